#pragma once
#include <optional>
#include <span>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/remesh/triangle_quality.h"

namespace spia {

struct RemeshOptions {
    /// mm, length of edges where neither curvature nor a short line asks for shorter ones; not
    /// given: the median edge of the part, or that of as many equilateral triangles if it is
    /// longer, but from 1/250 to 1/40 of the diagonal
    std::optional<double> size = {};
    /// mm, that no place of one mesh may be exceeded from the other one; not given: 1/1000 of the
    /// diagonal
    std::optional<double> tolerance = {};
    /// radians between the normals of two faces from which on their edge is kept as a line, and
    /// between two edges of a line from which on their vertex is kept
    double sharp = 0.5236;
    double ridge = 0.1; ///< radians; edges of coarse bends are kept from there on if they do not
                        ///< fork (kept_lines())

    bool operator==(const RemeshOptions&) const = default;
};

/// A mesh with well-shaped triangles in place of another one.
struct RemeshResult {
    TriMesh mesh;
    std::vector<int> nearest_face;   ///< per new face: the given one nearest to its middle; never
                                     ///< decreases
    std::vector<int> nearest_vertex; ///< per new vertex: the given one nearest to it of that face;
                                     ///< never decreases
    TriangleQuality before, after;
    double size = 0, tolerance = 0; ///< mm, as asked for or chosen
    double distance = 0;            ///< mm; no place of either mesh is farther from the other one
    double seen = 0;                ///< mm; at least one place is that far
    int lines = 0, corners = 0;     ///< that were kept
    double seconds = 0;
};

/// Remeshes a part isotropically. Boundary and sharp edges stay as lines: their corners are kept in
/// place, what is coarser than the new edges is divided where it lies, finer vertices are left out
/// within the tolerance. New vertices lie on the given mesh. The result is accepted only if no
/// place of one mesh is farther from the other than the tolerance, it is the same kind of surface,
/// and no face is turned over; where it is not, edges are made shorter there and it is done again.
/// @param label  per face, e.g. its sheet: borders between different ones are kept as lines; empty:
/// all the same
/// @throws InputError if the mesh is not manifold, an option is out of range, or the tolerance
/// cannot be kept: names the place The result does not depend on the number of threads.
RemeshResult remesh(const TriMesh& part, const RemeshOptions& options = {}, std::span<const int> label = {},
                    const Progress& progress = {});

} // namespace spia
