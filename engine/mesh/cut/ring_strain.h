#pragma once
#include <vector>

#include "engine/mesh/cut/front_march.h"

namespace spia {

/// How unwilling the sheet around a hole is to become a flat ring, from the lengths of the lines at
/// equal distances around the hole. A map that keeps angles takes the line of length l(s) at the
/// distance s onto a circle of radius r with dr / r = 2 pi ds / l(s); the scale there is 2 pi r /
/// l(s). Around a hole in a flat sheet the scale is one everywhere; from one end of a tube to the
/// other, a height h away, its logarithm grows by 2 pi h / l. Cut open, the sheet becomes a fan of
/// any angle in place of 2 pi: a tube one of no angle, a cone its own, both without a change of
/// scale.
struct RingStrain {
    double ring = 0;   ///< greatest difference of the logarithm of the scale, as a closed ring
    double fan = 0;    ///< likewise for the best fan; never more than ring
    double reach = 0;  ///< mm, how far the lines were followed: up to the next of the loops that
                       ///< count
    double widest = 0; ///< mm, the longest of the lines
};

/// @param loop the boundary loop @param stop #V, 1 at the vertices of the loops that end the search
RingStrain ring_strain(FrontMarch& march, const std::vector<int>& loop, const std::vector<char>& stop);

} // namespace spia
