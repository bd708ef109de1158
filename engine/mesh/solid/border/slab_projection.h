#pragma once
#include <Eigen/Core>
#include <array>
#include <limits>
#include <map>
#include <vector>

#include "engine/mesh/solid/stated_surface.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A solid of sheet as it is given, with its marks.
struct GivenSolid {
    const TriMesh& mesh;
    const std::vector<StatedSurface>& surface; ///< per triangle what CAD states; empty: nothing
    double thickness;                          ///< mm
    double flipped;                            ///< -1 if its triangles are seen from inside
    double deflection;                         ///< mm, how far they may be from what CAD states
};

/// A plane with axes, in the middle of a flat of sheet.
struct FlatChart {
    Eigen::Vector3d origin, x, y, normal; ///< mm; unit vectors

    Eigen::Vector2d flat(const Eigen::Vector3d& p) const { return {(p - origin).dot(x), (p - origin).dot(y)}; }
    double height(const Eigen::Vector3d& p) const { return (p - origin).dot(normal); }
    Eigen::Vector3d in_space(const Eigen::Vector2d& p) const { return origin + p.x() * x + p.y() * y; }
};

/// A place along a ring of the projection: in its edge from that point on.
struct AlongRing {
    size_t ring = 0;
    double at = 0; ///< the whole part is the number of the point
    double distance = std::numeric_limits<double>::infinity();
};

/// The outline of what a solid has within half its thickness on both sides of a plane, seen square
/// to that. Walls that cross all of it askew count where they are in the plane.
class SlabProjection {
public:
    SlabProjection(const GivenSolid& given, const FlatChart& chart);

    /// As polygon_union() has them.
    const std::vector<Eigen::Matrix2Xd>& rings() const { return ring_; }

    AlongRing nearest(const Eigen::Vector2d& place) const;

    /// The points between two places of one ring, along it, with those that divide arcs of stated
    /// cylinders into chords of 3 degrees at most.
    std::vector<Eigen::Vector2d> between(const AlongRing& from, const AlongRing& to) const;
    /// All of a ring, likewise.
    std::vector<Eigen::Vector2d> whole(size_t r) const;

private:
    using Key = std::array<double, 4>;
    struct Arc {
        Eigen::Vector2d centre;
        double radius;
    };
    std::vector<Eigen::Matrix2Xd> ring_;
    std::map<Key, Arc> arc_; ///< per edge of walls that are square to the plane

    static Key key(const Eigen::Vector2d& a, const Eigen::Vector2d& b);
    /// A point after those that divide the arc to it from the one before.
    void add(const Eigen::Vector2d& point, const Eigen::Matrix2Xd& ring, Eigen::Index i,
             std::vector<Eigen::Vector2d>& result) const;
};

} // namespace spia
