#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/model/viewer_words.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

bool idle(const Frame& frame) { return !frame.state.job.running; }

/// What is to be done next, as one wide button; nothing once all is done.
void next_button(Frame& frame)
{
    const Document& document = frame.state.document;
    if (document.steps.empty()) {
        muted(
            frame,
            "For a part that is not made in one hit: its flanges are laid flat one after another, the outermost first.");
        if (primary_button(frame, "Propose steps", idle(frame)))
            frame.actions.push(ProposeSteps{});
        tooltip(
            "Splits the part at its bends and says in which order it can be unfolded; the largest flat region stays. All "
            "of it can be changed.");
        return;
    }
    if (all_steps_done(document))
        return;
    const size_t done = steps_done(document);
    const bool again = document.unfolding && done < document.steps.size() && done > 0;
    if (primary_button(frame, again ? fmt::format("Redo from step {}", done + 1).c_str() : "Unfold step by step",
                       idle(frame)))
        frame.actions.push(RunSteps{});
    tooltip(again ? "The states before it are kept" : "Runs every step that is missing or out of date");
}

void blank_figures(Frame& frame)
{
    const Document& document = frame.state.document;
    if (!all_steps_done(document))
        return;
    const UnfoldRun& run = document.unfolding->run;
    if (!run.blank)
        return coloured(palette_of(frame.state.view.dark).warning, "The part does not lie in a plane yet; add a step.");
    const Eigen::Vector2d size = run.blank->position.rowwise().maxCoeff() - run.blank->position.rowwise().minCoeff();
    figure(frame, "Blank of the steps", fmt::format("{:.4g} x {:.4g} mm", size[0], size[1]));
    if (run.flipped > 0)
        coloured(palette_of(frame.state.view.dark).warning, fmt::format("{} triangles of it are flipped", run.flipped));
}

/// The slider from the part to the last state, and what plays it.
void slider(Frame& frame)
{
    const double done = double(steps_done(frame.state.document));
    std::optional<float>& playing = frame.ui.playing;
    if (done == 0) {
        playing.reset();
        return;
    }
    float position = float(step_position(frame.state));
    if (playing) {
        constexpr float seconds_per_step = 1.4f, longest_frame = 0.1f;
        *playing += std::min(longest_frame, ImGui::GetIO().DeltaTime) / seconds_per_step;
        frame.actions.push(ShowStep{{}, std::min(done, double(*playing))});
        if (double(*playing) >= done)
            playing.reset();
    }
    if (ImGui::Button(playing ? "Stop" : "Play", {52 * frame.ui.scale, 0}))
        playing = playing ? std::nullopt : std::optional(double(position) < done ? position : 0.f);
    tooltip("Plays the unfolding");
    ImGui::SameLine();
    const double whole = std::round(double(position));
    const std::string text = position == 0               ? "the part"
                             : double(position) == whole ? fmt::format("after step {:.0f}", whole)
                                                         : fmt::format("in step {:.0f}", std::ceil(position));
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##unfolded", &position, 0, float(done), text.c_str(), ImGuiSliderFlags_NoInput)) {
        constexpr double near = 0.08; // of a step: whole ones are met
        const double nearest = std::round(double(position));
        playing.reset();
        frame.actions.push(ShowStep{
            {}, std::clamp(std::abs(double(position) - nearest) < near ? nearest : double(position), 0., done)});
    }
    tooltip("How far the part is unfolded in its view");
}

const char* status_words(StepStatus status)
{
    switch (status) {
    case StepStatus::missing: return "not run yet";
    case StepStatus::done: return "";
    case StepStatus::poor: return "not converged";
    case StepStatus::stale: return "out of date";
    case StepStatus::failed: return "no result";
    }
    return "";
}

ImVec4 status_colour(const Palette& p, StepStatus status)
{
    return status == StepStatus::done                                  ? p.good
           : status == StepStatus::poor || status == StepStatus::stale ? p.warning
           : status == StepStatus::failed                              ? p.error
                                                                       : p.muted;
}

/// With a sign, but for what is nothing when rounded.
std::string percent(double share)
{
    const double tenths = std::round(1000 * share) / 10;
    return tenths == 0 ? "0" : fmt::format("{:+.1f}", tenths);
}

/// The figures of a step, or why there are none, in one line below its name.
void figures_line(Frame& frame, size_t number, StepStatus status)
{
    const Document& document = frame.state.document;
    const Palette p = palette_of(frame.state.view.dark);
    ImGui::PushFont(frame.ui.fonts.small);
    if (status == StepStatus::done || status == StepStatus::poor) {
        const StepFigures& figures = document.unfolding->figure[number];
        const UnfoldState& after = document.unfolding->run.states[number];
        const std::string text =
            fmt::format("{}, strain to {:.3f}\nthinning {} to {} %", after.plain, figures.strain_equivalent,
                        percent(figures.thinning[0]), percent(figures.thinning[1]));
        muted(frame, text);
        tooltip("What it was laid on; equivalent strain and thinning per face of the faces that it moves.");
        if (status == StepStatus::poor)
            coloured(p.warning, "Not converged: " + after.reason);
    } else if (status == StepStatus::failed)
        coloured(p.error, as_sentence(in_viewer_words(document.unfolding->run.failure)));
    else
        coloured(status_colour(p, status), status_words(status));
    ImGui::PopFont();
}

/// Name, options, place in the list: of the chosen step.
void step_editor(Frame& frame, int number)
{
    const PlannedStep& step = *frame.state.document.steps[size_t(number)];
    ChangeStep edited{number, step.name, step.offset_mm, step.within_mm, step.tolerance};
    ImGui::SetNextItemWidth(-1);
    bool changed = typed_text(frame, "##name", edited.name, "name");
    const float width = 86 * frame.ui.scale;
    if (step.kind == UnfoldKind::lay) {
        ImGui::SetNextItemWidth(width);
        changed |= typed_number(frame, "Offset, mm", edited.offset_mm, "%.4g");
        tooltip("Moves the face onto which it unfolds, to its outer side");
        ImGui::SetNextItemWidth(width);
        changed |= typed_number(frame, "Within, mm", edited.within_mm, "%.4g");
        edited.within_mm = std::max(0., edited.within_mm);
        tooltip(
            "How far the yellow faces may be from the plane, cylinder or cone that is looked for. 0: automatic; if there is none, "
            "a smooth face through them.");
    }
    if (step.kind != UnfoldKind::unroll) {
        double tolerance = edited.tolerance.value_or(FlattenOptions{}.tolerance);
        ImGui::SetNextItemWidth(width);
        if (typed_number(frame, "Tolerance", tolerance, "%.1e")) {
            edited.tolerance = std::clamp(tolerance, 1e-14, 0.1);
            changed = true;
        }
        tooltip("Of the solver: a larger one lets a step end that nearly converges");
    }
    if (changed)
        frame.actions.push(edited);
    const int last = int(frame.state.document.steps.size()) - 1;
    ImGui::BeginDisabled(number == 0);
    if (small_button(frame, "Up"))
        frame.actions.push(MoveStep{number, number - 1});
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(number == last);
    if (small_button(frame, "Down"))
        frame.actions.push(MoveStep{number, number + 1});
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (small_button(frame, "Remove"))
        frame.actions.push(RemoveStep{number});
    ImGui::SameLine();
    if (small_button(frame, "Select faces"))
        frame.actions.push(SelectFaces{step.pick.freed});
    tooltip("Selects the faces that it moves");
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

/// A small picture of the step where there is room for it. @returns its width with what is beside it, pixels
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
    tooltip(fmt::format("{}: {} faces. A click shows it and lets change it, another one shows the part again.",
                        step.name, step.pick.freed.size()));
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddCircleFilled({at.x + r, at.y + ImGui::GetTextLineHeight() / 2}, r, ink(status_colour(p, status)), 16);
    draw->AddText({at.x + text_from, at.y}, ImGui::GetColorU32(ImGuiCol_Text),
                  cut_to(fmt::format("{}  {}", number + 1, step.name), room - text_from).c_str());
    figures_line(frame, size_t(number), status);
    ImGui::Unindent(std::max(beside, 1.f));
    if (beside > 0)
        ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), top + 52 * s));
    if (chosen)
        step_editor(frame, number);
}

/// A region to choose, or the selection.
void region_combo(Frame& frame, const char* label, int& chosen, bool or_selection)
{
    const Document& document = frame.state.document;
    const auto text = [&](int k) {
        return k < 0 ? fmt::format("{} selected", document.selected.size()) : document.regions[size_t(k)].name;
    };
    chosen = std::clamp(chosen, or_selection ? -1 : 0, int(document.regions.size()) - 1);
    ImGui::SetNextItemWidth(150 * frame.ui.scale);
    if (!ImGui::BeginCombo(label, text(chosen).c_str()))
        return;
    for (int k = or_selection ? -1 : 0; k < int(document.regions.size()); ++k) {
        ImGui::PushID(k);
        if (ImGui::Selectable(text(k).c_str(), k == chosen))
            chosen = k;
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

/// A step of one's own.
void new_step(Frame& frame)
{
    const Document& document = frame.state.document;
    if (!ImGui::TreeNodeEx("Add a step", ImGuiTreeNodeFlags_NoTreePushOnOpen))
        return;
    if (document.regions.empty())
        return muted(frame, "Make a region of the faces that stay, below, and select those to unfold onto their face.");
    Ui& ui = frame.ui;
    region_combo(frame, "stays", ui.step_fixed, false);
    tooltip("The region on whose plane, cylinder, cone or smooth face the others are laid");
    region_combo(frame, "unfolds", ui.step_freed, true);
    tooltip("What moves: with the bend between them");
    const bool nothing = ui.step_freed < 0 && document.selected.empty();
    ImGui::BeginDisabled(nothing || ui.step_fixed == ui.step_freed);
    if (ImGui::Button("Add step", {-1, 0}))
        frame.actions.push(AddStep{ui.step_fixed, ui.step_freed < 0 ? std::nullopt : std::optional(ui.step_freed), {}});
    ImGui::EndDisabled();
    if (nothing)
        muted(frame, "Select the faces to unfold.");
}

void proposals(Frame& frame)
{
    const Document& document = frame.state.document;
    ImGui::BeginDisabled(!idle(frame));
    if (!document.steps.empty()) {
        if (small_button(frame, "Propose anew"))
            frame.actions.push(ProposeSteps{});
        tooltip("Replaces the list; the largest flat region stays. Undo brings this one back.");
    }
    if (!document.selected.empty()) {
        if (!document.steps.empty())
            ImGui::SameLine();
        if (small_button(frame, document.steps.empty() ? "Propose, selection stays" : "Selection stays"))
            frame.actions.push(ProposeSteps{document.selected.front()});
        tooltip("Proposes steps in which the region of the first selected face stays where it is");
    }
    ImGui::EndDisabled();
}

} // namespace

void unfolding_section(Frame& frame)
{
    const Document& document = frame.state.document;
    if (!document.session.part) {
        frame.ui.playing.reset();
        return;
    }
    const bool appear = !document.steps.empty() && !frame.ui.steps_listed;
    frame.ui.steps_listed = !document.steps.empty();
    if (appear)
        ImGui::SetNextItemOpen(true);
    const bool open = ImGui::CollapsingHeader("Step by step");
    tooltip("Unfolds picked regions one after another onto faces in space, until the part is flat");
    if (appear)
        ImGui::SetScrollHereY(0.1f);
    if (!open)
        return;
    next_button(frame);
    slider(frame);
    for (size_t k = 0; k < document.steps.size(); ++k) {
        ImGui::PushID(int(k));
        step_row(frame, int(k));
        ImGui::PopID();
    }
    blank_figures(frame);
    if (steps_done(document) > 0) {
        bool field = frame.state.view.field_on_steps;
        if (ImGui::Checkbox("Colour by the field", &field)) {
            ViewSettings settings = frame.state.view;
            settings.field_on_steps = field;
            frame.actions.push(SetViewSettings{settings});
        }
        tooltip("Of the state that is shown, instead of what stays (yellow) and what unfolds (green)");
    }
    proposals(frame);
    new_step(frame);
}

} // namespace spia::viewer
