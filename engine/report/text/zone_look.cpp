#include "engine/report/text/zone_look.h"

#include <cmath>
#include <fmt/core.h>

namespace spia {
namespace {

struct Look {
    const char* words;
    int rgb;
};

Look look(Zone zone)
{
    switch (zone) {
    case Zone::crack: return {"Crack", 0xc0261c};
    case Zone::risk: return {"Risk", 0xe8590c};
    case Zone::marginal: return {"Marginal", 0xf2b01e};
    case Zone::excessive_thinning: return {"Excessive thinning", 0xa8871f};
    case Zone::strong_thickening: return {"Excessive thickening", 0x6a3fa0};
    case Zone::wrinkling_tendency: return {"Wrinkling tendency", 0x2f6fc4};
    case Zone::low_strain: return {"Low strain", 0x8a93a0};
    case Zone::safe: return {"Safe", 0x3f9142};
    }
    return {"", 0};
}

} // namespace

std::string zone_words(Zone zone) { return look(zone).words; }

std::array<float, 4> zone_colour(Zone zone)
{
    const int rgb = look(zone).rgb;
    return {float(rgb >> 16) / 255, float(rgb >> 8 & 255) / 255, float(rgb & 255) / 255, 1};
}

std::string hex(const std::array<float, 4>& srgb)
{
    const auto byte = [](float share) { return int(std::lround(255 * share)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(srgb[0]), byte(srgb[1]), byte(srgb[2]));
}

} // namespace spia
