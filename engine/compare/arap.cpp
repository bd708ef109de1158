#include "engine/compare/arap.h"

#include <fmt/core.h>

#include "engine/core/parallel.h"
#include "engine/forming/solver/nearest_rotation.h"

namespace spia {

double arap_density(const Eigen::Matrix2d& J) { return (J - nearest_rotation(J)).squaredNorm(); }

FlatMap arap(const TriMesh& part, const IsometricOptions& options, const Progress& progress,
             const Eigen::Matrix2Xd& start)
{
    IsometricSteps steps(part, progress);
    FlatMap map;
    Eigen::Matrix2Xd& u = map.position;
    u = start.cols() ? start : steps.start(progress.part(0.1, 0.3));
    steps.factor(std::vector<Eigen::Matrix2d>(size_t(part.triangles()), Eigen::Matrix2d::Identity()));
    std::vector<Eigen::Matrix2d> stress(static_cast<size_t>(part.triangles()));
    map.energy = {steps.energy(u, arap_density)};
    map.ended = "most steps taken";
    while (map.iterations < options.most_steps) {
        const double before = map.energy.back();
        if (before <= options.nothing * steps.part_area()) {
            map.ended = "nothing left to gain";
            break;
        }
        progress.checkpoint(0.3 + 0.7 * map.iterations / options.most_steps,
                            fmt::format("ARAP step {}, energy {:.6g} mm2", map.iterations + 1, before));
        parallel_for(part.triangles(), [&](int f) {
            const Eigen::Matrix2d J = steps.gradient(u, f);
            stress[size_t(f)] = J - nearest_rotation(J);
        });
        const Eigen::Matrix2Xd next = u + steps.step(stress);
        const double after = steps.energy(next, arap_density);
        if (!(after < before)) { // rounding is all that is left
            map.ended = "converged";
            break;
        }
        u = next;
        map.energy.push_back(after);
        ++map.iterations;
        if (before - after <= options.decrease * before) {
            map.ended = "converged";
            break;
        }
    }
    return map;
}

} // namespace spia
