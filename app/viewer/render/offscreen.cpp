#include "app/viewer/render/offscreen.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia::viewer {
namespace {

int limit(GLenum name)
{
    GLint value[2] = {0, 0}; // the limit of viewports has two
    glGetIntegerv(name, value);
    return value[0];
}

void require_complete(int width, int height)
{
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw Error(fmt::format("OpenGL cannot draw a picture of {} x {} pixels (framebuffer status 0x{:04x}); make it "
                                "smaller or update the graphics driver",
                                width, height, status));
}

} // namespace

int longest_side()
{
    return std::min({limit(GL_MAX_TEXTURE_SIZE), limit(GL_MAX_RENDERBUFFER_SIZE), limit(GL_MAX_VIEWPORT_DIMS)});
}

Offscreen::Offscreen(int width, int height, int samples) : width_(width), height_(height), samples_asked_(samples)
{
    if (const int most = longest_side(); width < 1 || height < 1 || width > most || height > most)
        throw Error(
            fmt::format("a view of {} x {} pixels cannot be drawn; its sides may have 1 to {}", width, height, most));
    const int used = std::clamp(samples, 1, std::max(1, limit(GL_MAX_SAMPLES)));
    const auto reserve = [&](GLuint buffer, GLenum format) {
        glBindRenderbuffer(GL_RENDERBUFFER, buffer);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, used > 1 ? used : 0, format, width, height);
    };
    reserve(colour_, GL_RGBA8);
    reserve(depth_, GL_DEPTH_COMPONENT24);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);

    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    check_gl("making room for a view");

    glBindFramebuffer(GL_FRAMEBUFFER, drawn_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    require_complete(width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    require_complete(width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    check_gl("making room for a view");
}

void Offscreen::begin() const
{
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_);
    glViewport(0, 0, width_, height_);
}

void Offscreen::clear() const
{
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

std::vector<uint8_t> Offscreen::pixels() const
{
    resolve();
    std::vector<uint8_t> rows(size_t(width_) * size_t(height_) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    check_gl("reading a picture");
    return rows;
}

void Offscreen::resolve() const
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_);
}

} // namespace spia::viewer
