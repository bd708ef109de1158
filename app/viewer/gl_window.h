#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "app/viewer/panels/mouse_trail.h"
#include "app/viewer/panels/ui.h"
#include "app/viewer/render/renderer.h"

struct GLFWwindow;

namespace spia::viewer {

/// GLFW, its window and the context of OpenGL. One per program.
class GlWindow {
public:
    /// @throws Error if there is no display, or no OpenGL 3.3
    GlWindow(int width, int height, bool visible);
    ~GlWindow();
    GlWindow(const GlWindow&) = delete;
    GlWindow& operator=(const GlWindow&) = delete;
    GLFWwindow* get() const { return window_; }
    /// What the window shows before its buffers are swapped. @param width, height  pixels
    float content_scale() const; ///< of the screen it is on: 1 for 96 dots per inch, and no less
    static Picture picture(int width, int height);
    /// Keys that were pressed since this was last emptied.
    static std::vector<KeyPress>& keys();
    /// Between the backend's part of a frame and ImGui's: the mouse is where it was pressed or let
    /// go since the last frame.
    static void place_mouse();
    /// Where the mouse went with a button down since the last call.
    static std::vector<glm::dvec2> take_path();
    void call(const std::string& title);
    /// Whether anything has happened since this was last set to false.
    static bool& news();

private:
    static MouseTrail& mouse();
    GLFWwindow* window_;
    std::string title_;
};

/// ImGui with its backends for the window.
struct ImGuiContextOwner {
    explicit ImGuiContextOwner(GLFWwindow* window);
    ~ImGuiContextOwner();
    ImGuiContextOwner(const ImGuiContextOwner&) = delete;
    ImGuiContextOwner& operator=(const ImGuiContextOwner&) = delete;
};

} // namespace spia::viewer
