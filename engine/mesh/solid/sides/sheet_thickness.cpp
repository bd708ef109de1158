#include "engine/mesh/solid/sides/sheet_thickness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

std::vector<int> faces_of(const SolidInPieces& solid, PieceSide side)
{
    std::vector<int> faces;
    for (int f = 0; f < solid.mesh.triangles(); ++f)
        if (solid.side(f) == side)
            faces.push_back(f);
    return faces;
}

/// The triangles of one side alone.
TriMesh only(const SolidInPieces& solid, PieceSide side)
{
    return {solid.mesh.position, solid.mesh.triangle(Eigen::all, faces_of(solid, side))};
}

/// The least that an eighth of the distances are, to single precision of a part a hundred times as
/// large: vertices that do not lie quite opposite are farther away. @param sorted at least one
std::optional<double> agreed(const std::vector<double>& sorted)
{
    constexpr double equal = 1 + 1e-5;
    for (size_t i = 0, j = 0; i < sorted.size(); ++i) {
        while (j < sorted.size() && sorted[j] <= equal * sorted[i])
            ++j;
        if (8 * (j - i) >= sorted.size())
            return sorted[(i + j) / 2];
    }
    return std::nullopt;
}

/// How a skin lies at a vertex.
struct SkinAt {
    Eigen::Vector3d first = Eigen::Vector3d::Zero(); ///< unit normal of one of its faces
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< about which it turns most, the sine of by
                                                     ///< how much; 0 if by less than a degree

    /// It lies on the skin's surface, while those within a chord of a bend lie below it.
    bool turns() const { return axis != Eigen::Vector3d::Zero(); }

    /// Whether a way goes straight through the sheet: from beside a chamfer the nearest place of
    /// the other skin is its border, askew.
    bool straight(const Eigen::Vector3d& way) const
    {
        constexpr double askew = 0.02; // sine of 1.1 degrees
        return (turns() ? std::abs(way.dot(axis.normalized())) : way.cross(first).norm()) <= askew * way.norm();
    }
};

std::vector<SkinAt> skin_at_vertices(const SolidInPieces& solid)
{
    constexpr double turn = 0.0175; // sine of 1 degree
    std::vector<SkinAt> at(size_t(solid.mesh.vertices()));
    for (int f = 0; f < solid.mesh.triangles(); ++f)
        for (int k = 0; k < 3 && solid.side(f) != PieceSide::rim; ++k) {
            SkinAt& here = at[size_t(solid.mesh.triangle(k, f))];
            const Eigen::Vector3d normal = solid.normal.col(f).normalized();
            if (here.first == Eigen::Vector3d::Zero())
                here.first = normal;
            const Eigen::Vector3d axis = here.first.cross(normal);
            if (axis.norm() > std::max(turn, here.axis.norm()))
                here.axis = axis;
        }
    return at;
}

/// Vertices at which the border of a skin turns, as at both ends of a free edge; where a section is
/// cut into chords it does not.
std::vector<char> border_corners(const SolidInPieces& solid)
{
    constexpr double turn = 0.5; // the sine of 30 degrees
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> way(size_t(solid.mesh.vertices()), none);
    std::vector<char> corner(way.size(), 0);
    const std::vector<EdgeUse> uses = edge_uses(solid.mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin != 2 || solid.side(uses[begin].face) == solid.side(uses[begin + 1].face))
            return;
        const int a = uses[begin].low, b = uses[begin].high;
        const Eigen::Vector3d along = (solid.mesh.position.col(b) - solid.mesh.position.col(a)).normalized();
        for (const int v : {a, b}) {
            corner[size_t(v)] |= way[size_t(v)].cross(along).norm() > turn;
            way[size_t(v)] = along;
        }
    });
    return corner;
}

} // namespace

double between_vertices(const SolidInPieces& solid, double by_rays, const std::vector<SheetMark>& marks)
{
    std::vector<char> marked(size_t(solid.mesh.triangles()), 0);
    for (const SheetMark& mark : marks)
        for (const std::vector<int>* faces : {&mark.floor, &mark.wall})
            for (const int f : *faces)
                marked[size_t(f)] = 1;
    constexpr double exact = 1e-4, alike = 1e-3;
    constexpr double nearer = 0.02, farther = 0.1; // chords of 50 degrees are nearer to each other
                                                   // by that
    std::vector<double> distance, turning, ends;
    const std::vector<SkinAt> skin = skin_at_vertices(solid);
    const std::vector<char> corners = border_corners(solid);
    int asked = 0;
    for (const PieceSide side : {PieceSide::one, PieceSide::other}) {
        const ClosestPointSearch opposite(only(solid, side == PieceSide::one ? PieceSide::other : PieceSide::one));
        std::vector<char> seen(size_t(solid.mesh.vertices()), 0);
        for (int f = 0; f < solid.mesh.triangles(); ++f)
            for (int k = 0; k < 3 && solid.side(f) == side && !marked[size_t(f)]; ++k) {
                const int v = solid.mesh.triangle(k, f);
                if (std::exchange(seen[size_t(v)], char(1)))
                    continue;
                ++asked;
                const ClosestPoint near = opposite.nearest(solid.mesh.position.col(v), 2 * by_rays);
                if (near.face < 0 || near.barycentric.maxCoeff() <= 1 - exact ||
                    near.distance < (1 - nearer) * by_rays || near.distance > (1 + farther) * by_rays ||
                    !skin[size_t(v)].straight(near.position - solid.mesh.position.col(v)))
                    continue;
                distance.push_back(near.distance);
                if (skin[size_t(v)].turns())
                    turning.push_back(near.distance);
                else if (corners[size_t(v)])
                    ends.push_back(near.distance);
            }
    }
    constexpr size_t enough = 8, one_edge = 4; // has so many ends on both skins
    std::sort(turning.begin(), turning.end());
    if (turning.size() >= enough)
        if (const std::optional<double> same = agreed(turning)) {
            const auto by_rays_too = [&](double d) { return std::abs(d - by_rays) < exact * by_rays; };
            const bool mitred = *same > (1 + alike) * by_rays && ends.size() >= one_edge &&
                                std::all_of(ends.begin(), ends.end(), by_rays_too);
            return mitred ? by_rays : *same;
        }
    if (distance.size() < std::max(enough, size_t(asked / 50)))
        return by_rays;
    std::sort(distance.begin(), distance.end());
    if (const std::optional<double> same = agreed(distance))
        return *same;
    std::erase_if(distance, [&](double d) { return d > (1 + nearer) * by_rays; });
    if (distance.size() < std::max(enough, size_t(asked / 50)))
        return by_rays;
    // Those that do not lie quite opposite are farther away.
    const double low = distance[distance.size() / 10], median = distance[distance.size() / 2];
    return median - low <= alike * low ? low : median;
}

std::vector<LocalThickness> local_thickness(const SolidInPieces& solid, double thickness, const Progress& progress)
{
    constexpr size_t enough = 60'000;
    const size_t stride = (solid.places.size() + enough - 1) / enough;
    std::vector<const Opposite*> chosen;
    for (size_t i = 0; i < solid.places.size(); i += stride)
        if (solid.side(solid.places[i].face) != PieceSide::rim)
            chosen.push_back(&solid.places[i]);
    const ClosestPointSearch one(only(solid, PieceSide::one)), other(only(solid, PieceSide::other));
    const std::vector<int> faces_of_one = faces_of(solid, PieceSide::one),
                           faces_of_other = faces_of(solid, PieceSide::other);
    const std::vector<StatedSurface>& surface = solid.options.surface;
    const double size = bounding_diagonal(solid.mesh);
    std::vector<LocalThickness> result(chosen.size());
    progress.checkpoint(0, "measuring the thickness");
    parallel_for(int(chosen.size()), [&](int i) {
        const Opposite& at = *chosen[size_t(i)];
        const double most = 10 * thickness;
        const bool from_one = solid.side(at.face) == PieceSide::one;
        const ClosestPoint near = (from_one ? other : one).nearest(at.place, most);
        double distance = std::min(near.distance, most);
        if (near.face >= 0 && !surface.empty()) { // of chords it is not that of their surfaces
            const int opposite = (from_one ? faces_of_other : faces_of_one)[size_t(near.face)];
            if (const double stated = distance_between(surface[size_t(at.face)], surface[size_t(opposite)], size);
                stated > 0)
                distance = stated;
        }
        result[size_t(i)] = {at.face, distance, at.area};
    });
    return result;
}

} // namespace spia
