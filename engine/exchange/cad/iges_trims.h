#pragma once
#include <IGESGeom_BSplineSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <span>

#include "engine/core/length_unit.h"
#include "engine/nurbs/trim.h"

namespace spia {

/// Entity 144: the surface within its natural border without its holes, each of them a curve on the
/// surface (142) with its curves in (u, v) and in space (126, several joined by 102). [IGES 5.3,
/// 4.33 and 4.34]
/// @param entity  128 of the same surface
Handle(IGESGeom_TrimmedSurface) entity_144(const NurbsSurface& surface, const Handle(IGESGeom_BSplineSurface) & entity,
                                           std::span<const TrimLoop> holes, LengthUnit unit);

} // namespace spia
