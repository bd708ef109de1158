#pragma once
#include <vector>

#include "engine/mesh/closest_point.h"
#include "engine/nurbs/evaluate.h"

namespace spia {

/// Moves the points of a fit to the foot points of its surface on the part.
class FootPointProjection {
public:
    /// @throws InputError if the part has no boundary
    explicit FootPointProjection(const TriMesh& part);

    /// Moves inner points to the nearest place of the part to the surface at their parameters,
    /// border points likewise along the part's boundary; corners stay. A foot on another sheet of
    /// the part, or farther off than the point itself, is left.
    /// @param points  (i, j) at u[i], v[j], i fastest
    /// @returns what the surface is like at the parameters, in the same order
    std::vector<SurfacePoint> project_points(const NurbsSurface& surface, const std::vector<double>& u,
                                             const std::vector<double>& v, Eigen::Matrix3Xd& points) const;

private:
    Eigen::Matrix3Xd face_normal_; ///< unit
    ClosestPointSearch inside_, boundary_;
};

} // namespace spia
