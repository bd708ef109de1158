#pragma once
#include <cstdint>

#include "tests/support/cad/bent_solid.h"

/// Families of bent sheet drawn at random, each the same for the same seed.
namespace spia::shapes {

/// One of a family drawn at random: 1 to 8 bends of 1 to 180 degrees, R/t from 0.1 to 20, no
/// section that touches itself.
BentSolid random_bent_solid(std::uint64_t seed);

/// 1 to 3 bends of 20 to 110 degrees, R/t from 0.3 to 10, each with a hole, a slot, an oblique
/// hole, a notch or a V notch through it or over one of its ends, of which its legs' free ends keep
/// clear: length and width of the blank are those without them.
BentSolid random_cut_bends(std::uint64_t seed);

/// A bend of 30 to 125 degrees, R/t from 0.2 to 1, with a round hole through it that is 0.6 to 1.6
/// times as wide as its arc in the middle of the sheet: on one skin, on both or on none the hole is
/// wider than the bend.
BentSolid random_wide_hole(std::uint64_t seed);

/// 1 or 2 bends of 25 to 110 degrees, R/t from 0.5 to 5, among them joggles, with round and long
/// embosses in the legs.
BentSolid random_embossed_bracket(std::uint64_t seed);

} // namespace spia::shapes
