#include "engine/mesh/solid/marks/refilled_bend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "engine/mesh/doctor/split_polygon.h"
#include "engine/mesh/flat/inside_polygon.h"
#include "engine/mesh/solid/bends/unrolled_skin.h"
#include "engine/mesh/vectors.h"

namespace spia {
namespace {

/// Numbers of corners, in order around it.
using PolygonRow = std::vector<int>;

/// A plane that triangles of the skin lie in, and their area.
struct Flat {
    StatedSurface plane;
    double area = 0;
};

/// By its corners: the normal of a sliver says nothing.
bool lies_in(const MarkedSkin& marked, int f, const StatedSurface& plane)
{
    return marked.normal.col(f).dot(plane.direction) > 0 &&
           std::ranges::all_of(marked.solid.triangle.col(f), [&](int v) {
               return std::abs((marked.solid.position.col(v) - plane.point).dot(plane.direction)) <= marked.flat;
           });
}

/// Planes of some triangles, those first that most of all the skin lies in.
std::vector<Flat> flats_of(const MarkedSkin& marked, std::vector<int> faces)
{
    std::vector<Flat> flats;
    std::ranges::stable_sort(faces, std::greater(), [&](int f) { return marked.normal.col(f).norm(); });
    for (const int f : faces) {
        if (std::ranges::any_of(flats, [&](const Flat& flat) { return lies_in(marked, f, flat.plane); }))
            continue;
        Flat flat;
        flat.plane.kind = StatedSurface::Kind::plane;
        flat.plane.point = marked.solid.position.col(marked.solid.triangle(0, f));
        flat.plane.direction = marked.normal.col(f).normalized();
        for (int g = 0; g < marked.solid.triangles(); ++g)
            if (marked.skin[size_t(g)] && lies_in(marked, g, flat.plane))
                flat.area += marked.normal.col(g).norm();
        flats.push_back(flat);
    }
    std::ranges::stable_sort(flats, std::greater(), &Flat::area);
    return flats;
}

/// Of a mesh: a cylinder through the vertices of triangles at the mark that lie in none of two
/// planes, of one or of none, whichever fits first. The planes are those with the most area; chords
/// of the bend touch no cylinder.
std::optional<UnrolledSkin> measured(const MarkedSkin& marked, const std::vector<int>& loop)
{
    std::vector<int> ring;
    for (const int v : loop)
        for (const int f : marked.around[size_t(v)])
            if (marked.skin[size_t(f)])
                ring.push_back(f);
    std::ranges::sort(ring);
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    const std::vector<Flat> flats = flats_of(marked, ring);
    const Eigen::Matrix3Xd points = marked.solid.position(Eigen::all, loop);
    for (size_t count = std::min<size_t>(2, flats.size()) + 1; count-- > 0;) {
        std::vector<StatedSurface> surfaces;
        for (size_t i = 0; i < count; ++i)
            surfaces.push_back(flats[i].plane);
        std::vector<int> curved, vertex;
        for (const int f : ring)
            if (std::ranges::none_of(surfaces, [&](const StatedSurface& s) { return lies_in(marked, f, s); })) {
                curved.push_back(f);
                for (const int v : marked.solid.triangle.col(f))
                    vertex.push_back(v);
            }
        std::ranges::sort(vertex);
        vertex.erase(std::unique(vertex.begin(), vertex.end()), vertex.end());
        if (curved.empty())
            continue;
        const auto cylinder =
            cylinder_through(marked.solid.position(Eigen::all, vertex), marked.normal(Eigen::all, curved), marked.flat);
        if (!cylinder)
            continue;
        surfaces.push_back(*cylinder);
        if (auto skin = UnrolledSkin::of(surfaces, points, marked.flat);
            skin &&
            std::ranges::all_of(loop, [&](int v) { return skin->flat(marked.solid.position.col(v)).has_value(); }))
            return skin;
    }
    return std::nullopt;
}

std::optional<UnrolledSkin> unrolled(const MarkedSkin& marked, const std::vector<int>& loop,
                                     const std::vector<int>& beside)
{
    if (marked.surface.empty())
        return measured(marked, loop);
    std::vector<StatedSurface> surfaces;
    for (const int f : beside)
        surfaces.push_back(marked.surface[size_t(f)]);
    return UnrolledSkin::of(surfaces, marked.solid.position(Eigen::all, loop), marked.flat);
}

/// Of a triangle of the skin beside the mark.
int zone_of(const UnrolledSkin& skin, const MarkedSkin& marked, int f)
{
    if (!marked.surface.empty())
        return skin.zone_of(marked.surface[size_t(f)]);
    // Of chords of a bend the middle lies below it.
    const auto middle = skin.flat(marked.solid.position(Eigen::all, marked.solid.triangle.col(f)).rowwise().mean());
    return middle ? skin.zone(middle->x()) : 0;
}

bool inside(const std::vector<Eigen::Vector2d>& at, const PolygonRow& polygon, const Eigen::Vector2d& p)
{
    Eigen::Matrix2Xd corner(2, Eigen::Index(polygon.size()));
    for (size_t i = 0; i < polygon.size(); ++i)
        corner.col(Eigen::Index(i)) = at[size_t(polygon[i])];
    return inside_polygon(corner, p);
}

/// Cuts a polygon along the line u = `seam`, from corner to corner; where its edges cross the line
/// they have corners, as edges of a CAD file do.
std::vector<PolygonRow> cut_along(const std::vector<Eigen::Vector2d>& at, const PolygonRow& whole, double seam,
                                  double on)
{
    PolygonRow along;
    for (const int i : whole)
        if (std::abs(at[size_t(i)].x() - seam) <= on)
            along.push_back(i);
    std::sort(along.begin(), along.end(), [&](int a, int b) { return at[size_t(a)].y() < at[size_t(b)].y(); });
    std::vector<PolygonRow> pieces{whole};
    for (size_t k = 0; k + 1 < along.size(); ++k) {
        const Eigen::Vector2d middle = (at[size_t(along[k])] + at[size_t(along[k + 1])]) / 2;
        for (size_t p = 0; p < pieces.size(); ++p) {
            const PolygonRow piece = pieces[p];
            auto i = size_t(std::find(piece.begin(), piece.end(), along[k]) - piece.begin()),
                 j = size_t(std::find(piece.begin(), piece.end(), along[k + 1]) - piece.begin());
            if (i == piece.size() || j == piece.size())
                continue;
            if (i > j)
                std::swap(i, j);
            const bool neighbours = j == i + 1 || (i == 0 && j + 1 == piece.size());
            if (neighbours || !inside(at, piece, middle))
                continue;
            PolygonRow rest(piece.begin() + long(j), piece.end());
            rest.insert(rest.end(), piece.begin(), piece.begin() + long(i) + 1);
            pieces[p] = PolygonRow(piece.begin() + long(i), piece.begin() + long(j) + 1);
            pieces.push_back(std::move(rest));
            break;
        }
    }
    return pieces;
}

/// Triangles of a polygon in the unrolled skin. Three corners in a row across a bend are no
/// triangle there, but stand upright in space: so edges are turned until each triangle has the
/// corners next to it (Delaunay), then halved where they turn by more than 3 degrees and than any
/// edge of the polygon. Those stay, and so do the lines where planes touch the cylinder.
class Refinement {
public:
    /// @param at  first the corners of the polygon, around it @param on mm, within which a corner
    /// is on a seam
    Refinement(const UnrolledSkin& skin, std::vector<Eigen::Vector2d>& at, std::vector<Triangle>& triangle, double on)
        : skin_(skin), at_(at), triangle_(triangle), on_(on)
    {
        for (size_t i = 0; i < at.size(); ++i)
            most_ = std::max(most_, skin.turn(at[i].x(), at[(i + 1) % at.size()].x()));
    }
    void refine()
    {
        constexpr int most_rounds = 20; // a half turn is halved six times
        turn_edges();
        for (int round = 0; round < most_rounds && halve_edges(); ++round)
            turn_edges();
    }

private:
    const UnrolledSkin& skin_;
    std::vector<Eigen::Vector2d>& at_;
    std::vector<Triangle>& triangle_;
    double on_;
    double most_ = 3 * std::numbers::pi / 180;

    double turn(const EdgeUse& use) const { return skin_.turn(at_[size_t(use.low)].x(), at_[size_t(use.high)].x()); }
    bool along_seam(const EdgeUse& use) const
    {
        return std::ranges::any_of(skin_.seams(), [&](double u) {
            return std::abs(at_[size_t(use.low)].x() - u) <= on_ && std::abs(at_[size_t(use.high)].x() - u) <= on_;
        });
    }
    double cross(int a, int b, int c) const
    {
        return spia::cross(at_[size_t(b)] - at_[size_t(a)], at_[size_t(c)] - at_[size_t(a)]);
    }
    double angle(int at, int a, int b) const
    {
        return std::atan2(std::abs(cross(at, a, b)),
                          (at_[size_t(a)] - at_[size_t(at)]).dot(at_[size_t(b)] - at_[size_t(at)]));
    }

    /// Each triangle once at most. @returns whether one was turned
    bool turn_some()
    {
        constexpr double rounding = 1e-9;
        const std::vector<EdgeUse> uses = edge_uses(triangle_);
        std::vector<char> done(triangle_.size(), 0);
        bool any = false;
        for_each_edge(uses, [&](size_t begin, size_t end) {
            if (end != begin + 2 || along_seam(uses[begin]) || done[size_t(uses[begin].face)] ||
                done[size_t(uses[begin + 1].face)])
                return;
            Triangle &one = triangle_[size_t(uses[begin].face)], &other = triangle_[size_t(uses[begin + 1].face)];
            const auto k = size_t(uses[begin].corner);
            const int p = one[k], q = one[(k + 1) % 3], r = one[(k + 2) % 3],
                      s = other[(size_t(uses[begin + 1].corner) + 2) % 3];
            const double first = cross(p, s, r), second = cross(s, q, r), all = cross(p, q, r) + cross(q, p, s);
            if (angle(r, p, q) + angle(s, p, q) <= std::numbers::pi + rounding ||
                !(first * all > rounding * all * all) || !(second * all > rounding * all * all))
                return;
            one = {p, s, r};
            other = {s, q, r};
            done[size_t(uses[begin].face)] = done[size_t(uses[begin + 1].face)] = 1;
            any = true;
        });
        return any;
    }
    void turn_edges()
    {
        constexpr int most_rounds = 200;
        for (int round = 0; round < most_rounds && turn_some(); ++round) {
        }
    }

    /// Each triangle once at most. @returns whether an edge was halved
    bool halve_edges()
    {
        constexpr double rounding = 1e-9;
        const std::vector<EdgeUse> uses = edge_uses(triangle_);
        std::vector<size_t> wide;
        for_each_edge(uses, [&](size_t begin, size_t end) {
            if (end == begin + 2 && turn(uses[begin]) > most_ * (1 + rounding))
                wide.push_back(begin);
        });
        std::stable_sort(wide.begin(), wide.end(), [&](size_t a, size_t b) { return turn(uses[a]) > turn(uses[b]); });
        std::vector<char> done(triangle_.size(), 0);
        for (const size_t u : wide) {
            if (done[size_t(uses[u].face)] || done[size_t(uses[u + 1].face)])
                continue;
            const int middle = int(at_.size());
            at_.push_back((at_[size_t(uses[u].low)] + at_[size_t(uses[u].high)]) / 2);
            for (const size_t side : {u, u + 1}) {
                done[size_t(uses[side].face)] = 1;
                Triangle& t = triangle_[size_t(uses[side].face)];
                const auto k = size_t(uses[side].corner), next = (k + 1) % 3;
                Triangle other = t;
                other[k] = middle;
                t[next] = middle;
                triangle_.push_back(other);
            }
        }
        return !wide.empty();
    }
};

/// Per zone of the unrolled skin the first triangle beside the mark; the first of all where there
/// is none.
std::array<int, 3> sources(const UnrolledSkin& skin, const MarkedSkin& marked, std::vector<int> beside)
{
    std::sort(beside.begin(), beside.end());
    std::array<int, 3> result{-1, -1, -1};
    for (const int f : beside)
        if (int& first = result[size_t(zone_of(skin, marked, f) + 1)]; first < 0)
            first = f;
    for (int& first : result)
        first = first < 0 ? beside.front() : first;
    return result;
}

} // namespace

std::optional<RefilledMark> refilled_bend(const MarkedSkin& marked, const std::vector<int>& loop,
                                          const std::vector<int>& beside)
{
    const std::optional<UnrolledSkin> skin = unrolled(marked, loop, beside);
    if (!skin)
        return std::nullopt;
    std::vector<Eigen::Vector2d> at;
    for (const int v : loop) {
        const auto flat = skin->flat(marked.solid.position.col(v));
        if (!flat)
            return std::nullopt;
        at.push_back(*flat);
    }
    std::vector<PolygonRow> pieces(1);
    for (size_t i = 0; i < loop.size(); ++i)
        pieces[0].push_back(int(i));
    for (const double seam : skin->seams()) {
        std::vector<PolygonRow> cut;
        for (const PolygonRow& piece : pieces)
            for (PolygonRow& part : cut_along(at, piece, seam, 2 * marked.flat))
                cut.push_back(std::move(part));
        pieces = std::move(cut);
    }
    std::vector<Triangle> triangles;
    for (const PolygonRow& piece : pieces) {
        std::vector<Eigen::Vector3d> corners;
        for (const int i : piece)
            corners.emplace_back(at[size_t(i)].x(), at[size_t(i)].y(), 0);
        const auto split = split_polygon(corners);
        if (split.size() + 2 != piece.size())
            return std::nullopt;
        for (const std::array<int, 3>& t : split)
            triangles.push_back({piece[size_t(t[0])], piece[size_t(t[1])], piece[size_t(t[2])]});
    }
    Refinement(*skin, at, triangles, 2 * marked.flat).refine();

    RefilledMark result;
    const std::array<int, 3> source = sources(*skin, marked, beside);
    for (size_t i = loop.size(); i < at.size(); ++i)
        result.added.push_back(skin->in_space(at[i]));
    for (const Triangle& t : triangles) {
        const double u = (at[size_t(t[0])].x() + at[size_t(t[1])].x() + at[size_t(t[2])].x()) / 3;
        result.beside.push_back(source[size_t(skin->zone(u) + 1)]);
        Triangle& triangle = result.triangle.emplace_back();
        for (size_t k = 0; k < 3; ++k)
            triangle[k] =
                size_t(t[k]) < loop.size() ? loop[size_t(t[k])] : marked.solid.vertices() + t[k] - int(loop.size());
    }
    return result;
}

} // namespace spia
