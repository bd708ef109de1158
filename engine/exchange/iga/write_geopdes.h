#pragma once
#include <filesystem>
#include <string_view>

#include "engine/core/length_unit.h"
#include "engine/nurbs/multi_patch.h"

namespace spia {

/// Writes the patches as the NURBS text of GeoPDEs and octave-nurbs, version 2.1. Control points
/// are multiplied by their weights, as the format has them; where all weights are 1 they read back
/// as the same bits, else as the same products. Each outer side is a boundary of its own. The
/// format has no place for fields.
///
/// Grammar: GeoPDEs, geopdes/doc/geo_specs_mp_v21.txt; octave-nurbs 1.4.3, nrbexport.m. Sides 1 to
/// 4 are u = 0, u = 1, v = 0, v = 1; of an interface 1 is one sense, -1 the opposite; patches are
/// counted from 1, u fastest.
/// @param name for a comment; may be anything
/// @throws InputError if the patches are none, no surfaces or not watertight; ExchangeError if the
/// file cannot be written
void write_geopdes(const std::filesystem::path& path, const MultiPatch& patches, std::string_view name = "surface",
                   LengthUnit unit = LengthUnit::mm);

} // namespace spia
