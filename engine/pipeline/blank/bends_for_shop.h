#pragma once
#include <array>
#include <vector>

#include "engine/mesh/edge_uses.h"
#include "engine/part/part_file.h"
#include "engine/unfold/plan/bends.h"

namespace spia {

/// The bends that a shop is told of. Where a CAD file states that all faces are planes and
/// cylinders, an edge between two planes is a fold, however little it turns, if the planes turn by
/// as much: triangles that a rim tilts do not. Of other parts it may be an edge between chords: it
/// is none where the CAD faces go over into each other, or where it is within one of them.
BendMap bends_for_shop(const PartFile& part);

/// The bends over which a part is unfolded step by step. Where a CAD file states that all faces are
/// planes and cylinders, cylinders are bends, also wide ones.
BendMap bends_for_steps(const PartFile& part);

/// The edges of a mesh at which a sharp fold lies between its two regions; of each both uses.
std::vector<std::array<EdgeUse, 2>> edges_of(const TriMesh& part, const BendMap& map, const Bend& fold);

/// Whether bend k is only some of a CAD face, which goes on into sheet that is bent less: a shape
/// that is rolled or drawn, and not bent along a line.
bool is_within_a_face(const PartFile& part, const BendMap& map, size_t k);

} // namespace spia
