#include "app/viewer/model/reports/viewer_words.h"

#include <fmt/core.h>

#include "engine/report/text/lengths.h"

namespace spia::viewer {

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
