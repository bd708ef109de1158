#include "app/viewer/render/gl_objects.h"

#include <fmt/core.h>

#include "app/viewer/render/graphics_card.h"
#include "engine/core/error.h"

namespace spia::viewer {
namespace {

const char* words(GLenum error)
{
    switch (error) {
    case GL_INVALID_ENUM: return "invalid enum";
    case GL_INVALID_VALUE: return "invalid value";
    case GL_INVALID_OPERATION: return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION: return "incomplete framebuffer";
    case GL_OUT_OF_MEMORY: return "out of graphics memory";
    }
    return "unknown error";
}

} // namespace

void check_gl(const char* doing)
{
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR)
        return;
    constexpr int most = 100; // a lost context complains without end
    for (int i = 0; i < most && glGetError() != GL_NO_ERROR; ++i) {
    }
    throw Error(fmt::format(
        "OpenGL failed while {}: {} (0x{:04x}) on {}; {}", doing, words(error), error, graphics_card().renderer,
        error == GL_OUT_OF_MEMORY ? "close other programs or show a smaller part" : "update the graphics driver"));
}

void require_gl_3_3()
{
    constexpr int least = 33;
    const int version = epoxy_gl_version();
    if (version >= least && epoxy_is_desktop_gl())
        return;
    throw Error(fmt::format(
        "the viewer needs OpenGL 3.3; here there is {} {}.{} on {}. Update the graphics driver, or draw "
        "without it: set LIBGL_ALWAYS_SOFTWARE=1. The command line program spia needs no OpenGL.",
        epoxy_is_desktop_gl() ? "OpenGL" : "OpenGL ES", version / 10, version % 10, graphics_card().renderer));
}

} // namespace spia::viewer
