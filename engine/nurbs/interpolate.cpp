#include "engine/nurbs/interpolate.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/small_sparse.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/end_tangent.h"
#include "engine/nurbs/point_rows.h"

namespace spia {

namespace {

void require_usable(const QuadGrid& grid)
{
    if (grid.columns < 1 || grid.rows < 1)
        throw InputError(
            fmt::format("a grid of {} x {} cells has no surface; ask for at least 1 x 1", grid.columns, grid.rows));
    if (grid.position.cols() != grid.nodes())
        throw InputError(fmt::format("the grid of {} x {} cells needs {} nodes but has {}; fill and lift it again",
                                     grid.columns, grid.rows, grid.nodes(), grid.position.cols()));
    for (int j = 0; j <= grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i)
            if (!grid.position.col(grid.node(i, j)).allFinite())
                throw InputError(fmt::format("node ({}, {}) of the grid has a coordinate that is not a number; lift "
                                             "the grid again",
                                             i, j));
}

struct MeanParameters {
    std::vector<double> value; ///< strictly rising from 0 to 1
    int coinciding = 0;        ///< intervals that had to be widened
};

double interval(const Eigen::Vector3d& a, const Eigen::Vector3d& b, InterpolateOptions::Parameters kind)
{
    switch (kind) {
    case InterpolateOptions::Parameters::chord: return (b - a).norm();
    case InterpolateOptions::Parameters::centripetal: return std::sqrt((b - a).norm());
    case InterpolateOptions::Parameters::uniform: break;
    }
    return 1;
}

/// Parameters along u: each row of points divides [0, 1] by the lengths of its intervals, and the
/// rows' mean is taken.
MeanParameters mean_parameters(const Eigen::Matrix3Xd& points, int count_u, InterpolateOptions::Parameters kind)
{
    const int intervals = count_u - 1, rows = int(points.cols()) / count_u;
    Eigen::MatrixXd length(intervals, rows);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < intervals; ++i)
            length(i, j) = interval(points.col(i + j * count_u), points.col(i + 1 + j * count_u), kind);

    // A row collapsed to a point has no intervals but rounding.
    const Eigen::VectorXd whole = length.colwise().sum();
    const double collapsed = 1e-12 * whole.maxCoeff();
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(intervals);
    for (int j = 0; j < rows; ++j)
        if (whole[j] > collapsed)
            mean += length.col(j) / whole[j];
    if (mean.sum() > 0)
        mean *= intervals / mean.sum(); // 1 is now the mean interval
    // Two columns of nodes at one parameter would make the matrix singular; held this far apart,
    // they cost no more than about four of its sixteen digits.
    constexpr double narrowest = 1e-4;
    MeanParameters result;
    result.coinciding = int((mean.array() < narrowest).count());
    mean = mean.cwiseMax(narrowest);

    result.value.assign(size_t(count_u), 0);
    for (int i = 0; i < intervals; ++i)
        result.value[size_t(i) + 1] = result.value[size_t(i)] + mean[i];
    for (double& value : result.value)
        value /= result.value.back(); // the last one is divided last
    return result;
}

/// Clamped knots, each inner one the mean of `degree` neighbouring parameters. [NURBS Book, eq.
/// 9.8]
std::vector<double> averaged_knots(const std::vector<double>& parameters, int degree)
{
    std::vector<double> knots(size_t(degree) + 1, 0);
    for (size_t j = 1; j + size_t(degree) < parameters.size(); ++j) {
        double sum = 0;
        for (int k = 0; k < degree; ++k)
            sum += parameters[j + size_t(k)];
        knots.push_back(sum / degree);
    }
    knots.insert(knots.end(), size_t(degree) + 1, 1);
    return knots;
}

/// Clamped cubic knots, an inner one at every inner parameter.
std::vector<double> knots_at_parameters(const std::vector<double>& parameters)
{
    std::vector<double> knots(3, 0);
    knots.insert(knots.end(), parameters.begin(), parameters.end());
    knots.insert(knots.end(), 3, 1);
    return knots;
}

/// Clamped knots for two control points more than parameters. [NURBS Book, 9.2.4]
std::vector<double> averaged_knots_with_end_tangents(const std::vector<double>& parameters, int degree)
{
    std::vector<double> knots(size_t(degree) + 1, 0);
    for (size_t j = 0; j + size_t(degree) <= parameters.size(); ++j) {
        double sum = 0;
        for (int k = 0; k < degree; ++k)
            sum += parameters[j + size_t(k)];
        knots.push_back(sum / degree);
    }
    knots.insert(knots.end(), size_t(degree) + 1, 1);
    return knots;
}

/// One direction of the interpolation: curves through points at fixed parameters.
class CurveSolver {
public:
    CurveSolver(const std::vector<double>& parameters, CurveEnds ends, int wanted_degree)
        : ends_(ends), points_(int(parameters.size()))
    {
        if (ends_ == CurveEnds::clamped && points_ < wanted_degree)
            ends_ = CurveEnds::averaged_knots; // a polynomial through all points: its tangents are
                                               // the estimated ones
        degree = ends_ == CurveEnds::averaged_knots ? std::min(wanted_degree, points_ - 1) : wanted_degree;
        knots = ends_ == CurveEnds::natural   ? knots_at_parameters(parameters)
                : ends_ == CurveEnds::clamped ? averaged_knots_with_end_tangents(parameters, degree)
                                              : averaged_knots(parameters, degree);
        count = int(knots.size()) - degree - 1;
        Eigen::SparseMatrix<double> matrix(count, count);
        std::vector<Eigen::Triplet<double>> entries;
        const auto add_row = [&](int row, int first, const auto& values) {
            for (int k = 0; k <= degree; ++k)
                entries.emplace_back(row, first + k, values[size_t(k)]);
        };
        for (int i = 0; i < points_; ++i) {
            const BasisValues N = basis(knots, degree, parameters[size_t(i)]);
            add_row(row_of_point(i), N.first, N.value);
            if (i > 0 && i < points_ - 1)
                continue;
            // What is asked of an end, scaled so that the row is of the size of the others.
            auto asked = ends_ == CurveEnds::natural ? N.second_derivative : N.first_derivative;
            double largest = 0;
            for (double value : asked)
                largest = std::max(largest, std::abs(value));
            for (double& value : asked)
                value /= largest;
            if (has_end_rows())
                add_row(i == 0 ? 1 : count - 2, N.first, asked);
            if (ends_ == CurveEnds::clamped)
                (i == 0 ? tangent_start_ : tangent_end_) =
                    end_derivative_weights(parameters, std::min(degree + 1, points_), i == 0) / largest;
        }
        matrix.setFromTriplets(entries.begin(), entries.end());
        lu_.emplace(matrix);
        // Every parameter lies in the support of its function, so that the matrix is regular
        // (Schoenberg-Whitney).
        if (!lu_->ok())
            throw SolveError("the interpolation matrix is singular");
    }

    /// Points (i, j), i fastest, of `width` curves that run along j, to their control points in the
    /// same order.
    Eigen::Matrix3Xd solve(const Eigen::Matrix3Xd& points, int width) const
    {
        const Eigen::Map<const Eigen::MatrixXd> rows(points.data(), 3 * width, points_);
        // one column per curve and coordinate
        Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 3 * width);
        for (int j = 0; j < points_; ++j)
            right.row(row_of_point(j)) = rows.col(j).transpose();
        for (Eigen::Index k = 0; k < tangent_start_.size(); ++k) {
            right.row(1) += tangent_start_[k] * rows.col(k).transpose();
            right.row(count - 2) += tangent_end_[k] * rows.col(points_ - 1 - k).transpose();
        }
        const Eigen::MatrixXd solution = lu_->solve(right);
        Eigen::Matrix3Xd control(3, width * count);
        Eigen::Map<Eigen::MatrixXd>(control.data(), 3 * width, count) = solution.transpose();
        return control;
    }

    int degree = 3;
    int count = 0; ///< control points
    std::vector<double> knots;

private:
    bool has_end_rows() const { return ends_ != CurveEnds::averaged_knots; }

    /// The second and the last row but one of the matrix hold what is asked of the ends.
    int row_of_point(int i) const
    {
        if (!has_end_rows() || i == 0)
            return i;
        return i == points_ - 1 ? count - 1 : i + 1;
    }

    CurveEnds ends_;
    int points_;
    Eigen::VectorXd tangent_start_, tangent_end_; ///< clamped: weights of the points in the right
                                                  ///< side's end rows
    std::optional<SparseLu> lu_;
};

void require_possible(const InterpolateOptions& options)
{
    for (const int degree : {options.degree_u, options.degree_v}) {
        if (degree < 2 || degree > 5)
            throw InputError(fmt::format("degree {} is not offered; choose one from 2 to 5", degree));
        if (options.ends == CurveEnds::natural && degree != 3)
            throw InputError(
                fmt::format("natural ends, as in the paper, are those of cubic curves; degree {} needs averaged "
                            "knots or clamped ends",
                            degree));
    }
}

} // namespace

InterpolateResult interpolate(const QuadGrid& lifted, const InterpolateOptions& options, const Progress& progress)
{
    require_usable(lifted);
    require_possible(options);
    const int nodes_u = lifted.columns + 1, nodes_v = lifted.rows + 1;
    MeanParameters u = mean_parameters(lifted.position, nodes_u, options.parameters);
    MeanParameters v = mean_parameters(transposed(lifted.position, nodes_u), nodes_v, options.parameters);

    progress.checkpoint(0, "interpolating along v");
    const CurveSolver along_v(v.value, options.ends, options.degree_v);
    const Eigen::Matrix3Xd columns = along_v.solve(lifted.position, nodes_u);
    progress.checkpoint(0.5, "interpolating along u");
    const CurveSolver along_u(u.value, options.ends, options.degree_u);
    const Eigen::Matrix3Xd control = along_u.solve(transposed(columns, nodes_u), along_v.count);

    InterpolateResult result;
    result.surface.degree_u = along_u.degree;
    result.surface.degree_v = along_v.degree;
    result.surface.count_u = along_u.count;
    result.surface.count_v = along_v.count;
    result.surface.knots_u = along_u.knots;
    result.surface.knots_v = along_v.knots;
    result.surface.control = transposed(control, along_v.count);
    result.surface.weight = Eigen::VectorXd::Ones(along_u.count * along_v.count);
    result.u = std::move(u.value);
    result.v = std::move(v.value);
    result.coinciding_columns = u.coinciding;
    result.coinciding_rows = v.coinciding;
    return result;
}

} // namespace spia
