#include "app/viewer/render/file_textures.h"

#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace spia::viewer {

FileTextures::Shown FileTextures::of(const std::filesystem::path& file)
{
    const auto found = kept_.find(file);
    if (found != kept_.end())
        return {found->second.width > 0 ? GLuint(found->second.texture) : 0, found->second.width, found->second.height};
    Kept& kept = kept_[file];
    int channels = 0;
    const std::unique_ptr<unsigned char, decltype(&stbi_image_free)> pixels(
        stbi_load(file.c_str(), &kept.width, &kept.height, &channels, 4), stbi_image_free);
    if (!pixels) {
        kept.width = kept.height = 0;
        return {};
    }
    glBindTexture(GL_TEXTURE_2D, kept.texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kept.width, kept.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.get());
    glGenerateMipmap(GL_TEXTURE_2D); // it is shown smaller than it is, too
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glBindTexture(GL_TEXTURE_2D, 0);
    return {kept.texture, kept.width, kept.height};
}

} // namespace spia::viewer
