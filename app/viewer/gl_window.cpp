#include "app/viewer/gl_window.h"

#include <epoxy/gl.h>
// after epoxy
#include <GLFW/glfw3.h>
#include <algorithm>
#include <fmt/core.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include "engine/core/error.h"

namespace spia::viewer {
namespace {

/// GLFW calls keys by their places on an American keyboard; people go by what is printed on them.
int in_layout(int key, int scan_code)
{
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_EQUAL)
        return key;
    const char* name = glfwGetKeyName(key, scan_code);
    if (!name || name[0] == 0 || name[1] != 0)
        return key;
    if (name[0] >= 'a' && name[0] <= 'z')
        return GLFW_KEY_A + (name[0] - 'a');
    return name[0] == '+' ? GLFW_KEY_EQUAL : name[0] == '-' ? GLFW_KEY_MINUS : key;
}

constexpr int first_width = 1440, first_height = 900;

/// Of the first screen, without what the desktop keeps for itself and the frame of a window; in
/// pixels at content scale 1, as sizes of new windows are told.
std::pair<int, int> room_on_screen()
{
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (!monitor)
        return {first_width, first_height};
    int x = 0, y = 0, width = 0, height = 0;
    float scale_x = 1, scale_y = 1;
    glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
    glfwGetMonitorContentScale(monitor, &scale_x, &scale_y);
    constexpr int title_bar = 32, least = 320;
    return {std::max(least, int(float(width) / std::max(scale_x, 1.f))),
            std::max(least, int(float(height) / std::max(scale_y, 1.f)) - title_bar)};
}

std::string& last_error()
{
    static std::string text;
    return text;
}

} // namespace

GlWindow::GlWindow(int width, int height, bool visible)
{
    glfwSetErrorCallback([](int, const char* text) { last_error() = text; });
    if (!glfwInit())
        throw Error(fmt::format("no window can be opened ({}); is there a display? Without one, use the command line: "
                                "spia run PART",
                                last_error()));
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_VISIBLE, visible);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    const auto [room_x, room_y] = room_on_screen();
    window_ = glfwCreateWindow(width > 0 ? width : std::min(first_width, room_x),
                               height > 0 ? height : std::min(first_height, room_y), "SPIA", nullptr, nullptr);
    if (!window_) {
        glfwTerminate();
        throw Error(
            fmt::format("this display offers no OpenGL 3.3 ({}); update the graphics driver, or use the command "
                        "line: spia run PART",
                        last_error()));
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    // ImGui's own callbacks, which come later, pass every event on to these.
    glfwSetCursorPosCallback(window_, [](GLFWwindow*, double x, double y) {
        news() = true;
        mouse().moved({x, y});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow*, int, int action, int) {
        news() = true;
        mouse().button(action == GLFW_PRESS);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow*, double, double) { news() = true; });
    glfwSetKeyCallback(window_, [](GLFWwindow*, int key, int scan_code, int action, int modifiers) {
        news() = true;
        if (action == GLFW_PRESS) // a tap may be shorter than a frame
            keys().push_back({in_layout(key, scan_code), modifiers});
    });
    glfwSetCharCallback(window_, [](GLFWwindow*, unsigned) { news() = true; });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow*, int) { news() = true; });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow*, int, int) { news() = true; });
    glfwSetWindowContentScaleCallback(window_, [](GLFWwindow*, float, float) { news() = true; });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow*) { news() = true; });
}

GlWindow::~GlWindow()
{
    glfwDestroyWindow(window_);
    glfwTerminate();
}

float GlWindow::content_scale() const
{
    float scale = 1;
    glfwGetWindowContentScale(window_, &scale, nullptr);
    return std::max(1.f, scale);
}

Picture GlWindow::picture(int width, int height)
{
    Picture picture{width, height, std::vector<uint8_t>(size_t(width) * size_t(height) * 4)};
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
    const size_t row = size_t(width) * 4;
    for (size_t low = 0, high = size_t(height) - 1; low < high; ++low, --high)
        std::swap_ranges(picture.rgba.begin() + long(low * row), picture.rgba.begin() + long((low + 1) * row),
                         picture.rgba.begin() + long(high * row));
    for (size_t k = 3; k < picture.rgba.size(); k += 4)
        picture.rgba[k] = 255;
    return picture;
}

std::vector<KeyPress>& GlWindow::keys()
{
    static std::vector<KeyPress> pressed;
    return pressed;
}

MouseTrail& GlWindow::mouse()
{
    static MouseTrail trail;
    return trail;
}

void GlWindow::place_mouse()
{
    if (const auto at = mouse().next())
        ImGui::GetIO().MousePos = {float(at->x), float(at->y)};
}

std::vector<glm::dvec2> GlWindow::take_path() { return mouse().take_path(); }

void GlWindow::call(const std::string& title)
{
    if (title != title_)
        glfwSetWindowTitle(window_, title.c_str());
    title_ = title;
}

bool& GlWindow::news()
{
    static bool happened = true;
    return happened;
}

ImGuiContextOwner::ImGuiContextOwner(GLFWwindow* window)
{
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // what is kept is in the project
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

ImGuiContextOwner::~ImGuiContextOwner()
{
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

} // namespace spia::viewer
