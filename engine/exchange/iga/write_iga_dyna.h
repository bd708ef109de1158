#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/forming/material/material.h"
#include "engine/nurbs/multi_patch.h"

namespace spia {

/// Writes the patches as isogeometric shells of an LS-DYNA deck, from *KEYWORD to *END, without
/// loads: *IGA_2D_NURBS_XYZ, *IGA_FACE_XYZ, *IGA_SHELL, *PART and *SECTION_IGA_SHELL for each
/// patch, under one number from 1, and *MAT_ELASTIC. Forces are N, times s. Fields of 20 columns
/// hold 12 to 16 digits; equal numbers give equal fields, so that the control points of shared
/// sides stay the same.
///
/// A section has one thickness; the form has no place for thickness or plastic strain that vary
/// over a patch. Interfaces are told in comments; LS-DYNA does not tie patches by itself
/// (*IGA_TIED_EDGE_TO_EDGE does, not written). One patch is Kirchhoff-Love (ELFORM 1), several are
/// Reissner-Mindlin (ELFORM 0), whose rotations can be tied.
///
/// Grammar: the keyword classes of ansys/pydyna, which are made from the manual
/// (keyword_classes/auto: iga_2d_nurbs_xyz.py, iga_face_xyz.py, iga_shell.py,
/// section_iga_shell.py): control points not multiplied by their weights, r fastest. Not stated
/// there, and taken to hold: SID of *IGA_SHELL is FID of the face; both are the patch's number
/// here. No LS-DYNA has read such a file of ours.
/// @param thickness_mm  one per patch
/// @param name for a comment; may be anything
/// @throws InputError if the patches are none, no surfaces or not watertight, or a thickness is not
/// positive; ExchangeError if the file cannot be written
void write_iga_dyna(const std::filesystem::path& path, const MultiPatch& patches,
                    const std::vector<double>& thickness_mm, const Material& material,
                    std::string_view name = "surface", LengthUnit unit = LengthUnit::mm);

} // namespace spia
