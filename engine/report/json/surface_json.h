#pragma once
#include <nlohmann/json.hpp>

#include "engine/pipeline/session.h"

namespace spia {

/// The surface's part of the report: control points, deviation both ways, normals, and how a fit
/// went.
/// @param part  whose numbers of the file name vertices
nlohmann::ordered_json surface_json(const SurfaceStage& stage, const PartFile& part);

/// What was moved, and by how much.
nlohmann::ordered_json deformation_json(const Deformation& deformation, const DeformResult& result);

} // namespace spia
