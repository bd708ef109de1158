#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/solid/bends/unrolled_bend.h"

namespace spia {

/// A round hole over a bend whose rim is elsewhere in the middle surface than where its wall meets
/// the middle of the sheet.
struct BendHole {
    StatedSurface wall;              ///< a cylinder
    std::vector<int> rim;            ///< vertices of the middle surface, one after the other
    std::vector<Eigen::Vector2d> to; ///< mm, per vertex of the rim: where the wall meets the middle
                                     ///< of the sheet
    std::vector<int> wall_triangles; ///< of the solid
};

std::vector<BendHole> bend_holes(const MiddleOfSolid& part, const UnrolledBend& bend);

/// Where the line along a hole's wall through a place meets the middle of the sheet, nearest to the
/// place.
/// @param place  mm, in space, on the wall @returns nothing if it is farther than three thicknesses
/// from there
std::optional<Eigen::Vector2d> where_wall_meets(const MiddleOfSolid& part, const UnrolledBend& bend,
                                                const StatedSurface& wall, const Eigen::Vector3d& place);

} // namespace spia
