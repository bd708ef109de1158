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
    const float height = std::min(200 * s, size.y - (size.y < 180 * s ? 66 : 110) * s), width = 13 * s;
    const ImVec2 low{from.x + 14 * s, from.y + size.y - 18 * s}, high{low.x + width, low.y - height};
    const bool dark = frame.state.view.dark;
    const ImU32 text = dark ? IM_COL32(235, 238, 242, 255) : IM_COL32(24, 28, 34, 255);
    ImGui::PushFont(frame.ui.fonts.small);
    const float line = ImGui::GetTextLineHeight(), label = high.x + 7 * s;
    const auto ticks = legend_ticks(legend, 1 + int(height / (18 * s)));
    float right = low.x + std::max(ImGui::CalcTextSize(title.c_str()).x, ImGui::CalcTextSize(legend.note.c_str()).x);
    for (const LegendTick& tick : ticks)
        right = std::max(right, label + ImGui::CalcTextSize(tick.text.c_str()).x);
    const float top = high.y - (legend.note.empty() ? 1.5f : 2.6f) * line, pad = 6 * s;
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
    draw->AddText({low.x, top}, text, title.c_str());
    if (!legend.note.empty())
        draw->AddText({low.x, top + 1.1f * line}, ink(palette_of(dark).muted), legend.note.c_str());
    ImGui::PopFont();
    return PixelBox{{plate_from.x - from.x, plate_from.y - from.y}, {plate_to.x - from.x, plate_to.y - from.y}};
}

} // namespace spia::viewer
