#pragma once
#include <optional>
#include <vector>

#include "engine/forming/blank.h"
#include "engine/forming/solver/laid_lengths.h"
#include "engine/unfold/plan/bend_table.h"
#include "engine/unfold/plan/bend_zones.h"
#include "engine/unfold/plan/k_factor.h"

namespace spia {

/// How a mesh stands for its sheet.
struct SheetLayers {
    double thickness = 1;          ///< mm
    double mesh_at = 0;            ///< mm from the middle of the sheet along the mesh's normals: 0
                                   ///< is the middle surface
    double face_at = 0;            ///< mm likewise, where the CAD faces lie whose radii are known
    std::optional<KFactor> k = {}; ///< of a middle surface; not given: 0.5
    /// mm, by how much corners may lie off their places, of a solid whose bends were measured; not
    /// given: its file states them, or it is no solid
    std::optional<double> rounding = {};
};

/// The bends of a part and the lengths with which their faces are laid flat.
struct NeutralFibre {
    BendTable table;
    LaidLengths laid;
    std::vector<BendZone> zone; ///< per bend of the table
};

/// Each zone gets the length of its arc at its neutral fibre, angle x (R + K t): where the mesh is
/// the middle surface by the K factor, else of the skin that it is. The flat faces beside it keep
/// theirs. That holds where the zone is a bend: all its corners lie on the cylinder, and its edges
/// have the same length in the faces beside it as in the zone; a bend of any angle between straight
/// lines, with or without holes and notches, is so. A cylinder that goes over into drawn sheet is
/// not: it keeps the lengths of its triangles, and the table says so. A zone that does not end at
/// the edge of the sheet at both its ends (FreeEnds) is a radius of a drawn part and no bend.
NeutralFibre neutral_fibre(const TriMesh& part, std::vector<BendZone> zones, const SheetLayers& layers);

/// Takes the lengths back: all bends keep those of their triangles. @param why, way_out for the
/// table
void keep_triangles(NeutralFibre& fibre, const std::string& why, const std::string& way_out);

/// mm, see SheetBend. @param angle  radians; the others mm
double bend_deduction(double inner_radius, double angle, double allowance, double thickness);

/// Fills in what the table tells of the blank.
void place_on_blank(NeutralFibre& fibre, const TriMesh& part, const Blank& blank);

} // namespace spia
