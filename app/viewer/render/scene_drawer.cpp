#include "app/viewer/render/scene_drawer.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "app/viewer/views/colours.h"

namespace spia::viewer {
namespace {

struct Backdrop {
    Colour lower, upper;
};
Backdrop backdrop(const Look& look)
{
    if (!look.gradient)
        return {background(look), background(look)};
    return look.dark ? Backdrop{{0.155f, 0.170f, 0.195f, 1}, {0.085f, 0.095f, 0.115f, 1}}
                     : Backdrop{{0.985f, 0.987f, 0.990f, 1}, {0.885f, 0.900f, 0.920f, 1}};
}

Texture map_texture(ColourMap map)
{
    constexpr int texels = 512;
    std::vector<float> rgb;
    for (int i = 0; i < texels; ++i)
        for (const double channel : map_colour(map, i / (texels - 1.0)))
            rgb.push_back(float(channel));
    Texture texture;
    glBindTexture(GL_TEXTURE_1D, texture);
    glTexImage1D(GL_TEXTURE_1D, 0, GL_RGB16F, texels, 0, GL_RGB, GL_FLOAT, rgb.data());
    glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_1D, 0);
    return texture;
}

} // namespace

glm::dmat4 Tile::zoom() const
{
    const glm::dvec2 scale = glm::dvec2(picture) / glm::dvec2(size);
    const glm::dvec2 middle = (glm::dvec2(corner) + 0.5 * glm::dvec2(size)) / glm::dvec2(picture) * 2.0 - 1.0;
    return glm::scale(glm::dmat4(1), glm::dvec3(scale, 1)) * glm::translate(glm::dmat4(1), glm::dvec3(-middle, 0));
}

SceneDrawer::SceneDrawer(const std::filesystem::path& folder)
    : background_shader_(folder, "background"), mesh_shader_(folder, "mesh"), line_shader_(folder, "line"),
      point_shader_(folder, "point"), maps_{map_texture(ColourMap::viridis), map_texture(ColourMap::diverging),
                                            map_texture(ColourMap::grey), map_texture(ColourMap::quality),
                                            map_texture(ColourMap::zones)}
{
    check_gl("preparing the shaders");
}

/// The box may leave out what is not worth fitting to the view, but nothing may be cut off.
Eigen::AlignedBox3d SceneDrawer::bounds(const Scene& scene)
{
    Eigen::AlignedBox3d box = scene.box;
    for (const SceneLayer& layer : scene.layers)
        box.extend(uploads_.of(layer.mesh).box);
    for (const auto& lines : scene.lines)
        box.extend(uploads_.of(lines).box);
    for (const auto& points : scene.points)
        box.extend(uploads_.of(points).box);
    return box;
}

void SceneDrawer::draw(const Scene& scene, const Camera& camera, const Tile& tile, const Look& look)
{
    Eigen::AlignedBox3d box = bounds(scene);
    if (box.isEmpty())
        box = Eigen::AlignedBox3d(Eigen::Vector3d::Zero());
    // mm
    const double aspect = double(tile.picture.x) / tile.picture.y, pixel = camera.height / tile.picture.y;
    const float lift = float(std::min(1.5e-3 * box.diagonal().norm(), 2 * pixel * look.content_scale));
    const Pass pass{scene, camera, tile, look, glm::mat4(tile.zoom() * projection_matrix(camera, aspect, box)), lift};

    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_STENCIL_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_MULTISAMPLE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glBlendEquation(GL_FUNC_ADD);
    // stays opaque
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glClearDepth(1);
    glClear(GL_DEPTH_BUFFER_BIT);
    if (look.ground) {
        draw_background(pass);
    } else {
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
    }

    if (scene.kept)
        glEnable(GL_CLIP_DISTANCE0);

    // Solid faces first, then all lines that they may hide, then what one looks through, then what
    // lies on top.
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1); // behind the lines on them
    glDisable(GL_BLEND);
    for (const SceneLayer& layer : scene.layers)
        if (!transparent(layer))
            draw_faces(pass, layer);
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    for (const SceneLayer& layer : scene.layers)
        draw_layer_lines(pass, layer);
    draw_lines(pass, false);
    draw_points(pass, false);
    glEnable(GL_CULL_FACE);
    for (const SceneLayer& layer : scene.layers)
        if (transparent(layer))
            for (const GLenum hidden : {GL_FRONT, GL_BACK}) { // the far sides first
                glCullFace(hidden);
                draw_faces(pass, layer);
            }
    glDisable(GL_CULL_FACE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_TEST);
    draw_lines(pass, true);
    draw_points(pass, true);

    glDisable(GL_CLIP_DISTANCE0);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glBindVertexArray(0);
    glUseProgram(0);
    glActiveTexture(GL_TEXTURE0);
    check_gl("drawing a view");
    uploads_.forget_unused();
    ++pictures_;
}

void SceneDrawer::draw_background(const Pass& pass)
{
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    const auto [lower, upper] = backdrop(pass.look);
    background_shader_.use();
    background_shader_.set("lower", lower);
    background_shader_.set("upper", upper);
    background_shader_.set("shown", glm::vec2(pass.tile.corner.y, pass.tile.corner.y + pass.tile.size.y) /
                                        float(pass.tile.picture.y));
    glBindVertexArray(no_vertices_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void SceneDrawer::place(ShaderProgram& shader, const Pass& pass, const Eigen::Vector3d& origin)
{
    shader.set("view", glm::mat4(view_matrix(pass.camera, origin)));
    shader.set("projection", pass.projection);
    shader.set("size", glm::vec2(pass.tile.size));
    Colour kept{0, 0, 0, 1}; // everything
    if (const auto& half = pass.scene.kept)
        kept = {float(half->normal[0]), float(half->normal[1]), float(half->normal[2]), float(half->height(origin))};
    shader.set("kept", kept);
}

} // namespace spia::viewer
