#include "tests/robustness/unfold_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <stdexcept>

#include "engine/compare/abf.h"
#include "engine/compare/arap.h"
#include "engine/unfold/unfold_script.h"

namespace spia {
namespace {

double off_exact(const TriMesh& part, const Eigen::Matrix2Xd& flat, const Eigen::Matrix2Xd& exact)
{
    double most = 0;
    for (const auto& t : part.triangle.colwise())
        for (int k = 0; k < 3; ++k) {
            const int i = t[k], j = t[(k + 1) % 3];
            most = std::max(most, std::abs((flat.col(i) - flat.col(j)).norm() - (exact.col(i) - exact.col(j)).norm()));
        }
    return most;
}

/// @param blank gives the places of all vertices; may throw
MethodRun method_run(const shapes::BentPart& part, const std::function<Eigen::Matrix2Xd()>& blank)
{
    MethodRun run;
    try {
        const Eigen::Matrix2Xd flat = blank();
        run.quality = map_quality(part.mesh, flat);
        if (part.flat)
            run.off_exact = off_exact(part.mesh, flat, *part.flat);
    } catch (const std::exception& error) {
        run.failure = error.what();
    }
    return run;
}

Eigen::Matrix2Xd step_by_step(const TriMesh& part, const FlattenOptions& options, BentRun& run)
{
    const auto clock = std::chrono::steady_clock::now();
    const BendMap map = find_bends(part);
    run.regions = int(map.regions.size());
    const UnfoldScript steps = propose_sequence(part, map).steps;
    UnfoldRun unfolded = run_unfolding(part, steps, options);
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    run.steps = int(steps.size());
    for (const UnfoldState& state : unfolded.states)
        run.converged += state.converged;
    if (!unfolded.blank)
        throw std::runtime_error(unfolded.failure.empty() ? "it does not lie in a plane" : unfolded.failure);
    const UnfoldState& last = unfolded.states.back();
    run.strain = last.face.strain_equivalent.maxCoeff();
    run.necking = last.face.necking.sum();
    run.overlaps = last.overlap.places;
    return std::move(unfolded.blank->position);
}

} // namespace

BentRun run_bent(const shapes::BentPart& part, const FlattenOptions& options, bool others)
{
    BentRun run;
    run.triangles = part.mesh.triangles();
    run.local = method_run(part, [&] { return step_by_step(part.mesh, options, run); });
    run.whole = method_run(part, [&] {
        FlattenResult flat = flatten(part.mesh, options);
        run.whole_converged = flat.report.converged;
        run.whole_strain = flat.face.strain_equivalent.maxCoeff();
        return std::move(flat.blank.position);
    });
    if (others) {
        run.abf = method_run(part, [&] { return abf(part.mesh).position; });
        run.arap = method_run(part, [&] { return arap(part.mesh).position; });
    }
    return run;
}

} // namespace spia
