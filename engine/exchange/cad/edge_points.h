#pragma once
#include <Eigen/Core>
#include <TopoDS_Edge.hxx>
#include <vector>

namespace spia {

/// An edge as so many straight pieces, even in its parameter: pieces + 1 points, mm. For .cpp files
/// of engine/exchange that hold an OcctSession.
/// @throws Standard_Failure  the edge has no curve
std::vector<Eigen::Vector3d> points_along(const TopoDS_Edge& edge, int pieces);

/// Squared distance of p from the segment ab, which may be a point.
double squared_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

} // namespace spia
