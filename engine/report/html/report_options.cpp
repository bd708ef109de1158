#include "engine/report/html/report_options.h"

#include "engine/report/text/shown_lengths.h"

namespace spia {

std::string ReportReader::told(std::string text) const { return in_shown_lengths(words(text), lengths); }

} // namespace spia
