#include "app/viewer/render/renderer.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/core.h>
#include <string_view>

#include "app/viewer/render/offscreen.h"
#include "app/viewer/render/same_picture.h"
#include "app/viewer/render/scene_drawer.h"
#include "engine/core/error.h"

namespace spia::viewer {
namespace {

/// What was blended onto nothing has its colours multiplied by its opacity.
void divide_by_opacity(std::vector<uint8_t>& rgba)
{
    for (size_t k = 0; k + 3 < rgba.size(); k += 4)
        if (const int opacity = rgba[k + 3]; opacity > 0 && opacity < 255)
            for (size_t c = k; c < k + 3; ++c)
                rgba[c] = uint8_t(std::min(255, (rgba[c] * 255 + opacity / 2) / opacity));
}

} // namespace

Colour background(const Look& look)
{
    return look.dark ? Colour{0.118f, 0.130f, 0.150f, 1} : Colour{0.945f, 0.952f, 0.960f, 1};
}

std::filesystem::path Renderer::default_shader_folder()
{
    const char* const folder = std::getenv("SPIA_SHADERS");
    return folder && *folder ? folder : SPIA_SHADERS_DIR;
}

/// What an image shows; holding the scene keeps its objects, so that their addresses tell whether
/// it is the same one.
struct Renderer::Image::Drawn {
    Offscreen target;
    Scene scene;
    Camera camera;
    Look look;
};

Renderer::Image::Image() = default;
Renderer::Image::~Image() = default;
Renderer::Image::Image(Image&&) noexcept = default;
Renderer::Image& Renderer::Image::operator=(Image&&) noexcept = default;

Renderer::Renderer(const std::filesystem::path& shader_folder)
{
    require_gl_3_3();
    drawer_ = std::make_unique<SceneDrawer>(shader_folder);
}

Renderer::~Renderer() = default;

/// Whether the image has this size; only then its contents matter.
static bool fits(const Offscreen& target, int width, int height, const Look& look)
{
    return target.width() == width && target.height() == height && target.samples_asked() == look.samples;
}

bool Renderer::shows(const Image& image, const Scene& scene, const Camera& camera, int width, int height,
                     const Look& look) const
{
    const auto& drawn = image.drawn_;
    return drawn && fits(drawn->target, width, height, look) && drawn->camera == camera && drawn->look == look &&
           same_picture(drawn->scene, scene);
}

bool Renderer::shows(const Image& image, const Scene& scene)
{
    return image.drawn_ && image.drawn_->camera.height > 0 && same_picture(image.drawn_->scene, scene);
}

unsigned Renderer::texture(const Image& image) { return image.drawn_ ? image.drawn_->target.texture() : 0; }

unsigned Renderer::draw(Image& image, const Scene& scene, const Camera& camera, int width, int height, const Look& look)
{
    if (shows(image, scene, camera, width, height, look))
        return texture(image);
    auto& drawn = image.drawn_;
    if (!drawn || !fits(drawn->target, width, height, look)) {
        drawn.reset(); // first, or both would need memory
        drawn.reset(new Image::Drawn{Offscreen(width, height, look.samples), {}, {}, {}});
    }
    drawn->camera.height = 0; // shows nothing until it is finished
    drawn->target.begin();
    drawer_->draw(scene, camera, Tile{.picture = {width, height}, .size = {width, height}}, look);
    drawn->target.resolve();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    check_gl("showing a view");
    drawn->scene = scene;
    drawn->camera = camera;
    drawn->look = look;
    return drawn->target.texture();
}

Picture Renderer::picture(const Scene& scene, const Camera& camera, int width, int height, const Look& look,
                          int largest_tile)
{
    constexpr int64_t most_pixels = 1 << 29; // 2 GiB of memory
    if (width < 1 || height < 1 || int64_t(width) * height > most_pixels)
        throw InputError(fmt::format("a picture of {} x {} pixels cannot be made; ask for 1 to {} million pixels",
                                     width, height, most_pixels / 1000000));
    Picture result{width, height, std::vector<uint8_t>(size_t(width) * size_t(height) * 4)};
    // Even, so that the groups of 2 x 2 pixels from which slopes are taken are the same in every
    // tiling.
    const int side = std::max(2, std::min(largest_tile, longest_side()) / 2 * 2);
    for (int y = 0; y < height; y += side)
        for (int x = 0; x < width; x += side) {
            const Tile tile{.picture = {width, height},
                            .corner = {x, y},
                            .size = {std::min(side, width - x), std::min(side, height - y)}};
            const Offscreen target(tile.size.x, tile.size.y, look.samples);
            target.begin();
            drawer_->draw(scene, camera, tile, look);
            const std::vector<uint8_t> rows = target.pixels();
            const size_t row_bytes = size_t(tile.size.x) * 4;
            for (int row = 0; row < tile.size.y; ++row) // OpenGL's rows run upwards
                std::copy_n(rows.begin() + ptrdiff_t(size_t(row) * row_bytes), row_bytes,
                            result.rgba.begin() + (ptrdiff_t(height - 1 - y - row) * width + x) * 4);
        }
    if (!look.ground)
        divide_by_opacity(result.rgba);
    return result;
}

bool Renderer::in_software() const
{
    const GLubyte* const name = glGetString(GL_RENDERER);
    const std::string_view words = name ? reinterpret_cast<const char*>(name) : "";
    for (const std::string_view software : {"llvmpipe", "softpipe", "SwiftShader", "GDI Generic"})
        if (words.find(software) != std::string_view::npos)
            return true;
    return false;
}

int Renderer::pictures_drawn() const { return drawer_->pictures(); }
size_t Renderer::uploads() const { return drawer_->uploads().count(); }

} // namespace spia::viewer
