#pragma once
#include <array>
#include <filesystem>
#include <glm/glm.hpp>

#include "app/viewer/render/renderer.h"
#include "app/viewer/render/shader.h"
#include "app/viewer/render/uploads.h"

namespace spia::viewer {

/// A part of a picture that is drawn at once; x and y from the lower left corner.
struct Tile {
    glm::ivec2 picture; ///< size of the whole
    glm::ivec2 corner{0}, size;

    /// Clip coordinates of the picture to those of the tile.
    glm::dmat4 zoom() const;
};

/// Whether one looks through a layer.
inline bool transparent(const SceneLayer& layer) { return layer.colour[3] < 1; }

/// All that lies on the graphics card, and how a scene is drawn with it.
class SceneDrawer {
public:
    /// @throws Error if a shader cannot be read or compiled
    explicit SceneDrawer(const std::filesystem::path& shader_folder);

    /// Into the framebuffer that is bound. Leaves depth test, culling and blending off. @throws
    /// Error if OpenGL fails
    void draw(const Scene& scene, const Camera& camera, const Tile& tile, const Look& look);
    int pictures() const { return pictures_; } ///< drawn so far
    const Uploads& uploads() const { return uploads_; }

private:
    /// What all drawing functions need to know.
    struct Pass {
        const Scene& scene;
        const Camera& camera;
        const Tile& tile;
        const Look& look;
        glm::mat4 projection;
        float lift; ///< mm towards the viewer, for what lies on a surface; away for what lies
                    ///< behind
    };
    Eigen::AlignedBox3d bounds(const Scene& scene);
    static bool is_coarse(const Pass& pass, const SceneLayer& layer);
    void draw_background(const Pass& pass);
    void draw_faces(const Pass& pass, const SceneLayer& layer);
    void draw_layer_lines(const Pass& pass, const SceneLayer& layer);
    void draw_lines(const Pass& pass, bool on_top);
    void draw_points(const Pass& pass, bool on_top);
    static void place(ShaderProgram& shader, const Pass& pass, const Eigen::Vector3d& origin);

    ShaderProgram background_shader_, mesh_shader_, line_shader_, point_shader_;
    std::array<Texture, 5> maps_; ///< by ColourMap
    VertexArray no_vertices_;
    Uploads uploads_;
    int pictures_ = 0;
};

} // namespace spia::viewer
