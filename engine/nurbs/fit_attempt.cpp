#include "engine/nurbs/fit_attempt.h"

#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/nurbs/span_borders.h"

namespace spia {

void fit_to(Attempt& fit, const Eigen::Matrix3Xd& points, const Progress& progress)
{
    const PatchBorders borders = fit_borders(points, fit.along_u, fit.along_v);
    fit.surface = fit_patch(points, fit.along_u, fit.along_v, borders, progress);
}

Attempt attempt(const FitSource& source, const FitOptions& options, const std::vector<double>& borders_u,
                const std::vector<double>& borders_v, const Progress& progress)
{
    const std::vector<double> u = data_parameters(borders_u, source.lines_u);
    const std::vector<double> v = data_parameters(borders_v, source.lines_v);
    Attempt result{borders_u,
                   borders_v,
                   source.at(u, v),
                   CurveFit(clamped_knots(borders_u, options.degree_u), options.degree_u, options.ends, u),
                   CurveFit(clamped_knots(borders_v, options.degree_v), options.degree_v, options.ends, v),
                   {}};
    if (result.points.cols() != Eigen::Index(u.size() * v.size()))
        throw InputError(fmt::format("the source gave {} points where {} x {} were asked for", result.points.cols(),
                                     u.size(), v.size()));
    fit_to(result, result.points, progress);
    return result;
}

} // namespace spia
