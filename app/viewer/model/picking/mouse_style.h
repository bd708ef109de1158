#pragma once
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/viewer/model/picking/camera.h"

namespace spia::viewer {

/// Whose habits the mouse follows in the views.
enum class MouseStyle { spia, nx, catia, solidworks, inspire, blender };
inline constexpr MouseStyle all_mouse_styles[] = {MouseStyle::spia,       MouseStyle::nx,      MouseStyle::catia,
                                                  MouseStyle::solidworks, MouseStyle::inspire, MouseStyle::blender};
std::string_view name(MouseStyle style);               ///< "spia", ...
MouseStyle mouse_style_by_name(std::string_view name); ///< @throws InputError
const char* title(MouseStyle style);                   ///< for people

/// What the mouse does to the camera.
enum class Navigation { none, turn, pan, zoom };

/// Buttons and keys that are down.
struct MouseHeld {
    bool left = false, middle = false, right = false, shift = false, ctrl = false;

    bool any_button() const { return left || middle || right; }
};

/// One way to move the camera, in words: "Shift + middle button", "pan".
struct MouseHabit {
    std::string how, does;
};
/// All of a style, the wheel among them.
std::vector<MouseHabit> habits(MouseStyle style);

/// Whether the wheel, rolled away from the user, makes things larger.
bool forward_enlarges(MouseStyle style);

/// Turns what is pressed into what the camera does, from the press of the first button to the
/// release of the last. The camera waits until the mouse has left the place of the press, so that a
/// click moves nothing.
class Navigator {
public:
    /// What one frame brings.
    struct Step {
        Navigation does = Navigation::none;
        glm::dvec2 drag{0};  ///< pixels
        bool centre = false; ///< the place under the mouse comes into the middle of the view
    };

    /// @param pressed  a button went down in this frame
    /// @param drag     pixels since the last frame
    /// @param may_begin  the mouse is in a view and does nothing else there
    /// @param left_is_free  the tool has no use for the left button
    /// @param slack    pixels that a hand moves in a click
    Step follow(MouseStyle style, const MouseHeld& held, bool pressed, glm::dvec2 drag, bool may_begin,
                bool left_is_free, double slack);

    bool busy() const { return busy_; }       ///< from the press to the release
    bool dragged() const { return dragged_; } ///< the last press has become a drag, no click
    Navigation does() const { return does_; }
    void end() { busy_ = false, does_ = Navigation::none; }

private:
    void follow_catia(const MouseHeld& held);

    bool busy_ = false, dragged_ = false, middle_alone_ = false, ctrl_first_ = false, side_used_ = false;
    Navigation does_ = Navigation::none;
    MouseHeld before_, keys_; ///< of the last frame; as they were when a button went down
    glm::dvec2 withheld_{0};  ///< pixels, while it may still become a click
};

/// Turned, panned or zoomed by a drag; zooming is about the middle of the view, larger by dragging
/// up.
Camera moved(const Camera& camera, const Navigator::Step& step, glm::dvec2 size);

} // namespace spia::viewer
