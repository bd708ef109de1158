#include "engine/compare/comparison_report.h"

#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "engine/mesh/topology.h"
#include "engine/options/command_line_json.h"

namespace spia {
namespace {

constexpr int columns = 11;
using Cells = std::array<std::string, columns>;

const Cells heads = {"method",     "time s",         "CPU s", "memory MB", "angular rms", "area rms",
                     "L2 stretch", "sym. Dirichlet", "flips", "overlaps",  "steps"};

std::string number(double value, int decimals)
{
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "inf";
}

Cells cells(const ComparisonRow& row)
{
    Cells result;
    result.fill("-");
    result[0] = title(row.method);
    if (!row.failure.empty())
        return result;
    const MapQuality& q = row.quality;
    return {std::string(title(row.method)), number(row.seconds, 2),
            number(row.cpu_seconds, 2),     row.added_mb ? number(*row.added_mb, 0) : "-",
            number(q.angular_rms, 5),       number(q.area_rms, 5),
            number(q.l2_stretch, 4),        number(q.symmetric_dirichlet, 4),
            std::to_string(q.flips),        std::to_string(q.crossings),
            std::to_string(row.iterations)};
}

std::string remarks(const std::vector<ComparisonRow>& rows, const char* bullet)
{
    std::string text;
    for (const ComparisonRow& row : rows)
        text += fmt::format("{}{}: {}\n", bullet, title(row.method),
                            row.failure.empty() ? row.ended : "no map: " + row.failure);
    return text;
}

constexpr const char* units =
    "time s: wall clock from the mesh in memory to the map, start included; CPU s: of the processor, all threads "
    "together.\n"
    "memory MB: the most the program held meanwhile, less what it held before (1024^2 bytes).\n";

} // namespace

std::string comparison_table(const std::vector<ComparisonRow>& rows, TableStyle style)
{
    std::vector<Cells> lines = {heads};
    for (const ComparisonRow& row : rows)
        lines.push_back(cells(row));
    std::string text;
    for (size_t i = 0; i < lines.size(); ++i) {
        if (style == TableStyle::markdown) {
            text += fmt::format("| {} |\n", fmt::join(lines[i], " | "));
            if (i == 0)
                text += "|---" + [] {
                    std::string rule;
                    for (int c = 1; c < columns; ++c)
                        rule += "|---:";
                    return rule;
                }() + "|\n";
            continue;
        }
        for (size_t c = 0; c < columns; ++c) {
            size_t width = 0;
            for (const Cells& line : lines)
                width = std::max(width, line[c].size());
            text += c == 0 ? fmt::format("{:<{}}", lines[i][c], width) : fmt::format("  {:>{}}", lines[i][c], width);
        }
        text += "\n";
    }
    const bool markdown = style == TableStyle::markdown;
    text += "\n" + remarks(rows, markdown ? "- " : "");
    std::string definitions = std::string(units) + std::string(quality_definitions()) + "\n";
    if (markdown) { // a list item per line
        std::string list = "\n";
        for (size_t from = 0, to; (to = definitions.find('\n', from)) != std::string::npos; from = to + 1)
            list += "- " + definitions.substr(from, to - from) + "\n";
        return text + list;
    }
    return text + "\n" + definitions;
}

std::string comparison_json(const std::filesystem::path& file, const TriMesh& part,
                            const std::vector<ComparisonRow>& rows, const std::vector<std::string>& notes)
{
    const auto optional = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
    Json json = {{"schema", "spia.compare/1"},
                 {"input", file.string()},
                 {"part",
                  {{"vertices", part.vertices()},
                   {"triangles", part.triangles()},
                   {"boundary_loops", boundary_loops(part).size()},
                   {"area_mm2", area(part)},
                   {"notes", notes}}},
                 {"definitions", quality_definitions()},
                 {"methods", Json::array()}};
    for (const ComparisonRow& row : rows) {
        Json entry = {{"method", name(row.method)},
                      {"title", title(row.method)},
                      {"seconds", row.seconds},
                      {"cpu_seconds", row.cpu_seconds},
                      {"peak_memory_mb", optional(row.peak_mb)},
                      {"added_memory_mb", optional(row.added_mb)}};
        if (!row.failure.empty())
            entry["failure"] = row.failure;
        else {
            const MapQuality& q = row.quality;
            entry.update({{"iterations", row.iterations},
                          {"ended", row.ended},
                          {"angular_rms", q.angular_rms},
                          {"area_rms", q.area_rms},
                          {"l2_stretch", q.l2_stretch},
                          {"symmetric_dirichlet", q.symmetric_dirichlet},
                          {"flips", q.flips},
                          {"outline_overlaps", q.crossings}});
        }
        json["methods"].push_back(std::move(entry));
    }
    return with_command_line_texts(std::move(json)).dump(2) + "\n";
}

} // namespace spia
