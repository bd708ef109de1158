#pragma once
#include "engine/forming/blank.h"
#include "engine/forming/solver/laid_lengths.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Incompressibility: the largest |h A - h0 A0| / (h0 A0) over the faces, thickness as given, areas
/// measured anew in space (of laid faces: as they are laid) and in the plane.
/// @param thickness #F, mm, of the flat sheet
double volume_error(const TriMesh& part, const Blank& blank, const SheetFields& face, const Eigen::VectorXd& thickness,
                    const LaidLengths& laid = {});

} // namespace spia
