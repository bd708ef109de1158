#pragma once
#include <epoxy/gl.h>

#include <string>
#include <utility>

namespace spia::viewer {

/// Owns one OpenGL object. It is made and destroyed while the context it belongs to is current.
template <void (*create)(GLuint&), void (*destroy)(GLuint)> class GlObject {
public:
    GlObject() { create(name_); }
    ~GlObject()
    {
        if (name_)
            destroy(name_);
    }
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept
    {
        std::swap(name_, other.name_);
        return *this;
    }
    operator GLuint() const { return name_; }

private:
    GLuint name_ = 0;
};

namespace gl {
inline void make_buffer(GLuint& name) { glGenBuffers(1, &name); }
inline void drop_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void make_texture(GLuint& name) { glGenTextures(1, &name); }
inline void drop_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void make_vertex_array(GLuint& name) { glGenVertexArrays(1, &name); }
inline void drop_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void make_framebuffer(GLuint& name) { glGenFramebuffers(1, &name); }
inline void drop_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void make_renderbuffer(GLuint& name) { glGenRenderbuffers(1, &name); }
inline void drop_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }
} // namespace gl

using Buffer = GlObject<gl::make_buffer, gl::drop_buffer>;
using Texture = GlObject<gl::make_texture, gl::drop_texture>;
using VertexArray = GlObject<gl::make_vertex_array, gl::drop_vertex_array>;
using Framebuffer = GlObject<gl::make_framebuffer, gl::drop_framebuffer>;
using Renderbuffer = GlObject<gl::make_renderbuffer, gl::drop_renderbuffer>;

/// @throws Error if OpenGL has complained since the last call; names the complaint and `doing`,
/// e.g. "drawing a view"
void check_gl(const char* doing);

/// @throws Error if the current context is older than OpenGL 3.3 or no desktop OpenGL; says what it
/// is and what to do
void require_gl_3_3();

} // namespace spia::viewer
