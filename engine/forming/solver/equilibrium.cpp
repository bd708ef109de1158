#include "engine/forming/solver/equilibrium.h"

#include <Eigen/LU>
#include <cmath>
#include <fmt/core.h>
#include <numeric>
#include <optional>

#include "engine/core/line_search.h"
#include "engine/core/text.h"
#include "engine/sparse/gmres.h"
#include "engine/sparse/lu.h"

namespace spia {
namespace {

/// How far the blank is, in the mean, moved and turned from where it lies nearest under the part
/// (Kabsch's condition for the rotation, which is linear): orthonormal rows with area weights. One
/// held vertex leaves the rotation only, two leave nothing to be fixed.
class RigidMotion {
public:
    RigidMotion(const TriMesh& part, const std::vector<Element>& element, const ExternalForces& external)
        : below_(external.plane.transpose() * part.position)
    {
        Eigen::VectorXd mass = Eigen::VectorXd::Zero(part.vertices());
        for (int f = 0; f < part.triangles(); ++f)
            for (int a = 0; a < 3; ++a)
                mass[part.triangle(a, f)] += element[size_t(f)].area / 3;
        centre_ = below_ * mass / mass.sum();
        Eigen::MatrixX3d rows(2 * below_.cols(), 3);
        for (int v = 0; v < part.vertices(); ++v) {
            const Eigen::Vector2d arm = below_.col(v) - centre_;
            rows.block<2, 3>(2 * v, 0) << -mass[v] * arm[1], mass[v], 0, mass[v] * arm[0], 0, mass[v];
        }
        rows_ = rows.leftCols(external.held.empty() ? 3 : external.held.size() == 1 ? 1 : 0).colwise().normalized();
    }

    const Eigen::MatrixXd& rows() const { return rows_; }
    /// Force and, about the centre, moment of the nodal forces that the multipliers stand for. N,
    /// N, N mm
    Eigen::Vector3d resultant(const Eigen::VectorXd& multiplier) const
    {
        const Eigen::VectorXd force = rows_ * multiplier;
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (Eigen::Index v = 0; v < below_.cols(); ++v) {
            const Eigen::Vector2d f = force.segment<2>(2 * v), arm = below_.col(v) - centre_;
            sum += Eigen::Vector3d(f[0], f[1], arm[0] * f[1] - arm[1] * f[0]);
        }
        return sum;
    }
    Eigen::VectorXd moved(const Eigen::Matrix2Xd& X) const { return rows_.transpose() * (X - below_).reshaped(); }

private:
    Eigen::Matrix2Xd below_; ///< the part seen along the stamping direction, in the plane of the
                             ///< blank
    Eigen::Vector2d centre_;
    Eigen::MatrixXd rows_;
};

class Newton {
public:
    Newton(const TriMesh& part, const std::vector<Element>& element, VirtualWork& work, const Eigen::Matrix2Xd& start,
           BlockMatrix& tangent, Cholesky& cholesky, const EquilibriumOptions& options)
        : triangle_(part.triangle), work_(work), rigid_(part, element, work.external()), tangent_(tangent),
          preconditioner_(tangent), cholesky_(cholesky), options_(options), yield_force_(work.yield_force())
    {
        work_.set_axes(start);
        work_.tangent(start, tangent_);
        spring_ = tangent_.diagonal().mean();
    }

    EquilibriumResult solve(const Eigen::Matrix2Xd& start, double tolerance, const Progress& progress)
    {
        EquilibriumResult result;
        result.position = start;
        Eigen::Matrix2Xd& X = result.position;
        work_.stabilize(X);
        factored_ = false;
        for (int step = 0; step <= options_.most_steps; ++step) {
            work_.set_axes(X);
            const Eigen::VectorXd R = residual(X);
            result.residual = R.norm() / yield_force_;
            const Step here{progress, double(step) / options_.most_steps,
                            fmt::format("equilibrium step {}, residual {:.1e}", step + 1, result.residual)};
            here.checkpoint();
            result.resultant = rigid_.resultant(spring_ * rigid_.moved(X));
            result.steps.push_back({0, result.residual, 0});
            if (options_.watch)
                options_.watch(X, result.steps.back());
            if (result.residual <= tolerance) {
                result.ended = Ended::converged;
                return result;
            }
            if (step == options_.most_steps)
                break;
            // A short step tells that the expected stresses lead astray: begin anew with the ones
            // that are there.
            if (result.steps.size() > 1 && result.steps[result.steps.size() - 2].step_length < short_step)
                work_.stabilize(X);
            if (no_progress(result.steps, size_t(options_.stall_steps)) || !advance(X, R, result.steps, here)) {
                result.ended = Ended::stalled;
                return result;
            }
        }
        return result;
    }

private:
    /// A step may take seconds: it can be cancelled between its iterations, too.
    struct Step {
        const Progress& progress;
        double fraction;
        std::string text;
        void checkpoint() const { progress.checkpoint(fraction, text); }
    };

    Eigen::VectorXd residual(const Eigen::Matrix2Xd& X) const
    {
        return work_.residual(X) + rigid_.rows() * (spring_ * rigid_.moved(X));
    }

    /// The residual has not halved in a while, or steps have become tiny: most often a triangle is
    /// about to turn over.
    static bool no_progress(const std::vector<NewtonStep>& steps, size_t stall_steps)
    {
        constexpr size_t few = 6;
        constexpr double tiny = 0.02; // mean step length
        const size_t n = steps.size();
        if (n > stall_steps && steps.back().residual > 0.5 * steps[n - 1 - stall_steps].residual)
            return true;
        double length = 0;
        for (size_t k = 2; k <= few + 1 && n > few; ++k)
            length += steps[n - k].step_length;
        return n > few && length < few * tiny;
    }

    bool advance(Eigen::Matrix2Xd& X, const Eigen::VectorXd& R, std::vector<NewtonStep>& steps, const Step& here)
    {
        const std::optional<Eigen::VectorXd> newton = direction_at(X, R, steps, here);
        if (!newton)
            return false;
        const Eigen::Matrix2Xd direction = newton->reshaped(2, X.cols());
        double least = std::numeric_limits<double>::max();
        for (const NewtonStep& step : steps)
            least = std::min(least, step.residual);
        const auto take = [&](double length) {
            here.checkpoint();
            const Eigen::Matrix2Xd trial = X + length * direction;
            if (!descends(R, residual(trial), length, least * yield_force_))
                return false;
            work_.expect(X, length * direction);
            X = trial;
            return true;
        };
        steps.back().step_length = backtrack(std::min(1.0, 0.9 * largest_step(triangle_, X, direction)), 10, take);
        return steps.back().step_length > 0;
    }

    /// Whether a step from R to `then` is one forward. A few triangles with a stress turned round
    /// can carry more than all of |R| while the blank as a whole comes nearer: then the work of R
    /// on the step that a linear sheet would answer with (Deuflhard's natural level in the norm of
    /// energy) falls, and |R| may rise up to twice the least so far. [Deuflhard 2004, sec. 3.3]
    bool descends(const Eigen::VectorXd& R, const Eigen::VectorXd& then, double length, double least) const
    {
        constexpr double most_rise = 2, fall = 0.8;
        if (then.norm() <= (1 - 1e-4 * length) * R.norm())
            return true;
        return factored_ && then.norm() <= most_rise * least &&
               then.dot(cholesky_.precondition(then)) <= fall * fall * R.dot(cholesky_.precondition(R));
    }

    /// To which part of R the linear system is solved: as exactly as the decrease of the residual
    /// deserves [Eisenstat and Walker 1996, choice 2], near the end as exactly as the end asks for.
    double forcing_term(const std::vector<NewtonStep>& steps) const
    {
        if (steps.size() < 2)
            return worst_forcing;
        if (steps[steps.size() - 2].step_length < short_step)
            return rough_forcing;
        const double enough = 0.3 * options_.tolerance / steps.back().residual;
        const double deserved = 0.9 * decrease(steps) * decrease(steps);
        // Where the end is within reach of this step it is worth a few iterations more.
        constexpr double reach = 300;
        return deserved < reach * enough ? std::clamp(enough, 1e-10, worst_forcing) : std::min(deserved, worst_forcing);
    }

    /// Of the residual, by the last step.
    static double decrease(const std::vector<NewtonStep>& steps)
    {
        return steps.size() < 2 ? 1 : steps.back().residual / steps[steps.size() - 2].residual;
    }

    /// Solves (K + k C C^T) d = -R, the tangent with the three soft springs on the rigid motion, by
    /// GMRES. A Cholesky factor of the tangent's definite neighbour preconditions it, near the
    /// solution the one of the step before; where that is not enough, a sparse LU takes its place.
    /// None: the tangent is singular, or an LU is not allowed.
    std::optional<Eigen::VectorXd> direction_at(const Eigen::Matrix2Xd& X, const Eigen::VectorXd& R,
                                                const std::vector<NewtonStep>& steps, const Step& here)
    {
        constexpr int most_iterations = 60, most_by_old_factor = 20;
        constexpr double near_solution = 0.3;
        const double tolerance = forcing_term(steps);
        // Far from the solution a rough direction is worth more than an exact one that costs ten
        // times as much.
        const double rough = tolerance < worst_forcing ? 0 : 0.3;
        const LinearMap A = [&](const Eigen::VectorXd& x) {
            here.checkpoint();
            Eigen::VectorXd y;
            tangent_.multiply(x, y);
            return Eigen::VectorXd(y + rigid_.rows() * (spring_ * (rigid_.rows().transpose() * x)));
        };
        const LinearMap by_cholesky = [&](const Eigen::VectorXd& x) { return cholesky_.precondition(x); };
        GmresResult old{Eigen::VectorXd::Zero(R.size())};
        Eigen::VectorXd rest = -R; // what the old factor has not solved is left to the new one
        if (factored_ && decrease(steps) < near_solution) {
            work_.tangent(X, tangent_);
            old = gmres(A, by_cholesky, rest, tolerance, most_by_old_factor);
            if (old.relative_residual <= tolerance)
                return old.x;
            rest -= A(old.x);
        }
        work_.tangents(X, tangent_, preconditioner_);
        here.checkpoint();
        factored_ = cholesky_.factor(preconditioner_);
        here.checkpoint();
        if (factored_) {
            const double left = rest.norm() / R.norm();
            const GmresResult solved = gmres(A, by_cholesky, rest, tolerance / left, most_iterations);
            if (left * solved.relative_residual <= std::max(tolerance, rough))
                return old.x + solved.x;
        }
        if (!options_.allow_lu)
            return std::nullopt;
        preconditioner_ = tangent_;
        preconditioner_.add_to_diagonal(0, spring_);
        preconditioner_.add_to_diagonal(1, spring_);
        preconditioner_.add_to_diagonal(preconditioner_.size() - 1, spring_);
        here.checkpoint();
        const Lu lu(preconditioner_);
        here.checkpoint();
        if (lu.singular())
            return std::nullopt;
        return gmres(
                   A, [&](const Eigen::VectorXd& x) { return lu.solve(x); }, -R, tolerance, most_iterations)
            .x;
    }

    static constexpr double worst_forcing = 0.1;
    // Where a triangle in the way leaves room for a short step only, a direction of few iterations,
    // which is smooth, goes round it.
    static constexpr double short_step = 0.1, rough_forcing = 0.5;

    const Eigen::Matrix3Xi& triangle_;
    VirtualWork& work_;
    RigidMotion rigid_;
    BlockMatrix& tangent_;
    BlockMatrix preconditioner_;
    Cholesky& cholesky_;
    const EquilibriumOptions& options_;
    double yield_force_;
    double spring_ = 0;
    bool factored_ = false; ///< cholesky_ holds the factor of a state of this iteration
};

/// The vertices that carry nine tenths of |R|^2.
std::vector<int> most_loaded(const Eigen::VectorXd& R)
{
    std::vector<int> vertex(size_t(R.size() / 2));
    std::iota(vertex.begin(), vertex.end(), 0);
    const auto load = [&](int v) { return R.segment<2>(2 * v).squaredNorm(); };
    std::stable_sort(vertex.begin(), vertex.end(), [&](int a, int b) { return load(a) > load(b); });
    double rest = R.squaredNorm();
    size_t count = 0;
    for (const double enough = 0.1 * rest; count < vertex.size() && rest > enough; ++count)
        rest -= load(vertex[count]);
    vertex.resize(count);
    return vertex;
}

} // namespace

std::string describe(const EquilibriumResult& result)
{
    const std::string steps = counted(result.steps.size(), "step", "steps");
    switch (result.ended) {
    case Ended::converged: return "converged in " + steps;
    case Ended::stalled: return fmt::format("stalled at a residual of {:.1e} after {}", result.residual, steps);
    case Ended::too_many_steps: break;
    }
    return fmt::format("a residual of {:.1e} left after {}", result.residual, steps);
}

EquilibriumResult solve_equilibrium(const TriMesh& part, const std::vector<Element>& element, VirtualWork& work,
                                    const Eigen::Matrix2Xd& start, BlockMatrix& matrix, Cholesky& cholesky,
                                    const EquilibriumOptions& options, const Progress& progress)
{
    return Newton(part, element, work, start, matrix, cholesky, options).solve(start, options.tolerance, progress);
}

EquilibriumResult solve_relaxed_equilibrium(const TriMesh& part, const std::vector<Element>& element, VirtualWork& work,
                                            const Eigen::Matrix2Xd& start, BlockMatrix& matrix, Cholesky& cholesky,
                                            const EquilibriumOptions& options, const Progress& progress)
{
    constexpr double near_enough = 1e-3; // for a start
    constexpr std::array<double, 5> most_mismatch = {std::numeric_limits<double>::max(), 1.4, 1.25, 1.15, 1.08};
    constexpr double rounds = double(most_mismatch.size()) + 2;
    const size_t vertices = size_t(part.vertices());
    std::vector<NewtonStep> steps;
    const auto keep_steps = [&](const EquilibriumResult& result) {
        steps.insert(steps.end(), result.steps.begin(), result.steps.end());
    };

    work.relax(std::vector<char>(vertices, 1));
    Newton newton(part, element, work, start, matrix, cholesky, options);
    const EquilibriumResult all = newton.solve(start, near_enough, progress.part(0, 1 / rounds));
    if (all.ended != Ended::converged)
        return all;
    keep_steps(all);

    std::vector<char> relaxed(vertices, 0);
    Eigen::Matrix2Xd looked_at = all.position;
    EquilibriumResult result;
    const auto solve = [&](const Progress& here, AttemptReport& own) {
        result = newton.solve(all.position, options.tolerance, here);
        own.reason = describe(result);
        keep_steps(result);
        return result.ended == Ended::converged;
    };
    const auto relaxed_above = [&](size_t round, AttemptReport& own) {
        work.set_axes(looked_at); // where a failed attempt went astray, the mismatch has grown
        if (round > 0) {
            const Eigen::VectorXd mismatch = work.mismatch();
            for (size_t v = 0; v < vertices; ++v)
                relaxed[v] |= mismatch[int(v)] > most_mismatch[round];
        }
        if (round > 1)
            for (const int v : most_loaded(work.residual(looked_at)))
                relaxed[size_t(v)] = 1;
        work.relax(relaxed);
        const bool converged = solve(progress.part((1 + double(round)) / rounds, (2 + double(round)) / rounds), own);
        looked_at = result.position;
        return converged;
    };
    const auto all_relaxed = [&](AttemptReport& own) {
        work.relax(std::vector<char>(vertices, 1));
        return solve(progress.part(1 - 1 / rounds, 1), own);
    };
    std::vector<PlannedAttempt> attempts;
    for (size_t round = 0; round < most_mismatch.size(); ++round)
        attempts.push_back({round == 0 ? "no vertex relaxed"
                                       : fmt::format("vertices relaxed of mismatch above {}", most_mismatch[round]),
                            {},
                            [&, round](AttemptReport& own) { return relaxed_above(round, own); }});
    attempts.push_back({"all vertices relaxed", {}, all_relaxed});
    result.attempts = try_in_order(attempts);
    result.steps = std::move(steps);
    return result;
}

} // namespace spia
