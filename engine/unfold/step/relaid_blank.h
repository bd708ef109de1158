#pragma once
#include "engine/forming/flatten_from.h"

namespace spia {

/// A blank solved anew with the lengths of laid faces, lying as it lay: for blanks that were made
/// in steps.
/// @param flat  2 by #V, mm, as for flatten_from()
FlattenResult relaid_blank(const TriMesh& part, const Eigen::Matrix2Xd& flat, const LaidLengths& laid,
                           const FlattenOptions& options, const Progress& progress = {}, const StepWatch& watch = {});

/// Up to this equivalent strain a blank made in steps is laid anew: more is not that of bending
/// alone, and belongs to the steps.
inline constexpr double most_relaid_strain = 0.02;

} // namespace spia
