#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A part laid flat by one of the methods of this folder.
struct FlatMap {
    Eigen::Matrix2Xd position; ///< 2 by #V, mm, faces counter-clockwise; as large as the part in
                               ///< area
    int iterations = 0;
    std::vector<double> energy = {}; ///< of the method after each iteration, the start first; mm2
                                     ///< (empty: it has none)
    std::string ended = {};          ///< why it stopped, in words
};

/// What all of these methods ask of a part: one sheet with a boundary and without handles, every
/// face with an area.
/// @throws InputError that says what the part is instead
void require_sheet(const TriMesh& part);

/// Signed area of a flat mesh, mm2.
double flat_area(const TriMesh& part, const Eigen::Matrix2Xd& flat);

/// Scales a map about the origin to the area of the part. A conformal map has no size of its own.
/// @throws SolveError if its signed area is not positive
void scale_to_area_of(const TriMesh& part, Eigen::Matrix2Xd& flat);

} // namespace spia
