#pragma once
#include "engine/mesh/solid/thin_solid.h"

namespace spia {

/// What a closed surface stands for that has two skins at one distance, where its file does not say
/// whether it is a solid.
enum class ClosedSurface {
    sheet,         ///< a solid of sheet
    perhaps_sheet, ///< a solid of sheet more likely than a hollow body of the same shape
    perhaps_hollow ///< the other way round
};

/// A plate and a closed box are one and the same surface: their proportions decide alone. What
/// tells more is an outline around a hole, which a hollow body hardly has, and skins that are bent
/// together. The proportion is that of the thickness to the width of the skins, four times their
/// area over their outline: the side of a square, the diameter of a disk, twice the width of a
/// strip.
/// - Plain plates: below 0.15 a sheet, to 0.4 perhaps (a tin has 0.15 to 0.5), beyond a hollow
///   body.
/// - Bent ones without holes: below 0.25 a sheet (closed ducts have 0.3 to 0.5), to 0.5 perhaps.
/// - With holes through them: below 0.4 a sheet, to 0.5 perhaps.
/// - Plain plates whose skins go over into each other by rounded edges are hollow bodies beyond
/// 0.08.
ClosedSurface sheet_or_hollow(const ThinSolid& sheet);

/// The thickness over the width, see there.
double proportion(const ThinSolid& sheet);

} // namespace spia
