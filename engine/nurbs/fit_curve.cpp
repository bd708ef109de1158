#include "engine/nurbs/fit_curve.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/curve_fit.h"
#include "engine/nurbs/span_borders.h"

namespace spia {

namespace {

Eigen::Matrix3Xd points_of(const CurveSource& source, const std::vector<double>& parameters)
{
    Eigen::Matrix3Xd points = source(parameters);
    if (points.cols() != Eigen::Index(parameters.size()) || !points.allFinite())
        throw InputError(
            fmt::format("a curve that is to be fitted gave {} points for {} parameters, or coordinates that are "
                        "not numbers; lift the grid again",
                        points.cols(), parameters.size()));
    return points;
}

/// How far the curve is from a point across its own direction: along it only the parameter differs.
double distance_across(const CurveFitResult& curve, int degree, double t, const Eigen::Vector3d& point)
{
    const BasisValues N = basis(curve.knots, degree, t);
    Eigen::Vector3d away = -point, along = Eigen::Vector3d::Zero();
    for (int k = 0; k <= degree; ++k) {
        away += N.value[size_t(k)] * curve.control.col(N.first + k);
        along += N.first_derivative[size_t(k)] * curve.control.col(N.first + k);
    }
    const double speed = along.norm();
    return speed > 0 ? (away - away.dot(along) / speed * along / speed).norm() : away.norm();
}

/// Per span the largest distance, at the data and halfway between them.
std::vector<double> distances(const CurveFitResult& curve, const CurveSource& source, const CurveFitOptions& options)
{
    std::vector<double> places = data_parameters(curve.borders, options.lines);
    if (options.lines.empty())
        places = halved(places, std::vector<char>(places.size() - 1, 1));
    const Eigen::Matrix3Xd points = points_of(source, places);
    std::vector<double> largest(curve.borders.size() - 1, 0);
    for (size_t i = 0; i < places.size(); ++i) {
        double& here = largest[size_t(span_of(curve.borders, places[i]))];
        here = std::max(here, distance_across(curve, options.degree, places[i], points.col(Eigen::Index(i))));
    }
    return largest;
}

} // namespace

CurveFitResult curve_over(const std::vector<double>& borders, const CurveSource& source, const CurveFitOptions& options)
{
    CurveFitResult result;
    result.borders = borders;
    result.rounds = 1;
    const std::vector<double> parameters = data_parameters(borders, options.lines);
    const CurveFit fit(clamped_knots(borders, options.degree), options.degree, options.ends, parameters);
    result.knots = fit.knots();
    result.control = fit.control(points_of(source, parameters), 1);
    const std::vector<double> distance = distances(result, source, options);
    result.largest = *std::max_element(distance.begin(), distance.end());
    result.reached = result.largest <= options.tolerance;
    return result;
}

CurveFitResult fit_curve(const CurveSource& source, const CurveFitOptions& options)
{
    if (!(options.tolerance > 0) || options.degree < 2 || options.degree > 5)
        throw InputError(
            fmt::format("a curve of degree {} within {} mm cannot be fitted; choose a degree from 2 to 5 and a "
                        "positive tolerance",
                        options.degree, options.tolerance));
    CurveFitResult best;
    std::vector<double> borders = first_borders(options.ends);
    for (int round = 1;; ++round) {
        CurveFitResult curve = curve_over(borders, source, options);
        const std::vector<double> distance = distances(curve, source, options);
        if (round == 1 || curve.largest < best.largest)
            best = std::move(curve);
        best.rounds = round;
        std::vector<char> halve(distance.size(), 0);
        for (size_t s = 0; s < distance.size(); ++s)
            halve[s] = distance[s] > options.tolerance && may_halve(borders[s], borders[s + 1], options.lines);
        const auto more = std::count(halve.begin(), halve.end(), 1);
        if (best.reached || more == 0 || int(distance.size()) + more > options.most_spans)
            return best;
        borders = halved(borders, halve);
    }
}

} // namespace spia
