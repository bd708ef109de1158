#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/panels/widgets.h"

namespace spia::viewer {

void residual_plot(Frame& frame)
{
    const auto& residual = frame.state.job.residual;
    if (residual.size() < 2)
        return;
    const Palette p = palette_of(frame.state.view.dark);
    const ImVec2 at = ImGui::GetCursorScreenPos(), size{ImGui::GetContentRegionAvail().x, 56 * frame.ui.scale};
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const auto height = [&](double r) { // 1e1 on top, 1e-10 below
        return at.y + size.y * float(std::clamp((1 - std::log10(std::max(r, 1e-10))) / 11, 0., 1.));
    };
    const float letters = ImGui::GetTextLineHeight(), left = at.x + ImGui::CalcTextSize("1e-8").x + 5 * frame.ui.scale,
                width = at.x + size.x - left;
    for (const int power : {0, -4, -8}) {
        const float y = height(std::pow(10., power));
        const std::string number = power == 0 ? "1" : fmt::format("1e{}", power);
        draw->AddText({left - ImGui::CalcTextSize(number.c_str()).x - 5 * frame.ui.scale, y - letters / 2},
                      ink(p.muted), number.c_str());
        draw->AddLine({left, y}, {left + width, y}, ink(p.line));
    }
    draw->AddRect({left, at.y}, {left + width, at.y + size.y}, ink(p.line));
    for (size_t k = 1; k < residual.size(); ++k)
        draw->AddLine({left + width * float(k - 1) / float(residual.size() - 1), height(residual[k - 1])},
                      {left + width * float(k) / float(residual.size() - 1), height(residual[k])}, ink(p.accent),
                      1.6f * frame.ui.scale);
    ImGui::Dummy(size);
    figure(frame, fmt::format("Residual, step {}", residual.size()).c_str(), fmt::format("{:.1e}", residual.back()));
}

float residual_plot_height(const Frame& frame)
{
    if (frame.state.job.residual.size() < 2)
        return 0;
    return 56 * frame.ui.scale + ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().ItemSpacing.y;
}

} // namespace spia::viewer
