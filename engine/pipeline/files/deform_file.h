#pragma once
#include <filesystem>

#include "engine/deform/deform.h"

namespace spia {

/// What a file asks for before there is a surface.
struct DeformationWish {
    std::vector<ControlMove> moves;
    std::optional<Lattice> lattice;
    bool around = false; ///< no box is given: the lattice is laid around the surface
};

/// A JSON file of schema spia.deformation/1: "moves" [{patch (from 0, may be left out), at [i, j],
/// by [x, y, z]}, ...] of control points, and "lattice" {count [l, m, n], degree [p, q, r], origin
/// [x, y, z], edges [[x, y, z], ...], moves [{at [i, j, k], by [x, y, z]}, ...]}; without origin
/// and edges around the surface; lengths in mm.
/// @throws InputError naming the place in the file that cannot be taken
DeformationWish read_deformation(const std::filesystem::path& file);

/// With the box of the lattice laid around the surface where the file has none.
/// @throws InputError as lattice_around()
Deformation deformation_of(const DeformationWish& wish, const MultiPatch& surface);

/// As read_deformation() reads it, with the box.
/// @throws ExchangeError if the file cannot be written
void write_deformation(const std::filesystem::path& file, const Deformation& deformation);

} // namespace spia
