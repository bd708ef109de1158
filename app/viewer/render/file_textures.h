#pragma once
#include <filesystem>
#include <map>

#include "app/viewer/render/gl_objects.h"

namespace spia::viewer {

/// Pictures of files as textures, each read once.
class FileTextures {
public:
    struct Shown {
        GLuint texture = 0; ///< 0: there is no such picture
        int width = 0, height = 0;
    };
    /// @param file  PNG
    Shown of(const std::filesystem::path& file);

private:
    struct Kept {
        Texture texture;
        int width = 0, height = 0;
    };
    std::map<std::filesystem::path, Kept> kept_;
};

} // namespace spia::viewer
