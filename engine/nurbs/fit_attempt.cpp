#include "engine/nurbs/fit_attempt.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/nurbs/slide.h"
#include "engine/nurbs/span_borders.h"

namespace spia {

namespace {

void fit_to_points(Attempt& fit)
{
    const PatchBorders borders = fit_borders(fit.points, fit.along_u, fit.along_v);
    fit.surface = fit_patch(fit.points, fit.along_u, fit.along_v, borders);
}

/// Parameter correction: the points slide over the part to the feet of the surface, and it is fitted again. [Hoschek 1988]
void correct_parameters(Attempt& fit, const Slide& slide)
{
    // It converges slowly; the fewer the points, the less a time costs.
    const int times = int(std::clamp<Eigen::Index>(120'000 / fit.points.cols(), 3, 60));
    for (int time = 0; time < times; ++time) {
        slide.to_feet(fit.surface, fit.along_u.parameters(), fit.along_v.parameters(), fit.points);
        fit_to_points(fit);
    }
}

} // namespace

Attempt attempt(const FitSource& source, const FitOptions& options, const Slide* slide,
                const std::vector<double>& borders_u, const std::vector<double>& borders_v)
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
    fit_to_points(result);
    if (slide)
        correct_parameters(result, *slide);
    return result;
}

} // namespace spia
