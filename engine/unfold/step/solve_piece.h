#pragma once
#include "engine/forming/flatten.h"
#include "engine/unfold/step/freed_piece.h"
#include "engine/unfold/target/target_surface.h"

namespace spia {

struct SolvedPiece {
    Eigen::Matrix3Xd position; ///< 3 by #V of the piece, mm, on the target
    SheetFields face;          ///< one entry per face of the piece
    SolveReport report;
};

/// Lays one freed piece on the target: see unfold_step().
/// @param traction of friction, see friction_traction()
SolvedPiece solve_piece(const TriMesh& part, const Eigen::Matrix3Xd& state, const std::vector<int>& fixed,
                        const FreedPiece& piece, const TargetSurface& target, const Eigen::VectorXd& traction,
                        const FlattenOptions& options, const Progress& progress);

} // namespace spia
