// Layouts with fewer patches are layouts still: looked at without the code that makes them.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "engine/layout/simplify/operations.h"
#include "engine/layout/simplify/relax.h"
#include "engine/layout/simplify/simplify_layout.h"
#include "engine/mesh/topology.h"
#include "tests/support/check_layout.h"
#include "tests/support/random_outlines.h"
#include "tests/support/seeded_random.h"
#include "tests/support/shapes.h"

namespace spia::simplify_test {
namespace {

using std::numbers::pi;
constexpr int plates_with_holes = 7; // the kind of random_outline()
constexpr CornerOptions usual_corners{50 * pi / 180, 1e30};

struct Divided {
    TriMesh part;
    Blank blank;
    Layout start;
};

Divided divided(const TriMesh& part, LayoutOptions options = {})
{
    Divided result{part, Blank{part.position.topRows(2)}, {}};
    options.layers = true;
    options.corner_radius = 1e30;
    result.start = make_layout(part, result.blank, options);
    return result;
}

Divided plate_by_lot(int number) { return divided(shapes::random_outline(plates_with_holes, number).part); }

int vertex_uses(const Layout& layout, const LayoutPatch& patch, size_t k)
{
    return layout.curve[size_t(patch[k].curve)].vertex[patch[k].reversed ? 1 : 0];
}

/// The sum of 4 - n over inner vertices and of 2 - n over those on the border, for n patches at the
/// vertex: 4 (1 - holes) for a disk with holes.
int index_sum(const Layout& layout)
{
    std::map<int, int> patches;
    std::set<int> border;
    for (const LayoutPatch& patch : layout.patch)
        for (size_t k = 0; k < 4; ++k)
            ++patches[vertex_uses(layout, patch, k)];
    for (const LayoutCurve& curve : layout.curve)
        if (curve.on_border())
            border.insert({curve.vertex[0], curve.vertex[1]});
    int sum = 0;
    for (const auto& [v, n] : patches)
        sum += (border.contains(v) ? 2 : 4) - n;
    return sum;
}

using Key = std::array<double, 3>;

Key key_of(const LayoutCurve& curve, Eigen::Index i) { return {curve.part(0, i), curve.part(1, i), curve.part(2, i)}; }

/// What is wrong with the curves along the border: every point of those of the start has to be one
/// of them (within one curve, or where two meet), to the last bit, on the blank and on the part;
/// and they are as long as the border.
std::string fault_of_border(const Layout& layout, const Layout& start)
{
    std::map<Key, std::array<double, 2>> place;
    std::map<Key, int> halves; // 2: covered once
    double length_now = 0, length_before = 0;
    for (const LayoutCurve& curve : layout.curve) {
        if (!curve.on_border())
            continue;
        length_now += length(curve);
        for (Eigen::Index i = 0; i < curve.part.cols(); ++i) {
            place[key_of(curve, i)] = {curve.plane(0, i), curve.plane(1, i)};
            halves[key_of(curve, i)] += i == 0 || i + 1 == curve.part.cols() ? 1 : 2;
        }
    }
    for (const LayoutCurve& curve : start.curve) {
        if (!curve.on_border())
            continue;
        length_before += length(curve);
        for (Eigen::Index i = 0; i < curve.part.cols(); ++i) {
            const Key key = key_of(curve, i);
            if (!place.contains(key))
                return "a point of the border is no point of a curve";
            if (place[key] != std::array{curve.plane(0, i), curve.plane(1, i)})
                return "a point of the border is elsewhere on the blank";
            if (halves[key] != 2)
                return "a point of the border is not covered once";
        }
    }
    if (std::abs(length_now - length_before) > 1e-9 * length_before)
        return "the curves are not as long as the border";
    return "";
}

/// The least area of the cells of Coons grids of all patches, over that of an even cell.
double least_cell(const Layout& layout)
{
    constexpr int n = 6;
    std::vector<double> t;
    for (int i = 0; i <= n; ++i)
        t.push_back(double(i) / n);
    double least = 1;
    for (const LayoutPatch& patch : layout.patch) {
        std::array<Eigen::Matrix2Xd, 4> side;
        for (size_t k = 0; k < 4; ++k) {
            side[k] = points_on(layout.curve[size_t(patch[k].curve)], t);
            if (patch[k].reversed != (k >= 2)) // all along u or v
                side[k] = side[k].rowwise().reverse().eval();
        }
        const auto at = [&](int i, int j) -> Eigen::Vector2d {
            const double u = t[size_t(i)], v = t[size_t(j)];
            return (1 - v) * side[0].col(i) + v * side[2].col(i) + (1 - u) * side[3].col(j) + u * side[1].col(j) -
                   (1 - u) * (1 - v) * side[0].col(0) - u * (1 - v) * side[0].col(n) - u * v * side[2].col(n) -
                   (1 - u) * v * side[2].col(0);
        };
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const Eigen::Vector2d p = at(i + 1, j + 1) - at(i, j), q = at(i, j + 1) - at(i + 1, j);
                least = std::min(least, (p.x() * q.y() - p.y() * q.x()) / 2 / area(layout, patch) * n * n);
            }
    }
    return least;
}

int vertices_on_border(const Layout& layout)
{
    return int(
        std::count_if(layout.curve.begin(), layout.curve.end(), [](const LayoutCurve& c) { return c.on_border(); }));
}

int loops_with_few_vertices(const Layout& layout)
{
    std::map<int, int> next, at_all;
    for (const LayoutCurve& curve : layout.curve)
        if (curve.on_border())
            next[curve.vertex[0]] = curve.vertex[1];
    int few = 0;
    while (!next.empty()) {
        int count = 0;
        for (int v = next.begin()->first; next.contains(v); ++count) {
            const int following = next[v];
            next.erase(v);
            v = following;
        }
        few += count < 3;
    }
    return few;
}

void expect_sound(const Layout& layout, const Divided& sheet)
{
    const int holes = int(boundary_loops(sheet.part).size()) - 1;
    EXPECT_EQ(shapes::fault_of_layout(layout, sheet.part, sheet.blank), "");
    EXPECT_EQ(fault_of_border(layout, sheet.start), "");
    EXPECT_EQ(index_sum(layout), 4 * (1 - holes));
    EXPECT_EQ(loops_with_few_vertices(layout), 0);
    EXPECT_GT(least_cell(layout), 0);
    // As many patches as the vertices ask for: F = inner vertices + border vertices / 2 + holes -
    // 1.
    const int border = vertices_on_border(layout), inner = int(layout.vertex.cols()) - border;
    EXPECT_EQ(2 * int(layout.patch.size()), 2 * inner + border + 2 * holes - 2);
}

bool same_bits(const Layout& a, const Layout& b)
{
    if (a.patch != b.patch || a.curve.size() != b.curve.size() || a.vertex != b.vertex)
        return false;
    for (size_t c = 0; c < a.curve.size(); ++c)
        if (a.curve[c].vertex != b.curve[c].vertex || a.curve[c].plane.cols() != b.curve[c].plane.cols() ||
            a.curve[c].plane != b.curve[c].plane || a.curve[c].kept != b.curve[c].kept)
            return false;
    return true;
}

double length_of_kept(const Layout& layout)
{
    double sum = 0;
    for (const LayoutCurve& curve : layout.curve)
        sum += curve.kept ? length(curve) : 0;
    return sum;
}

} // namespace

class SimplifyByLot : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Plates, SimplifyByLot, testing::Range(0, 20));

TEST_P(SimplifyByLot, LayoutStaysSoundWithFewerPatches)
{
    const Divided sheet = plate_by_lot(GetParam());
    SimplifyOptions options;
    options.effort = 0.2; // to be quick
    const Layout simple = simplify_layout(sheet.start, options);
    expect_sound(simple, sheet);
    EXPECT_LT(simple.patch.size(), sheet.start.patch.size() / 2);
}

TEST(Simplify, PlatesNeedFewPatchesForEachHole)
{
    std::vector<double> for_each_hole;
    for (int holes : {1, 2, 4, 9, 16}) {
        shapes::Plate plate{60.0 * std::ceil(std::sqrt(holes)), 60.0 * std::ceil(std::sqrt(holes)), {}, 3000};
        shapes::SeededRandom random{std::uint64_t(holes)};
        const int columns = int(std::ceil(std::sqrt(holes)));
        for (int h = 0; h < holes; ++h) {
            const int row = h / columns, column = h % columns;
            plate.holes.push_back(
                {{60.0 * column + random.between(22, 38), 60.0 * row + random.between(22, 38)}, random.between(6, 14)});
        }
        const Divided sheet = divided(shapes::plate(plate));
        const Layout simple = simplify_layout(sheet.start);
        expect_sound(simple, sheet);
        for_each_hole.push_back((double(simple.patch.size()) - 5) / holes);
        LayoutMesh mesh(simple, usual_corners);
        EXPECT_GE(mesh.least_quality(), 0.3) << holes << " round holes";
    }
    std::sort(for_each_hole.begin(), for_each_hole.end());
    EXPECT_LE(for_each_hole[for_each_hole.size() / 2], 5);
}

TEST(Simplify, CornersStayVertices)
{
    const Divided sheet = divided(shapes::plate({100, 80, {{{50, 40}, 15}, {{20, 20}, 6}}, 3000}));
    const Layout simple = simplify_layout(sheet.start);
    for (const auto& corner :
         {Eigen::Vector2d(0, 0), Eigen::Vector2d(100, 0), Eigen::Vector2d(100, 80), Eigen::Vector2d(0, 80)})
        EXPECT_LT((simple.vertex.colwise() - corner).colwise().norm().minCoeff(), 1e-9) << corner.transpose();
}

TEST(Simplify, CutsStaySidesOfPatches)
{
    const TriMesh part = shapes::plate({100, 80, {{{30, 40}, 10}, {{70, 40}, 10}}, 3000});
    const Blank blank{part.position.topRows(2)};
    LayoutOptions options;
    options.cuts = {
        {shapes::vertex_near(blank, 50, 0), shapes::vertex_near(blank, 48, 40), shapes::vertex_near(blank, 50, 80)}};
    const Divided sheet = divided(part, options);
    ASSERT_GT(length_of_kept(sheet.start), 79);
    const Layout simple = simplify_layout(sheet.start);
    expect_sound(simple, sheet);
    EXPECT_NEAR(length_of_kept(simple), length_of_kept(sheet.start), 1e-9);
    EXPECT_LT(simple.patch.size(), sheet.start.patch.size());
}

TEST(Simplify, TheSameLayoutComesOutToTheLastBit)
{
    const Divided sheet = plate_by_lot(6);
    EXPECT_TRUE(same_bits(simplify_layout(sheet.start), simplify_layout(sheet.start)));
}

TEST(LayoutMesh, GivesItsLayoutBack)
{
    const Divided sheet = plate_by_lot(4);
    const Layout back = LayoutMesh(sheet.start, usual_corners).layout(sheet.start);
    expect_sound(back, sheet);
    EXPECT_EQ(back.patch.size(), sheet.start.patch.size());
}

TEST(LayoutMesh, RefinedHasFourTimesThePatches)
{
    const Divided sheet = divided(shapes::plate({100, 80, {{{50, 40}, 15}}, 3000}));
    LayoutMesh mesh(sheet.start, usual_corners);
    mesh.refine();
    const Layout fine = mesh.layout(sheet.start);
    EXPECT_EQ(fine.patch.size(), 4 * sheet.start.patch.size());
    expect_sound(fine, sheet);
}

TEST(LayoutMesh, UndoneTrialsLeaveItAsItWas)
{
    const Divided sheet = plate_by_lot(5);
    LayoutMesh mesh(sheet.start, usual_corners);
    const Layout before = mesh.layout(sheet.start);
    const double energy = mesh.energy();
    shapes::SeededRandom random{1};
    int possible = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const int face = random.whole(0, mesh.faces() - 1), k = random.whole(0, 3);
        mesh.begin();
        bool done = false;
        switch (random.whole(0, 3)) {
        case 0: done = collapse_diagonal(mesh, face, k); break;
        case 1: done = collapse_strip(mesh, strip_of(mesh, face, k)); break;
        case 2: done = rotate_side(mesh, face, k, random.coin()); break;
        default: done = remove_doublet(mesh, mesh.face(face).vertex[size_t(k)]);
        }
        if (done && mesh.sound()) {
            ++possible;
            mesh.judge_edited();
            relax(mesh, std::vector<int>(mesh.edited_vertices()), 1, 0.2);
        }
        mesh.undo();
    }
    EXPECT_GT(possible, 200);
    EXPECT_EQ(mesh.energy(), energy);
    EXPECT_TRUE(same_bits(mesh.layout(sheet.start), before));
}

} // namespace spia::simplify_test
