#include "engine/exchange/cad/edge_points.h"

#include <BRepAdaptor_Curve.hxx>
#include <algorithm>

namespace spia {

std::vector<Eigen::Vector3d> points_along(const TopoDS_Edge& edge, int pieces)
{
    const BRepAdaptor_Curve curve(edge);
    const double from = curve.FirstParameter(), to = curve.LastParameter();
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k <= pieces; ++k) {
        const gp_Pnt p = curve.Value(from + (to - from) * k / pieces);
        points.emplace_back(p.X(), p.Y(), p.Z());
    }
    return points;
}

double squared_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    const Eigen::Vector3d along = b - a;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0;
    return (a + t * along - p).squaredNorm();
}

} // namespace spia
