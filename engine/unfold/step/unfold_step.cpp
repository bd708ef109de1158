#include "engine/unfold/step/unfold_step.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <iterator>

#include "engine/core/error.h"
#include "engine/forming/solver/sheet_fields.h"
#include "engine/mesh/topology.h"
#include "engine/options/advice.h"
#include "engine/unfold/step/freed_piece.h"
#include "engine/unfold/step/hinge_quality.h"
#include "engine/unfold/step/solve_piece.h"
#include "engine/unfold/step/target_friction.h"
#include "engine/unfold/target/fit_height.h"
#include "engine/unfold/target/turn_target.h"

namespace spia {
namespace {

/// The faces of a pick, ascending, each once.
std::vector<int> sorted_faces(const TriMesh& part, std::vector<int> faces, const char* what)
{
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    for (const int f : faces)
        if (f < 0 || f >= part.triangles())
            throw InputError(
                fmt::format("the {} faces name face {}; the part has faces 0 to {}", what, f, part.triangles() - 1));
    return faces;
}

void require_area(const TriMesh& mesh, const std::vector<int>& faces, const char* where)
{
    for (const int f : faces) {
        const Eigen::Matrix3d x = mesh.position(Eigen::all, mesh.triangle.col(f));
        if (!((x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() > 0))
            throw InputError(fmt::format("face {} has no area {}; weld or remove it before unfolding", f, where));
    }
}

void require_valid(const TriMesh& part, const Eigen::Matrix3Xd& state, const FlattenOptions& options)
{
    if (state.cols() != part.vertices() || !state.allFinite())
        throw InputError(
            fmt::format("the state has {} places, the part {} vertices; it must have a finite place for each",
                        state.cols(), part.vertices()));
    if (!(options.thickness > 0) || !std::isfinite(options.thickness))
        throw InputError(fmt::format("the sheet thickness is {} mm; it must be positive", options.thickness));
    if (has_tools(options.process))
        throw InputError(
            "binders, pads, drawbeads, pilots and edge restraint act on the part as a whole; leave them out of the "
            "local steps and apply them when the whole part is flattened; what rubs on a step's target belongs to its pick");
}

struct Picked {
    std::vector<int> fixed, freed;
};

Picked picked_faces(const TriMesh& part, const UnfoldPick& pick)
{
    Picked out{sorted_faces(part, pick.fixed, "fixed"), sorted_faces(part, pick.freed, "freed")};
    if (out.freed.empty())
        throw InputError("no face is freed; pick the faces that the step shall move");
    std::vector<int> both;
    std::set_intersection(out.fixed.begin(), out.fixed.end(), out.freed.begin(), out.freed.end(),
                          std::back_inserter(both));
    if (!both.empty())
        throw InputError(
            fmt::format("face {} is picked both to stay and to move; take it out of one of the two", both[0]));
    return out;
}

/// The target with its outer side where that of the faces is.
TargetSurface seen_from_outside(const TargetSurface& face, const TriMesh& state, const std::vector<int>& faces)
{
    double sum = 0;
    for (const int f : faces) {
        const Eigen::Matrix3d x = state.position(Eigen::all, state.triangle.col(f));
        sum += (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).dot(outer_normal(face, x.rowwise().mean()));
    }
    return sum < 0 ? turned_over(face) : face;
}

TargetSurface target_of(const TriMesh& part, const TriMesh& state, const UnfoldPick& pick, const Picked& picked)
{
    const std::vector<int> carrying = sorted_faces(part, pick.carrying, "carrying");
    for (const int f : carrying)
        if (!std::binary_search(picked.fixed.begin(), picked.fixed.end(), f))
            throw InputError(fmt::format("face {} shall carry the target but is not fixed; fix it, too", f));
    if (pick.target)
        return seen_from_outside(*pick.target, state, picked.fixed);
    if (picked.fixed.empty())
        throw InputError("nothing says where the freed faces shall lie; fix some faces or give a target");
    const std::vector<int>& faces = carrying.empty() ? picked.fixed : carrying;
    std::optional<TargetFit> fit = fit_target(state, faces);
    if (!fit)
        fit = fit_height(state, faces);
    if (!fit)
        throw InputError(
            fmt::format("the fixed faces around face {} lie on no plane, cylinder or cone and turn too far for a "
                        "smooth face over a plane; {}",
                        faces[0], mention(advice::smooth_carriers)));
    return fit->face;
}

/// Where faces stand among the freed ones.
std::vector<int> places_of(const std::vector<int>& faces, const std::vector<int>& freed)
{
    std::vector<int> at;
    for (const int f : faces)
        at.push_back(int(std::lower_bound(freed.begin(), freed.end(), f) - freed.begin()));
    return at;
}

} // namespace

bool UnfoldStepResult::converged() const
{
    return std::all_of(piece.begin(), piece.end(), [](const UnfoldedPiece& p) { return p.report.converged; });
}

UnfoldStepResult unfold_step(const TriMesh& part, const Eigen::Matrix3Xd& state, const UnfoldPick& pick,
                             const FlattenOptions& options, const Progress& progress)
{
    const auto clock = std::chrono::steady_clock::now();
    require_valid(part, state, options);
    const Picked picked = picked_faces(part, pick);
    const TriMesh now{state, part.triangle};
    require_area(part, picked.freed, "in the part");
    require_area(now, picked.freed, "in the state");
    require_area(now, picked.fixed, "in the state");
    const TargetSurface target = target_of(part, now, pick, picked);
    const std::vector<FreedPiece> pieces = freed_pieces(part, picked.fixed, picked.freed);
    const Eigen::VectorXd traction = friction_traction(part, state, pick, picked.freed, target);

    UnfoldStepResult result;
    result.position = state;
    result.target = hinge_quality(target, now, picked.fixed, pieces);
    result.freed = picked.freed;
    result.face = sized_fields(Eigen::Index(picked.freed.size()));
    double done = 0;
    for (const FreedPiece& piece : pieces) {
        const double share = double(piece.face.size()) / double(picked.freed.size());
        const SolvedPiece solved =
            solve_piece(part, state, picked.fixed, piece, target, traction, options, progress.part(done, done + share));
        done += share;
        for (size_t v = 0; v < piece.vertex.size(); ++v)
            result.position.col(piece.vertex[v]) = solved.position.col(Eigen::Index(v));
        for (const int v : piece.held) // where they are, even where the target runs beside them
            result.position.col(piece.vertex[size_t(v)]) = state.col(piece.vertex[size_t(v)]);
        put_fields(solved.face, places_of(piece.face, picked.freed), result.face);
        result.piece.push_back({piece.face, int(piece.held.size()), solved.report});
    }
    result.necking_triangles = result.face.necking.sum();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    return result;
}

} // namespace spia
