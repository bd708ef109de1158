#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <string>

#include "app/viewer/panels/ui.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

/// How far the part reaches along the direction of a plane, mm.
std::array<double, 2> reach_of_part(const Frame& frame, const ClipPlane& clip)
{
    const PartFile* part = examined(frame.state);
    if (!part || part->mesh.vertices() == 0)
        return {0, 0};
    const Eigen::RowVectorXd along = direction_of(clip).transpose() * part->mesh.position;
    return {along.minCoeff(), along.maxCoeff()};
}

void through_the_middle(const Frame& frame, ClipPlane& clip)
{
    const auto [least, greatest] = reach_of_part(frame, clip);
    clip.place_mm = (least + greatest) / 2;
}

std::string side_words(const ClipPlane& clip, LengthUnit unit)
{
    if (clip.axis == ClipAxis::view)
        return clip.flip ? "everything behind it is cut away" : "everything in front of it is cut away";
    const char axis = "xyz"[int(clip.axis)];
    return fmt::format("{} {} {} is cut away", axis, clip.flip ? '<' : '>', fixed_length(clip.place_mm + 0., unit, 2));
}

} // namespace

void toggle_clip(Frame& frame)
{
    ViewSettings settings = frame.state.view;
    ClipPlane& clip = settings.clip;
    clip.on = !clip.on;
    const auto [least, greatest] = reach_of_part(frame, clip);
    if (clip.on && !(clip.place_mm > least && clip.place_mm < greatest))
        through_the_middle(frame, clip);
    frame.actions.push(SetViewSettings{settings});
}

float clip_bar_height(const Frame& frame)
{
    return frame.state.view.clip.on ? ImGui::GetFrameHeight() + 5 * frame.ui.scale : 0;
}

void clip_bar(Frame& frame)
{
    ViewSettings settings = frame.state.view;
    ClipPlane& clip = settings.clip;
    const ClipPlane before = clip;
    const float s = frame.ui.scale, gap = 4 * s;
    const Palette p = palette_of(settings.dark);
    ImGui::PushFont(frame.ui.fonts.small);
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, p.warning);
    ImGui::TextUnformatted("Clipped");
    ImGui::PopStyleColor();
    tooltip("A plane cuts part, quad mesh and surface; what is cut away cannot be picked  (H)");
    constexpr std::pair<ClipAxis, const char*> axes[] = {
        {ClipAxis::x, "x##clip"}, {ClipAxis::y, "y##clip"}, {ClipAxis::z, "z##clip"}, {ClipAxis::view, "view##clip"}};
    for (const auto& [axis, label] : axes) {
        ImGui::SameLine(0, axis == ClipAxis::x ? 8 * s : gap);
        const bool chosen = clip.axis == axis;
        if (chosen) {
            ImGui::PushStyleColor(ImGuiCol_Button, p.accent);
            ImGui::PushStyleColor(ImGuiCol_ButtonHovered, p.accent);
            ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1, 1, 1, 1));
        }
        if (ImGui::Button(label)) {
            clip.axis = axis;
            if (axis == ClipAxis::view) {
                const glm::dvec3 viewer = settings.camera[size_t(View::part)].turn * glm::dvec3(0, 0, 1);
                clip.direction = {viewer.x, viewer.y, viewer.z};
            }
            through_the_middle(frame, clip);
        }
        if (chosen)
            ImGui::PopStyleColor(3);
        tooltip(axis == ClipAxis::view ? "Square to the line of sight in the view of the part as it is now"
                                       : "Square to this axis");
    }
    const ImGuiStyle& style = ImGui::GetStyle();
    const auto button = [&](const char* label) { return ImGui::CalcTextSize(label).x + 2 * style.FramePadding.x; };
    const std::string words = side_words(clip, frame.lengths());
    const float ends = button("Flip") + gap + button("Off") + 8 * s,
                room = ImGui::GetContentRegionAvail().x - (ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x);
    const float text = ImGui::CalcTextSize(words.c_str()).x + 8 * s;
    const bool spoken = room - ends - text > 120 * s; // else the slider alone says where
    ImGui::SameLine(0, 8 * s);
    ImGui::SetNextItemWidth(std::clamp(room - ends - (spoken ? text : 0) - 24 * s, 60 * s, 420 * s));
    const auto [least, greatest] = reach_of_part(frame, clip);
    const LengthUnit unit = frame.lengths();
    const double low = shown_length(least, unit), high = shown_length(greatest, unit);
    auto place = float(shown_length(clip.place_mm, unit));
    // Three figures of the part's size are as fine as a hand drags.
    const int digits = high > low ? std::clamp(3 - int(std::floor(std::log10(high - low))), 0, 6) : 2;
    const std::string format = fmt::format("%.{}f {}", digits, length_word(unit));
    if (ImGui::SliderFloat("##place", &place, float(low), float(high), format.c_str()))
        clip.place_mm = kept_length(place, unit);
    tooltip("Where the plane is along its direction. Ctrl and click to type a number");
    if (spoken) {
        ImGui::SameLine(0, 8 * s);
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(p.muted, "%s", words.c_str());
    }
    ImGui::SameLine(0, 8 * s);
    if (ImGui::Button("Flip"))
        clip.flip = !clip.flip;
    tooltip("Cut away the other side");
    ImGui::SameLine(0, gap);
    if (ImGui::Button("Off"))
        clip.on = false;
    tooltip("Show all of it  (H)");
    ImGui::PopFont();
    if (clip != before)
        frame.actions.push(SetViewSettings{settings});
}

} // namespace spia::viewer
