#include "app/viewer/panels/stress_plot.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"

namespace spia::viewer {

ImVec2 StressPlot::place(double at_strain, double at_stress) const
{
    return {low.x + float(at_strain / strain) * (high.x - low.x),
            low.y - float(std::clamp(at_stress / stress, 0., 1.)) * (low.y - high.y)};
}

double StressPlot::strain_at(float x) const { return double((x - low.x) / (high.x - low.x)) * strain; }

StressPlot stress_plot(const Frame& frame, float height, double strain, double stress, const std::string& title)
{
    const Palette p = palette_of(frame.state.view.dark);
    const float s = frame.ui.scale, line = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const RoundRange strains = round_range(0, strain), stresses = round_range(0, stress);
    const StressPlot plot{{at.x + 48 * s, at.y + height - line - 4 * s},
                          {at.x + ImGui::GetContentRegionAvail().x - 8 * s, at.y + line + 2 * s},
                          strains.greatest,
                          stresses.greatest};
    ImDrawList* draw = ImGui::GetWindowDrawList();
    // so many to a number
    const int rows = (stresses.intervals + 3) / 4, columns = (strains.intervals + 7) / 8;
    for (int k = 0; k <= stresses.intervals; k += rows) {
        const double value = plot.stress * k / stresses.intervals;
        const std::string text = fmt::format("{:.4g}", value);
        const ImVec2 left = plot.place(0, value);
        draw->AddLine(left, {plot.high.x, left.y}, ink(p.line));
        draw->AddText({left.x - ImGui::CalcTextSize(text.c_str()).x - 5 * s, left.y - line / 2}, ink(p.muted),
                      text.c_str());
    }
    for (int k = 0; k <= strains.intervals; k += columns) {
        const double value = plot.strain * k / strains.intervals;
        const std::string text = fmt::format("{:.3g}", value);
        const float wide = ImGui::CalcTextSize(text.c_str()).x, at_x = plot.place(value, 0).x;
        draw->AddText({std::min(at_x - wide / 2, plot.high.x - wide), plot.low.y + 3 * s}, ink(p.muted), text.c_str());
    }
    draw->AddText({plot.low.x, at.y - 2 * s}, ink(p.muted), title.c_str());
    ImGui::Dummy({0, height});
    return plot;
}

void draw_dashed(ImDrawList* draw, const std::vector<ImVec2>& line, ImU32 colour, float width, float dash)
{
    if (dash <= 0) {
        draw->AddPolyline(line.data(), int(line.size()), colour, ImDrawFlags_None, width);
        return;
    }
    float along = 0; // pixels since the dash began
    for (size_t i = 1; i < line.size(); ++i) {
        const ImVec2 a = line[i - 1], b = line[i];
        const float length = std::hypot(b.x - a.x, b.y - a.y);
        for (float done = 0; done < length;) {
            const bool ink_on = along < dash;
            const float step = std::min(length - done, (ink_on ? dash : 1.5f * dash) - along);
            const auto on_piece = [&](float t) {
                return ImVec2(a.x + (b.x - a.x) * t / length, a.y + (b.y - a.y) * t / length);
            };
            if (ink_on)
                draw->AddLine(on_piece(done), on_piece(done + step), colour, width);
            done += std::max(step, 1e-3f);
            along += std::max(step, 1e-3f);
            if (along >= 1.5f * dash)
                along = 0;
        }
    }
}

void draw_curve(const StressPlot& plot, const FlowCurve& curve, ImU32 colour, float width, float dash)
{
    std::vector<ImVec2> line;
    for (size_t k = 0; k < curve.strain.size(); ++k)
        line.push_back(plot.place(curve.strain[k], curve.stress_MPa[k]));
    draw_dashed(ImGui::GetWindowDrawList(), line, colour, width, dash);
}

} // namespace spia::viewer
