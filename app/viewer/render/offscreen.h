#pragma once
#include <cstdint>
#include <vector>

#include "app/viewer/render/gl_objects.h"

namespace spia::viewer {

/// A multisampled picture with depth, and a texture that it is resolved to.
class Offscreen {
public:
    /// @param samples  per pixel; as many as the graphics card offers if that is fewer
    /// @throws Error if there is not enough graphics memory, or the card does not draw pictures of
    /// this size
    Offscreen(int width, int height, int samples);

    int width() const { return width_; }
    int height() const { return height_; }
    int samples_asked() const { return samples_asked_; }
    GLuint texture() const { return texture_; }

    void begin() const;   ///< what is drawn from now on lands here
    void clear() const;   ///< to nothing, transparent
    void resolve() const; ///< to the texture, which is then bound for reading
    /// Resolves and reads: 4 bytes per pixel, rows from below. Leaves the framebuffer of the window
    /// bound.
    std::vector<uint8_t> pixels() const;

private:
    int width_, height_, samples_asked_;
    Renderbuffer colour_, depth_;
    Texture texture_;
    Framebuffer drawn_, resolved_;
};

/// Longest side of a picture that the graphics card can draw, pixels.
int longest_side();

} // namespace spia::viewer
