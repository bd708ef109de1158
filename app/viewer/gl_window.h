#pragma once
#include <vector>

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
    static Picture picture(int width, int height);
    /// Keys that were pressed since this was last emptied.
    static std::vector<KeyPress>& keys();
    /// Whether anything has happened since this was last set to false.
    static bool& news();

private:
    GLFWwindow* window_;
};

/// ImGui with its backends for the window.
struct ImGuiContextOwner {
    explicit ImGuiContextOwner(GLFWwindow* window);
    ~ImGuiContextOwner();
    ImGuiContextOwner(const ImGuiContextOwner&) = delete;
    ImGuiContextOwner& operator=(const ImGuiContextOwner&) = delete;
};

} // namespace spia::viewer
