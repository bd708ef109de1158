#pragma once
#include <imgui.h>
#include <string>

#include "app/viewer/panels/ui.h"

namespace spia::viewer {

/// A button that is hardly higher than a line of text; letters keep room below it.
bool small_button(const Frame& frame, const char* label);

/// A button follows: beside the last item where there is room for it, else below.
void beside_if_room(const char* label);

/// The one obvious next step: a wide button in the accent colour.
bool primary_button(const Frame& frame, const char* label, bool enabled = true);

enum class Status { nothing, done, poor, stale, failed };

/// Heading of a step with its number and a mark of how it stands.
void step_heading(const Frame& frame, int number, const char* title, Status status);

/// A part of a panel that scrolls, its text clear of the scroll bar; another part begins at its
/// top. End it with ImGui::EndChild().
/// @param height  pixels; negative: what it leaves below
void begin_scrolled(const Frame& frame, const char* name, float height);

/// A text in lines of this width (pixels), broken at spaces only; see model/reports/wrapped_text.h.
std::string broken(const std::string& text, float room);
/// A text on one line of this width (pixels): what there is no room for goes from its middle.
std::string without_middle(const std::string& text, float room);
/// A text as wide as there is room; the one way in which texts wrap.
void wrapped(const std::string& text);

/// What the engine says, in the viewer's words and in the unit of the screen.
std::string engine_words(const Frame& frame, std::string text);

/// The next item, whose label stands behind it, is as wide as the panel lets it: for choices whose
/// texts are long.
void wide_item(const char* label);
/// The next item, a choice, is wide enough for the longest of its texts, as far as there is room
/// for it.
void item_for(const char* longest);

/// To be called in a panel that scrolls, behind all of it: the item that was clicked last stays
/// under the mouse when what is above it becomes higher or lower.
void keep_in_place(Frame& frame);

/// A small grey line; wraps.
void muted(const Frame& frame, const std::string& text);
void coloured(const ImVec4& colour, const std::string& text);

/// A text against the right border of its cell; a heading is grey.
void right_aligned(const std::string& text, bool heading = false);

/// A row "name   value" in two columns.
void figure(const Frame& frame, const char* name, const std::string& value);

/// Shown while the last item is under the mouse: beside its panel or list, else below or above it,
/// never over it.
/// @param lower  pixels that stay free below the item
void tooltip(const std::string& text, float lower = 0);

/// A button with white bold letters on a colour.
bool coloured_button(const Frame& frame, const char* label, ImVec2 size, const ImVec4& colour);

/// Numbers that are typed, one to three in a row; with a step they have buttons. What is typed
/// counts when typing ends, by Return, Tab, a shortcut or a click elsewhere; Escape takes it back.
/// What is no number is refused with a message, and the number before stays (Ui::number_refused).
/// @param value the numbers now. @param format of printf, as they are shown while nobody types;
/// null: with all digits
/// @returns whether they have just been changed, in `value`
bool typed_numbers(Frame& frame, const char* label, double* value, int count, const char* format, double step = 0);
inline bool typed_number(Frame& frame, const char* label, double& value, const char* format, double step = 0)
{
    return typed_numbers(frame, label, &value, 1, format, step);
}
bool typed_integer(Frame& frame, const char* label, int& value, int step = 0);
/// To be called before a frame is drawn: what is typed into a slider (Ctrl and a click) may have a
/// comma before its decimals, as it may in the fields above.
void points_for_commas();
/// How lengths are typed, by unit; the numbers themselves are mm.
struct LengthFormat {
    const char* mm = "%.4g";
    const char* inch = "%.4f";         ///< 0.0025 mm
    double step_mm = 0, step_inch = 0; ///< of the buttons; 0: there are none
};
/// Likewise lengths, shown and typed in a unit and kept in mm. One that is not typed does not
/// change, not even by rounding.
bool length_inputs(Frame& frame, const char* label, double* mm, int count, LengthUnit unit, const LengthFormat& format);
/// One, in the unit of the preferences, whose name stands behind the label's: "Thickness" becomes
/// "Thickness, mm".
bool length_input(Frame& frame, const char* label, double& mm, const LengthFormat& format = {});
/// The same for a line of text. An empty one is no change.
bool typed_text(Frame& frame, const char* label, std::string& text, const char* hint);

/// What picking does with what is picked: Shift adds, Ctrl takes away.
PickMode pick_mode();

ImU32 ink(const Colour& colour, float opacity = 1);
inline ImU32 ink(const ImVec4& c) { return ImGui::ColorConvertFloat4ToU32(c); }

} // namespace spia::viewer
