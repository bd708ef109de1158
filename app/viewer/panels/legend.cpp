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
    if (!scene.legend || size.y < 180 * s || size.x < 200 * s)
        return std::nullopt;
    const SceneLegend& legend = *scene.legend;
    const ColourScale& scale = legend.scale;
    const std::string title = legend.title + (legend.unit.empty() ? "" : ", " + legend.unit);
    const float height = std::min(200 * s, size.y - 110 * s), width = 13 * s;
    const ImVec2 low{from.x + 14 * s, from.y + size.y - 18 * s}, high{low.x + width, low.y - height};
    const bool dark = frame.state.view.dark;
    const ImU32 text = dark ? IM_COL32(235, 238, 242, 255) : IM_COL32(24, 28, 34, 255),
                halo = dark ? IM_COL32(20, 24, 30, 200) : IM_COL32(255, 255, 255, 200);
    constexpr int strips = 64;
    for (int k = 0; k < strips; ++k) {
        const float value = scale.least + (float(k) + 0.5f) / strips * (scale.greatest - scale.least);
        draw->AddRectFilled({low.x, low.y - height * float(k + 1) / strips},
                            {high.x, low.y - height * float(k) / strips + 0.5f}, ink(colour_of(scale, value)));
    }
    draw->AddRect({low.x, high.y}, {high.x, low.y}, text);
    ImGui::PushFont(frame.ui.fonts.small);
    const float line = ImGui::GetTextLineHeight(), label = high.x + 7 * s;
    float right = low.x + ImGui::CalcTextSize(title.c_str()).x;
    for (const LegendTick& tick : legend_ticks(legend, 1 + int(height / (18 * s)))) {
        const float y = low.y - height * float(tick.share);
        draw->AddLine({high.x, y}, {high.x + 4 * s, y}, text);
        haloed(draw, {label, y - line / 2}, text, halo, tick.text.c_str());
        right = std::max(right, label + ImGui::CalcTextSize(tick.text.c_str()).x);
    }
    const float top = high.y - 1.5f * line;
    haloed(draw, {low.x, top}, text, halo, title.c_str());
    ImGui::PopFont();
    return PixelBox{{low.x - from.x, top - from.y}, {right - from.x, low.y + line / 2 - from.y}};
}

} // namespace spia::viewer
