#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/panels/widgets.h"
#include "app/viewer/views/colour_scale.h"

namespace spia::viewer {
namespace {

/// Where strains stand on the screen.
struct Axes {
    RoundRange minor, major;
    ImVec2 low, high; ///< corners of the plane on the screen: least strains, greatest strains

    ImVec2 place(double x, double y) const
    {
        return {low.x + float((x - minor.least) / (minor.greatest - minor.least)) * (high.x - low.x),
                low.y + float((y - major.least) / (major.greatest - major.least)) * (high.y - low.y)};
    }
    Eigen::Vector2d strains(ImVec2 at) const
    {
        return {minor.least + (at.x - low.x) / (high.x - low.x) * (minor.greatest - minor.least),
                major.least + (at.y - low.y) / (high.y - low.y) * (major.greatest - major.least)};
    }
    Eigen::AlignedBox2d range() const
    {
        return {Eigen::Vector2d(minor.least, major.least), Eigen::Vector2d(minor.greatest, major.greatest)};
    }
};

/// The plane reaches well above the points and to either side of pure plane strain: there runs the
/// limit of forming.
Axes axes_of(const SheetFigures& sheet, const FormingLimitCurve* curve, ImVec2 low, ImVec2 high)
{
    constexpr double above = 1.3, least_height = 0.1, least_width = 0.1;
    return {round_range(std::min(1.1 * sheet.strain_minor[0], -least_width),
                        std::max(1.1 * sheet.strain_minor[1], least_width)),
            round_range(std::min(sheet.strain_major[0], 0.),
                        std::max({above * sheet.strain_major[1], least_height,
                                  curve ? std::min(above * curve->at_plane_strain(), 3 * sheet.strain_major[1]) : 0})),
            low, high};
}

void draw_axes(const Frame& frame, const Axes& axes, ImDrawList* draw)
{
    const Palette p = palette_of(frame.state.view.dark);
    const float s = frame.ui.scale;
    ImGui::PushFont(frame.ui.fonts.small);
    const auto label = [&](ImVec2 where, const std::string& text, float align_x, float align_y) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        draw->AddText({where.x - align_x * size.x, where.y - align_y * size.y}, ink(p.muted), text.c_str());
    };
    const auto number = [](double value) { return fmt::format("{:.3g}", std::abs(value) < 1e-9 ? 0 : value); };
    for (int k = 0; k <= axes.minor.intervals; ++k) {
        const double value = axes.minor.least + (axes.minor.greatest - axes.minor.least) * k / axes.minor.intervals;
        const ImVec2 low = axes.place(value, axes.major.least);
        draw->AddLine(low, {low.x, axes.high.y}, ink(p.line));
    }
    for (const double value : axis_numbers(axes.minor, 5)) {
        const ImVec2 low = axes.place(value, axes.major.least);
        label({std::min(low.x, axes.high.x - 8 * s), low.y + 2 * s}, number(value), 0.5f, 0);
    }
    for (int k = 0; k <= axes.major.intervals; ++k) {
        const double value = axes.major.least + (axes.major.greatest - axes.major.least) * k / axes.major.intervals;
        const ImVec2 low = axes.place(axes.minor.least, value);
        draw->AddLine(low, {axes.high.x, low.y}, ink(p.line));
    }
    for (const double value : axis_numbers(axes.major, 6)) {
        const ImVec2 low = axes.place(axes.minor.least, value);
        label({low.x - 4 * s, low.y}, number(value), 1, 0.5f);
    }
    const float line = ImGui::GetTextLineHeight();
    label({(axes.low.x + axes.high.x) / 2, axes.low.y + 2 * s + line}, "minor strain (true)", 0.5f, 0);
    label({axes.low.x - 4 * s, axes.high.y - line / 2 - 2 * s}, "major strain (true)", 0, 1);
    ImGui::PopFont();
    draw->AddLine(axes.place(0, axes.major.least), axes.place(0, axes.major.greatest), ink(p.muted), 1.5f * s);
}

/// What is red: beyond the forming limit; without a curve beyond the trusted strain.
Eigen::VectorXi marked(const Session& session)
{
    if (!session.limits || session.limits->zones.distance.size() == 0)
        return session.blank->face.necking;
    const std::vector<Zone>& zone = session.limits->zones.zone;
    Eigen::VectorXi crack(Eigen::Index(zone.size()));
    std::transform(zone.begin(), zone.end(), crack.begin(), [](Zone each) { return int(each == Zone::crack); });
    return crack;
}

/// The forming limit and, dashed, where the margin below it begins.
void draw_limit(const Frame& frame, const LimitsResult& limits, const Axes& axes, ImDrawList* draw)
{
    if (!limits.curve)
        return;
    const Palette p = palette_of(frame.state.view.dark);
    const float s = frame.ui.scale;
    draw->PushClipRect({axes.low.x, axes.high.y}, {axes.high.x, axes.low.y}, true);
    constexpr int pieces = 96;
    for (const bool margin : {false, true}) {
        const auto at = [&](int k) {
            const double minor = axes.minor.least + (axes.minor.greatest - axes.minor.least) * k / pieces;
            const double limit = (*limits.curve)(minor);
            return axes.place(
                minor, margin ? logarithmic_strain(std::max(engineering_strain(limit) - limits.settings.margin, -0.9))
                              : limit);
        };
        for (int k = 0; k < pieces; ++k)
            if (!margin || k % 3 != 2)
                draw->AddLine(at(k), at(k + 1), ink(margin ? p.warning : p.error), (margin ? 1.2f : 1.8f) * s);
    }
    draw->PopClipRect();
}

/// The fuller a square, the more solid; red by the share of marked faces.
void draw_cloud(Frame& frame, const SheetFields& face, const Axes& axes, ImDrawList* draw)
{
    const Session& session = frame.state.document.session;
    const Palette p = palette_of(frame.state.view.dark);
    const float s = frame.ui.scale, square = 2 * s;
    const int columns = std::max(1, int((axes.high.x - axes.low.x) / square)),
              rows = std::max(1, int((axes.low.y - axes.high.y) / square));
    const PointCloud& cloud = frame.ui.charts.strains.of({session.blank, session.limits, columns, rows}, [&] {
        return count_points(face.strain_minor, face.strain_major, marked(session), axes.range(), columns, rows);
    });
    const float wide = (axes.high.x - axes.low.x) / float(columns), high = (axes.low.y - axes.high.y) / float(rows);
    const double fullest = std::log1p(cloud.most);
    for (const auto& at : cloud.squares) {
        const float red = float(at.marked) / float(at.points),
                    opacity = 0.3f + 0.7f * float(std::log1p(at.points) / fullest);
        const auto mix = [&](float a, float b) { return a + red * (b - a); };
        const ImVec2 corner{axes.low.x + float(at.column) * wide, axes.low.y - float(at.row) * high};
        draw->AddRectFilled(
            {corner.x, corner.y - high}, {corner.x + wide, corner.y},
            ink(ImVec4(mix(p.accent.x, p.error.x), mix(p.accent.y, p.error.y), mix(p.accent.z, p.error.z), opacity)));
    }
    std::vector<char> taken(size_t(columns) * size_t(rows)); // thousands of selected faces need no
                                                             // dot each
    for (const int f : frame.state.document.selected) {
        const ImVec2 c = axes.place(face.strain_minor[f], face.strain_major[f]);
        const int column = std::clamp(int((c.x - axes.low.x) / wide), 0, columns - 1),
                  row = std::clamp(int((axes.low.y - c.y) / high), 0, rows - 1);
        if (std::exchange(taken[size_t(row) * size_t(columns) + size_t(column)], 1))
            continue;
        const float r = 2 * s;
        draw->AddRectFilled({c.x - r, c.y - r}, {c.x + r, c.y + r}, ink(p.warning));
    }
}

/// At the end of a click or a drag.
void choose(Frame& frame, const SheetFields& face, const Axes& axes, ImVec2 from, ImVec2 to)
{
    const float s = frame.ui.scale;
    const Eigen::Vector2d a = axes.strains(from), b = axes.strains(to);
    if (std::hypot(to.x - from.x, to.y - from.y) >= 4 * s) {
        const Eigen::AlignedBox2d box(a.cwiseMin(b), a.cwiseMax(b));
        frame.actions.push(SelectFaces{points_within(face.strain_minor, face.strain_major, box), pick_mode()});
        return;
    }
    constexpr float near = 8; // pixels at content scale 1
    const Eigen::Vector2d reach = (axes.strains({to.x + near * s, to.y - near * s}) - b).cwiseAbs();
    if (const auto point = nearest_point(face.strain_minor, face.strain_major, b, reach))
        frame.actions.push(SelectFaces{{*point}, pick_mode()});
}

} // namespace

void strain_diagram(Frame& frame)
{
    const Document& document = frame.state.document;
    if (!document.session.blank)
        return;
    const bool open = ImGui::CollapsingHeader("Strain diagram", ImGuiTreeNodeFlags_DefaultOpen);
    tooltip(
        "Each point is a face: greatest (major) over smallest (minor) strain in the sheet, logarithmic. Red line: forming limit, dashed: required margin. Red points: above the limit or, without a curve, strained beyond the range of the hardening curve. Click a point to select its face, drag a box to select several.");
    if (!open)
        return;
    const SheetFields& face = document.session.blank->face;
    const float s = frame.ui.scale, side = ImGui::GetContentRegionAvail().x, height = std::min(side, 260 * s);
    const float line = frame.ui.fonts.small->FontSize;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const auto& limits = document.session.limits;
    const FormingLimitCurve* curve = limits && limits->curve ? &*limits->curve : nullptr;
    const Axes axes = axes_of(sheet_figures(frame), curve, {at.x + 38 * s, at.y + height - 2 * line - 6 * s},
                              {at.x + side - 4 * s, at.y + 1.5f * line + 4 * s});
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw_axes(frame, axes, draw);
    draw_cloud(frame, face, axes, draw);
    if (limits)
        draw_limit(frame, *limits, axes, draw);
    ImGui::InvisibleButton("diagram", {side, height});
    if (ImGui::IsItemHovered()) { // above the diagram, where no points are
        const Eigen::Vector2d here = axes.strains(ImGui::GetMousePos());
        const std::string text = fmt::format("{:.3f}, {:.3f}", here[0] + 0., here[1] + 0.);
        ImGui::PushFont(frame.ui.fonts.small);
        draw->AddText({axes.high.x - ImGui::CalcTextSize(text.c_str()).x, axes.high.y - 1.5f * line},
                      ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
        ImGui::PopFont();
    }
    auto& from = frame.ui.diagram_from;
    if (ImGui::IsItemActivated())
        from = ImGui::GetMousePos();
    if (!from)
        return;
    const ImVec2 now = ImGui::GetMousePos();
    const Palette p = palette_of(frame.state.view.dark);
    const ImVec2 low{std::min(now.x, from->x), std::min(now.y, from->y)},
        high{std::max(now.x, from->x), std::max(now.y, from->y)};
    draw->AddRectFilled(low, high, ink(ImVec4(p.accent.x, p.accent.y, p.accent.z, 0.15f)));
    draw->AddRect(low, high, ink(p.accent));
    if (!ImGui::IsMouseDown(0))
        choose(frame, face, axes, *std::exchange(from, std::nullopt), now);
}

} // namespace spia::viewer
