#pragma once
#include <array>
#include <imgui.h>
#include <optional>

/// What ImGui has only inside.
namespace spia::viewer {

/// Closes open menus, lists and pickers, but no dialog that waits for an answer. @returns whether
/// there was any
bool close_menus();
/// Whether there are any. Before NewFrame(): that closes a menu itself with Escape, which then
/// means nothing else.
bool menus_are_open();

/// Return takes what is chosen by the arrows in an open menu or list, as Space does; for ImGui it
/// is for text alone. To be called before NewFrame(). @returns whether it did, so that the dialog
/// that the entry opens does not take it for an answer
bool take_return_in_menus();

/// The item that the keyboard is at, where a frame marks it; corners in the window, pixels. None:
/// no item is marked.
std::optional<std::array<ImVec2, 2>> marked_item();

/// Whether the keyboard is at an item of the current window.
bool is_at(const char* label);
/// Puts the keyboard at the last item, and marks it.
void go_to_last_item();

/// Closes the dialog that is on the screen, with what it has opened.
void close_dialogs();

/// Ends a frame that an exception has left in the middle, so that the next one can begin; nothing
/// of it is drawn. No effect between two frames.
void end_broken_frame();

} // namespace spia::viewer
