#pragma once
#include <functional>

#include "engine/forming/solver/initial_guess.h"
#include "engine/forming/solver/stages.h"
#include "engine/unfold/step/freed_piece.h"

namespace spia {

/// A flat, flip-free place of every vertex of a piece, the held ones where they are held.
struct PieceStart {
    Eigen::Matrix2Xd position; ///< 2 by #V of the piece, mm
    StartMethod method;
};

/// By the shape of the state alone, so it does not matter how far the piece is bent: the first
/// guess of flatten() for the piece and fixed faces beside it, as rigid as possible, moved onto the
/// held vertices as a whole; then springs that grow stiffer draw these to their places while the
/// work of forming keeps every triangle from turning over.
/// @param state  3 by #V of the part, mm
/// @param fixed  faces of the part, ascending
/// @param context    of the piece; `external.held` says where its held vertices lie
/// @param measure  called with a place of the piece: takes the lengths of the target there into the
/// elements of the context
/// @throws SolveError if there is none: names the face whose triangle stands in the way
PieceStart piece_start(const TriMesh& part, const Eigen::Matrix3Xd& state, const std::vector<int>& fixed,
                       const FreedPiece& piece, SolveContext& context,
                       const std::function<void(const Eigen::Matrix2Xd&)>& measure, const Progress& progress = {});

} // namespace spia
