#pragma once

/// What ImGui has only inside.
namespace spia::viewer {

/// Closes open menus, lists and pickers, but no dialog that waits for an answer. @returns whether there was any
bool close_menus();

/// Ends a frame that an exception has left in the middle, so that the next one can begin; nothing of it is drawn. No
/// effect between two frames.
void end_broken_frame();

} // namespace spia::viewer
