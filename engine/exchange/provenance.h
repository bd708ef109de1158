#pragma once
#include <string>

namespace spia {

/// Name and version of this program as written into files, e.g. "SPIA 0.2.0".
std::string program_name();

/// The time written into a file's header, in UTC: SOURCE_DATE_EPOCH (seconds since 1970) if the
/// environment has it, so that the same input can give the same bytes; else now. @param format of
/// std::strftime
std::string time_stamp(const char* format);

} // namespace spia
