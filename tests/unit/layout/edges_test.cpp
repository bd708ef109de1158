// Patches that end on the sharp edges of a part: folded sheets, whose flat sides four control
// points each way hold exactly.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <numbers>

#include "engine/core/error.h"
#include "engine/layout/fit_patches.h"
#include "engine/layout/plane_graph.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/certificate.h"
#include "tests/support/check_layout.h"
#include "tests/support/shapes.h"

namespace spia::edges_test {

namespace {

using std::numbers::pi;

struct Sheet {
    TriMesh part;
    Blank blank;
};

/// A rectangle of square cells of 5 mm, x from 0 and y from 0, without the cells that are not to be
/// there, and bent: place(x, y).
Sheet sheet(int columns, int rows, const std::function<bool(int, int)>& there,
            const std::function<Eigen::Vector3d(double, double)>& place)
{
    constexpr double cell = 5;
    std::map<std::array<int, 2>, int> number;
    std::vector<Eigen::Vector3i> faces;
    const auto node = [&](int i, int j) { return number.emplace(std::array{i, j}, int(number.size())).first->second; };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            if (there(i, j)) {
                const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
                faces.emplace_back(a, b, c);
                faces.emplace_back(a, c, d);
            }
    Sheet result;
    result.part.position.resize(3, Eigen::Index(number.size()));
    result.blank.position.resize(2, Eigen::Index(number.size()));
    for (const auto& [at, v] : number) {
        result.blank.position.col(v) << cell * at[0], cell * at[1];
        result.part.position.col(v) = place(cell * at[0], cell * at[1]);
    }
    result.part.triangle.resize(3, Eigen::Index(faces.size()));
    for (size_t f = 0; f < faces.size(); ++f)
        result.part.triangle.col(Eigen::Index(f)) = faces[f];
    return result;
}

constexpr int sectors = 48;

/// Rings of cells around the origin, bent: place(on the blank).
/// @param radius  of the rings of vertices, mm, rising
/// @param filled  within the first one, too
Sheet round_sheet(const std::vector<double>& radius, bool filled,
                  const std::function<Eigen::Vector3d(const Eigen::Vector2d&)>& place)
{
    const int rings = int(radius.size()), centre = rings * sectors;
    const auto node = [](int r, int s) { return r * sectors + s % sectors; };
    Sheet result;
    result.blank.position = Eigen::Matrix2Xd::Zero(2, centre + int(filled));
    std::vector<Eigen::Vector3i> faces;
    for (int s = 0; s < sectors; ++s) {
        for (int r = 0; r < rings; ++r) {
            result.blank.position.col(node(r, s)) =
                radius[size_t(r)] * Eigen::Vector2d(std::cos(2 * pi * s / sectors), std::sin(2 * pi * s / sectors));
            if (r > 0) {
                faces.emplace_back(node(r - 1, s), node(r, s), node(r, s + 1));
                faces.emplace_back(node(r - 1, s), node(r, s + 1), node(r - 1, s + 1));
            }
        }
        if (filled)
            faces.emplace_back(centre, node(0, s), node(0, s + 1));
    }
    result.part.position.resize(3, result.blank.position.cols());
    for (Eigen::Index v = 0; v < result.blank.position.cols(); ++v)
        result.part.position.col(v) = place(result.blank.position.col(v));
    result.part.triangle.resize(3, Eigen::Index(faces.size()));
    for (size_t f = 0; f < faces.size(); ++f)
        result.part.triangle.col(Eigen::Index(f)) = faces[f];
    return result;
}

bool everywhere(int, int) { return true; }

/// Folded along x = 50 by an angle.
std::function<Eigen::Vector3d(double, double)> folded(double angle)
{
    return [angle](double x, double y) {
        const double beyond = std::max(0., x - 50);
        return Eigen::Vector3d(x - beyond + beyond * std::cos(angle), y, beyond * std::sin(angle));
    };
}

int control_points(const PatchesFit& fit)
{
    int count = 0;
    for (const NurbsSurface& patch : fit.patches.patch)
        count += int(patch.control.cols());
    return count;
}

/// Along its edges, whatever that costs.
PatchesFit fitted_along(const Sheet& sheet, double tolerance)
{
    PatchesFitOptions options;
    options.tolerance = tolerance;
    return fit_patches(sheet.part, sheet.blank, make_layout(sheet.part, sheet.blank), options);
}

double length_of_kept(const Layout& layout)
{
    double sum = 0;
    for (const LayoutCurve& curve : layout.curve)
        sum += curve.kept ? length(curve) : 0;
    return sum;
}

PatchesFit fitted(const Sheet& sheet, double tolerance, double edge_deg = LayoutOptions{}.edge_deg)
{
    LayoutOptions layout;
    layout.edge_deg = edge_deg;
    PatchesFitOptions options;
    options.tolerance = tolerance;
    return blank_patches(sheet.part, sheet.blank, layout, options);
}

} // namespace

TEST(Edges, AFoldedSheetIsOnePatchOnEachSideOfTheFold)
{
    const Sheet fold = sheet(20, 12, everywhere, folded(pi / 2));
    const PatchesFit fit = fitted(fold, 0.01);
    EXPECT_EQ(fit.layout.edges, 1);
    EXPECT_EQ(shapes::fault_of_layout(fit.layout, fold.part, fold.blank), "");
    EXPECT_EQ(fit.patches.patch.size(), 2u);
    EXPECT_EQ(control_points(fit), 32);
    EXPECT_LT(fit.deviation_max(), 1e-9);
    const PatchesFit across = fitted(fold, 0.01, 180);
    EXPECT_EQ(across.layout.edges, 0);
    EXPECT_GT(control_points(across), 5 * control_points(fit)) << "the smooth surface follows the fold by its knots";
}

TEST(Edges, AreTakenFromTheGivenAngleOn)
{
    for (const double angle : {44., 46.}) {
        const Sheet fold = sheet(20, 12, everywhere, folded(angle * pi / 180));
        EXPECT_EQ(make_layout(fold.part, fold.blank).edges, angle > 45 ? 1 : 0) << angle;
        LayoutOptions flatter;
        flatter.edge_deg = 40;
        EXPECT_EQ(make_layout(fold.part, fold.blank, flatter).edges, 1) << angle;
    }
}

TEST(Edges, NoPatchReachesAcrossAFoldBetweenWindows)
{
    const auto frame = [](int i, int j) {
        const bool left = i >= 3 && i < 7 && j >= 4 && j < 8, right = i >= 13 && i < 16 && j >= 2 && j < 9;
        return !left && !right;
    };
    const Sheet fold = sheet(20, 12, frame, folded(pi / 2));
    const PatchesFit fit = fitted(fold, 0.01);
    EXPECT_EQ(shapes::fault_of_layout(fit.layout, fold.part, fold.blank), "");
    EXPECT_NEAR(length_of_kept(fit.layout), 60, 1e-9);
    for (const LayoutPatch& patch : fit.layout.patch) {
        const Eigen::Matrix2Xd border = polygon_of(fit.layout, patch).point;
        EXPECT_TRUE(border.row(0).maxCoeff() <= 50 || border.row(0).minCoeff() >= 50);
    }
    EXPECT_LT(fit.deviation_max(), 1e-9);
    EXPECT_TRUE(certify(fit.patches).suited());
}

TEST(Edges, NoPatchReachesAcrossADiagonalFold)
{
    // Two triangles, which would make a good patch together.
    const Sheet fold = sheet(12, 12, everywhere, [](double x, double y) {
        const double off = std::max(0., x - y) / 2; // turned up about the line x = y
        return Eigen::Vector3d(x - off, y + off, off * std::sqrt(2.));
    });
    const PatchesFit fit = fitted(fold, 0.01);
    EXPECT_EQ(shapes::fault_of_layout(fit.layout, fold.part, fold.blank), "");
    EXPECT_EQ(fit.patches.patch.size(), 6u);
    EXPECT_NEAR(length_of_kept(fit.layout), 60 * std::sqrt(2.), 1e-9);
    EXPECT_LT(fit.deviation_max(), 1e-9);
}

TEST(Edges, RingsAroundHolesKeepClearOfAFold)
{
    const Sheet fold = sheet(
        30, 30, [](int i, int j) { return i < 7 || i > 8 || j < 14 || j > 15; },
        folded(pi / 2)); // a window at x = 35 to 45
    const Layout layout = make_layout(fold.part, fold.blank);
    EXPECT_EQ(layout.edges, 1);
    EXPECT_EQ(shapes::fault_of_layout(layout, fold.part, fold.blank), "");
    const PatchesFit fit = fitted(fold, 0.01);
    EXPECT_LT(fit.deviation_max(), 1e-9);
}

TEST(Edges, AHoleMayLieAcrossAFold)
{
    // A washer, folded along its diameter.
    const Sheet fold = round_sheet({12, 18, 25, 33, 42, 52}, false, [](const Eigen::Vector2d& at) {
        return Eigen::Vector3d(at.x(), std::min(at.y(), 0.), std::max(at.y(), 0.));
    });
    for (const bool layers : {false, true}) {
        LayoutOptions options;
        options.layers = layers;
        const Layout layout = make_layout(fold.part, fold.blank, options);
        EXPECT_EQ(layout.edges, 2) << layers;
        EXPECT_EQ(shapes::fault_of_layout(layout, fold.part, fold.blank), "") << layers;
        double shortest = 100;
        for (const LayoutCurve& curve : layout.curve)
            shortest = std::min(shortest, length(curve));
        EXPECT_GT(shortest, 1) << layers; // mm: a layer along the fold would have no depth
    }
    const PatchesFit fit = fitted(fold, 0.05);
    EXPECT_TRUE(fit.reached) << fit.deviation_max();
    EXPECT_TRUE(certify(fit.patches).suited());
}

TEST(Edges, AFoldMayEndWithinTheSheet)
{
    // A crease along x = 50 that is flat at y = 0 and sharper and sharper from there on; its
    // projection is taken for the blank.
    const auto creased = [](double x, double y) { return Eigen::Vector3d(x, y, std::abs(x - 50) * y / 60); };
    const Sheet crease = sheet(20, 24, everywhere, creased);
    const PatchesFit fit = fitted_along(crease, 0.05);
    EXPECT_EQ(fit.layout.edges, 1);
    EXPECT_EQ(shapes::fault_of_layout(fit.layout, crease.part, crease.blank), "");
    // The normals beside it are 2 atan(y / 60) apart: 45 degrees at y = 24.9; edges are 5 mm long.
    EXPECT_NEAR(length_of_kept(fit.layout), 120 - 24.9, 5);
    EXPECT_TRUE(certify(fit.patches).suited());
    EXPECT_TRUE(fit.reached) << fit.deviation_max();
}

TEST(Edges, MayBeClosed)
{
    // A flat rim, a wall of 60 degrees and a flat top, round: two closed edges. The projection is
    // taken for the blank.
    const Sheet cup = round_sheet({10, 20, 27, 34, 45, 56}, true, [](const Eigen::Vector2d& at) {
        return Eigen::Vector3d(at.x(), at.y(), std::sqrt(3.) * std::clamp(34 - at.norm(), 0., 14.));
    });
    const PatchesFit fit = fitted(cup, 0.1);
    EXPECT_EQ(fit.layout.edges, 2);
    EXPECT_EQ(shapes::fault_of_layout(fit.layout, cup.part, cup.blank), "");
    const double round = 2 * sectors * std::sin(pi / sectors) * (20 + 34);
    EXPECT_NEAR(length_of_kept(fit.layout), round, 1e-9 * round);
    EXPECT_TRUE(fit.reached) << fit.deviation_max();
    EXPECT_TRUE(certify(fit.patches).suited());
    const PatchesFit across = fitted(cup, 0.1, 180);
    EXPECT_GT(control_points(across), 3 * control_points(fit));
}

TEST(Edges, ARoughSheetHasNone)
{
    const Sheet rough = sheet(30, 30, everywhere, [](double x, double y) {
        // some 60 degrees at most of its edges
        return Eigen::Vector3d(x, y, 4 * std::sin(12.9898 * x + 78.233 * y));
    });
    EXPECT_TRUE(sharp_edges(rough.part, pi / 4).empty());
    EXPECT_GT(sharp_edges(sheet(20, 12, everywhere, folded(pi / 2)).part, pi / 4).size(), 0u);
}

TEST(Edges, ControlPointsThatAreNotEnoughGoToTheFarthestPatches)
{
    // Across a fold no count is enough; all that are allowed are used, and more bring the patches
    // nearer.
    const Sheet fold = sheet(23, 12, everywhere, folded(pi / 2));
    LayoutOptions across;
    across.edge_deg = 180;
    PatchesFitOptions options;
    options.tolerance = 1e-6;
    double before = std::numeric_limits<double>::infinity();
    for (const int most : {150, 300, 600}) {
        options.max_control_points = most;
        const PatchesFit fit = blank_patches(fold.part, fold.blank, across, options);
        EXPECT_FALSE(fit.reached);
        EXPECT_LE(control_points(fit), most);
        EXPECT_GT(fit.attempts.size(), 1u);
        EXPECT_EQ(std::count_if(fit.attempts.begin(), fit.attempts.end(), [](const auto& each) { return each.won; }),
                  1);
        EXPECT_LT(fit.deviation_max(), before);
        before = fit.deviation_max();
    }
}

TEST(Edges, AFlangeMayBeNarrow)
{
    // Its corner is right beside the end of the fold, and is a corner of patches all the same.
    for (const double width : {0.2, 1., 2.4, 5.}) {
        const Sheet fold = sheet(11, 12, everywhere, folded(pi / 2));
        Sheet narrow = fold;
        for (Eigen::Index v = 0; v < fold.part.position.cols(); ++v)
            if (fold.blank.position(0, v) > 50) {
                narrow.blank.position(0, v) = 50 + width;
                narrow.part.position.col(v) << 50, fold.blank.position(1, v), width;
            }
        const PatchesFit fit = fitted(narrow, 0.01);
        EXPECT_EQ(fit.patches.patch.size(), 2u) << width;
        EXPECT_LT(fit.deviation_max(), 1e-9) << width;
    }
}

TEST(Edges, FoldsMayBeCloseTogether)
{
    // Two folds 0.05 mm apart on 60 mm: layers beside them are as thin, but not as short.
    Sheet step = sheet(11, 12, everywhere, folded(0));
    for (Eigen::Index v = 0; v < step.part.position.cols(); ++v) {
        const double x = step.blank.position(0, v), up = std::clamp(x - 45, 0., 5.) / 100, on = std::max(0., x - 50);
        step.blank.position(0, v) = std::min(x, 45.) + up + on;
        step.part.position.col(v) << std::min(x, 45.) + on, step.blank.position(1, v), up;
    }
    LayoutOptions options;
    options.layers = true;
    const Layout layout = make_layout(step.part, step.blank, options);
    EXPECT_EQ(layout.edges, 2);
    EXPECT_EQ(shapes::fault_of_layout(layout, step.part, step.blank), "");
    EXPECT_LT(layout.patch.size(), 600u);
    EXPECT_LT(fitted(step, 0.01).deviation_max(), 1e-9);
}

TEST(Edges, AChordOfARoundSheetMayBeFolded)
{
    // The arc beside the chord has no corner: the face between them would have two sides.
    const Sheet fold = round_sheet({10, 20, 30, 40, 50}, true,
                                   [](const Eigen::Vector2d& at) { return Eigen::Vector3d(at.x(), at.y(), 0); });
    Sheet chord = fold;
    constexpr double x0 = 50 * 0.92387953251128674; // cos(22.5 degrees): the line through the
                                                    // vertices 3 and -3 of the rim
    for (Eigen::Index v = 0; v < chord.part.position.cols(); ++v) {
        Eigen::Vector2d at = fold.blank.position.col(v);
        // The last ring but one is moved onto the chord where it is beside it; its first vertex
        // close to the rim's.
        const double angle = std::atan2(at.y(), at.x()) * 180 / pi;
        if (std::abs(at.norm() - 40) < 1e-9 && angle > -22.6 && angle < 22.4)
            at = Eigen::Vector2d(x0, angle < -22.4 ? -17 : x0 * std::tan(angle * pi / 180));
        chord.blank.position.col(v) = at;
        const double beyond = std::max(0., at.x() - x0);
        chord.part.position.col(v) << at.x() - beyond, at.y(), beyond;
    }
    const PatchesFit fit = fitted_along(chord, 0.1);
    EXPECT_EQ(fit.layout.edges, 1);
    EXPECT_EQ(shapes::fault_of_layout(fit.layout, chord.part, chord.blank), "");
    EXPECT_TRUE(fit.reached) << fit.deviation_max();
    EXPECT_TRUE(certify(fit.patches).suited());
}

TEST(Edges, MoreThanTheyMayBeAreTakenFromASharperAngleOn)
{
    // 240 folds of 20 degrees, one of 60.
    Sheet many = sheet(250, 2, everywhere, folded(0));
    Eigen::Vector2d at(0, 0);
    double angle = 0;
    std::vector<Eigen::Vector2d> profile = {at};
    for (int i = 0; i < 250; ++i) {
        at += 5 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        profile.push_back(at);
        angle = i == 245 ? 60 * pi / 180 : i < 241 ? (i % 2 ? 0 : 20 * pi / 180) : 0;
    }
    for (Eigen::Index v = 0; v < many.part.position.cols(); ++v) {
        const Eigen::Vector2d p = profile[size_t(std::lround(many.blank.position(0, v) / 5))];
        many.part.position.col(v) << p.x(), many.blank.position(1, v), p.y();
    }
    EXPECT_EQ(sharp_edges(many.part, 50 * pi / 180).size(), 2u); // up and down again
    EXPECT_EQ(sharp_edges(many.part, 10 * pi / 180).size(), 2u) << "not none, and not all 240";
}

TEST(Edges, CutsMayCrossAtAVertexAndTouchTheBorder)
{
    const Sheet flat = sheet(20, 12, everywhere, folded(0));
    const auto vertex = [&](double x, double y) { return shapes::vertex_near(flat.blank, x, y); };
    const std::vector<std::vector<LayoutCut>> all = {
        {{vertex(50, 0), vertex(50, 30), vertex(50, 60)}, {vertex(0, 30), vertex(50, 30), vertex(100, 30)}},
        {{vertex(25, 0), vertex(50, 60), vertex(75, 0)}}};
    for (const auto& cuts : all)
        for (const bool layers : {false, true}) {
            LayoutOptions options;
            options.cuts = cuts;
            options.layers = layers;
            const Layout layout = make_layout(flat.part, flat.blank, options);
            EXPECT_EQ(shapes::fault_of_layout(layout, flat.part, flat.blank), "");
            EXPECT_NEAR(length_of_kept(layout), cuts.size() == 2 ? 160 : 130, 1e-9);
        }
}

TEST(Edges, ALayoutCanBeCancelled)
{
    const Sheet fold = sheet(20, 12, everywhere, folded(pi / 2));
    for (const bool layers : {false, true}) {
        LayoutOptions options;
        options.layers = layers;
        int left = 1;
        const auto stop = std::make_shared<std::atomic<bool>>(false);
        const Progress progress([&](double, std::string_view) { stop->store(--left <= 0); }, stop);
        EXPECT_THROW(make_layout(fold.part, fold.blank, options, progress), Cancelled) << layers;
    }
}

TEST(Edges, FlatterOnesAreTakenWhereTheToleranceLacks)
{
    const Sheet fold = sheet(23, 12, everywhere, folded(pi / 6));
    PatchesFitOptions options;
    options.tolerance = 1e-4;
    options.max_control_points = 200;
    const PatchesFit fit = blank_patches(fold.part, fold.blank, {}, options);
    EXPECT_TRUE(fit.reached);
    EXPECT_EQ(fit.layout.edges, 1);
    LayoutOptions none;
    none.edge_deg = 180;
    EXPECT_FALSE(blank_patches(fold.part, fold.blank, none, options).reached);
    options.tolerance = 10;
    EXPECT_EQ(blank_patches(fold.part, fold.blank, {}, options).layout.edges, 0);
}

TEST(Edges, WithoutEdgesIsTakenWhereThatCostsLess)
{
    // A fold of 46 degrees that a coarse tolerance does not see.
    const Sheet fold = sheet(20, 12, everywhere, folded(46 * pi / 180));
    EXPECT_EQ(fitted(fold, 30).layout.edges, 0);
    EXPECT_EQ(fitted(fold, 0.1).layout.edges, 1);
}

TEST(Edges, CutsStaySidesOfPatches)
{
    const TriMesh part = shapes::plate({100, 80, {{{25, 40}, 12}, {{75, 40}, 12}}, 4000});
    const Blank blank{part.position.topRows(2)};
    const auto nearest = [&](double x, double y) { return shapes::vertex_near(blank, x, y); };
    LayoutOptions options;
    options.cuts = {{nearest(50, 0), nearest(50, 80)}};
    const double cut = (blank.position.col(options.cuts[0][0]) - blank.position.col(options.cuts[0][1])).norm();
    const Layout layout = make_layout(part, blank, options);
    EXPECT_EQ(shapes::fault_of_layout(layout, part, blank), "");
    EXPECT_NEAR(length_of_kept(layout), cut, 1e-9 * cut);
}

} // namespace spia::edges_test
