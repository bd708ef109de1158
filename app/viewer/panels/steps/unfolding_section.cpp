#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/k_choice.h"
#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/steps/step_parts.h"
#include "engine/core/text.h"

namespace spia::viewer {
namespace {

bool idle(const Frame& frame) { return !frame.state.job.running; }

/// What is to be done next, as one wide button; nothing once all is done.
void next_button(Frame& frame)
{
    const Document& document = frame.state.document;
    if (document.steps.empty()) {
        muted(frame,
              "For parts made in several operations: flanges are unfolded one after another, the outermost first.");
        if (primary_button(frame, "Propose steps", idle(frame)))
            frame.actions.push(ProposeSteps{});
        note_place(frame, "propose steps");
        tooltip(
            "Splits the part at its bends and proposes the order of unfolding; the largest flat region stays fixed. All steps can be edited.");
        return;
    }
    if (all_steps_done(document))
        return;
    const size_t done = steps_done(document);
    const bool again = document.unfolding && done < document.steps.size() && done > 0;
    if (primary_button(frame, again ? fmt::format("Redo from step {}", done + 1).c_str() : "Unfold step by step",
                       idle(frame)))
        frame.actions.push(RunSteps{});
    note_place(frame, "run steps");
    tooltip(again ? "Earlier states are kept" : "Runs every step that is missing or out of date");
}

/// Tools and restraint that the steps know nothing of.
void left_out_line(Frame& frame)
{
    const Document& document = frame.state.document;
    const std::string text = document.steps.empty() ? "" : left_out_by_steps(document);
    if (text.empty())
        return;
    coloured(palette_of(frame.state.view.dark).warning, text);
    note_place(frame, "left out by steps");
    tooltip("The one-step solution takes them into account: \"Unfold\" in the step Unfold  (F6)");
}

/// Where a proposal was planned anew: what of it, in one line.
void given_up_line(Frame& frame)
{
    const Document& document = frame.state.document;
    if (!document.unfolding || document.unfolding->given_up.empty() || !still_proposed(document) ||
        document.unfolding->steps != document.steps)
        return;
    const std::vector<std::string>& given_up = document.unfolding->given_up;
    muted(frame, fmt::format("Replanned: {} step{} failed.", given_up.size(), given_up.size() == 1 ? "" : "s"));
    note_place(frame, "planned anew");
    std::string all;
    for (const std::string& each : given_up)
        all += (all.empty() ? "" : "\n") + each;
    tooltip(all + "\nUndo restores the first proposal.");
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
        const double wanted =
            std::clamp(std::abs(double(position) - nearest) < near ? nearest : double(position), 0., done);
        playing.reset();
        if (wanted != step_position(frame.state)) // held still near a whole one it is no news in
                                                  // every frame
            frame.actions.push(ShowStep{{}, wanted});
    }
    note_place(frame, "slider");
    tooltip("How far the part is shown unfolded");
}

/// The list as a whole: another proposal, files.
void list_buttons(Frame& frame)
{
    const Document& document = frame.state.document;
    const bool empty = document.steps.empty();
    ImGui::BeginDisabled(!idle(frame));
    if (!empty) {
        if (small_button(frame, "Propose again"))
            frame.actions.push(ProposeSteps{});
        tooltip("Replaces the list; the largest flat region stays fixed. Undo restores the current list.");
        ImGui::SameLine();
    }
    if (!document.selected.empty()) {
        if (small_button(frame, empty ? "Propose, selection fixed" : "Selection fixed"))
            frame.actions.push(ProposeSteps{document.selected.front()});
        tooltip("Proposes steps that keep the region of the first selected face fixed");
        if (empty)
            ImGui::SameLine();
    }
    if (!empty && document.selected.empty())
        ImGui::NewLine();
    if (small_button(frame, "Open steps..."))
        frame.ui.files.open(FileDialog::Purpose::open_steps, suggested_file(frame, ".json").parent_path());
    tooltip("Steps from a file of the command line: spia unfold PART --script FILE");
    if (!empty) {
        ImGui::SameLine();
        if (small_button(frame, "Save steps..."))
            frame.ui.files.open(FileDialog::Purpose::save_steps, suggested_file(frame, "-steps.json"));
        tooltip("As a file for the command line: spia unfold PART --script FILE");
    }
    ImGui::EndDisabled();
}

} // namespace

void note_place(Frame& frame, const std::string& name)
{
    frame.ui.items[name] = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
}

bool blank_of_steps_waits(const Document& document)
{
    if (!all_steps_done(document) || !document.unfolding->run.blank || document.unfolding->run.flipped > 0)
        return false;
    const auto& made = document.made_with.steps;
    return !(document.session.blank && made && holds(document, *made));
}

void blank_of_steps(Frame& frame)
{
    const Document& document = frame.state.document;
    if (!all_steps_done(document))
        return;
    const Palette p = palette_of(frame.state.view.dark);
    const UnfoldRun& run = document.unfolding->run;
    if (!run.blank)
        return coloured(p.warning, "The part is not flat yet; add a step.");
    std::string other;
    if (const auto blank = size_of_blank(document)) {
        other = of_other_k(document, *blank);
        ImGui::PushStyleColor(ImGuiCol_Text, other.empty() ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : p.muted);
        figure(frame, "Blank of the steps", size_text(blank->size[0], blank->size[1], frame.lengths()) + other);
        ImGui::PopStyleColor();
        if (!other.empty())
            tooltip("With the K factor of the run");
    }
    if (run.flipped > 0)
        return coloured(p.warning,
                        fmt::format("{} flipped; unfold in smaller steps there.",
                                    counted(run.flipped, "triangle of the blank is", "triangles of the blank are")));
    bool& polish = frame.ui.polish_steps;
    const bool waits = blank_of_steps_waits(document);
    if (!waits) {
        const bool polished = document.made_with.steps->polish;
        bool fine = document.session.blank->report.whole();
        for (size_t k = 0; k < document.steps.size(); ++k)
            fine &= step_status(document, k) == StepStatus::done;
        coloured(fine ? p.good : ImGui::GetStyleColorVec4(ImGuiCol_Text),
                 polished ? "Polished, in use for grid and surface" : "In use for grid and surface");
        if (small_button(frame, polished ? "Use it unpolished" : "Polish it"))
            frame.actions.push(UseBlankOfSteps{!polished});
        note_place(frame, "polish");
        tooltip(polished ? "Uses the blank of the steps unchanged"
                         : "Runs the one-step solution from it; all points may move again");
        ImGui::SameLine();
        if (small_button(frame, "Unfold in one step"))
            frame.actions.push(RunTo{Stage::solve});
        tooltip("Uses the blank of the one-step solution instead  (F6); the blank of the steps is kept here");
        return;
    }
    if (!other.empty())
        muted(frame, fmt::format("When used, its bends are laid with the K factor set now ({}).",
                                 k_words(document.session.options.k_factor)));
    if (primary_button(frame, "Use this blank", idle(frame)))
        frame.actions.push(UseBlankOfSteps{polish});
    note_place(frame, "use this blank");
    tooltip("Uses this blank for forming limits, grid, surface and files instead of the one-step blank");
    ImGui::Checkbox("Polish by the one-step solution", &polish);
    tooltip(
        "Runs the one-step solution from this blank; all points may move again. For parts made in several operations both blanks are approximations.");
}

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
    note_place(frame, "step by step");
    tooltip("Unfolds regions one after another onto target surfaces until the part is flat");
    if (appear)
        ImGui::SetScrollHereY(0); // the list has the room
    if (!open)
        return;
    next_button(frame);
    left_out_line(frame);
    given_up_line(frame);
    blank_of_steps(frame);
    slider(frame);
    for (size_t k = 0; k < document.steps.size(); ++k) {
        ImGui::PushID(int(k));
        step_row(frame, int(k));
        ImGui::PopID();
    }
    if (steps_done(document) > 0) {
        bool field = frame.state.view.field_on_steps;
        if (ImGui::Checkbox("Colour by the field", &field)) {
            ViewSettings settings = frame.state.view;
            settings.field_on_steps = field;
            frame.actions.push(SetViewSettings{settings});
        }
        tooltip("Colours the shown state by the field instead of by fixed (yellow) and moving (green) faces");
    }
    list_buttons(frame);
    new_step(frame);
}

} // namespace spia::viewer
