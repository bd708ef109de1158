#include "app/viewer/render/shader.h"

#include <fmt/core.h>
#include <fstream>
#include <sstream>

#include "engine/core/error.h"

namespace spia::viewer {
namespace {

std::string read(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream || text.str().empty())
        throw Error(fmt::format("cannot read the shader {}; install SPIA's folder shaders/ again, or name it in the "
                                "environment variable SPIA_SHADERS",
                                file.string()));
    return text.str();
}

/// What the compiler or linker said. @param get, get_log: glGetShaderiv and glGetShaderInfoLog or
/// those of a program
template <class Get, class GetLog> std::string log_of(GLuint object, const Get& get, const GetLog& get_log)
{
    GLint length = 0;
    get(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(std::max(length, 1)), '\0');
    get_log(object, length, &length, log.data());
    log.resize(size_t(length));
    while (!log.empty() && (log.back() == '\n' || log.back() == '\0'))
        log.pop_back();
    return log.empty() ? "no reason given" : log;
}

/// A compiled shader, destroyed with this object; a program it is attached to keeps what it needs.
class Shader {
public:
    Shader(GLenum kind, const std::filesystem::path& file) : name_(glCreateShader(kind))
    {
        const std::string source = read(file);
        const char* const text = source.c_str();
        glShaderSource(name_, 1, &text, nullptr);
        glCompileShader(name_);
        GLint compiled = GL_FALSE;
        glGetShaderiv(name_, GL_COMPILE_STATUS, &compiled);
        if (!compiled) {
            const std::string log = log_of(name_, glGetShaderiv, glGetShaderInfoLog);
            glDeleteShader(name_);
            throw Error(fmt::format("the shader {} does not compile:\n{}", file.string(), log));
        }
    }
    ~Shader() { glDeleteShader(name_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    operator GLuint() const { return name_; }

private:
    GLuint name_;
};

} // namespace

ShaderProgram::ShaderProgram(const std::filesystem::path& folder, const std::string& name)
{
    const Shader vertex(GL_VERTEX_SHADER, folder / (name + ".vert"));
    const Shader fragment(GL_FRAGMENT_SHADER, folder / (name + ".frag"));
    program_ = glCreateProgram();
    glAttachShader(program_, vertex);
    glAttachShader(program_, fragment);
    glLinkProgram(program_);
    glDetachShader(program_, vertex);
    glDetachShader(program_, fragment);
    GLint linked = GL_FALSE;
    glGetProgramiv(program_, GL_LINK_STATUS, &linked);
    if (!linked) {
        const std::string log = log_of(program_, glGetProgramiv, glGetProgramInfoLog);
        glDeleteProgram(program_);
        throw Error(
            fmt::format("the shaders {}/{}.vert and .frag do not fit together:\n{}", folder.string(), name, log));
    }
}

ShaderProgram::~ShaderProgram() { glDeleteProgram(program_); }

GLint ShaderProgram::location(const char* uniform)
{
    const auto found = location_.find(uniform);
    if (found != location_.end())
        return found->second;
    return location_.emplace(uniform, glGetUniformLocation(program_, uniform)).first->second;
}

} // namespace spia::viewer
