#pragma once
#include <optional>
#include <vector>

#include "engine/core/progress.h"
#include "engine/forming/flatten.h"
#include "engine/unfold/target/fit_target.h"
#include "engine/unfold/target/unfold_pick.h"

namespace spia {

/// A connected piece of the freed faces, solved for itself.
struct UnfoldedPiece {
    std::vector<int> faces; ///< of the part, ascending
    int held_vertices = 0;  ///< shared with fixed faces
    SolveReport report;
};

struct UnfoldStepResult {
    Eigen::Matrix3Xd position;        ///< 3 by #V, mm: all vertices after the step
    TargetFit target;                 ///< the target and how well it goes on from the fixed faces:
                                      ///< see hinge_quality()
    std::vector<int> freed;           ///< ascending
    SheetFields face;                 ///< of forming the step's sheet into the part: one entry per
                                      ///< freed face
    std::vector<UnfoldedPiece> piece; ///< in the order of their first faces
    int necking_triangles = 0;        ///< freed faces beyond the trusted strain
    double seconds = 0;

    bool converged() const; ///< all pieces
};

/// One step of local unfolding: the freed faces are laid on a target face in space without moving
/// the fixed ones. Positions live in the target's development, and vertices shared with fixed faces
/// stay where they are. On a smooth face, which has no development with true lengths, those around
/// each triangle are taken from where it lies, in rounds until it lies still; so on a cylinder or
/// cone where a ring goes all the way around it, which knows neither friction nor a rolling
/// direction. The equations are those of flatten(): equilibrium of the freed material, whose strain
/// is measured from its place on the target to the original part, whatever steps were before.
/// @param part   as it is formed, mm
/// @param state  3 by #V, mm: where its vertices are now; before the first step the part's own
///         positions
/// @param options of flatten(); of the process only tailored pieces and the rolling direction, seen
///         square to the target in the middle of the hinge. A piece that is joined to nothing lies
///         on a plane as flatten() lays it, with the plane's normal as stamping direction; where
///         steps before have moved it and it is seen whole along that, it starts from there if
///         there is a way.
/// @throws InputError if the pick or an option is not as described: names the first offending face
/// @throws SolveError if a piece cannot be laid on the target without turning a triangle over:
///         names the face
/// The result does not depend on the number of threads nor on the order of the faces in the pick.
/// [Zhu et al. 2013, sec. 4.3]
UnfoldStepResult unfold_step(const TriMesh& part, const Eigen::Matrix3Xd& state, const UnfoldPick& pick,
                             const FlattenOptions& options, const Progress& progress = {});

} // namespace spia
