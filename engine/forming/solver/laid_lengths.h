#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/forming/solver/membrane.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Faces whose material has other lengths than their triangles: those of the arcs that they are
/// chords of, or of the neutral fibre of a bend.
struct LaidLengths {
    std::vector<int> face; ///< ascending
    std::vector<Eigen::Matrix<double, 2, 3>>
        corner; ///< of each: mm, in a plane, counter-clockwise, wherever they lie in it

    bool empty() const { return face.empty(); }
};

/// elements() with these lengths: their gradients and areas are those of the laid triangles, turned
/// to lie on the part's as nearly as they can.
/// @throws InputError  if a face has no area, as it is or laid
std::vector<Element> elements(const TriMesh& part, const LaidLengths& laid);

} // namespace spia
