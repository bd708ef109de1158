#pragma once
#include <optional>
#include <set>
#include <vector>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/solid/bends/unrolled_skin.h"
#include "engine/mesh/solid/fit/plane_triangles.h"
#include "engine/mesh/solid/skin.h"

namespace spia {

/// A solid of sheet and its middle surface, as it is at the time, with what is asked of them for
/// each bend.
struct MiddleOfSolid {
    MiddleOfSolid(const SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet,
                  const std::vector<StatedSurface>& surface);

    const SkinMesh& middle;
    const TriMesh& solid;
    const ThinSolid& sheet;
    const std::vector<StatedSurface>& surface; ///< per triangle of the solid
    Eigen::Matrix3Xd normal;                   ///< per triangle of the solid, area vectors outwards
    std::vector<EdgeUse> uses;                 ///< of the solid's edges
    double within;                             ///< mm, what vertices may be off: meshes have the
                                               ///< digits of STL

    /// mm, of a vertex of the middle surface: the one of the outer skin that it comes from.
    Eigen::Vector3d outer(int vertex) const { return solid.position.col(middle.source_vertex[size_t(vertex)]); }
};

/// One bend of the middle surface, laid in a plane with the flats beside it: along u it turns,
/// along v its axis runs.
struct UnrolledBend {
    UnrolledSkin skin;
    StatedSurface cylinder;           ///< of the middle surface
    std::vector<StatedSurface> flat;  ///< likewise, the two that touch it; normals outwards
    std::vector<char> on;             ///< per triangle of the middle surface: 1 the cylinder, 2 + i
                                      ///< its flat i, 0 elsewhere
    PlaneTriangles triangles;         ///< of the cylinder and the flats, with vertices straight
                                      ///< below the outer skin
    std::vector<Eigen::Vector2d> now; ///< mm, per vertex, where it is in the middle surface; not a
                                      ///< number: on neither
    std::set<EdgeKey> fixed;          ///< edges to the rest of the middle surface
};

/// Lays the cylinder, the two flats that touch it, and what is connected to it on those, in a
/// plane.
/// @param on  the bend's cylinder on the outer skin
/// @returns nothing of a bend that does not lie between two flats
std::optional<UnrolledBend> unrolled_bend(const MiddleOfSolid& part, const StatedSurface& on);

} // namespace spia
