#pragma once
#include <filesystem>
#include <string_view>

#include "engine/core/length_unit.h"
#include "engine/nurbs/patch_field.h"

namespace spia {

/// Writes the patches as XML of G+Smo: one Geometry each, TensorBSpline2 where all weights are 1,
/// else TensorNurbs2, with the ids 0, 1, ..., and a MultiPatch with interfaces and boundary.
/// Numbers read back as the same bits.
///
/// Grammar: G+Smo, src/gsIO/gsXmlGenericUtils.hpp (bases with the component of the fastest
/// direction first, weights as a block of their own, coefs not multiplied by them, one point a
/// line, u fastest), src/gsCore/gsCoreXml.hpp and src/gsIO/gsXmlUtils (MultiPatch: `patches` as a
/// range of ids; in `boundary` patch and side; in `interfaces` patch side patch side, to which
/// direction of the second each direction of the first goes, and whether the two have one sense),
/// src/gsCore/gsBoundary.h (sides 1 to 4 are u = 0, u = 1, v = 0, v = 1; across the interface the
/// sense is one where the sides are a beginning and an end).
/// @param name for a comment; may be anything
/// @throws InputError if the patches are none, no surfaces or not watertight; ExchangeError if the
/// file cannot be written
void write_gismo(const std::filesystem::path& path, const MultiPatch& patches, std::string_view name = "surface",
                 LengthUnit unit = LengthUnit::mm);

/// Writes a field as a file of its own in the same form: the same bases and topology, coefs with
/// geoDim 1. A file of its own, since programs take every Geometry of a file for a patch of the
/// surface.
/// @throws as write_gismo(), and InputError if the field is not one of these patches
/// (require_field())
void write_gismo_field(const std::filesystem::path& path, const MultiPatch& patches, const PatchField& field,
                       std::string_view name = "surface", LengthUnit unit = LengthUnit::mm);

} // namespace spia
