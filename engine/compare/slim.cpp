#include "engine/compare/slim.h"

#include <Eigen/LU>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/line_search.h"
#include "engine/core/parallel.h"
#include "engine/forming/solver/energy_stage.h"

namespace spia {
namespace {

constexpr double least_density = 4; ///< of an isometry

/// W^T W of the paper's eq. 7 and table 1: in the left singular basis of J the slope of the energy
/// over that of
/// |s - 1|^2, (s - s^-3) / (s - 1), and the derivative of the energy, 2 (J - J^-T J^-1 J^-T).
void reweight(const Eigen::Matrix2d& J, Eigen::Matrix2d& metric, Eigen::Matrix2d& stress)
{
    const Svd2 d = svd(J);
    const auto s = d.s.array();
    const Eigen::Vector2d weight = 2 * (s + 1) * (s.square() + 1) / s.cube();
    metric = d.U * weight.asDiagonal() * d.U.transpose();
    const Eigen::Vector2d slope = 2 * (s - s.cube().inverse());
    stress = d.U * slope.asDiagonal() * d.V.transpose();
}

} // namespace

double symmetric_dirichlet_density(const Eigen::Matrix2d& J)
{
    const double determinant = J.determinant();
    if (!(determinant > 0))
        return std::numeric_limits<double>::infinity();
    // |J^-1| = |J| / det J in two dimensions
    return J.squaredNorm() * (1 + 1 / (determinant * determinant));
}

FlatMap slim(const TriMesh& part, const IsometricOptions& options, const Progress& progress,
             const Eigen::Matrix2Xd& start)
{
    IsometricSteps steps(part, progress);
    FlatMap map;
    Eigen::Matrix2Xd& u = map.position;
    u = start.cols() ? start : steps.start(progress.part(0.05, 0.15));
    if (flipped_triangles(part.triangle, u) > 0)
        throw InputError("SLIM needs a start without flipped triangles");
    const double floor = least_density * steps.part_area();
    std::vector<Eigen::Matrix2d> metric(static_cast<size_t>(part.triangles())), stress(metric.size());
    map.energy = {steps.energy(u, symmetric_dirichlet_density)};
    map.ended = "most steps taken";
    while (map.iterations < options.most_steps) {
        const double before = map.energy.back();
        if (before - floor <= options.nothing * steps.part_area()) {
            map.ended = "nothing left to gain";
            break;
        }
        progress.checkpoint(
            0.15 + 0.85 * map.iterations / options.most_steps,
            fmt::format("SLIM step {}, energy {:.6g} of at least 4", map.iterations + 1, before / steps.part_area()));
        parallel_for(part.triangles(),
                     [&](int f) { reweight(steps.gradient(u, f), metric[size_t(f)], stress[size_t(f)]); });
        steps.factor(metric);
        const Eigen::Matrix2Xd direction = steps.step(stress);
        double after = before;
        const auto take = [&](double length) {
            const Eigen::Matrix2Xd trial = u + length * direction;
            const double energy = steps.energy(trial, symmetric_dirichlet_density);
            if (!(energy < before && flipped_triangles(part.triangle, trial) == 0))
                return false;
            u = trial;
            after = energy;
            return true;
        };
        backtrack(std::min(1.0, 0.8 * largest_step(part.triangle, u, direction)), 40, take);
        if (after == before) { // rounding is all that is left
            map.ended = "converged";
            break;
        }
        map.energy.push_back(after);
        ++map.iterations;
        if (before - after <= options.decrease * (before - floor)) {
            map.ended = "converged";
            break;
        }
    }
    return map;
}

} // namespace spia
