#include "engine/nurbs/patch_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/small_sparse.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"

namespace spia {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Row i holds the basis functions at parameter i.
Sparse basis_matrix(const std::vector<double>& knots, int degree, const std::vector<double>& parameters)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (size_t i = 0; i < parameters.size(); ++i) {
        const BasisValues N = basis(knots, degree, parameters[i]);
        for (int k = 0; k <= degree; ++k)
            entries.emplace_back(int(i), N.first + k, N.value[size_t(k)]);
    }
    Sparse matrix(int(parameters.size()), int(knots.size()) - degree - 1);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

/// Least squares with the first and the last value kept.
Eigen::MatrixXd least_squares(const Sparse& N, const Eigen::MatrixXd& values)
{
    const int count = int(N.cols()), inner = count - 2;
    Eigen::MatrixXd result(count, values.cols());
    result.row(0) = values.row(0);
    result.row(count - 1) = values.row(values.rows() - 1);
    if (inner == 0)
        return result;
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k < inner; ++k) {
        entries.emplace_back(k, k, 1);
        entries.emplace_back(k, k + 1, -2);
        entries.emplace_back(k, k + 2, 1);
    }
    Sparse second(inner, count);
    second.setFromTriplets(entries.begin(), entries.end());
    // So little moves the result by 1e-10 of what the values leave in doubt, and settles what they
    // leave open.
    constexpr double smoothing = 1e-10;
    const Sparse normal = Sparse(N.transpose() * N) + smoothing * Sparse(second.transpose() * second);
    const Eigen::MatrixXd right =
        N.transpose() * values - normal.col(0) * result.row(0) - normal.col(count - 1) * result.row(count - 1);
    const SparseLdlt solver(Sparse(normal.block(1, 1, inner, inner)));
    if (!solver.ok())
        throw SolveError("the control values of a field are not determined; make a finer grid");
    result.middleRows(1, inner) = solver.solve(right.middleRows(1, inner));
    return result;
}

/// Values at the parameters, one row each, to control values, one row each.
Eigen::MatrixXd control_values(const std::vector<double>& knots, int degree, const std::vector<double>& parameters,
                               const Eigen::MatrixXd& values)
{
    const Sparse N = basis_matrix(knots, degree, parameters);
    if (N.rows() != N.cols())
        return least_squares(N, values);
    const SparseLu solver(N);
    if (!solver.ok())
        return least_squares(N, values); // as many, but not where the knots want them
                                         // (Schoenberg-Whitney)
    return solver.solve(values);
}

void require_values(const NurbsSurface& surface, const Eigen::VectorXd& value, const std::string& name, size_t patch)
{
    if (value.size() != surface.control.cols() || !value.allFinite())
        throw InputError(
            fmt::format("{} has not one finite value for each of the {} control points of patch {}; fit it "
                        "to this surface",
                        name, surface.control.cols(), patch + 1));
}

} // namespace

double evaluate_field(const NurbsSurface& surface, const Eigen::VectorXd& value, double u, double v)
{
    u = std::clamp(u, surface.knots_u.front(), surface.knots_u.back());
    v = std::clamp(v, surface.knots_v.front(), surface.knots_v.back());
    const BasisValues N = basis(surface.knots_u, surface.degree_u, u), M = basis(surface.knots_v, surface.degree_v, v);
    double sum = 0, weight = 0;
    for (int j = 0; j <= surface.degree_v; ++j)
        for (int i = 0; i <= surface.degree_u; ++i) {
            const int c = surface.index(N.first + i, M.first + j);
            const double share = N.value[size_t(i)] * M.value[size_t(j)] * surface.weight[c];
            sum += share * value[c];
            weight += share;
        }
    return sum / weight;
}

double field_mean(const NurbsSurface& surface, const Eigen::VectorXd& value)
{
    constexpr double place[] = {-0.861136311594052575, -0.339981043584856265, 0.339981043584856265,
                                0.861136311594052575};
    constexpr double share[] = {0.347854845137453857, 0.652145154862546143, 0.652145154862546143, 0.347854845137453857};
    const std::vector<double> u = span_borders(surface.knots_u, surface.degree_u),
                              v = span_borders(surface.knots_v, surface.degree_v);
    double sum = 0, area = 0;
    for (size_t j = 0; j + 1 < v.size(); ++j)
        for (size_t i = 0; i + 1 < u.size(); ++i)
            for (int b = 0; b < 4; ++b)
                for (int a = 0; a < 4; ++a) {
                    const double s = (u[i] + u[i + 1] + place[a] * (u[i + 1] - u[i])) / 2,
                                 t = (v[j] + v[j + 1] + place[b] * (v[j + 1] - v[j])) / 2;
                    const SurfacePoint at = evaluate(surface, s, t);
                    const double part =
                        share[a] * share[b] * (u[i + 1] - u[i]) * (v[j + 1] - v[j]) * at.S_u.cross(at.S_v).norm();
                    sum += part * evaluate_field(surface, value, s, t);
                    area += part;
                }
    return sum / area;
}

Eigen::VectorXd fit_field(const NurbsSurface& surface, const std::vector<double>& u, const std::vector<double>& v,
                          const Eigen::VectorXd& at_nodes)
{
    const auto columns = Eigen::Index(u.size()), rows = Eigen::Index(v.size());
    if (at_nodes.size() != columns * rows || !at_nodes.allFinite())
        throw InputError(fmt::format("a field of {} values does not go with {} x {} nodes, or one is not a number",
                                     at_nodes.size(), columns, rows));
    // With weights the field times the weight is what the basis functions span.
    Eigen::MatrixXd nodes = Eigen::Map<const Eigen::MatrixXd>(at_nodes.data(), columns, rows);
    const Eigen::Map<const Eigen::MatrixXd> weight(surface.weight.data(), surface.count_u, surface.count_v);
    const Sparse N = basis_matrix(surface.knots_u, surface.degree_u, u),
                 M = basis_matrix(surface.knots_v, surface.degree_v, v);
    const Eigen::MatrixXd weight_at_nodes = N * weight * M.transpose();
    const Eigen::MatrixXd along_u =
        control_values(surface.knots_u, surface.degree_u, u, nodes.cwiseProduct(weight_at_nodes));
    const Eigen::MatrixXd both = control_values(surface.knots_v, surface.degree_v, v, along_u.transpose()).transpose();
    const Eigen::MatrixXd result = both.cwiseQuotient(weight);
    return Eigen::Map<const Eigen::VectorXd>(result.data(), result.size());
}

void share_borders(const MultiPatch& patches, PatchField& field)
{
    if (field.value.size() != patches.patch.size())
        throw InputError(fmt::format("{} has values for {} patches, there are {}; fit it to this surface", field.name,
                                     field.value.size(), patches.patch.size()));
    double largest = 0;
    for (size_t p = 0; p < patches.patch.size(); ++p) {
        require_values(patches.patch[p], field.value[p], field.name, p);
        largest = std::max(largest, field.value[p].cwiseAbs().maxCoeff());
    }
    constexpr double rounding = 1e-9; // of the largest value: what solving two equal systems may
                                      // set them apart
    const SharedControls shared = shared_controls(patches);
    std::vector<const double*> first(size_t(shared.count), nullptr);
    for (int p = 0; p < int(patches.patch.size()); ++p)
        for (int c = 0; c < int(field.value[size_t(p)].size()); ++c) {
            double& value = field.value[size_t(p)][c];
            const double*& wanted = first[size_t(shared.of(p, c))];
            if (!wanted)
                wanted = &value;
            if (std::abs(value - *wanted) > rounding * largest)
                throw InputError(fmt::format("{} jumps from {} to {} at the border of patch {}; take its values at "
                                             "shared nodes from one place",
                                             field.name, *wanted, value, p + 1));
            value = *wanted;
        }
}

void require_field(const MultiPatch& patches, const PatchField& field)
{
    if (field.value.size() != patches.patch.size())
        throw InputError(fmt::format("{} has values for {} patches, there are {}; fit it to this surface", field.name,
                                     field.value.size(), patches.patch.size()));
    for (size_t p = 0; p < patches.patch.size(); ++p)
        require_values(patches.patch[p], field.value[p], field.name, p);
    for (const PatchInterface& joint : patches.interfaces) {
        const std::vector<int> a = side_controls(patches, joint.first, false),
                               b = side_controls(patches, joint.second, joint.reversed);
        for (size_t k = 0; k < a.size(); ++k)
            if (field.value[size_t(joint.first.patch)][a[k]] != field.value[size_t(joint.second.patch)][b[k]])
                throw InputError(fmt::format("{} is not the same on {} and {}; share its borders", field.name,
                                             name(joint.first), name(joint.second)));
    }
}

} // namespace spia
