#include "app/viewer/render/picture_file.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

namespace spia::viewer {

std::string png(const Picture& picture)
{
    std::string result;
    const auto append = [](void* to, void* from, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(from), size_t(size));
    };
    if (!stbi_write_png_to_func(append, &result, picture.width, picture.height, 4, picture.rgba.data(),
                                4 * picture.width))
        throw ExchangeError("the picture could not be compressed; memory may be short");
    return result;
}

void write_png(const std::filesystem::path& file, const Picture& picture) { write_atomically(file, png(picture)); }

} // namespace spia::viewer
