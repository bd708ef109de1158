#pragma once
#include <nlohmann/json.hpp>

#include "engine/nurbs/certificate.h"

namespace spia {

/// `certificate` of the report, the contract of engine/pipeline/README.md.
nlohmann::ordered_json certificate_json(const Certificate& certificate);

} // namespace spia
