#include "engine/mesh/solid/holes/open_counterbores.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/fit/cylinder_fit.h"
#include "engine/mesh/solid/fit/plane_regions.h"
#include "engine/mesh/solid/holes/hole_limits.h"
#include "engine/mesh/solid/marks/sheet_marks.h"

namespace spia {
namespace {

constexpr double least = 0.9, most = 1.1; // of the thickness: sheet that is as thick, about
constexpr double upright = 0.02;          // the cosine of 89 degrees
constexpr double turning = 0.985;         // mean of unit vectors over an arc of 35 degrees

/// Edges of a floor beyond which walls stand square to it, rising from it or going down.
using Edges = std::vector<FaceEdge>;

class CounterboreSearch {
public:
    CounterboreSearch(const TriMesh& solid, const Eigen::Matrix3Xd& normal, double thickness)
        : solid_(solid), normal_(normal), thickness_(thickness),
          neighbour_(face_neighbours(solid.triangles(), edge_uses(solid.triangle))),
          planes_(plane_regions(solid, normal, neighbour_, same_in_hole * thickness))
    {
    }

    std::vector<OpenCounterbore> found() const
    {
        std::map<int, std::pair<Edges, Edges>> walls; // by plane: rising, going down
        for (int f = 0; f < solid_.triangles(); ++f)
            for (int k = 0; k < 3; ++k)
                if (const int next = neighbour_(k, f), plane = planes_.of[size_t(f)];
                    next >= 0 && planes_.of[size_t(next)] != plane && stands(next, plane)) {
                    auto& [rising, down] = walls[plane];
                    (height(next, plane) > 0 ? rising : down).push_back({f, k, next});
                }
        std::vector<OpenCounterbore> result;
        for (const auto& [plane, edges] : walls)
            if (const auto wide = cylinder_over(plane, edges.first, edges.second))
                result.push_back(counterbore(plane, *wide));
        return result;
    }

private:
    const TriMesh& solid_;
    const Eigen::Matrix3Xd& normal_;
    double thickness_; ///< mm
    Eigen::Matrix3Xi neighbour_;
    PlaneRegions planes_;

    bool stands(int f, int plane) const
    {
        return std::abs(normal_.col(f).normalized().dot(planes_.direction.col(plane))) < upright;
    }
    /// mm over the plane, of the corner that is farthest from it.
    double height(int f, int plane) const
    {
        double farthest = 0;
        for (const int v : solid_.triangle.col(f)) {
            const double h = planes_.direction.col(plane).dot(solid_.position.col(v)) - planes_.level[plane];
            farthest = std::abs(h) > std::abs(farthest) ? h : farthest;
        }
        return farthest;
    }
    Eigen::Matrix3Xd ends(const Edges& edges) const
    {
        Eigen::Matrix3Xd place(3, 2 * Eigen::Index(edges.size()));
        for (size_t i = 0; i < edges.size(); ++i)
            for (int end = 0; end < 2; ++end)
                place.col(2 * Eigen::Index(i) + end) =
                    solid_.position.col(solid_.triangle((edges[i].k + end) % 3, edges[i].face));
        return place;
    }

    /// Whether the walls beyond edges are chords of a cylinder that they turn around and face.
    bool around(const Edges& edges, const FittedCylinder& cylinder) const
    {
        constexpr double longest = 0.6; // of the radius: chords of 35 degrees, as circles have
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        const Eigen::Matrix3Xd place = ends(edges);
        double size = 0;
        for (size_t i = 0; i < edges.size(); ++i) {
            const Eigen::Vector3d a = place.col(2 * Eigen::Index(i)), b = place.col(2 * Eigen::Index(i) + 1);
            const Eigen::Vector3d from = (a + b) / 2 - cylinder.point,
                                  out = (from - from.dot(cylinder.axis) * cylinder.axis).normalized();
            if (normal_.col(edges[i].next).dot(out) >= 0 || (b - a).norm() > longest * cylinder.radius)
                return false;
            mean += (b - a).norm() * out;
            size += (b - a).norm();
        }
        return size > 0 && mean.norm() < turning * size;
    }

    /// mm, of edges that hang together: those of rounded corners about the axis are short rows.
    double longest_row(const Edges& edges) const
    {
        DisjointSets together(size_t(solid_.vertices()));
        std::map<int, double> length;
        for (const FaceEdge& at : edges)
            together.join(solid_.triangle(at.k, at.face), solid_.triangle((at.k + 1) % 3, at.face));
        double longest = 0;
        for (const FaceEdge& at : edges) {
            const Eigen::Matrix3Xd place = ends({at});
            double& row = length[together.root(solid_.triangle(at.k, at.face))];
            row += (place.col(1) - place.col(0)).norm();
            longest = std::max(longest, row);
        }
        return longest;
    }

    /// Of walls that go down from a floor those of a hole about the axis: others are a border's.
    Edges hole_below(const Edges& down, const FittedCylinder& wide) const
    {
        const double within = same_in_hole * thickness_;
        const auto radii = [&](const FaceEdge& at) {
            const Eigen::Matrix3Xd place = ends({at});
            return Eigen::Vector2d(distance_from_axis(wide, place.col(0)), distance_from_axis(wide, place.col(1)));
        };
        constexpr double least_arc = 0.6; // radians, 35 degrees
        Edges best;
        double radius = 0;
        for (const FaceEdge& first : down) {
            const double r = radii(first).mean();
            Edges alike;
            for (const FaceEdge& at : down)
                if ((radii(at).array() - r).abs().maxCoeff() < within)
                    alike.push_back(at);
            if (r < wide.radius - sunk_in_hole * thickness_ && alike.size() > best.size()) {
                best = std::move(alike);
                radius = r;
            }
        }
        FittedCylinder narrow = wide;
        narrow.radius = radius;
        return longest_row(best) > least_arc * radius && around(best, narrow) ? best : Edges{};
    }

    /// Of the walls that rise from a floor; nothing if it is none of a counterbore.
    std::optional<FittedCylinder> cylinder_over(int plane, const Edges& rising, const Edges& down) const
    {
        if (rising.size() < 3 || down.size() < 2)
            return std::nullopt;
        const double within = same_in_hole * thickness_;
        const auto wide = cylinder_along(planes_.direction.col(plane), ends(rising));
        if (!wide || wide->off > within || !around(rising, *wide))
            return std::nullopt;
        const Edges hole = hole_below(down, *wide);
        if (hole.empty())
            return std::nullopt;
        double depth = 0, below = 0;
        for (const FaceEdge& at : rising)
            depth = std::max(depth, height(at.next, plane));
        for (const FaceEdge& at : hole)
            below = std::max(below, -height(at.next, plane));
        const double thick = depth + below;
        const bool through = thick > least * thickness_ && thick < most * thickness_;
        return depth > deepest_mark * thickness_ && through ? wide : std::nullopt;
    }

    OpenCounterbore counterbore(int plane, const FittedCylinder& wide) const
    {
        OpenCounterbore result{{}, {}, Eigen::Vector3d::Zero()};
        for (int f = 0; f < solid_.triangles(); ++f)
            if (planes_.of[size_t(f)] == plane)
                result.floor.push_back(f);
            else if (stands(f, plane) && height(f, plane) > 0 && height(f, plane) < thickness_ &&
                     lies_on(solid_, wide, f, same_in_hole * thickness_))
                result.wall.push_back(f);
        for (const int f : result.floor)
            result.place +=
                solid_.position(Eigen::all, solid_.triangle.col(f)).rowwise().mean() / double(result.floor.size());
        return result;
    }
};

} // namespace

std::vector<OpenCounterbore> open_counterbores(const TriMesh& solid, const Eigen::Matrix3Xd& normal, double thickness)
{
    return CounterboreSearch(solid, normal, thickness).found();
}

} // namespace spia
