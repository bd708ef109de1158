#include "engine/pipeline/blank/bend_report.h"

#include <algorithm>
#include <fmt/core.h>
#include <map>

#include "engine/core/angle.h"
#include "engine/core/text.h"

namespace spia {
namespace {

} // namespace

std::vector<std::string> all_notes(const BendTable& table)
{
    std::vector<std::string> all = table.kept;
    all.insert(all.end(), table.notes.begin(), table.notes.end());
    return all;
}

std::vector<std::string> bend_doubts(const PartFile& part, const BendTable& table, bool k_is_given)
{
    std::vector<std::string> doubts;
    // The lengths of a sheet that is given as triangles are those of its triangles unless arcs are
    // asked for.
    const bool as_triangles = !part.cad && !part.solid && !k_is_given;
    // by why and the way out
    std::map<std::pair<std::string, std::string>, std::vector<size_t>> kept;
    for (size_t b = 0; b < table.bends.size() && !as_triangles; ++b)
        if (const SheetBend& bend = table.bends[b]; !bend.laid)
            kept[{bend.why_not, bend.way_out}].push_back(b);
    for (const auto& [why, bends] : kept) {
        const SheetBend& first = table.bends[bends.front()];
        doubts.push_back(fmt::format(
            "bend {}{} (R {:.4g} mm, {:.4g} degrees, near {:.4g}, {:.4g}, {:.4g} mm) is not laid with its allowance: {}; {}",
            bends.front() + 1, bends.size() > 1 ? fmt::format(", the first of {},", bends.size()) : "",
            first.inner_radius, first.angle * degrees_per_radian, first.place[0], first.place[1], first.place[2],
            why.first, why.second));
    }
    doubts.insert(doubts.end(), table.doubts.begin(), table.doubts.end());
    if (k_is_given)
        doubts.insert(doubts.end(), table.notes.begin(), table.notes.end());
    return doubts;
}

std::string describe(const SheetBend& bend)
{
    if (bend.sharp)
        return fmt::format("sharp, {:.5g} degrees {}, allowance {:.5g} mm, deduction {:.5g} mm",
                           bend.angle * degrees_per_radian, bend.up ? "up" : "down", bend.allowance, bend.deduction);
    return fmt::format("R {:.5g} mm, {:.5g} degrees {}, K {:.4g}, allowance {:.5g} mm, deduction {:.5g} mm{}",
                       bend.inner_radius, bend.angle * degrees_per_radian, bend.up ? "up" : "down", bend.k,
                       bend.allowance, bend.deduction, bend.laid ? "" : " (not applied)");
}

std::vector<std::string> describe(const BendTable& table)
{
    constexpr size_t most = 20;
    std::vector<std::string> lines{"lengths are those of the " + table.surface};
    for (size_t b = 0; b < std::min(most, table.bends.size()); ++b)
        lines.push_back(fmt::format("bend {}: {}", b + 1, describe(table.bends[b])));
    if (table.bends.size() > most)
        lines.push_back(fmt::format("and {}", counted(table.bends.size() - most, "more bend", "more bends")));
    for (const std::string& note : all_notes(table))
        lines.push_back("note: " + note);
    return lines;
}

} // namespace spia
