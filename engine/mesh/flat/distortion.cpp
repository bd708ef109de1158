#include "engine/mesh/flat/distortion.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/mesh/topology.h"

namespace spia {
namespace {

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

} // namespace

Distortion distortion(const TriMesh& part, const Eigen::Matrix2Xd& flat)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(part.vertices());
    Eigen::Matrix3Xd formed(3, part.triangles()), unfolded(3, part.triangles());
    Eigen::VectorXd area(part.triangles()), flat_area(part.triangles());
    for (int f = 0; f < part.triangles(); ++f) {
        Eigen::Matrix3d p, q = Eigen::Matrix3d::Zero();
        for (int k = 0; k < 3; ++k) {
            p.col(k) = part.position.col(part.triangle(k, f));
            q.col(k).head<2>() = flat.col(part.triangle(k, f));
        }
        for (int k = 0; k < 3; ++k) {
            const int l = (k + 1) % 3, m = (k + 2) % 3;
            formed(k, f) = angle(p.col(l) - p.col(k), p.col(m) - p.col(k));
            unfolded(k, f) = angle(q.col(l) - q.col(k), q.col(m) - q.col(k));
            sum[part.triangle(k, f)] += formed(k, f);
        }
        area[f] = 0.5 * (p.col(1) - p.col(0)).cross(p.col(2) - p.col(0)).norm();
        flat_area[f] = 0.5 * (q.col(1) - q.col(0)).cross(q.col(2) - q.col(0))[2];
    }
    std::vector<char> border(size_t(part.vertices()), 0);
    for (const auto& loop : boundary_loops(part))
        for (int v : loop)
            border[size_t(v)] = 1;

    double angular = 0, areal = 0;
    const double scale = area.sum() / flat_area.sum();
    for (int f = 0; f < part.triangles(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int v = part.triangle(k, f);
            const double best = border[size_t(v)] ? formed(k, f) : formed(k, f) * 2 * std::numbers::pi / sum[v];
            angular += std::pow((unfolded(k, f) - best) / best, 2);
        }
        areal += area[f] * std::pow(scale * flat_area[f] / area[f] - 1, 2);
    }
    return {std::sqrt(angular / (3.0 * part.triangles())), std::sqrt(areal / area.sum())};
}

} // namespace spia
