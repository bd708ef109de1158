#include "tests/robustness/unfold_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <stdexcept>
#include <vector>

#include "engine/compare/abf.h"
#include "engine/compare/arap.h"
#include "engine/mesh/topology.h"
#include "engine/unfold/step/unfold_script.h"

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

/// Per vertex: on the free rim, and between fixed and freed faces in one of the steps.
std::vector<char> hinge_ends(const TriMesh& part, const UnfoldScript& steps)
{
    std::vector<char> rim(size_t(part.vertices()), 0), end = rim;
    for (const std::vector<int>& loop : boundary_loops(part))
        for (const int v : loop)
            rim[size_t(v)] = 1;
    for (const PlannedStep& step : steps) {
        std::vector<char> fixed(size_t(part.vertices()), 0);
        for (const int f : step.pick.fixed)
            for (const int v : part.triangle.col(f))
                fixed[size_t(v)] = 1;
        for (const int f : step.pick.freed)
            for (const int v : part.triangle.col(f))
                if (fixed[size_t(v)] && rim[size_t(v)])
                    end[size_t(v)] = 1;
    }
    return end;
}

void count_necking(const TriMesh& part, const UnfoldScript& steps, const UnfoldState& last, BentRun& run)
{
    const std::vector<char> end = hinge_ends(part, steps);
    for (int f = 0; f < part.triangles(); ++f)
        if (last.face.necking[f]) {
            const auto corner = part.triangle.col(f);
            const bool at_end = std::any_of(corner.begin(), corner.end(), [&](int v) { return end[size_t(v)]; });
            ++(at_end ? run.at_hinge_end : run.necking);
        }
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
    count_necking(part, steps, last, run);
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
