#include "engine/compare/lscm.h"

#include <Eigen/Geometry>
#include <cmath>
#include <fmt/core.h>
#include <queue>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using Complex = std::complex<double>;

/// Lengths of the shortest ways along edges.
std::vector<double> distances(const TriMesh& part, int from)
{
    std::vector<std::vector<int>> faces(size_t(part.vertices()));
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            faces[size_t(part.triangle(k, f))].push_back(f);
    std::vector<double> result(size_t(part.vertices()), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    open.push({result[size_t(from)] = 0, from});
    while (!open.empty()) {
        const auto [distance, v] = open.top();
        open.pop();
        if (distance > result[size_t(v)])
            continue;
        for (int f : faces[size_t(v)])
            for (int k = 0; k < 3; ++k) {
                const int w = part.triangle(k, f);
                const double length = distance + (part.position.col(w) - part.position.col(v)).norm();
                if (length < result[size_t(w)])
                    open.push({result[size_t(w)] = length, w});
            }
    }
    return result;
}

/// The triangles of the part in their own planes.
FlatShapes formed_shapes(const TriMesh& part)
{
    FlatShapes shapes(size_t(part.triangles()));
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Vector3d p = part.position.col(part.triangle(1, f)) - part.position.col(part.triangle(0, f));
        const Eigen::Vector3d q = part.position.col(part.triangle(2, f)) - part.position.col(part.triangle(0, f));
        const double length = p.norm();
        shapes[size_t(f)] = {Complex(length), Complex(p.dot(q), p.cross(q).norm()) / length};
    }
    return shapes;
}

/// The equation of one triangle, sum of weight[k] u_k = 0.
struct Equation {
    std::array<Complex, 3> weight;

    Complex residual(const Eigen::Matrix2Xd& u, const Eigen::Vector3i& face) const
    {
        Complex sum = 0;
        for (int k = 0; k < 3; ++k)
            sum += weight[size_t(k)] * Complex(u(0, face[k]), u(1, face[k]));
        return sum;
    }
};

std::vector<Equation> equations(const FlatShapes& shapes)
{
    std::vector<Equation> result(shapes.size());
    for (size_t f = 0; f < shapes.size(); ++f) {
        const auto& [p, q] = shapes[f];
        const double root = std::sqrt((std::conj(p) * q).imag()); // of twice the area
        result[f].weight = {(q - p) / root, -q / root, p / root};
    }
    return result;
}

} // namespace

std::array<int, 2> far_pins(const TriMesh& part)
{
    const std::vector<int> outer = boundary_loops(part).at(0);
    const auto farthest = [&](int from) {
        const std::vector<double> distance = distances(part, from);
        return *std::max_element(outer.begin(), outer.end(),
                                 [&](int a, int b) { return distance[size_t(a)] < distance[size_t(b)]; });
    };
    const int first = farthest(outer[0]);
    return {first, farthest(first)};
}

Eigen::Matrix2Xd conformal_layout(const TriMesh& part, const FlatShapes& shapes, const std::array<int, 2>& pins,
                                  BlockMatrix& matrix, Cholesky& cholesky, const Progress& progress)
{
    progress.checkpoint(0, "factoring the conformal equations");
    const std::vector<Equation> equation = equations(shapes);
    const auto held = [&](int v) { return v == pins[0] || v == pins[1]; };
    std::vector<Matrix6d> element(equation.size(), Matrix6d::Zero());
    for (size_t f = 0; f < equation.size(); ++f)
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) {
                if (held(part.triangle(a, int(f))) || held(part.triangle(b, int(f))))
                    continue;
                const Complex z = std::conj(equation[f].weight[size_t(a)]) * equation[f].weight[size_t(b)];
                element[f].block<2, 2>(2 * a, 2 * b) << z.real(), -z.imag(), z.imag(), z.real();
            }
    const auto factored = [&](double shift) {
        matrix.assemble(element);
        for (int pin : pins)
            matrix.add_to_diagonal(pin, Eigen::Matrix2d::Identity());
        for (int i = 0; shift > 0 && i < matrix.size(); ++i)
            matrix.add_to_diagonal(i, shift);
        return cholesky.factor(matrix);
    };
    // The shift spoils nothing: the refinement below solves the equations without it.
    constexpr double first_shift = 1e-14, largest_shift = 1e-8;
    for (double shift = 0; !factored(shift); shift = shift > 0 ? 100 * shift : first_shift)
        if (shift >= largest_shift)
            throw SolveError("the conformal equations are singular; there are triangles too thin for the arithmetic");

    Eigen::Matrix2Xd u = Eigen::Matrix2Xd::Zero(2, part.vertices());
    u(0, pins[1]) = bounding_diagonal(part); // any length: the map has no size yet
    constexpr int most_refinements = 6;
    constexpr double settled = 1e-13;
    for (int step = 0; step <= most_refinements; ++step) {
        progress.checkpoint(0.5 + 0.07 * step, "solving the conformal equations");
        Eigen::Matrix2Xd right = Eigen::Matrix2Xd::Zero(2, part.vertices());
        for (int f = 0; f < part.triangles(); ++f) {
            const Complex r = equation[size_t(f)].residual(u, part.triangle.col(f));
            for (int a = 0; a < 3; ++a) {
                const Complex z = std::conj(equation[size_t(f)].weight[size_t(a)]) * r;
                right.col(part.triangle(a, f)) -= Eigen::Vector2d(z.real(), z.imag());
            }
        }
        for (int pin : pins)
            right.col(pin).setZero();
        const Eigen::VectorXd correction = cholesky.solve(right.reshaped());
        u.reshaped() += correction;
        if (!u.allFinite())
            throw SolveError("the conformal equations have no finite solution in this arithmetic");
        if (correction.lpNorm<Eigen::Infinity>() <= settled * u.lpNorm<Eigen::Infinity>())
            break;
    }
    return u;
}

FlatMap lscm(const TriMesh& part, const LscmOptions& options, const Progress& progress)
{
    require_sheet(part);
    const std::array<int, 2> pins = options.pins ? *options.pins : far_pins(part);
    for (int pin : pins)
        if (pin < 0 || pin >= part.vertices() || pins[0] == pins[1])
            throw InputError(fmt::format("hold two different vertices from 0 to {}, not {} and {}", part.vertices() - 1,
                                         pins[0], pins[1]));
    progress.checkpoint(0, "ordering the conformal equations");
    BlockMatrix matrix(part.triangle, part.vertices());
    Cholesky cholesky(matrix);
    FlatMap map;
    map.position = conformal_layout(part, formed_shapes(part), pins, matrix, cholesky, progress.part(0.4, 1));
    scale_to_area_of(part, map.position);
    map.iterations = 1;
    map.ended = fmt::format("one linear system, vertices {} and {} held", pins[0], pins[1]);
    return map;
}

} // namespace spia
