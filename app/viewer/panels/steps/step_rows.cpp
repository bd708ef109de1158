#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/panels/steps/step_parts.h"
#include "engine/core/text.h"
#include "engine/report/text/sentence.h"

namespace spia::viewer {
namespace {

const char* status_words(StepStatus status)
{
    switch (status) {
    case StepStatus::missing: return "not run yet";
    case StepStatus::done: return "";
    case StepStatus::poor: return "not converged";
    case StepStatus::stale: return "out of date";
    case StepStatus::failed: return "no result";
    case StepStatus::needs_pick:
        return "The fixed faces of its target no longer exist. Select fixed faces and press \"Fit to selection\", or "
               "choose a target.";
    }
    return "";
}

ImVec4 status_colour(const Palette& p, StepStatus status)
{
    return status == StepStatus::done                                                                      ? p.good
           : status == StepStatus::poor || status == StepStatus::stale || status == StepStatus::needs_pick ? p.warning
           : status == StepStatus::failed                                                                  ? p.error
                                                                                                           : p.muted;
}

/// One decimal, but for what is nothing when rounded.
std::string percent(double share)
{
    const double tenths = std::round(1000 * share) / 10;
    return tenths == 0 ? "0" : fmt::format("{:.1f}", tenths);
}

/// Below them a figure is nothing when rounded as it is here.
constexpr double no_distance_mm = 5e-4, no_angle_deg = 0.05, no_strain = 5e-4;

/// How well the target goes on from what stays: what is more than nothing of it.
std::string hinge_words(const StepFigures::Hinge& hinge, LengthUnit lengths)
{
    const std::string offset = "offset " + length_text(hinge.distance_mm, lengths, 2),
                      angle = fmt::format("at {:.1f}\u00b0", hinge.angle_deg);
    return "hinge " + (hinge.distance_mm < no_distance_mm ? angle
                       : hinge.angle_deg < no_angle_deg   ? offset
                                                          : offset + " and " + angle);
}

/// The figures that are more than nothing: noughts in every row would hide them.
std::string figures_words(const std::string& laid_on, const StepFigures& figures, LengthUnit lengths)
{
    std::string text = laid_on + (figures.strain_equivalent < no_strain
                                      ? ", strain below 0.001"
                                      : fmt::format(", strain to {:.3f}", figures.strain_equivalent));
    const std::string least = percent(figures.thinning[0]), greatest = percent(figures.thinning[1]);
    if (least != "0" || greatest != "0")
        text += fmt::format("\nthinning {} to {} %", least, greatest);
    if (const auto& hinge = figures.hinge; hinge && !hinge->bad && laid_on == "smooth" &&
                                           (hinge->distance_mm >= no_distance_mm || hinge->angle_deg >= no_angle_deg))
        text += "\n" + hinge_words(*hinge, lengths);
    return text;
}

/// The figures of a step, or why there are none, in one line below its name.
void figures_line(Frame& frame, size_t number, StepStatus status)
{
    const Document& document = frame.state.document;
    const Palette p = palette_of(frame.state.view.dark);
    ImGui::PushFont(frame.ui.fonts.small);
    // lines of one row
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 0});
    if (status == StepStatus::done || status == StepStatus::poor) {
        const StepFigures& figures = document.unfolding->figure[number];
        const UnfoldState& after = document.unfolding->run.states[number];
        const bool bad = figures.hinge && figures.hinge->bad;
        muted(frame, figures_words(engine_words(frame, after.plain), figures, frame.lengths()));
        tooltip(
            "Target; equivalent strain and thinning of the moving faces; offset and angle of the target at the hinge to the fixed faces. Values that round to 0 are left out.");
        if (bad) {
            coloured(p.warning, hinge_words(*figures.hinge, frame.lengths()));
            tooltip(
                "At the hinge between moving and fixed faces the target is offset or at an angle: the sheet has a step or a crease there. Fit the target to other faces, or give other numbers.");
        }
        if (after.necking > 0) {
            coloured(p.warning,
                     fmt::format("{} face{} beyond the hardening curve", after.necking, after.necking == 1 ? "" : "s"));
            tooltip(
                "Strain beyond the valid range of the hardening curve, extrapolated: the sheet would neck or crack there");
        }
        if (after.friction_share < 1)
            coloured(p.warning, fmt::format("{:.2g} % of its friction applied", 100 * after.friction_share));
        if (status == StepStatus::poor)
            coloured(p.warning, "Not converged: " + engine_words(frame, after.reason));
    } else if (status == StepStatus::failed)
        coloured(p.error, as_sentence(engine_words(frame, document.unfolding->run.failure)));
    else
        coloured(status_colour(p, status), status_words(status));
    ImGui::PopStyleVar();
    ImGui::PopFont();
    ImGui::Dummy({0, 0});
}

/// The beginning of a text that has a width, with dots where it goes on.
std::string cut_to(const std::string& text, float width)
{
    if (ImGui::CalcTextSize(text.c_str()).x <= width)
        return text;
    std::string cut = text;
    while (!cut.empty() && ImGui::CalcTextSize((cut + "...").c_str()).x > width) {
        while (!cut.empty() && (cut.back() & 0xc0) == 0x80) // a letter of several bytes
            cut.pop_back();
        if (!cut.empty())
            cut.pop_back();
    }
    return cut + "...";
}

/// A name in a width: what it lays on, at the end of a proposed one, is kept as long as possible.
std::string name_in(std::string name, float width)
{
    const auto fits = [&](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x <= width; };
    if (fits(name))
        return name;
    constexpr std::string_view again = ", region ", onto = " onto ";
    for (size_t at = name.find(again); at != std::string::npos; at = name.find(again, at + 2))
        name.replace(at, again.size(), ", ");
    const size_t tail = name.rfind(onto);
    if (fits(name) || tail == std::string::npos || tail == 0)
        return cut_to(name, width);
    const std::string end = name.substr(tail), least = name.substr(0, 1) + "...";
    const float room = width - ImGui::CalcTextSize(end.c_str()).x;
    if (room < 2 * ImGui::CalcTextSize(least.c_str()).x)
        return cut_to(name, width);
    return cut_to(name.substr(0, tail), room) + end;
}

/// A small picture of the step where there is room for it. @returns its width with what is beside
/// it, pixels
float thumbnail(Frame& frame, size_t number, const ImVec4& border)
{
    constexpr int most_triangles = 200'000; // of a part: each picture has a mesh of its own
    const Document& document = frame.state.document;
    const float s = frame.ui.scale;
    const ImVec2 size{64 * s, 48 * s}, at = ImGui::GetCursorScreenPos();
    if (document.session.part->mesh.triangles() > most_triangles || !frame.draw_step)
        return 0;
    auto& pictures = frame.ui.step_pictures;
    pictures.resize(document.steps.size());
    follow(pictures[number], frame.state, frame.cache, number, {double(size.x), double(size.y)});
    const ImVec2 dots = ImGui::GetIO().DisplayFramebufferScale;
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImVec2 to{at.x + size.x, at.y + size.y};
    if (ImGui::IsRectVisible(at, to))
        if (const ImTextureID texture =
                frame.draw_step(pictures[number], number, int(size.x * dots.x), int(size.y * dots.y)))
            draw->AddImage(texture, at, to, {0, 1}, {1, 0});
    draw->AddRect(at, to, ink(border));
    return size.x + 8 * s;
}

} // namespace

void step_row(Frame& frame, int number)
{
    const PlannedStep& step = *frame.state.document.steps[size_t(number)];
    const StepStatus status = step_status(frame.state.document, size_t(number));
    const Palette p = palette_of(frame.state.view.dark);
    const bool chosen = frame.state.view.step == number;
    const float top = ImGui::GetCursorPosY(), s = frame.ui.scale;
    const float beside = thumbnail(frame, size_t(number), chosen ? p.accent : p.line);
    ImGui::Indent(std::max(beside, 1.f));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float r = 4 * s, room = ImGui::GetContentRegionAvail().x;
    const float text_from = 2 * r + 6 * s;
    if (ImGui::Selectable("##row", chosen, 0, {0, ImGui::GetTextLineHeight()})) {
        frame.ui.playing.reset();
        frame.actions.push(chosen ? ShowStep{} : ShowStep{number, {}});
    }
    note_place(frame, fmt::format("step {}", number + 1));
    tooltip(fmt::format("{}: {}. Click to show and edit the step, click again to return to the part.", step.name,
                        counted(step.pick.freed.size(), "face", "faces")));
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddCircleFilled({at.x + r, at.y + ImGui::GetTextLineHeight() / 2}, r, ink(status_colour(p, status)), 16);
    draw->AddText({at.x + text_from, at.y}, ImGui::GetColorU32(ImGuiCol_Text),
                  name_in(fmt::format("{}  {}", number + 1, step.name), room - text_from).c_str());
    figures_line(frame, size_t(number), status);
    ImGui::Unindent(std::max(beside, 1.f));
    if (beside > 0)
        ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), top + 52 * s));
    if (chosen)
        step_editor(frame, number);
}

} // namespace spia::viewer
