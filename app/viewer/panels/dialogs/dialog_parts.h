#pragma once
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>

#include "app/viewer/panels/ui.h"

/// What the dialogs have in common.
namespace spia::viewer {

/// A modal window in the middle of the screen, as high as its content; if it is open, call
/// end_dialog(). It is to be called in every frame in which the dialog is open or waits behind
/// another one (DialogQueue); one that is not called is closed.
/// @param title no other dialog has it; what follows "###" is not shown
/// @param appears opens it now
/// @param width at content scale 1
/// @param urgent it goes before other dialogs, which come back after it
bool begin_dialog(const Frame& frame, const char* title, bool appears, float width, bool urgent = false);

void end_dialog();

/// Likewise a modal window whose size and place are set by the caller; if it is open, call
/// ImGui::EndPopup().
bool begin_modal(const Frame& frame, const char* title, bool appears, ImGuiWindowFlags flags, bool* stays = nullptr,
                 bool urgent = false);

/// Whether the key was pressed since the last frame.
bool pressed(const Frame& frame, int key);
/// Return on either side of the keyboard.
bool enter_pressed(const Frame& frame);

/// Begins a row of a form, a table of two columns: its label; what is asked comes next.
void form_row(const char* label);

/// A line to type a file or folder into, and a button that lets choose it. @returns whether the
/// button was pressed
bool path_input(const Frame& frame, const char* id, std::string& path, const char* hint);

/// Says that a file is there already and will be replaced.
void replaced_note(const Frame& frame, const std::filesystem::path& file);

/// Buttons below each other, the first one in a colour. Tab and the arrows go from one to the next,
/// Return takes the one that is marked, at the beginning the first, Escape the last. @returns which
/// was chosen
struct StackedAnswer {
    const char *label, *help = "";
};
std::optional<size_t> stacked_answers(const Frame& frame, std::initializer_list<StackedAnswer> answers);

/// Two buttons at the lower right: the one that does it, in a colour, and Cancel.
enum class Answer { none, yes, cancel };
float answer_buttons_height(const Frame& frame); ///< pixels
Answer answer_buttons(const Frame& frame, const char* yes, bool enabled, const ImVec4& colour);

/// A file in the folder where the user works, see model/document/suggested_files.h.
std::filesystem::path suggested_file(const Frame& frame, const std::string& ending);

/// Open the file dialog where the user works.
void choose_part(Frame& frame);
void choose_project(Frame& frame);
void choose_project_name(Frame& frame);

/// @param suggested what the path was set to last; as long as the user has typed no other, it
/// follows the part
void follow(std::string& path, std::string& suggested, const std::string& suggestion);

/// A warning if the results are older than the options, with a way to make them anew first; while a
/// job runs how far it is. The dialog stays.
void old_results_banner(Frame& frame);

} // namespace spia::viewer
