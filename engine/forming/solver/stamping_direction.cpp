#include "engine/forming/solver/stamping_direction.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// How good a direction is. Slivers have normals of noise: the smallest n . d is the least quantile
/// by area.
struct Score {
    double smallest;     ///< n . d that all but `ignored_area` of the part reach
    double visible_area; ///< signed: sum of n . d over what is seen, minus what is hidden
};
constexpr double ignored_area = 1e-4;

Score score(const Eigen::Matrix3Xd& area_vector, const Eigen::VectorXd& face_area, const Eigen::Vector3d& d)
{
    // A histogram of n . d weighted by area instead of a sort: this runs a few hundred times.
    constexpr int bins = 400;
    Eigen::VectorXd histogram = Eigen::VectorXd::Zero(bins);
    Score result{-1, 0};
    for (Eigen::Index f = 0; f < area_vector.cols(); ++f) {
        const double projected = area_vector.col(f).dot(d);
        histogram[std::clamp(int((projected / face_area[f] + 1) * 0.5 * bins), 0, bins - 1)] += face_area[f];
        result.visible_area += projected > 0 ? projected : 4 * projected;
    }
    double allowed = ignored_area * face_area.sum();
    int bin = 0;
    while (bin < bins - 1 && (allowed -= histogram[bin]) >= 0)
        ++bin;
    result.smallest = 2.0 * bin / bins - 1;
    return result;
}

bool better(const Score& a, const Score& b)
{
    if (std::max(a.smallest, b.smallest) > 0)
        return a.smallest != b.smallest ? a.smallest > b.smallest : a.visible_area > b.visible_area;
    return a.visible_area > b.visible_area;
}

} // namespace

StampingDirection stamping_direction(const TriMesh& part)
{
    const Eigen::Matrix3Xd area_vector = area_vectors(part);
    const Eigen::VectorXd face_area = area_vector.colwise().norm();

    // Start: the mean normal, which maximises the signed visible area; then a pattern search on the
    // sphere.
    Eigen::Vector3d best = area_vector.rowwise().sum();
    if (best.norm() < 1e-12 * face_area.sum())
        best = Eigen::Vector3d::UnitZ();
    best.normalize();
    Score best_score = score(area_vector, face_area, best);
    for (double step = 0.5; step > 2e-3; step *= 0.5)
        for (bool improved = true; improved;) {
            improved = false;
            const Eigen::Vector3d a = best.unitOrthogonal(), b = best.cross(a);
            for (int k = 0; k < 8; ++k) {
                const double angle = k * std::numbers::pi / 4;
                const Eigen::Vector3d candidate =
                    (best + step * (std::cos(angle) * a + std::sin(angle) * b)).normalized();
                const Score candidate_score = score(area_vector, face_area, candidate);
                if (better(candidate_score, best_score)) {
                    best = candidate;
                    best_score = candidate_score;
                    improved = true;
                }
            }
        }

    StampingDirection result{best, 0, true, 0};
    double hidden = 0;
    for (Eigen::Index f = 0; f < area_vector.cols(); ++f) {
        const double cosine = face_area[f] > 0 ? area_vector.col(f).dot(best) / face_area[f] : 1;
        result.steepest_angle = std::max(result.steepest_angle, std::acos(std::clamp(cosine, -1.0, 1.0)));
        if (cosine <= 0)
            hidden += face_area[f];
    }
    result.height_field = hidden == 0;
    result.hidden_area_fraction = hidden / face_area.sum();
    return result;
}

} // namespace spia
