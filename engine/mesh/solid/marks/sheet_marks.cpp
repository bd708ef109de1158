#include "engine/mesh/solid/marks/sheet_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <map>
#include <optional>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/solid/marks/sheet_heights.h"
#include "engine/mesh/solid/thin_solid.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Of the thickness: heights over the chords of coarse bends are off by the deflection; how deep a
/// mark is, its walls tell then.
constexpr double deepest_over_chords = deepest_mark + 0.05;

PieceSide other_of(PieceSide side) { return side == PieceSide::one ? PieceSide::other : PieceSide::one; }

/// Of each side the pieces that hang together with its largest ones.
std::vector<char> main_parts(const SurfacePieces& pieces, const std::vector<PieceSide>& side)
{
    DisjointSets together(size_t(pieces.count()));
    for (const PieceContact& c : pieces.contact)
        if (side[size_t(c.a)] == side[size_t(c.b)])
            together.join(c.a, c.b);
    std::vector<double> size(size_t(pieces.count()), 0);
    for (int p = 0; p < pieces.count(); ++p)
        size[size_t(together.root(p))] += pieces.area[size_t(p)];
    std::vector<char> main(size_t(pieces.count()), 0);
    for (const PieceSide s : {PieceSide::one, PieceSide::other}) {
        int largest = -1;
        for (int p = 0; p < pieces.count(); ++p)
            if (side[size_t(p)] == s && (largest < 0 || size[size_t(together.root(p))] > size[size_t(largest)]))
                largest = together.root(p);
        for (int p = 0; p < pieces.count(); ++p)
            main[size_t(p)] |= largest >= 0 && side[size_t(p)] == s && together.root(p) == largest;
    }
    return main;
}

bool has_triangles(const SurfacePieces& pieces, const std::vector<char>& main, const std::vector<PieceSide>& side,
                   PieceSide of)
{
    for (int p = 0; p < pieces.count(); ++p)
        if (main[size_t(p)] && side[size_t(p)] == of)
            return true;
    return false;
}

/// Pieces that may be of a mark: off the main parts of both skins, and not from one to the other.
std::vector<char> candidates(const SurfacePieces& pieces, const std::vector<PieceSide>& side,
                             const std::vector<char>& main)
{
    std::vector<char> touches(size_t(pieces.count()), 0), result;
    for (const PieceContact& c : pieces.contact)
        for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            if (main[size_t(q)])
                touches[size_t(p)] |= side[size_t(q)] == PieceSide::one ? 1 : 2;
    for (int p = 0; p < pieces.count(); ++p)
        result.push_back(!main[size_t(p)] && touches[size_t(p)] != 3);
    return result;
}

/// Takes floors of marks from the main part of their skin that hang together with it smoothly where
/// they run out, into a bend say: they are off its level elsewhere, and meet walls that do not
/// reach the other skin.
void take_out_floors(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, const SurfacePieces& pieces,
                     const std::vector<PieceSide>& side, double thickness, std::vector<char>& main)
{
    const std::vector<char> free = candidates(pieces, side, main);
    std::vector<char> perhaps(size_t(pieces.count()), 0);
    for (const PieceContact& c : pieces.contact)
        for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            perhaps[size_t(p)] |= main[size_t(p)] && free[size_t(q)] && c.concave + c.convex > 0;
    const std::vector<char> skins = main;
    for (const PieceSide skin : {PieceSide::one, PieceSide::other}) {
        const auto of_skin = [&](int p) { return side[size_t(p)] == skin && skins[size_t(p)]; };
        bool any = false;
        double whole = 0;
        for (int p = 0; p < pieces.count(); ++p) {
            any |= of_skin(p) && perhaps[size_t(p)];
            whole += of_skin(p) ? pieces.area[size_t(p)] : 0;
        }
        if (!any || !has_triangles(pieces, skins, side, other_of(skin)))
            continue;
        const auto piece = [&](int f) { return pieces.piece[size_t(f)]; };
        SheetHeights height(
            mesh, [&](int f) { return skins[size_t(piece(f))] && side[size_t(piece(f))] == other_of(skin); },
            2 * thickness);
        std::vector<double> most(size_t(pieces.count()), 0), sum(size_t(pieces.count()), 0);
        for (int f = 0; f < mesh.triangles(); ++f)
            for (int k = 0; k < 3 && of_skin(piece(f)) && perhaps[size_t(piece(f))]; ++k) {
                const double above = height.square_to(mesh.triangle(k, f), normal.col(f).normalized()) - thickness;
                most[size_t(piece(f))] = std::max(most[size_t(piece(f))], std::abs(above));
                sum[size_t(piece(f))] += above * normal.col(f).norm() / 3;
            }
        // of the thickness on average; of the skin's area
        constexpr double off = 4 * chords_off_bends, half = 0.5;
        for (int p = 0; p < pieces.count(); ++p)
            if (of_skin(p) && perhaps[size_t(p)] && pieces.area[size_t(p)] < half * whole &&
                most[size_t(p)] <= deepest_over_chords * thickness &&
                std::abs(sum[size_t(p)]) > off * thickness * pieces.area[size_t(p)])
                main[size_t(p)] = 0;
    }
}

/// A skin at its vertices, by the triangles of it around them.
struct SkinAtVertices {
    Eigen::Matrix3Xd normal; ///< sum of their area vectors; zero: not on the skin
    Eigen::VectorXd size;    ///< mm2, sum of their lengths

    bool has(int v) const { return size[v] > 0; }
    // but for 0.1 degrees
    bool plane(int v) const { return normal.col(v).norm() > (1 - 1e-6) * size[v]; }
};

template <class OnSkin>
SkinAtVertices skin_at_vertices(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, const OnSkin& on_skin)
{
    SkinAtVertices result{Eigen::Matrix3Xd::Zero(3, mesh.vertices()), Eigen::VectorXd::Zero(mesh.vertices())};
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3 && on_skin(f); ++k) {
            result.normal.col(mesh.triangle(k, f)) += normal.col(f);
            result.size[mesh.triangle(k, f)] += normal.col(f).norm();
        }
    return result;
}

/// The most at the feet of its walls: of the steepest way up to the skin from there its height; on
/// a bend, whose chords' normals are off, its length if it goes about straight up; what is on flats
/// too is told by them. Else how far the foot is off the level of its own.
/// @param above  mm, a vertex over that level
double depth_of_mark(const TriMesh& mesh, const SheetMark& mark, const SkinAtVertices& skin,
                     const HeightAboveSkin& above, double thickness)
{
    constexpr double straight =
        0.94; // cosine: the skin's normals at the edge of a mark on a bend are off by half a chord,
              // 10 degrees
    struct Way {
        double cosine = 0, length = 0;
        bool plane = false;
    };
    std::map<int, Way> up;
    double most = 0;
    for (const std::vector<int>* faces : {&mark.wall, &mark.floor}) {
        if (most > 0)
            break; // the floor alone says less
        for (const int f : *faces)
            for (int k = 0; k < 3; ++k) {
                const int v = mesh.triangle(k, f);
                if (skin.has(v))
                    continue;
                Way& way = up[v];
                for (const int w : mesh.triangle.col(f))
                    if (skin.has(w)) {
                        const Eigen::Vector3d edge = mesh.position.col(v) - mesh.position.col(w);
                        const double cosine = std::abs(edge.normalized().dot(skin.normal.col(w).normalized()));
                        if (cosine > way.cosine)
                            way = {cosine, edge.norm(), skin.plane(w)};
                    }
            }
        double in_flats = 0, in_bends = 0;
        for (const auto& [v, way] : up) {
            const double off = std::abs(above(v));
            const double high = !way.plane && way.cosine > straight ? way.length : way.cosine * way.length;
            const bool by_wall = high > 0 && std::abs(high - off) < 0.25 * off + 4 * chords_off_bends * thickness;
            double& here = way.plane ? in_flats : in_bends;
            here = std::max(here, by_wall ? high : off);
        }
        constexpr double askew = 1.15; // what a way up a bend is longer by, 30 degrees off its radius
        most = in_bends > askew * in_flats ? in_bends : in_flats;
    }
    return most;
}

/// Of a groove with two ends at the rim, the share of its outline there; a chamfer has about half.
constexpr double most_rim = 0.25;

/// mm, of each piece, where it touches others.
std::vector<double> outlines(const SurfacePieces& pieces)
{
    std::vector<double> result(size_t(pieces.count()), 0);
    for (const PieceContact& c : pieces.contact)
        for (const int p : {c.a, c.b})
            result[size_t(p)] += c.length();
    return result;
}

/// Takes chamfers and roundings of the border off pieces that may be of marks: else one beside a
/// step would be a wall of that. Of a rounding in a mesh each chord goes over into the next one.
void leave_borders(const SurfacePieces& pieces, const std::vector<PieceSide>& side, const std::vector<char>& main,
                   PieceSide skin, std::vector<char>& level)
{
    const std::vector<double> whole = outlines(pieces);
    std::vector<double> smooth(level.size(), 0);
    for (const PieceContact& c : pieces.contact)
        for (const int p : {c.a, c.b})
            smooth[size_t(p)] += c.smooth;
    constexpr double goes_over = 0.25; // of what goes on smoothly; along a straight strip a half
    for (bool first = true, more = true; more; first = false) {
        more = false;
        std::vector<double> along_rim(level.size(), 0), into_rim = along_rim;
        for (const PieceContact& c : pieces.contact)
            for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
                if (!level[size_t(q)] && !(main[size_t(q)] && side[size_t(q)] == skin)) {
                    along_rim[size_t(p)] += c.length();
                    into_rim[size_t(p)] += c.smooth;
                }
        for (size_t p = 0; p < level.size(); ++p)
            if (level[p] && side[p] != skin &&
                ((first && along_rim[p] >= most_rim * whole[p]) || into_rim[p] > goes_over * smooth[p])) {
                level[p] = 0;
                more = true;
            }
    }
}

void find_marks_on(PieceSide skin, const TriMesh& mesh, const Eigen::Matrix3Xd& normal, double flipped,
                   const SurfacePieces& pieces, const std::vector<char>& main, std::vector<PieceSide>& side,
                   double thickness, std::vector<SheetMark>& marks)
{
    std::vector<char> level = candidates(pieces, side, main);
    if (std::none_of(level.begin(), level.end(), [](char c) { return c != 0; }) ||
        !has_triangles(pieces, main, side, other_of(skin)))
        return;
    const auto piece = [&](int f) { return size_t(pieces.piece[size_t(f)]); };
    HeightAboveSkin above_skin(
        mesh, [&](int f) { return main[piece(f)] && side[piece(f)] == skin; },
        [&](int f) { return main[piece(f)] && side[piece(f)] == other_of(skin); }, thickness, flipped);
    std::vector<double> off(size_t(pieces.count()), 0), raised(size_t(pieces.count()), 0);
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3 && level[piece(f)]; ++k) {
            const int v = mesh.triangle(k, f);
            const double above =
                side[piece(f)] == skin ? above_skin.of_floor(v, normal.col(f).normalized()) : above_skin(v);
            off[piece(f)] = std::max(off[piece(f)], std::abs(above));
            raised[piece(f)] += above * normal.col(f).norm();
            level[piece(f)] = off[piece(f)] <= deepest_over_chords * thickness;
        }

    leave_borders(pieces, side, main, skin, level);

    DisjointSets together(size_t(pieces.count()));
    for (const PieceContact& c : pieces.contact)
        if (level[size_t(c.a)] && level[size_t(c.b)])
            together.join(c.a, c.b);
    struct Group {
        double along_skin = 0, along_rim = 0, smoothly = 0; ///< mm; the last one of the first
        /// off: some vertex is not one of the skin, and can be moved to it; floor: a triangle that
        /// looks as the skin does has one that is not at the rim either, or is level below it, as
        /// none of a chamfer does
        bool floor = false, off = false;
    };
    std::map<int, Group> groups;
    const SkinAtVertices skin_at =
        skin_at_vertices(mesh, normal, [&](int f) { return main[piece(f)] && side[piece(f)] == skin; });
    std::vector<char> at_rim(size_t(mesh.vertices()), 0);
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3 && !level[piece(f)] && !(main[piece(f)] && side[piece(f)] == skin); ++k)
            at_rim[size_t(mesh.triangle(k, f))] = 1;
    for (int f = 0; f < mesh.triangles(); ++f) {
        if (!level[piece(f)])
            continue;
        Group& group = groups[together.root(pieces.piece[size_t(f)])];
        bool below = side[piece(f)] == skin; // wholly
        Eigen::Array3d depth;
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.triangle(k, f);
            group.off |= !skin_at.has(v);
            group.floor |= side[piece(f)] == skin && !skin_at.has(v) && !at_rim[size_t(v)];
            below &= !skin_at.has(v);
            depth[k] = below ? above_skin.of_floor(v, normal.col(f).normalized()) : 0;
        }
        constexpr double even = 0.1; // of the depth: facets of a rounding are not
        group.floor |= below && depth.maxCoeff() - depth.minCoeff() < even * std::abs(depth.mean());
    }
    for (const PieceContact& c : pieces.contact)
        for (const auto& [p, q] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
            if (level[size_t(p)] && !level[size_t(q)]) {
                Group& group = groups[together.root(p)];
                const bool reaches = main[size_t(q)] && side[size_t(q)] == skin;
                (reaches ? group.along_skin : group.along_rim) += c.length();
                group.smoothly += reaches ? c.smooth : 0;
            }
    std::map<int, int> number;
    std::vector<SheetMark> found_marks;
    for (const auto& [root, group] : groups)
        if (const bool edge = group.smoothly < group.along_skin / 2; // else it is a bend
            edge && group.off && (group.floor || group.along_rim < most_rim * group.along_skin)) {
            number[root] = int(found_marks.size());
            found_marks.emplace_back();
        }
    for (int f = 0; f < mesh.triangles(); ++f) {
        const auto found = level[piece(f)] ? number.find(together.root(pieces.piece[size_t(f)])) : number.end();
        if (found == number.end())
            continue;
        SheetMark& mark = found_marks[size_t(found->second)];
        (side[piece(f)] == skin ? mark.floor : mark.wall).push_back(f);
        const double size = normal.col(f).norm();
        mark.area += size;
        mark.place += size * mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean();
        if (mark.face < 0 || size > normal.col(mark.face).norm())
            mark.face = f;
    }
    for (const auto& [root, i] : number) {
        SheetMark& mark = found_marks[size_t(i)];
        mark.depth = depth_of_mark(mesh, mark, skin_at, above_skin, thickness);
        constexpr double rounding = 1e-3; // of the depth; pieces had to do with heights over chords
        if (mark.depth > (1 + rounding) * deepest_mark * thickness)
            continue;
        double above = 0;
        for (int p = 0; p < pieces.count(); ++p)
            if (level[size_t(p)] && together.root(p) == root) {
                above += raised[size_t(p)];
                side[size_t(p)] = skin;
            }
        mark.raised = above > 0;
        mark.place /= mark.area > 0 ? mark.area : 1;
        marks.push_back(std::move(mark));
    }
}

} // namespace

std::vector<SheetMark> find_marks(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, double flipped,
                                  const SurfacePieces& pieces, std::vector<PieceSide>& side, double thickness)
{
    std::vector<SheetMark> marks;
    std::vector<char> main = main_parts(pieces, side);
    take_out_floors(mesh, normal, pieces, side, thickness, main);
    for (const PieceSide skin : {PieceSide::one, PieceSide::other})
        find_marks_on(skin, mesh, normal, flipped, pieces, main, side, thickness, marks);
    return marks;
}

double depth_of(const TriMesh& mesh, const SurfacePieces& pieces, const std::vector<PieceSide>& side,
                const std::vector<char>& chosen, PieceSide skin, double thickness)
{
    const std::vector<char> main = main_parts(pieces, side);
    if (!has_triangles(pieces, main, side, other_of(skin)))
        return 0;
    const auto piece = [&](int f) { return size_t(pieces.piece[size_t(f)]); };
    const SheetHeights height(
        mesh, [&](int f) { return main[piece(f)] && side[piece(f)] == other_of(skin); }, 10 * thickness);
    double most = 0;
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3 && chosen[piece(f)]; ++k)
            most = std::max(most, std::abs(height.over_nearest(mesh.triangle(k, f)) - thickness));
    return most;
}

} // namespace spia
