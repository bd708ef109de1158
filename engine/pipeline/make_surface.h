#pragma once
#include "engine/core/progress.h"
#include "engine/pipeline/session.h"

namespace spia {

/// mm, that the surface may be from the part, where the program chooses what it is made of or it
/// has several patches: the tolerance that was asked for, else 1/1000 of the part's diagonal.
double surface_tolerance(const Session& session);

/// So many control points a surface may have before they are much for analysis: as many as
/// the part has vertices, and some hundreds whatever the mesh.
int enough_control_points(const TriMesh& part);

/// Of two surfaces that are not good enough: first whether it is free of folds, then how far it is
/// beyond its tolerance, then the least scaled Jacobian.
bool better(const SurfaceStage& a, const SurfaceStage& b);

/// The surface as it was asked for, through the nodes of the grid, within the tolerance, or of a
/// layout. Where the program chooses (SessionOptions::best_surface), it is one patch if that is
/// within the tolerance with no more than enough_control_points(), proved to be free of folds,
/// with a scaled Jacobian of well_shaped_jacobian; else a layout; if that lacks any of it
/// too, the better of both. SurfaceStage::choice says which and why. With a layout the session has
/// no grid.
/// @throws InputError if there is none
void make_surface(Session& session, const Progress& progress);

} // namespace spia
