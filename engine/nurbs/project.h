#pragma once
#include "engine/mesh/closest_point.h"
#include "engine/nurbs/surface.h"

namespace spia {

/// The place of a surface that is nearest to a point.
struct SurfaceFoot {
    double u = 0, v = 0;
    Eigen::Vector3d position; ///< mm, S(u, v)
    double distance = 0;      ///< mm
};

/// Projects many points on one surface. Searching from several threads at a time is safe.
class SurfaceProjection {
public:
    /// @param samples_per_span  where Newton's method starts: at the nearest place of this
    /// tessellation. Two sheets of
    ///        the surface whose distances from a point differ by less than the triangles' sag may
    ///        be confused.
    /// @param progress  checkpoints while that is made
    explicit SurfaceProjection(const NurbsSurface& surface, int samples_per_span = 4, const Progress& progress = {});

    /// Never farther than the place of the surface over the nearest place of the tessellation, and
    /// a point of the surface in any case: each step of Newton's method is taken only if it comes
    /// no farther, up to rounding.
    SurfaceFoot nearest(const Eigen::Vector3d& point) const;

private:
    NurbsSurface surface_;
    Eigen::Matrix2Xd uv_;       ///< of the vertices of the tessellation
    Eigen::Matrix3Xi triangle_; ///< of the tessellation
    ClosestPointSearch search_;
    double size_; ///< mm, diagonal of the box around the surface

    SurfaceProjection(const NurbsSurface& surface, struct Tessellation&& tessellation, const Progress& progress);
};

} // namespace spia
