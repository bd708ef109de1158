#pragma once
#include <optional>
#include <vector>

#include "engine/deform/lattice.h"

namespace spia {

/// A control point that is moved; one that patches share moves in all of them.
struct ControlMove {
    int patch = 0, i = 0, j = 0;                    ///< the place in the net: column i of count_u,
                                                    ///< row j of count_v
    Eigen::Vector3d move = Eigen::Vector3d::Zero(); ///< mm

    friend bool operator==(const ControlMove& a, const ControlMove& b)
    {
        return a.patch == b.patch && a.i == b.i && a.j == b.j && a.move == b.move;
    }
};

/// What is done to a finished surface: first single control points move, then a lattice bends all
/// of it.
struct Deformation {
    std::vector<ControlMove> moves;
    std::optional<Lattice> lattice;

    bool at_rest() const; ///< nothing would move
    friend bool operator==(const Deformation&, const Deformation&) = default;
};

struct DeformResult {
    MultiPatch patches;     ///< with the knots, weights and interfaces of the surface; shared
                            ///< control points stay the same to the last bit
    double largest = 0;     ///< mm, displacement of a control point
    double off_lattice = 0; ///< mm: as far is the surface of the moved net from the surface moved
                            ///< by the lattice itself, at 4 x 4 places of each span; 0 of an affine
                            ///< lattice
};

/// Free-form deformation of a surface by its control net [the paper, section 5; Sederberg & Parry
/// 1986].
/// @param measure  false leaves out off_lattice: quicker, for a drag
/// @throws InputError if a move names a control point that is not there, the same one twice (also
/// by another patch that shares it),
///         or is not finite; if the lattice is not sound
DeformResult deform(const MultiPatch& surface, const Deformation& deformation, bool measure = true);

} // namespace spia
