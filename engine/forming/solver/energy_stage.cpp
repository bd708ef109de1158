#include "engine/forming/solver/energy_stage.h"

#include <Eigen/Geometry>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/line_search.h"
#include "engine/core/parallel.h"

namespace spia {
namespace {

double energy(const Eigen::Matrix3Xi& triangle, const std::vector<Element>& element, const Sheet& sheet,
              const Eigen::Matrix2Xd& X)
{
    Eigen::VectorXd part(triangle.cols());
    parallel_for(int(triangle.cols()), [&](int f) {
        const Element& e = element[size_t(f)];
        part[f] = e.area * sheet.thickness[f] *
                  energy_density_value(sheet.law_of(f), inverse_gradient(e, corners(X, triangle.col(f))));
    });
    return part.sum();
}

/// What the springs of held vertices add; those that are there already have none.
class Springs {
public:
    explicit Springs(const EnergyOptions& options)
        : held_(options.held), stiffness_(std::isfinite(options.spring) ? options.spring : 0)
    {
    }
    double energy(const Eigen::Matrix2Xd& X) const
    {
        double sum = 0;
        for (const HeldVertex& h : held_)
            sum += stiffness_ / 2 * (X.col(h.vertex) - h.place).squaredNorm();
        return sum;
    }
    void add(const Eigen::Matrix2Xd& X, Eigen::VectorXd& gradient, BlockMatrix& matrix) const
    {
        for (const HeldVertex& h : held_) {
            gradient.segment<2>(2 * h.vertex) += stiffness_ * (X.col(h.vertex) - h.place);
            matrix.add_to_diagonal(h.vertex, stiffness_ * Eigen::Matrix2d::Identity());
        }
    }

private:
    const std::vector<HeldVertex>& held_;
    double stiffness_;
};

/// Per vertex whether it does not move; empty: all may.
std::vector<char> immovable(const EnergyOptions& options, Eigen::Index vertices)
{
    std::vector<char> out;
    if (options.held.empty() || std::isfinite(options.spring))
        return out;
    out.assign(size_t(vertices), 0);
    for (const HeldVertex& h : options.held)
        out[size_t(h.vertex)] = 1;
    return out;
}

} // namespace

double largest_step(const Eigen::Matrix3Xi& triangle, const Eigen::Matrix2Xd& X, const Eigen::Matrix2Xd& direction)
{
    double largest = std::numeric_limits<double>::infinity();
    for (Eigen::Index f = 0; f < triangle.cols(); ++f) {
        const auto x = corners(X, triangle.col(f)), d = corners(direction, triangle.col(f));
        const Eigen::Vector2d p = x.col(1) - x.col(0), q = x.col(2) - x.col(0);
        const Eigen::Vector2d dp = d.col(1) - d.col(0), dq = d.col(2) - d.col(0);
        const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; };
        // Smallest positive root of a t^2 + b t + c, c > 0 twice the present area.
        const double a = cross(dp, dq), b = cross(dp, q) + cross(p, dq), c = cross(p, q);
        const double discriminant = b * b - 4 * a * c;
        if (discriminant < 0)
            continue;
        const double root = std::sqrt(discriminant);
        const double t = b <= 0 ? 2 * c / (-b + root) : (a < 0 ? -(b + root) / (2 * a) : -1);
        if (t > 0 && t < largest)
            largest = t;
    }
    return largest;
}

EnergyResult minimise_energy(const Eigen::Matrix3Xi& triangle, const std::vector<Element>& element, const Sheet& sheet,
                             const Eigen::Matrix2Xd& start, BlockMatrix& matrix, Cholesky& cholesky,
                             const EnergyOptions& options, const Progress& progress)
{
    const int faces = int(triangle.cols());
    EnergyResult result;
    result.position = start;
    Eigen::Matrix2Xd& X = result.position;
    const Springs springs(options);
    const std::vector<char> fixed = immovable(options, X.cols());
    const auto total = [&](const Eigen::Matrix2Xd& at) {
        return energy(triangle, element, sheet, at) + springs.energy(at);
    };
    double E = total(X);
    // What the sheet would store at the yield point all over: the scale below which an energy is
    // nothing.
    double yield_energy = 0;
    for (int f = 0; f < faces; ++f) {
        const StressCurve& curve = sheet.law_of(f).curve();
        yield_energy +=
            0.5 * element[size_t(f)].area * sheet.thickness[f] * curve.yield_stress() * curve.yield_strain();
    }

    struct Contribution {
        Matrix6d stiffness;
        Eigen::Matrix<double, 2, 3> force;
    };
    std::vector<ElementStress> expected(size_t(faces), ElementStress::Zero());
    for (int step = 0; step < options.most_steps; ++step) {
        const auto checkpoint = [&, text = fmt::format("energy step {}, {:.4g} J", step + 1, E * 1e-3)] {
            progress.checkpoint(double(step) / options.most_steps, text);
        };
        checkpoint();
        Eigen::VectorXd gradient = Eigen::VectorXd::Zero(matrix.size());
        matrix.clear();
        parallel_in_order<Contribution>(
            faces,
            [&](int f, Contribution& out) {
                const Element& e = element[size_t(f)];
                const EnergyDensity w = energy_density(
                    sheet.law_of(f), inverse_gradient(e, corners(X, triangle.col(f))), expected[size_t(f)]);
                const double weight = e.area * sheet.thickness[f];
                out.force = weight * (w.gradient * e.gradient);
                if (e.metric)
                    out.force = *e.metric * out.force;
                out.stiffness = element_stiffness(e, weight * w.stiffness);
                for (int a = 0; a < 3 && !fixed.empty(); ++a)
                    if (fixed[size_t(triangle(a, f))]) {
                        out.force.col(a).setZero();
                        out.stiffness.middleRows<2>(2 * a).setZero();
                        out.stiffness.middleCols<2>(2 * a).setZero();
                    }
            },
            [&](int f, const Contribution& in) {
                matrix.add(f, in.stiffness);
                for (int a = 0; a < 3; ++a)
                    gradient.segment<2>(2 * triangle(a, f)) += in.force.col(a);
            });
        springs.add(X, gradient, matrix);
        const double mean_stiffness = matrix.diagonal().mean();
        for (size_t v = 0; v < fixed.size(); ++v)
            if (fixed[v])
                matrix.add_to_diagonal(int(v), mean_stiffness * Eigen::Matrix2d::Identity());
        // The blank may be moved freely; a shift far below the stiffness fixes it without being
        // felt.
        const double shift = 1e-12 * matrix.diagonal().mean();
        for (int i = 0; i < matrix.size(); ++i)
            matrix.add_to_diagonal(i, shift);
        checkpoint();
        if (!cholesky.factor(matrix))
            throw SolveError("the stiffness of the energy stage is not positive definite; the start is too distorted");
        checkpoint();
        const Eigen::VectorXd newton = -cholesky.solve(gradient);
        const Eigen::Matrix2Xd direction = newton.reshaped(2, X.cols());
        const double decrement = -gradient.dot(newton);

        result.steps.push_back({E * 1e-3, decrement / (E + yield_energy), 0});
        if (options.watch)
            options.watch(X, result.steps.back());
        if (decrement <= options.decrement * (E + 1e-6 * yield_energy)) {
            result.ended = Ended::converged;
            // the last step costs nothing more
            if (decrement > 0 && largest_step(triangle, X, direction) > 2) {
                const Eigen::Matrix2Xd trial = X + direction;
                if (total(trial) <= E)
                    X = trial;
            }
            return result;
        }
        const auto take = [&](double length) {
            checkpoint();
            const Eigen::Matrix2Xd trial = X + length * direction;
            const double E_trial = total(trial);
            if (!(E_trial <= E - 1e-4 * length * decrement)) // Armijo
                return false;
            parallel_for(faces, [&](int f) {
                const Element& e = element[size_t(f)];
                const Svd2 d = svd(inverse_gradient(e, corners(X, triangle.col(f))));
                const Eigen::Matrix2d change = length * inverse_gradient(e, corners(direction, triangle.col(f)));
                ElementStress& stress = expected[size_t(f)];
                stress = expected_stress(sheet.law_of(f).normal(-d.s.array().log().matrix()), d, change, stress);
            });
            X = trial;
            E = E_trial;
            return true;
        };
        result.steps.back().step_length =
            backtrack(std::min(1.0, 0.9 * largest_step(triangle, X, direction)), 40, take);
        if (result.steps.back().step_length == 0) {
            result.ended = Ended::stalled;
            return result;
        }
    }
    return result;
}

} // namespace spia
