#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "engine/core/length_unit.h"
#include "engine/nurbs/surface.h"
#include "engine/nurbs/trim.h"

namespace spia {

/// Writes a STEP file (AP242): one product of the given name, its shape an open shell of B-spline
/// faces within their natural borders; patches that meet are sewn and share their edges. Numbers
/// have 17 digits. The header names this program, never the user; its date comes from time_stamp()
/// (provenance.h): the same input gives the same bytes under SOURCE_DATE_EPOCH. Weights that are
/// all equal are written as a polynomial surface, which has the same shape.
/// @param unit what the lengths in the file are
/// @param holes  of each surface, which its face is trimmed by; empty: none
/// @throws InputError if a surface is not one (see require_exchangeable); ExchangeError if the file
/// cannot be written
void write_step(const std::filesystem::path& path, std::span<const NurbsSurface> surfaces,
                const std::string& part_name = "part", LengthUnit unit = LengthUnit::mm,
                std::span<const std::vector<TrimLoop>> holes = {});

inline void write_step(const std::filesystem::path& path, const NurbsSurface& surface,
                       const std::string& part_name = "part", LengthUnit unit = LengthUnit::mm)
{
    write_step(path, std::span(&surface, 1), part_name, unit);
}

} // namespace spia
