#pragma once
#include <GLFW/glfw3.h>

#include "engine/core/error.h"

namespace spia::viewer {

/// A window that is never shown, with OpenGL 3.3 core; or with what the driver has.
struct HiddenWindow {
    explicit HiddenWindow(bool core_3_3 = true)
    {
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        if (core_3_3) {
            glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
            glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
            glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        }
        window = glfwCreateWindow(64, 64, "test", nullptr, nullptr);
        if (!window)
            throw Error("no window; is there a display?");
        glfwMakeContextCurrent(window);
    }
    ~HiddenWindow() { glfwDestroyWindow(window); }
    HiddenWindow(const HiddenWindow&) = delete;
    HiddenWindow& operator=(const HiddenWindow&) = delete;
    GLFWwindow* window;
};

} // namespace spia::viewer
