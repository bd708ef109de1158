#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>

#include "app/viewer/model/document/scene.h"
#include "app/viewer/render/gl_objects.h"

namespace spia::viewer {

/// A vertex and a fragment shader, NAME.vert and NAME.frag of one folder, linked.
class ShaderProgram {
public:
    /// @throws Error if a file cannot be read or does not compile; names the file and quotes the
    /// compiler
    ShaderProgram(const std::filesystem::path& folder, const std::string& name);
    ~ShaderProgram();
    ShaderProgram(const ShaderProgram&) = delete;
    ShaderProgram& operator=(const ShaderProgram&) = delete;

    void use() const { glUseProgram(program_); }

    // Of the program in use. A name the compiler has found no use for is ignored.
    void set(const char* uniform, int value) { glUniform1i(location(uniform), value); }
    void set(const char* uniform, bool value) { glUniform1i(location(uniform), value); }
    void set(const char* uniform, float value) { glUniform1f(location(uniform), value); }
    void set(const char* uniform, glm::vec2 value) { glUniform2f(location(uniform), value.x, value.y); }
    void set(const char* uniform, const Colour& value) { glUniform4fv(location(uniform), 1, value.data()); }
    void set(const char* uniform, const glm::mat4& value)
    {
        glUniformMatrix4fv(location(uniform), 1, GL_FALSE, &value[0][0]);
    }
    void set(const char* uniform, const std::vector<Colour>& values)
    {
        if (!values.empty())
            glUniform4fv(location(uniform), GLsizei(values.size()), values.front().data());
    }

private:
    GLint location(const char* uniform);

    GLuint program_ = 0;
    std::map<std::string, GLint, std::less<>> location_;
};

} // namespace spia::viewer
