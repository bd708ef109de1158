#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/mesh/edge_uses.h"

namespace spia {

/// Where a closed surface touches itself along an edge, as two holes do that touch: of the four
/// faces there the two and two that the inside lies between. They are sides of one edge each; that
/// the two edges are at one place is no fault.
/// @param uses  of one edge, all that it has
/// @returns indices into uses, two pairs; nothing if it is another kind of edge, or the surface is
/// seen from both sides there
std::optional<std::array<int, 4>> touching_edge(std::span<const EdgeUse> uses, const std::vector<Triangle>& triangle,
                                                const std::vector<Eigen::Vector3d>& position);

} // namespace spia
