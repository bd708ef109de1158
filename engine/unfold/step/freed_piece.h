#pragma once
#include <array>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A connected piece of the freed faces, with a numbering of its own.
struct FreedPiece {
    std::vector<int> face;                 ///< of the part, ascending
    std::vector<int> vertex;               ///< of the part, ascending
    TriMesh mesh;                          ///< as in the part
    std::vector<int> held;                 ///< vertices of `mesh` that it shares with fixed faces,
                                           ///< ascending
    std::vector<std::array<int, 2>> hinge; ///< edges of `mesh` that it shares with fixed faces
};

/// Splits the freed faces into connected pieces, in the order of their first faces.
/// @param fixed, freed faces of the part, ascending, each once, no face in both
/// @throws InputError if a freed face is joined to one that is neither freed nor fixed, two pieces
/// meet in a vertex that is
///                    not held, or a piece could not be laid flat; names the faces
std::vector<FreedPiece> freed_pieces(const TriMesh& part, const std::vector<int>& fixed, const std::vector<int>& freed);

} // namespace spia
