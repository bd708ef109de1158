#pragma once
#include "engine/forming/flatten.h"
#include "engine/forming/solver/laid_lengths.h"

namespace spia {

/// Likewise, from a flat place of every vertex in place of the first guess: where flatten() finds
/// no start, or ends in another of several solutions.
/// @param start  2 by #V, mm, wherever it lies in the plane: without a flipped triangle, faces
/// wound once around each vertex
/// @returns as flatten(); `report.start` means nothing
/// @throws InputError also if the start is no such place: names the first offending face
FlattenResult flatten_from(const TriMesh& part, const Eigen::Matrix2Xd& start, const FlattenOptions& options,
                           const Progress& progress = {}, const StepWatch& watch = {});

/// Likewise, where the material of some faces has other lengths than their triangles: bends with
/// the length of their neutral fibre.
/// @param start  as in flatten_from(); null: a first guess of its own, as in flatten()
FlattenResult flatten_laid(const TriMesh& part, const LaidLengths& laid, const Eigen::Matrix2Xd* start,
                           const FlattenOptions& options, const Progress& progress = {}, const StepWatch& watch = {});

} // namespace spia
