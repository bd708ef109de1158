#pragma once
#include <string>

#include "app/viewer/model/reports/report_options.h"

namespace spia::viewer {

struct Frame;

/// What was chosen in the report dialog; kept until the program ends, title and remarks until
/// another part is opened.
struct ReportChoices {
    ViewerReportOptions options;
    std::string file, suggested; ///< see follow()
    std::string about;           ///< the part that title and remarks were written for
};

void report_dialog(Frame& frame);

} // namespace spia::viewer
