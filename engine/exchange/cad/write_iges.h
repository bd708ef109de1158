#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "engine/core/length_unit.h"
#include "engine/nurbs/surface.h"
#include "engine/nurbs/trim.h"

namespace spia {

/// Writes an IGES 5.3 file: one plain entity 128 per surface, in the order given; a trimmed surface
/// (144) around that of one with holes. Every number has 17 digits, so poles (in mm), weights and
/// knots come back bit for bit; lines keep to 80 columns. The header names this program, never the
/// user; its date comes from time_stamp() (provenance.h): the same input gives the same bytes under
/// SOURCE_DATE_EPOCH.
/// @param part_name names the product in the header
/// @param unit what the lengths in the file are, also its header's
/// @param holes  of each surface; empty: none
/// @throws InputError if a surface is not one (see require_exchangeable); ExchangeError if the file
/// cannot be written
void write_iges(const std::filesystem::path& path, std::span<const NurbsSurface> surfaces,
                const std::string& part_name = "part", LengthUnit unit = LengthUnit::mm,
                std::span<const std::vector<TrimLoop>> holes = {});

inline void write_iges(const std::filesystem::path& path, const NurbsSurface& surface,
                       const std::string& part_name = "part", LengthUnit unit = LengthUnit::mm)
{
    write_iges(path, std::span(&surface, 1), part_name, unit);
}

} // namespace spia
