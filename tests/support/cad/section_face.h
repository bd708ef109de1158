#pragma once
#include <TopoDS_Face.hxx>
#include <gp_Pnt.hxx>

#include "tests/support/profile.h"

/// Sections of sheet around a profile in the xz plane, for solids that OpenCASCADE sweeps or
/// revolves.
namespace spia::shapes {

double heading(const Profile::Piece& piece, double s); ///< radians, of the tangent at arc length s

/// At arc length s of the middle line, that far to its left, mm.
gp_Pnt beside(const Profile& profile, const Profile::Piece& piece, double s, double left);

/// What lies between two distances to the left of the middle line.
TopoDS_Face section_face(const Profile& profile, double left, double right);

} // namespace spia::shapes
