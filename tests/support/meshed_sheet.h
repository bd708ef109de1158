#pragma once
#include "engine/coons/quad_grid.h"
#include "engine/nurbs/fit.h"
#include "engine/nurbs/surface.h"
#include "tests/support/known_sheets.h"

namespace spia::shapes {

/// The mesh of a sheet as a source that is known everywhere.
struct MeshedSheet {
    TriMesh mesh;
    FitSource source;

    MeshedSheet(const KnownSheet& sheet, int cells);
    MeshedSheet(const MeshedSheet&) = delete;
};

/// The nodes of even lines on the mesh of a sheet, cells by cells.
QuadGrid even_grid(const TriMesh& mesh, int mesh_cells, int cells);

/// How far the surface is from the sheet, by its closed form, at places that are no borders of
/// spans.
double distance_from_sheet(const NurbsSurface& surface, const KnownSheet& sheet);

/// Both ways, none by the code under test: the other way from dense places of the sheet to fine
/// triangles of the surface.
double independent_deviation(const NurbsSurface& surface, const KnownSheet& sheet);

} // namespace spia::shapes
