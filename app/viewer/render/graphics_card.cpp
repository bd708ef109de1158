#include "app/viewer/render/graphics_card.h"

#include <epoxy/gl.h>

namespace spia::viewer {

static std::string text_of(GLenum name)
{
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "unknown";
}

GraphicsCard graphics_card() { return {text_of(GL_RENDERER), text_of(GL_VERSION)}; }

} // namespace spia::viewer
