#pragma once
#include <Eigen/Core>

#include "engine/core/json_file.h"

namespace spia {

/// [x, y, z]
inline Json vector_json(const Eigen::Vector3d& v) { return Json::array({v[0], v[1], v[2]}); }

} // namespace spia
