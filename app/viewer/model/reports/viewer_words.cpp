#include "app/viewer/model/reports/viewer_words.h"

#include <algorithm>
#include <fmt/core.h>
#include <regex>
#include <string_view>

#include "engine/report/text/lengths.h"

namespace spia::viewer {

std::string in_viewer_words(std::string text)
{
    constexpr std::string_view words[][2] = {
        {"--weld MM", "\"Close the crack\" in the step Part"},
        {"--weld", "\"Weld vertices\" in the step Part"},
        {"--seam corners", "\"Cut the corners\" in the step Part"},
        {"--seam", "a seam drawn with the tool Line"},
        {" (--grid)", ""},
        {" (--corners)", ""},
        {"--grid", "the numbers of cells in the step Corners and grid"},
        {"--corners", "the corners in the step Corners and grid"},
        {"(--k-factor, also 0.5)", "(\"number\" as \"K factor\" in the step Unfold, also 0.5)"},
        {"(--k-factor or --skin)", "(\"K factor\" in the step Unfold or \"Skin\" in the step Part)"},
        {"--k-factor", "K factor"},
        {"--keep-largest", "\"Keep the largest piece\" in the step Part"},
        {"--unit", "in the step Part"},
        {"--skin", "\"Skin\" in the step Part"},
        {"--skip-bad-faces", "\"Leave out faces that cannot be meshed\" in \"Import options...\""},
        {"--remesh-size or --remesh-tolerance", "the fields of \"Remesh\" in the step Part"},
        {"--no-remesh", "\"Remesh\" in the step Part"},
        {"--remesh", "\"Remesh\" in the step Part"},
        {"take one patch (--patches one)", "choose \"one patch\" in the step NURBS surface"},
        {"(--patch-edges DEG)", "(\"Edges from\" in the step NURBS surface)"},
        {"--patch-edges", "\"Edges from\" in the step NURBS surface"},
        {"(--patches FILE)", "(pick their ends with the tool Vertex)"},
        {" (--max-control-points)", ""},
        {"--max-control-points", "the greatest number of control points"},
        {"(--tolerance)", "(\"Tolerance\" in the step NURBS surface)"},
        {"(--patches auto)", "(\"Made of\" in the step NURBS surface)"},
        {"(--grid)", "(in the step Corners and grid)"},
        {"(--corners)", "(in the step Corners and grid)"},
        {"--patches", "\"Made of\" in the step NURBS surface"},
        {"--part", "\"Import options...\" in the step Part"},
        {"with --young", "in the field above"},
        {"--young", "in the field above"},
        {"--data engineering or --data true", "above"},
        {"--data", "above"},
        {"give a target that goes through their common edge",
         "remove its offset, or choose a fixed region whose surface goes through their common edge"},
        {"pick others, allow more or give a target", "pick others, or allow more with \"Within\""},
        {"pick others that stay, or give it a target",
         "select fixed faces and press \"Fit to selection\", or choose a target"},
        {"pick those that carry the target, or give one", "choose another fixed region"}};
    // The gap to be closed is on its button's tooltip.
    text = std::regex_replace(text, std::regex("--weld [0-9.e-]+"), "--weld MM");
    for (const auto& [flag, button] : words)
        for (size_t at = text.find(flag); at != std::string::npos; at = text.find(flag, at + button.size()))
            text.replace(at, flag.size(), button);
    return text;
}

const char* heading(Stage stage)
{
    switch (stage) {
    case Stage::read: return "Part";
    case Stage::solve: return "Unfold";
    case Stage::grid:
    case Stage::lift: return "Corners and grid";
    case Stage::fit: return "NURBS surface";
    }
    return "";
}

std::string load_words(const FaceRegion& region, LengthUnit lengths)
{
    if (region.contact) {
        const ToolContact& contact = *region.contact;
        return fmt::format("{}, friction {:.3g}{}",
                           contact.force_N ? fmt::format("{:.4g} kN", *contact.force_N / 1000)
                                           : fmt::format("{:.4g} MPa", contact.pressure_MPa.value_or(0)),
                           contact.friction, region.kind == RegionKind::binder ? " on both sides" : "");
    }
    if (region.sheet)
        return fmt::format("{}, {}", std::filesystem::path(region.sheet->material).filename().string(),
                           thickness_text(region.sheet->thickness, lengths));
    return "";
}

} // namespace spia::viewer
