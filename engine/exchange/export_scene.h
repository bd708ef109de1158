#pragma once
#include <span>
#include <string>

#include "engine/coons/quad_grid.h"
#include "engine/forming/blank.h"
#include "engine/limits/limits.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/nurbs/surface.h"

namespace spia {

/// What a scene file or a picture shows: the whole chain side by side. Everything is borrowed for
/// the call; what is null is left out, except that part, blank and fields belong together and are
/// always there.
struct ExportScene {
    std::string name;                    ///< of the part
    const TriMesh* part = nullptr;       ///< mm
    const Blank* blank = nullptr;        ///< of that part
    const SheetFields* fields = nullptr; ///< per vertex of the part
    const QuadGrid* quad_mesh = nullptr; ///< on the part
    const TriMesh* surface = nullptr;    ///< the NURBS surface in triangles
    const Eigen::Matrix3Xd* surface_normal =
        nullptr; ///< its unit normals, one per vertex of surface; null: from the triangles
    std::span<const NurbsSurface> control_nets = {}; ///< the patches whose control points are drawn
    const Zones* zones = nullptr;                    ///< per face of the part
};

/// @throws InputError naming what is missing, does not match or is not finite
void require_complete(const ExportScene& scene);

/// Two triangles per cell, counter-clockwise as the cells are; vertices are the grid's nodes.
TriMesh triangles_of(const QuadGrid& grid);

/// Pairs of neighbours along u and then along v in a structured net of count_u by count_v points, u
/// fastest. 2 by #lines
Eigen::Matrix2Xi net_lines(int count_u, int count_v);

} // namespace spia
