#include "app/viewer/panels/dialogs/picture_dialog.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/panels/dialogs/dialog_parts.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {
namespace {

using Size = PictureChoices::Size;
constexpr int longest = 16384; // pixels

const char* title_of(const std::optional<View>& view) { return view ? title(*view) : "The window"; }

ImVec2 pixels(const Frame& frame, const PictureChoices& choices)
{
    switch (choices.size) {
    case Size::full_hd: return {1920, 1080};
    case Size::ultra_hd: return {3840, 2160};
    case Size::own: return {float(choices.width), float(choices.height)};
    case Size::screen: break;
    }
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 size = choices.view ? frame.ui.view_size[size_t(*choices.view)] : io.DisplaySize,
                 dots = io.DisplayFramebufferScale;
    return size.x > 1 && size.y > 1 ? ImVec2(size.x * dots.x, size.y * dots.y)
                                    : ImVec2(1280, 800); // never shown so far
}

void size_input(Frame& frame, PictureChoices& choices)
{
    PictureChoices screen = choices;
    screen.size = Size::screen;
    const ImVec2 now = pixels(frame, screen);
    const std::string as_now = fmt::format("As on the screen, {} x {}", int(now.x), int(now.y));
    const std::pair<Size, const char*> sizes[] = {{Size::screen, as_now.c_str()},
                                                  {Size::full_hd, "1920 x 1080"},
                                                  {Size::ultra_hd, "3840 x 2160"},
                                                  {Size::own, "Custom size"}};
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##size", sizes[size_t(choices.size)].second)) {
        for (const auto& [size, label] : sizes)
            if (ImGui::Selectable(label, size == choices.size))
                choices.size = size;
        ImGui::EndCombo();
    }
    if (choices.size != Size::own)
        return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TableNextColumn();
    const float each = (ImGui::GetContentRegionAvail().x - 70 * frame.ui.scale) / 2;
    ImGui::SetNextItemWidth(each);
    ImGui::InputInt("##width", &choices.width, 0);
    ImGui::SameLine();
    ImGui::TextUnformatted("x");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(each);
    ImGui::InputInt("##height", &choices.height, 0);
    ImGui::SameLine();
    ImGui::TextUnformatted("px");
    choices.width = std::clamp(choices.width, 1, longest);
    choices.height = std::clamp(choices.height, 1, longest);
}

} // namespace

void picture_dialog(Frame& frame)
{
    PictureChoices& choices = frame.ui.picturing;
    const bool appears = std::exchange(frame.ui.show_picture, false);
    if (!begin_dialog(frame, "Picture", appears, 520))
        return;
    const std::string suggestion =
        suggested_file(frame, fmt::format("-{}.png", choices.view ? name(*choices.view) : "window")).string();
    if (appears || suggestion != choices.suggested)
        follow(choices.file, choices.suggested, suggestion);
    const auto labelled = [&](const char* label) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(label);
        ImGui::TableNextColumn();
    };
    old_results_banner(frame);
    bool choose = false;
    if (ImGui::BeginTable("choices", 2)) {
        ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 90 * frame.ui.scale);
        ImGui::TableSetupColumn("choice", ImGuiTableColumnFlags_WidthStretch);
        labelled("Shows");
        ImGui::SetNextItemWidth(-1);
        if (ImGui::BeginCombo("##view", title_of(choices.view))) {
            for (const std::optional<View> each :
                 {std::optional(View::part), std::optional(View::blank), std::optional(View::quads),
                  std::optional(View::surface), std::optional<View>()})
                if (ImGui::Selectable(title_of(each), each == choices.view))
                    choices.view = each;
            ImGui::EndCombo();
        }
        labelled("Size");
        size_input(frame, choices);
        ImGui::BeginDisabled(!choices.view.has_value()); // the window shows what it shows
        labelled("With");
        ImGui::Checkbox("Legend", &choices.legend);
        ImGui::SameLine(0, 16 * frame.ui.scale);
        ImGui::Checkbox("Labels", &choices.labels);
        labelled("Background");
        if (ImGui::RadioButton("As the theme", !choices.transparent))
            choices.transparent = false;
        ImGui::SameLine(0, 16 * frame.ui.scale);
        if (ImGui::RadioButton("Transparent", choices.transparent))
            choices.transparent = true;
        ImGui::EndDisabled();
        labelled("File");
        choose = path_input(frame, "file", choices.file, "a file for the picture");
        std::filesystem::path file = choices.file;
        if (!choices.file.empty())
            replaced_note(frame, file.extension() == ".png" ? file : file += ".png");
        ImGui::EndTable();
    }
    if (choose) {
        ImGui::CloseCurrentPopup();
        frame.ui.files.open(FileDialog::Purpose::save_picture, choices.file);
    }
    const bool ready = !choices.file.empty();
    const Answer answer = answer_buttons(frame, "Save the picture", ready, palette_of(frame.state.view.dark).accent);
    if (ready && (answer == Answer::yes || (enter_pressed(frame) && !choose))) {
        std::filesystem::path file = choices.file;
        if (file.extension() != ".png")
            file += ".png";
        const ImVec2 size = pixels(frame, choices);
        frame.actions.push(Screenshot{file, choices.view, int(size.x), int(size.y), choices.legend, choices.labels,
                                      choices.transparent && choices.view});
        ImGui::CloseCurrentPopup();
    }
    if (answer == Answer::cancel)
        ImGui::CloseCurrentPopup();
    end_dialog();
}

} // namespace spia::viewer
