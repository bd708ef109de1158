#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/viewer/model/document/scene.h"
#include "app/viewer/model/picking/camera.h"

namespace spia::viewer {

/// How a picture is drawn, whatever it shows.
struct Look {
    bool dark = true;
    bool gradient = true;    ///< of the background; else it has one colour
    bool ground = true;      ///< else what shows nothing is transparent; `dark` is then of no
                             ///< matter
    float content_scale = 1; ///< of the screen: how many pixels a line of width 1 has
    int samples = 4;         ///< per pixel, against jagged edges; fewer if the graphics card cannot
    int most_triangles = 0;  ///< of a mesh, about; a finer one is drawn coarse, without its edges:
                             ///< while a view moves. 0: no limit

    friend bool operator==(const Look&, const Look&) = default;
};

/// Mean colour of the background.
Colour background(const Look& look);

/// A picture in memory.
struct Picture {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba; ///< rows from the top, 4 bytes per pixel, sRGB, not multiplied by
                               ///< the opacity
};

class SceneDrawer;

/// Draws scenes with OpenGL 3.3 core. Made, used and destroyed on one thread while the same context
/// is current.
class Renderer {
public:
    /// @throws Error if the context is older than OpenGL 3.3, or a shader cannot be read or
    /// compiled
    explicit Renderer(const std::filesystem::path& shader_folder = default_shader_folder());
    ~Renderer();

    /// A place to draw a view again and again.
    class Image {
    public:
        Image();
        ~Image();
        Image(Image&&) noexcept;
        Image& operator=(Image&&) noexcept;

    private:
        friend class Renderer;
        struct Drawn;
        std::unique_ptr<Drawn> drawn_;
    };

    /// Draws into the image, which takes this size, unless it shows just that already. Leaves the
    /// framebuffer of the window bound, depth test, culling and blending off.
    /// @return a texture of OpenGL, opaque, its first row below: ImGui::Image(texture, size, {0,
    /// 1}, {1, 0})
    /// @throws Error if OpenGL fails
    unsigned draw(Image& image, const Scene& scene, const Camera& camera, int width, int height, const Look& look);

    /// Whether the image shows just that already, so that draw() costs nothing.
    bool shows(const Image& image, const Scene& scene, const Camera& camera, int width, int height,
               const Look& look) const;
    /// Whether it shows this scene, however it was seen.
    static bool shows(const Image& image, const Scene& scene);
    /// What the image shows, whatever it is; 0: nothing yet.
    static unsigned texture(const Image& image);

    /// The same as a picture of any size, in tiles if it is larger than what the graphics card
    /// draws at once.
    /// @param largest_tile  pixels; limits the graphics memory
    /// @throws Error if OpenGL fails; InputError if the size is not positive or is too large for
    /// the memory
    Picture picture(const Scene& scene, const Camera& camera, int width, int height, const Look& look,
                    int largest_tile = 2048);

    /// Whether OpenGL is computed by the processor, without a graphics card: then one sample per
    /// pixel while a view moves keeps it three times as quick.
    bool in_software() const;

    /// How many pictures have been drawn, and how many things lie on the graphics card: for tests
    /// and benchmarks.
    int pictures_drawn() const;
    size_t uploads() const;

    /// That of the environment variable SPIA_SHADERS, else the one of the source tree.
    static std::filesystem::path default_shader_folder();

private:
    std::unique_ptr<SceneDrawer> drawer_;
};

} // namespace spia::viewer
