#pragma once
#include <filesystem>
#include <string_view>

#include "engine/core/length_unit.h"
#include "engine/nurbs/patch_field.h"

namespace spia {

/// Writes the patches as an MFEM NURBS mesh v1.0 of dimension 2 in space. Patch p has the element
/// attribute p + 1, each outer side a boundary attribute of its own, from 1. Control points are not
/// multiplied by their weights; all numbers read back as the same bits.
///
/// Grammar: MFEM, mesh/nurbs.cpp (NURBSExtension::Load(), NURBSPatch(std::istream&),
/// CheckPatches()), mesh/mesh.cpp (LoadPatchTopo()), data/square-disc-nurbs-patch.mesh. The corner
/// numbers carry the topology: sides that meet are one edge. An edge line has the number of a knot
/// vector and the two corners in the sense of that knot vector; opposite sides of a patch, and so
/// whole strips of patches, share it.
/// @param name for a comment; may be anything
/// @throws InputError if the patches are none, no surfaces or not watertight, or MFEM has no words
///         for how they join: a patch that is closed in itself, two sides between the same two
///         corners, a strip that comes back upon itself twisted; ExchangeError if the file cannot
///         be written
void write_mfem(const std::filesystem::path& path, const MultiPatch& patches, std::string_view name = "surface",
                LengthUnit unit = LengthUnit::mm);

/// Writes a field as a grid function on the mesh of write_mfem(), patch by patch in the order of
/// the control points. Orders and weights are those of the mesh.
///
/// Grammar: MFEM, fem/fespace.cpp (FiniteElementSpace::Load(): a NURBS collection without a number
/// has the orders of the mesh), fem/gridfunc.cpp (GridFunction(Mesh*, std::istream&):
/// NURBS_patches), mesh/nurbs.cpp (NURBSExtension::LoadSolution()).
/// @throws as write_mfem(), and InputError if the field is not one of these patches
/// (require_field())
void write_mfem_field(const std::filesystem::path& path, const MultiPatch& patches, const PatchField& field,
                      std::string_view name = "surface", LengthUnit unit = LengthUnit::mm);

} // namespace spia
