#include "app/viewer/panels/picture_overlay.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/colours.h"

namespace spia::viewer {
namespace {

/// Text with an outline that is read on any ground.
void haloed(ImDrawList& draw, const ImFont* font, ImVec2 at, ImU32 colour, const Frame& frame, const std::string& text)
{
    const ImU32 halo = frame.state.view.dark ? IM_COL32(20, 24, 30, 210) : IM_COL32(255, 255, 255, 210);
    const float size = font->FontSize, d = std::max(1.f, frame.ui.scale * 0.8f);
    for (const ImVec2 by : {ImVec2(-d, 0), ImVec2(d, 0), ImVec2(0, -d), ImVec2(0, d), ImVec2(-d, -d), ImVec2(d, d),
                            ImVec2(d, -d), ImVec2(-d, d)})
        draw.AddText(font, size, {at.x + by.x, at.y + by.y}, halo, text.c_str());
    draw.AddText(font, size, at, colour, text.c_str());
}

ImVec2 size_of(const ImFont* font, const std::string& text)
{
    return font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text.c_str());
}

void draw_legend(ImDrawList& draw, const SceneLegend& legend, ImVec2 from, ImVec2 size, const Frame& frame)
{
    const ColourScale& scale = legend.scale;
    const float s = frame.ui.scale, height = std::min(200 * s, size.y - 110 * s), width = 13 * s;
    if (height < 40 * s)
        return;
    const ImVec2 low{from.x + 14 * s, from.y + size.y - 18 * s}, high{low.x + width, low.y - height};
    const ImU32 text = frame.state.view.dark ? IM_COL32(235, 238, 242, 255) : IM_COL32(24, 28, 34, 255);
    constexpr int strips = 128;
    for (int k = 0; k < strips; ++k) {
        const float value = scale.least + (float(k) + 0.5f) / strips * (scale.greatest - scale.least);
        draw.AddRectFilled({low.x, low.y - height * float(k + 1) / strips},
                           {high.x, low.y - height * float(k) / strips + 0.5f}, ink(colour_of(scale, value)));
    }
    draw.AddRect({low.x, high.y}, {high.x, low.y}, text, 0, 0, s);
    const ImFont* font = frame.ui.fonts.small;
    const float line = size_of(font, "0").y;
    const int ticks = scale.bands > 0 ? scale.bands : scale.ticks;
    const int every = std::max(1, int(std::ceil(double(ticks) * 18 * s / height)));
    for (int k = 0; k <= ticks; k += every) {
        const float y = low.y - height * float(k) / float(ticks);
        double value = scale.least + double(k) / ticks * (scale.greatest - scale.least);
        if (std::abs(value) < 1e-6 * (scale.greatest - scale.least))
            value = 0;
        draw.AddLine({high.x, y}, {high.x + 4 * s, y}, text, s);
        haloed(draw, font, {high.x + 7 * s, y - line / 2}, text, frame, fmt::format("{:.4g}", value));
    }
    haloed(draw, font, {low.x, high.y - 1.5f * line}, text, frame,
           legend.title + (legend.unit.empty() ? "" : ", " + legend.unit));
}

void draw_labels(ImDrawList& draw, const Scene& scene, const Camera& camera, ImVec2 from, ImVec2 size,
                 const Frame& frame)
{
    const ImFont* font = frame.ui.fonts.text;
    for (const SceneLabel& label : scene.labels) {
        const glm::dvec3 pixel = pixel_of(camera, label.place, {size.x, size.y});
        if (std::isnan(pixel.x))
            continue;
        const ImVec2 text = size_of(font, label.text);
        const float gap = 7 * frame.ui.scale;
        const bool left = float(pixel.x) + gap + text.x > size.x; // no room on the right
        haloed(draw, font,
               {from.x + float(pixel.x) + (left ? -gap - text.x : gap), from.y + float(pixel.y) - gap - text.y / 2},
               ink(label.colour), frame, label.text);
    }
}

} // namespace

void draw_overlay(Frame& frame, View view, const Scene& scene, ImVec2 from, ImVec2 size, bool legend, bool labels,
                  ImDrawList* draw)
{
    if (labels)
        draw_labels(*draw, scene, frame.state.view.camera[size_t(view)], from, size, frame);
    if (legend && scene.legend)
        draw_legend(*draw, *scene.legend, from, size, frame);
}

} // namespace spia::viewer
