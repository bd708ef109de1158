#include "engine/pipeline/bend_report.h"

#include <algorithm>
#include <fmt/core.h>
#include <numbers>

namespace spia {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

Json xyz(const Eigen::Vector3d& v) { return Json::array({v[0], v[1], v[2]}); }

} // namespace

Json bend_table_json(const BendTable& table)
{
    Json bends = Json::array();
    for (const SheetBend& bend : table.bends) {
        Json lines = Json::array();
        for (const BlankSegment& piece : bend.line)
            lines.push_back({piece.from[0], piece.from[1], piece.to[0], piece.to[1]});
        bends.push_back({{"inner_radius_mm", bend.inner_radius},
                         {"angle_deg", bend.angle * degrees},
                         {"direction", bend.up ? "up" : "down"},
                         {"k_factor", bend.k},
                         {"allowance_mm", bend.allowance},
                         {"deduction_mm", bend.deduction},
                         {"length_mm", bend.length},
                         {"radius_from", bend.stated ? "CAD" : "mesh"},
                         {"laid_by_k", bend.laid},
                         {"why_not", bend.laid ? Json(nullptr) : Json(bend.why_not)},
                         {"place_mm", xyz(bend.place)},
                         {"axis", xyz(bend.axis)},
                         {"lines_mm", std::move(lines)}});
    }
    return {{"surface", table.surface},
            {"thickness_mm", table.thickness},
            {"bends", std::move(bends)},
            {"notes", table.notes}};
}

std::string in_words(const SheetBend& bend)
{
    return fmt::format("R {:.5g} mm, {:.5g} degrees {}, K {:.3g}, allowance {:.5g} mm, deduction {:.5g} mm{}",
                       bend.inner_radius, bend.angle * degrees, bend.up ? "up" : "down", bend.k, bend.allowance,
                       bend.deduction, bend.laid ? "" : " (not laid by it)");
}

std::vector<std::string> in_words(const BendTable& table)
{
    constexpr size_t most = 20;
    std::vector<std::string> lines{"lengths are those of the " + table.surface};
    for (size_t b = 0; b < std::min(most, table.bends.size()); ++b)
        lines.push_back(fmt::format("bend {}: {}", b + 1, in_words(table.bends[b])));
    if (table.bends.size() > most)
        lines.push_back(fmt::format("and {} more bends", table.bends.size() - most));
    for (const std::string& note : table.notes)
        lines.push_back("note: " + note);
    return lines;
}

} // namespace spia
