#include "app/viewer/panels/dialogs/animation_dialog.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

// pixels
constexpr std::array<std::array<int, 2>, 4> sizes{{{640, 480}, {960, 640}, {1280, 720}, {1920, 1080}}};

std::string words(const std::array<int, 2>& size) { return fmt::format("{} x {}", size[0], size[1]); }

void choice_rows(Frame& frame, AnimationChoices& choices)
{
    const float s = frame.ui.scale;
    form_row("As");
    if (ImGui::RadioButton("GIF", choices.gif))
        choices.gif = true;
    ImGui::SameLine(0, 16 * s);
    if (ImGui::RadioButton("Numbered pictures (PNG)", !choices.gif))
        choices.gif = false;
    form_row("Size");
    ImGui::SetNextItemWidth(150 * s);
    if (ImGui::BeginCombo("##size", words(sizes[size_t(choices.size)]).c_str())) {
        for (size_t k = 0; k < sizes.size(); ++k)
            if (ImGui::Selectable(words(sizes[k]).c_str(), int(k) == choices.size))
                choices.size = int(k);
        ImGui::EndCombo();
    }
    form_row("Pictures");
    ImGui::SetNextItemWidth(150 * s);
    typed_integer(frame, "from part to blank", choices.frames, 4);
    choices.frames = std::clamp(choices.frames, 2, 500);
    ImGui::BeginDisabled(!choices.gif);
    form_row("Duration");
    ImGui::SetNextItemWidth(150 * s);
    typed_number(frame, "seconds", choices.seconds, "%.3g", 0.5);
    choices.seconds = std::clamp(choices.seconds, 0.1, 600.);
    form_row("At the end");
    ImGui::Checkbox("back to the part", &choices.back);
    ImGui::EndDisabled();
    form_row("With");
    ImGui::Checkbox("Legend", &choices.legend);
}

} // namespace

void animation_dialog(Frame& frame)
{
    AnimationChoices& choices = frame.ui.animating;
    const bool appears = std::exchange(frame.ui.show_animation, false);
    if (!begin_dialog(frame, "Animation", appears, 520))
        return;
    const std::string ending = choices.gif ? ".gif" : ".png";
    const std::string suggestion = suggested_file(frame, "-unfolding" + ending).string();
    if (appears || suggestion != choices.suggested)
        follow(choices.file, choices.suggested, suggestion);
    muted(frame, steps_done(frame.state.document) > 0
                     ? "The part unfolding step by step, seen as in the view of the part."
                     : "The part turning into the blank, seen as in the view of the part. There are no single steps: "
                       "the part was unfolded in one step.");
    bool choose = false;
    std::filesystem::path file = choices.file;
    if (ImGui::BeginTable("choices", 2)) {
        ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 90 * frame.ui.scale);
        ImGui::TableSetupColumn("choice", ImGuiTableColumnFlags_WidthStretch);
        choice_rows(frame, choices);
        form_row("File");
        choose = path_input(frame, "file", choices.file, "a file for the animation");
        file = choices.file;
        if (file.extension() != ending)
            file.replace_extension(ending);
        if (choices.file.empty())
            muted(frame, "Name a file.");
        else if (choices.gif)
            replaced_note(frame, file);
        else
            muted(frame, fmt::format("{0}-001.png to {0}-{1:03}.png", file.stem().string(), choices.frames));
        ImGui::EndTable();
    }
    if (choose) {
        ImGui::CloseCurrentPopup();
        frame.ui.files.open(FileDialog::Purpose::save_animation, choices.file);
    }
    const bool ready = !choices.file.empty() && !frame.ui.animation;
    const Answer answer = answer_buttons(frame, "Make the animation", ready, palette_of(frame.state.view.dark).accent);
    if (ready && (answer == Answer::yes || (enter_pressed(frame) && !choose))) {
        const auto& size = sizes[size_t(choices.size)];
        frame.actions.push(SaveAnimation{file, choices.frames, choices.seconds, size[0], size[1], choices.legend,
                                         choices.back && choices.gif});
        ImGui::CloseCurrentPopup();
    }
    if (answer == Answer::cancel)
        ImGui::CloseCurrentPopup();
    end_dialog();
}

} // namespace spia::viewer
