#pragma once
#include "engine/unfold/step/ring_chart.h"

namespace spia {

/// A start for a ring in the picture of the face that it goes around: harmonic in the logarithm of
/// the picture, held vertices at their places and free edges that go around at one distance, as far
/// as the area of the ring reaches. Nothing of it depends on how far the ring is bent away. [maps
/// of a cylinder by positive weights do not fold: Gortler, Gotsman, Thurston 2006]
/// @param state 3 by #V of the piece, mm; around the axis, no edge by half a turn
/// @returns 2 by #V, mm; holes in the ring may fold
Eigen::Matrix2Xd ring_start(const FreedPiece& piece, const Eigen::Matrix3Xd& state, const RingChart& chart);

} // namespace spia
