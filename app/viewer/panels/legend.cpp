#include <algorithm>

#include "app/viewer/panels/labels.h"
#include "app/viewer/panels/ui.h"
#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/colours.h"

namespace spia::viewer {

std::optional<PixelBox> draw_legend(const Frame& frame, const Scene& scene, ImVec2 from, ImVec2 size, ImDrawList* draw)
{
    const float s = frame.ui.scale;
    if (!scene.legend || size.y < 110 * s || size.x < 170 * s)
        return std::nullopt;
    const SceneLegend& legend = *scene.legend;
    const ColourScale& scale = legend.scale;
    const std::string title = legend.title + (legend.unit.empty() ? "" : ", " + legend.unit);
    ImGui::PushFont(frame.ui.fonts.small);
    // Title and note are wrapped: a long one would lie over what is shown.
    const float line = ImGui::GetTextLineHeight(), wrap = 84 * s;
    const auto extent = [&](const std::string& words) {
        return words.empty() ? ImVec2(0, 0) : ImGui::CalcTextSize(words.c_str(), nullptr, false, wrap);
    };
    const ImVec2 title_size = extent(title), note_size = extent(legend.note);
    const float heading = title_size.y + note_size.y + 0.5f * line, width = 13 * s,
                height = std::clamp(size.y - (size.y < 180 * s ? 40 : 80) * s - heading, 30 * s, 200 * s);
    const ImVec2 low{from.x + 14 * s, from.y + size.y - 18 * s}, high{low.x + width, low.y - height};
    const bool dark = frame.state.view.dark;
    const ImU32 text = dark ? IM_COL32(235, 238, 242, 255) : IM_COL32(24, 28, 34, 255);
    const float label = high.x + 7 * s;
    const auto ticks = legend_ticks(legend, 1 + int(height / (18 * s)));
    float right = low.x + std::max(title_size.x, note_size.x);
    for (const LegendTick& tick : ticks)
        right = std::max(right, label + ImGui::CalcTextSize(tick.text.c_str()).x);
    const float top = high.y - heading, pad = 6 * s;
    const ImVec2 plate_from{low.x - pad, top - pad}, plate_to{right + pad, low.y + line / 2 + pad / 2};
    draw->AddRectFilled(plate_from, plate_to, dark ? IM_COL32(24, 28, 34, 205) : IM_COL32(250, 251, 252, 215), 4 * s);
    constexpr int strips = 64;
    for (int k = 0; k < strips; ++k) {
        const float value = scale.least + (float(k) + 0.5f) / strips * (scale.greatest - scale.least);
        draw->AddRectFilled({low.x, low.y - height * float(k + 1) / strips},
                            {high.x, low.y - height * float(k) / strips + 0.5f}, ink(colour_of(scale, value)));
    }
    draw->AddRect({low.x, high.y}, {high.x, low.y}, text);
    for (const LegendTick& tick : ticks) {
        const float y = low.y - height * float(tick.share);
        draw->AddLine({high.x, y}, {high.x + 4 * s, y}, text);
        draw->AddText({label, y - line / 2}, text, tick.text.c_str());
    }
    draw->AddText(nullptr, 0, {low.x, top}, text, title.c_str(), nullptr, wrap);
    if (!legend.note.empty())
        draw->AddText(nullptr, 0, {low.x, top + title_size.y}, ink(palette_of(dark).muted), legend.note.c_str(),
                      nullptr, wrap);
    ImGui::PopFont();
    return PixelBox{{plate_from.x - from.x, plate_from.y - from.y}, {plate_to.x - from.x, plate_to.y - from.y}};
}

} // namespace spia::viewer
