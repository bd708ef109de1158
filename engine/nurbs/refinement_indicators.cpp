#include "engine/nurbs/refinement_indicators.h"

#include <algorithm>

#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/span_borders.h"

namespace spia {

namespace {

/// Of each span the first and the last parameter that lies in it or on its borders.
std::vector<std::pair<int, int>> parameters_in(const std::vector<double>& borders,
                                               const std::vector<double>& parameters)
{
    std::vector<std::pair<int, int>> range;
    for (size_t s = 0; s + 1 < borders.size(); ++s) {
        const auto first = std::lower_bound(parameters.begin(), parameters.end(), borders[s]);
        const auto behind = std::upper_bound(parameters.begin(), parameters.end(), borders[s + 1]);
        range.emplace_back(int(first - parameters.begin()), int(behind - parameters.begin()) - 1);
    }
    return range;
}

} // namespace

RefinementIndicators refinement_indicators(const NurbsSurface& surface, const std::vector<BeyondTolerance>& beyond,
                                           const Eigen::Matrix3Xd& points, const CurveFit& along_u,
                                           const CurveFit& along_v)
{
    const std::vector<double> borders_u = span_borders(surface.knots_u, surface.degree_u);
    const std::vector<double> borders_v = span_borders(surface.knots_v, surface.degree_v);
    const int spans_u = int(borders_u.size()) - 1, spans_v = int(borders_v.size()) - 1;
    std::vector<double> worst(size_t(spans_u) * size_t(spans_v), 0); // per cell of the knots
    for (const BeyondTolerance& sample : beyond) {
        double& here =
            worst[size_t(span_of(borders_u, sample.u)) + size_t(span_of(borders_v, sample.v)) * size_t(spans_u)];
        here = std::max(here, sample.distance);
    }

    const DirectionResiduals residual = direction_residuals(points, along_u, along_v);
    const auto range_u = parameters_in(borders_u, along_u.parameters());
    const auto range_v = parameters_in(borders_v, along_v.parameters());
    const Eigen::Index columns = Eigen::Index(along_u.parameters().size());
    RefinementIndicators result{std::vector<double>(size_t(spans_u), 0), std::vector<double>(size_t(spans_v), 0)};
    for (int b = 0; b < spans_v; ++b)
        for (int a = 0; a < spans_u; ++a) {
            const double distance = worst[size_t(a) + size_t(b) * size_t(spans_u)];
            if (distance == 0)
                continue;
            // Along the surface only the parameters differ; at its border that may open a gap all
            // the same.
            const bool at_border = a == 0 || b == 0 || a == spans_u - 1 || b == spans_v - 1;
            const Eigen::Vector3d normal = evaluate(surface, (borders_u[size_t(a)] + borders_u[size_t(a) + 1]) / 2,
                                                    (borders_v[size_t(b)] + borders_v[size_t(b) + 1]) / 2)
                                               .normal();
            double left_u = 0, left_v = 0, across_u = 0, across_v = 0;
            for (int j = range_v[size_t(b)].first; j <= range_v[size_t(b)].second; ++j)
                for (int i = range_u[size_t(a)].first; i <= range_u[size_t(a)].second; ++i) {
                    const Eigen::Index n = i + j * columns;
                    left_u = std::max(left_u, residual.u.col(n).norm());
                    left_v = std::max(left_v, residual.v.col(n).norm());
                    across_u = std::max(across_u, std::abs(residual.u.col(n).dot(normal)));
                    across_v = std::max(across_v, std::abs(residual.v.col(n).dot(normal)));
                }
            constexpr double telling = 0.1; // of the distance: less is not what keeps the surface
                                            // away
            if (!at_border && std::max(across_u, across_v) > telling * distance) {
                left_u = across_u;
                left_v = across_v;
            }
            constexpr double about_as_much = 0.3;
            if (left_u >= about_as_much * left_v)
                result.u[size_t(a)] = std::max(result.u[size_t(a)], distance);
            if (left_v >= about_as_much * left_u)
                result.v[size_t(b)] = std::max(result.v[size_t(b)], distance);
        }
    return result;
}

} // namespace spia
