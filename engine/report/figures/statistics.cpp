#include "engine/report/figures/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/mesh/topology.h"

namespace spia {

Histogram histogram(const TriMesh& part, const Eigen::VectorXd& value, int bins)
{
    Histogram result;
    result.share.assign(size_t(bins), 0);
    const Eigen::VectorXd size = area_vectors(part).colwise().norm();
    double whole = 0;
    bool any = false;
    for (int f = 0; f < part.triangles(); ++f)
        if (std::isfinite(value[f])) {
            result.least = any ? std::min(result.least, value[f]) : value[f];
            result.greatest = any ? std::max(result.greatest, value[f]) : value[f];
            any = true;
        }
    const double width = result.greatest - result.least;
    for (int f = 0; f < part.triangles(); ++f) {
        if (!std::isfinite(value[f]))
            continue;
        const double t = width > 0 ? (value[f] - result.least) / width : 0;
        result.share[size_t(std::min(bins - 1, int(t * bins)))] += size[f];
        whole += size[f];
    }
    for (double& share : result.share)
        share /= whole > 0 ? whole : 1;
    return result;
}

double badness(Field field, double value)
{
    switch (field) {
    case Field::thickness:
    case Field::strain_minor:
    case Field::outer_strain_minor:
    case Field::inner_strain_minor:
    case Field::limit_distance: return -value;
    case Field::curvature:
    case Field::deviation: return std::abs(value);
    default: return value;
    }
}

std::vector<int> worst_spots(const TriMesh& part, const Eigen::VectorXd& value, int most, bool smallest)
{
    std::vector<int> order;
    for (int f = 0; f < part.triangles(); ++f)
        if (std::isfinite(value[f]))
            order.push_back(f);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return smallest ? value[a] < value[b] : value[a] > value[b]; });
    const double apart = 0.1 * bounding_diagonal(part);
    const auto middle = [&](int f) -> Eigen::Vector3d {
        return (part.position.col(part.triangle(0, f)) + part.position.col(part.triangle(1, f)) +
                part.position.col(part.triangle(2, f))) /
               3;
    };
    std::vector<int> spots;
    for (const int f : order) {
        if (int(spots.size()) == most)
            break;
        if (std::none_of(spots.begin(), spots.end(),
                         [&](int spot) { return (middle(spot) - middle(f)).norm() < apart; }))
            spots.push_back(f);
    }
    return spots;
}

} // namespace spia
