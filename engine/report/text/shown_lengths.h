#pragma once
#include <string>
#include <string_view>

#include "engine/core/length_unit.h"

namespace spia {

/// Lengths below this are noise of the arithmetic and shown as 0, mm: a nanometre, which no mesh,
/// CAD file or press tells from nothing.
inline constexpr double no_length = 1e-6;

/// What the engine says, which always speaks of mm and mm2, in the unit of the screen: "0.258 mm"
/// becomes "0.0102 in", also in rows such as "12.1, 40, 3.2 mm" and "12 of 40 mm". Lengths below
/// no_length become 0, in mm too. Forces per length (N/mm) stay, they are no lengths.
std::string in_shown_lengths(std::string_view text, LengthUnit unit);

} // namespace spia
