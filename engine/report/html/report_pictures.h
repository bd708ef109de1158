#pragma once
#include <vector>

#include "engine/report/html/html_report.h"

namespace spia {

/// Pictures for a report, drawn without a window: part and blank in the colours of thinning, quad
/// mesh and surface as far as there are. @param session solved at least
/// @param lengths  in which sizes are told
std::vector<ReportPicture> drawn_pictures(const Session& session, LengthUnit lengths = LengthUnit::mm);

} // namespace spia
