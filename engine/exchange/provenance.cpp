#include "engine/exchange/provenance.h"

#include <cstdlib>
#include <ctime>

namespace spia {

std::string program_name() { return "SPIA " SPIA_VERSION; }

std::string time_stamp(const char* format)
{
    const char* fixed = std::getenv("SOURCE_DATE_EPOCH");
    const std::time_t time = fixed && *fixed ? std::time_t(std::strtoll(fixed, nullptr, 10)) : std::time(nullptr);
    std::tm utc{};
    gmtime_r(&time, &utc);
    char text[64];
    return std::string(text, std::strftime(text, sizeof text, format, &utc));
}

} // namespace spia
