#include "app/viewer/model/picking/mouse_style.h"

#include <cctype>
#include <cmath>
#include <optional>
#include <span>

#include "app/viewer/model/actions/names.h"

namespace spia::viewer {
namespace {

enum Button : unsigned { left = 1, middle = 2, right = 4 };
enum Key : unsigned { no_key = 0, shift = 1, ctrl = 2 };

/// What buttons held together do, with these keys and no others.
struct Binding {
    unsigned buttons, keys;
    Navigation does;
};

// The program's own. The left button turns only where the tool has no use for it.
constexpr Binding of_spia[] = {{left, no_key, Navigation::turn},
                               {right, no_key, Navigation::turn},
                               {middle, no_key, Navigation::pan},
                               {right, shift, Navigation::pan}};
// NX: middle turns; Shift or the right button with it pans, Ctrl or the left button with it zooms.
// As listed in https://github.com/KittyCAD/modeling-app/pull/411 and in the navigation style of
// FreeCAD that is called after NX (https://wiki.freecad.org/Mouse_navigation, where Shift or the
// right button pans and the left one zooms). Neither tells the sense of the wheel: it is the
// program's own.
constexpr Binding of_nx[] = {{middle, no_key, Navigation::turn},
                             {middle | right, no_key, Navigation::pan},
                             {middle, shift, Navigation::pan},
                             {middle | left, no_key, Navigation::zoom},
                             {middle, ctrl, Navigation::zoom}};
// SolidWorks: middle turns, with Ctrl it pans, with Shift it zooms (FreeCAD's style of that name,
// same page); the sense of the wheel is that of IMouse::MouseWheelXYZ,
// https://help.solidworks.com/2024/english/api/sldworksapi (120, which is forward, zooms out).
constexpr Binding of_solidworks[] = {
    {middle, no_key, Navigation::turn}, {middle, ctrl, Navigation::pan}, {middle, shift, Navigation::zoom}};
// Inspire: middle turns, right pans, the wheel zooms. No public text that says so was found
// (neither help pages nor source of others): it is from hearsay, and so is the sense of the wheel,
// the program's own.
constexpr Binding of_inspire[] = {{middle, no_key, Navigation::turn}, {right, no_key, Navigation::pan}};
// Blender: middle turns, with Shift it pans, with Ctrl it zooms: view3d.rotate, view3d.move and
// view3d.zoom of its default key map
// (https://docs.blender.org/manual/en/latest/editors/3dview/navigate/navigation.html). The wheel
// enlarges forward (https://github.com/x3dom/x3dom/issues/454 lists it among those that do).
constexpr Binding of_blender[] = {
    {middle, no_key, Navigation::turn}, {middle, shift, Navigation::pan}, {middle, ctrl, Navigation::zoom}};
// CATIA is no table: what the second button does depends on whether it is still down.
// Navigator::follow_catia().

std::span<const Binding> bindings(MouseStyle style)
{
    switch (style) {
    case MouseStyle::spia: return of_spia;
    case MouseStyle::nx: return of_nx;
    case MouseStyle::solidworks: return of_solidworks;
    case MouseStyle::inspire: return of_inspire;
    case MouseStyle::blender: return of_blender;
    case MouseStyle::catia: break;
    }
    return {};
}

unsigned buttons_of(const MouseHeld& held)
{
    return (held.left ? left : 0u) | (held.middle ? middle : 0u) | (held.right ? right : 0u);
}
unsigned keys_of(const MouseHeld& held) { return (held.shift ? shift : 0u) | (held.ctrl ? ctrl : 0u); }

std::optional<Navigation> bound(MouseStyle style, unsigned buttons, unsigned keys)
{
    for (const Binding& each : bindings(style))
        if (each.buttons == buttons && each.keys == keys)
            return each.does;
    for (const Binding& each : bindings(style)) // keys that mean nothing with these buttons
        if (each.buttons == buttons && each.keys == no_key)
            return each.does;
    return std::nullopt;
}

const char* words(Navigation does)
{
    switch (does) {
    case Navigation::turn: return "turn";
    case Navigation::pan: return "pan";
    case Navigation::zoom: return "zoom; up: larger";
    case Navigation::none: break;
    }
    return "";
}

std::string words(const Binding& binding)
{
    std::string text = binding.keys & shift ? "Shift + " : binding.keys & ctrl ? "Ctrl + " : "";
    std::string buttons;
    for (const auto& [button, called] :
         {std::pair(middle, "middle"), std::pair(left, "left"), std::pair(right, "right")})
        if (binding.buttons & button)
            buttons += (buttons.empty() ? "" : " + ") + std::string(called);
    text += buttons + " button" + (buttons.find('+') == buttons.npos ? "" : "s");
    text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

} // namespace

std::string_view name(MouseStyle style) { return name_in_table(style); }
MouseStyle mouse_style_by_name(std::string_view name) { return value_by_name<MouseStyle>(name); }

const char* title(MouseStyle style)
{
    switch (style) {
    case MouseStyle::spia: return "SPIA";
    case MouseStyle::nx: return "Siemens NX";
    case MouseStyle::catia: return "CATIA";
    case MouseStyle::solidworks: return "SolidWorks";
    case MouseStyle::inspire: return "Altair Inspire";
    case MouseStyle::blender: return "Blender";
    }
    return "";
}

bool forward_enlarges(MouseStyle style) { return style != MouseStyle::solidworks; }

std::vector<MouseHabit> habits(MouseStyle style)
{
    std::vector<MouseHabit> list;
    if (style == MouseStyle::catia)
        list = {{"Middle button", "pan; a click brings the place into the middle"},
                {"Middle, then hold left or right", "turn; also middle, then Ctrl"},
                {"Middle, then click left or right", "zoom from then on; up: larger"},
                {"Ctrl, then middle", "zoom"}};
    for (const Binding& each : bindings(style)) {
        const bool left_alone = each.buttons == left;
        list.push_back({words(each), std::string(words(each.does)) + (left_alone ? ", with the tool Look" : "")});
    }
    list.push_back({"Wheel", forward_enlarges(style) ? "zoom to the place under the mouse; forward: larger"
                                                     : "zoom to the place under the mouse; towards you: larger"});
    return list;
}

Navigator::Step Navigator::follow(MouseStyle style, const MouseHeld& held, bool pressed, glm::dvec2 drag,
                                  bool may_begin, bool left_is_free, double slack)
{
    Step step;
    if (!busy_) {
        if (!pressed || !may_begin)
            return step;
        const bool only_left = held.left && !held.middle && !held.right;
        const bool begins = style == MouseStyle::catia ? held.middle : bound(style, buttons_of(held), 0).has_value();
        if (!begins || (only_left && !left_is_free))
            return step;
        busy_ = true;
        dragged_ = side_used_ = false;
        does_ = Navigation::none;
        withheld_ = drag = {0, 0}; // what came before the press
        middle_alone_ = buttons_of(held) == middle;
        ctrl_first_ = held.ctrl;
        keys_ = before_ = held;
        if (style == MouseStyle::catia)
            does_ = held.left || held.right ? Navigation::turn : held.ctrl ? Navigation::zoom : Navigation::pan;
        side_used_ = held.left || held.right;
    }
    if (!held.any_button()) {
        step.centre = style == MouseStyle::catia && middle_alone_ && !dragged_;
        end();
        return step;
    }
    middle_alone_ &= !held.left && !held.right;
    if (style == MouseStyle::catia)
        follow_catia(held);
    else {
        if (pressed)
            keys_ = held; // released keys go on to count until a button is pressed anew
        const bool fewer = (buttons_of(before_) & ~buttons_of(held)) != 0;
        if (const auto now = bound(style, buttons_of(held), keys_of(keys_)))
            does_ = *now;
        else if (fewer)
            does_ = Navigation::none;
    }
    before_ = held;
    withheld_ += drag;
    if (!dragged_ && glm::length(withheld_) <= slack)
        return step;
    dragged_ = true;
    step.does = does_;
    if (does_ != Navigation::none)
        step.drag = withheld_;
    withheld_ = {0, 0};
    return step;
}

// CATIA V5: middle pans; while it is down a second button turns as long as it is held, and after
// its release the drag zooms (https://github.com/KittyCAD/modeling-app/issues/4456). 3DEXPERIENCE:
// Ctrl before middle zooms, Ctrl after it turns
// (https://github.com/KittyCAD/modeling-app/issues/2134). A click of the middle button centres the
// view there. The wheel moves no part there (same issue); here it zooms all the same, in the
// program's own sense.
void Navigator::follow_catia(const MouseHeld& held)
{
    const bool side = held.left || held.right;
    if (!held.middle) {
        does_ = Navigation::none;
        return;
    }
    if (side)
        does_ = Navigation::turn;
    else if (side_used_)
        does_ = Navigation::zoom;
    else if (!ctrl_first_)
        does_ = held.ctrl ? Navigation::turn : Navigation::pan;
    side_used_ |= side;
}

Camera moved(const Camera& camera, const Navigator::Step& step, glm::dvec2 size)
{
    constexpr double by_whole_view = 8; // larger, by a drag from its lower border to its upper one
    switch (step.does) {
    case Navigation::turn: return orbit(camera, step.drag, size);
    case Navigation::pan: return pan(camera, step.drag, size);
    case Navigation::zoom: return zoom(camera, std::pow(by_whole_view, -step.drag.y / size.y), size / 2., size);
    case Navigation::none: break;
    }
    return camera;
}

} // namespace spia::viewer
