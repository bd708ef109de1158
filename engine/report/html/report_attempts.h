#pragma once
#include <string>

#include "engine/pipeline/session.h"
#include "engine/report/html/report_options.h"

namespace spia {

/// Which attempts blank, grid and surface were found by, what each came to and how long it took, as
/// HTML; empty where nothing was tried.
std::string attempts_section(const Session& session, const ReportReader& reader = {});

} // namespace spia
