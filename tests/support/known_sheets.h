#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "engine/mesh/tri_mesh.h"

/// Four-sided pieces of surfaces whose distance has a closed form.
namespace spia::shapes {

struct KnownSheet {
    std::string name;
    std::function<Eigen::Vector3d(double s, double t)> place; ///< s, t from 0 to 1 -> mm
    /// mm, how far a point is from the whole surface; never less than the truth, and equal to it to
    /// first order
    std::function<double(const Eigen::Vector3d&)> distance;
    double size = 0; ///< mm, diagonal of the box around it
};

/// Plane (tilted, unevenly parameterised), quarter cylinder, torus piece, saddle, and a bump with a
/// radius of 1/20 of the sheet, about 100 mm each.
std::vector<KnownSheet> known_sheets();

/// cells x cells quads of two triangles, all vertices on the sheet; vertex i + j (cells + 1) at s =
/// i / cells, t = j / cells.
TriMesh mesh_of(const KnownSheet& sheet, int cells);

/// The place of that mesh over (s, t): linear in each triangle.
Eigen::Vector3d on_mesh(const TriMesh& mesh, int cells, double s, double t);

/// mm, the largest distance of a place of the mesh from the sheet (middles of the edges and faces).
double chord_error(const KnownSheet& sheet, const TriMesh& mesh);

} // namespace spia::shapes
