#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/mesh/tri_mesh.h"

/// Flat parts with outlines and corners drawn at random. They are their own blank.
namespace spia::shapes {

/// A counter-clockwise outline, meshed, z = 0. Vertices 0, 1, ... are those of the outline.
TriMesh meshed_outline(const std::vector<Eigen::Vector2d>& outline);

struct RandomOutline {
    std::string name;          ///< kind and number: "comb 17"
    TriMesh part;              ///< z = 0; may have holes
    std::array<int, 4> corner; ///< distinct vertices of the outer boundary, counter-clockwise,
                               ///< where it turns to the left
};

constexpr int outline_kinds = 8;
std::string_view outline_kind(int kind); ///< star, L, U, comb, spiral, lobes, maze, plate with
                                         ///< holes

/// One outline of a kind, turned and stretched at random: the same every time and everywhere.
/// Corners are any four vertices at which the outline turns to the left, looked at from its
/// neighbours and from one hundredth of its length: a cell with straight edges cannot have a corner
/// of 180 degrees or more.
RandomOutline random_outline(int kind, int number);

} // namespace spia::shapes
