#pragma once
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/smooth/smooth_mesh.h"
#include "engine/part/part_file.h"

namespace spia {

/// What a surface is fitted to and judged by: the smooth sheet that the facets of a part stand for.
struct SurfaceSource {
    SmoothMesh sheet;
    int part_faces = 0;    ///< the first of its triangles; those after them fill holes
    double facets_off = 0; ///< mm, by which the facets of the part that was given are off it at most
};

/// @param tolerance  mm, of the surface; the sheet is known within a tenth of it
/// @param edge_deg   edges of the part that turn by more are kept, LayoutOptions::edge_deg
SurfaceSource surface_source(const PartFile& part, double tolerance, double edge_deg);

/// The same with the fill of its holes, which is led on from the sheet of the part.
SurfaceSource surface_source(const PartFile& part, const FilledMesh& filled, double tolerance, double edge_deg);

/// Per vertex of the sheet the nearest one of the mesh that it comes from.
std::vector<int> nearest_vertices(const SmoothMesh& sheet, const TriMesh& from);

} // namespace spia
