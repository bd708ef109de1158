#include "app/viewer/render/renderer.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>
#include <string_view>
#include <tuple>

#include "app/viewer/render/offscreen.h"
#include "app/viewer/render/shader.h"
#include "app/viewer/render/uploads.h"
#include "app/viewer/views/colours.h"
#include "app/viewer/views/palette.h"
#include "engine/core/error.h"

namespace spia::viewer {
namespace {

// Texture units. Samplers of different kinds must not share one, even unused.
constexpr int unit_map = 0, unit_values = 1, unit_marks = 2;

constexpr float ghost_push = 8; // of the lift of lines: a few pixels, or a hundredth of the part
constexpr Colour ink{0.07f, 0.08f, 0.10f, 1};

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

/// A part of a picture that is drawn at once; x and y from the lower left corner.
struct Tile {
    glm::ivec2 picture; ///< size of the whole
    glm::ivec2 corner{0}, size;

    /// Clip coordinates of the picture to those of the tile.
    glm::dmat4 zoom() const
    {
        const glm::dvec2 scale = glm::dvec2(picture) / glm::dvec2(size);
        const glm::dvec2 middle = (glm::dvec2(corner) + 0.5 * glm::dvec2(size)) / glm::dvec2(picture) * 2.0 - 1.0;
        return glm::scale(glm::dmat4(1), glm::dvec3(scale, 1)) * glm::translate(glm::dmat4(1), glm::dvec3(-middle, 0));
    }
};

bool same_look(const SceneLayer& a, const SceneLayer& b)
{
    const auto all = [](const SceneLayer& layer) {
        const ColourScale& s = layer.scale;
        return std::tie(layer.mesh, layer.field, layer.marks, s.map, s.least, s.greatest, s.bands, s.isolines, s.ticks,
                        layer.colour, layer.back, layer.lit, layer.edges, layer.features);
    };
    return all(a) == all(b);
}

/// Points are few and made anew for every frame.
bool same_points(const std::shared_ptr<const ScenePoints>& a, const std::shared_ptr<const ScenePoints>& b)
{
    return a->origin == b->origin && a->colour == b->colour && a->size == b->size && a->on_top == b->on_top &&
           a->point.cols() == b->point.cols() && a->point == b->point;
}

/// Whether two scenes give the same picture; labels are not drawn here.
bool same_picture(const Scene& a, const Scene& b)
{
    return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(), same_look) &&
           a.lines == b.lines && a.region_colours == b.region_colours &&
           std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same_points);
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

bool transparent(const SceneLayer& layer) { return layer.colour[3] < 1; }

Colour faded(Colour colour, float opacity)
{
    colour[3] *= opacity;
    return colour;
}

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

/// All that lies on the graphics card, and how a scene is drawn with it.
struct Renderer::Gpu {
    explicit Gpu(const std::filesystem::path& folder)
        : background_shader(folder, "background"), mesh_shader(folder, "mesh"), line_shader(folder, "line"),
          point_shader(folder, "point"), maps{map_texture(ColourMap::viridis), map_texture(ColourMap::diverging),
                                              map_texture(ColourMap::grey), map_texture(ColourMap::quality)}
    {
        check_gl("preparing the shaders");
    }

    ShaderProgram background_shader, mesh_shader, line_shader, point_shader;
    std::array<Texture, 4> maps; ///< by ColourMap
    VertexArray no_vertices;
    Uploads uploads;
    int pictures = 0;

    void draw(const Scene& scene, const Camera& camera, const Tile& tile, const Look& look);

private:
    /// What all drawing functions need to know.
    struct Pass {
        const Scene& scene;
        const Camera& camera;
        const Tile& tile;
        const Look& look;
        glm::mat4 projection;
        float lift; ///< mm towards the viewer, for what lies on a surface; away for what lies behind
    };
    Eigen::AlignedBox3d bounds(const Scene& scene);
    void draw_background(const Pass& pass);
    void draw_faces(const Pass& pass, const SceneLayer& layer);
    void draw_layer_lines(const Pass& pass, const SceneLayer& layer);
    void draw_lines(const Pass& pass, bool on_top);
    void draw_points(const Pass& pass, bool on_top);
    void place(ShaderProgram& shader, const Pass& pass, const Eigen::Vector3d& origin) const;
};

/// The box may leave out what is not worth fitting to the view, but nothing may be cut off.
Eigen::AlignedBox3d Renderer::Gpu::bounds(const Scene& scene)
{
    Eigen::AlignedBox3d box = scene.box;
    for (const SceneLayer& layer : scene.layers)
        box.extend(uploads.of(layer.mesh).box);
    for (const auto& lines : scene.lines)
        box.extend(uploads.of(lines).box);
    for (const auto& points : scene.points)
        box.extend(uploads.of(points).box);
    return box;
}

void Renderer::Gpu::draw(const Scene& scene, const Camera& camera, const Tile& tile, const Look& look)
{
    Eigen::AlignedBox3d box = bounds(scene);
    if (box.isEmpty())
        box = Eigen::AlignedBox3d(Eigen::Vector3d::Zero());
    const double aspect = double(tile.picture.x) / tile.picture.y, pixel = camera.height / tile.picture.y; // mm
    const float lift = float(std::min(1.5e-3 * box.diagonal().norm(), 2 * pixel * look.content_scale));
    const Pass pass{scene, camera, tile, look, glm::mat4(tile.zoom() * projection_matrix(camera, aspect, box)), lift};

    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_STENCIL_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_MULTISAMPLE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA); // stays opaque
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

    // Solid faces first, then all lines that they may hide, then what one looks through, then what lies on top.
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

    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glBindVertexArray(0);
    glUseProgram(0);
    glActiveTexture(GL_TEXTURE0);
    check_gl("drawing a view");
    uploads.forget_unused();
    ++pictures;
}

void Renderer::Gpu::draw_background(const Pass& pass)
{
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    const auto [lower, upper] = backdrop(pass.look);
    background_shader.use();
    background_shader.set("lower", lower);
    background_shader.set("upper", upper);
    background_shader.set("shown", glm::vec2(pass.tile.corner.y, pass.tile.corner.y + pass.tile.size.y) /
                                       float(pass.tile.picture.y));
    glBindVertexArray(no_vertices);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::Gpu::place(ShaderProgram& shader, const Pass& pass, const Eigen::Vector3d& origin) const
{
    shader.set("view", glm::mat4(view_matrix(pass.camera, origin)));
    shader.set("projection", pass.projection);
    shader.set("size", glm::vec2(pass.tile.size));
}

void Renderer::Gpu::draw_faces(const Pass& pass, const SceneLayer& layer)
{
    const MeshBuffer& mesh = uploads.of(layer.mesh);
    ShaderProgram& shader = mesh_shader;
    shader.use();
    place(shader, pass, layer.mesh->origin);
    shader.set("push", transparent(layer) ? ghost_push * pass.lift : 0.f); // or it would show through what lies on it
    shader.set("front", layer.colour);
    shader.set("back", Colour{layer.back[0], layer.back[1], layer.back[2], layer.colour[3]});
    shader.set("lit", layer.lit);
    shader.set("pixel", pass.look.content_scale);
    shader.set("corner", glm::vec2(pass.tile.corner));
    shader.set("map", unit_map);
    shader.set("face_value", unit_values);
    shader.set("face_mark", unit_marks);
    shader.set("selected_colour", palette::selected);

    glBindVertexArray(mesh.array);
    glDisableVertexAttribArray(2);
    shader.set("has_field", layer.field != nullptr);
    if (layer.field) {
        const ValueBuffer& field = uploads.of(layer.field, *layer.mesh);
        shader.set("per_face", layer.field->per_face);
        shader.set("least", layer.scale.least);
        shader.set("greatest", layer.scale.greatest);
        shader.set("about_zero", layer.scale.map == ColourMap::diverging);
        shader.set("bands", layer.scale.bands);
        shader.set("ticks", std::max(1, layer.scale.ticks));
        shader.set("isolines", layer.scale.isolines);
        shader.set("no_value", no_value);
        glActiveTexture(GL_TEXTURE0 + unit_map);
        glBindTexture(GL_TEXTURE_1D, maps[size_t(layer.scale.map)]);
        if (field.by_face) {
            glActiveTexture(GL_TEXTURE0 + unit_values);
            glBindTexture(GL_TEXTURE_BUFFER, *field.by_face);
        } else {
            glBindBuffer(GL_ARRAY_BUFFER, field.values);
            glVertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, 0, nullptr);
            glEnableVertexAttribArray(2);
        }
    }
    shader.set("has_marks", layer.marks != nullptr);
    if (layer.marks) {
        std::vector<Colour> regions = pass.scene.region_colours;
        regions.resize(FaceMarks::region + 1, Colour{1, 1, 1, 1});
        shader.set("region_colour", regions);
        glActiveTexture(GL_TEXTURE0 + unit_marks);
        glBindTexture(GL_TEXTURE_BUFFER, *uploads.of(layer.marks, *layer.mesh).by_face);
    }
    glDrawElements(GL_TRIANGLES, mesh.indices, GL_UNSIGNED_INT, nullptr);
}

/// Edges thin and pale, so that a fine mesh does not turn black; boundary and sharp edges strong.
void Renderer::Gpu::draw_layer_lines(const Pass& pass, const SceneLayer& layer)
{
    if (!layer.edges && !layer.features)
        return;
    MeshBuffer& mesh = uploads.of(layer.mesh);
    line_shader.use();
    place(line_shader, pass, layer.mesh->origin);
    const auto stroke = [&](std::optional<LineBuffer>& lines, const auto& ends, float width, float opacity,
                            bool round_ends, float lift) {
        if (!lines)
            lines = upload_lines(layer.mesh->position, ends);
        line_shader.set("line_colour", faded(ink, opacity * (transparent(layer) ? std::sqrt(layer.colour[3]) : 1)));
        line_shader.set("width", width * pass.look.content_scale);
        line_shader.set("lift", lift);
        line_shader.set("round_ends", round_ends);
        glBindVertexArray(lines->array);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, lines->lines);
    };
    if (layer.edges)
        stroke(mesh.edge, layer.mesh->edge, 1, 0.38f, false, 0);
    if (layer.features)
        stroke(mesh.feature, layer.mesh->feature, 1.4f, 0.7f, true, 0.5f * pass.lift);
}

void Renderer::Gpu::draw_lines(const Pass& pass, bool on_top)
{
    line_shader.use();
    for (const auto& lines : pass.scene.lines) {
        if (lines->on_top != on_top)
            continue;
        const LineBuffer& buffer = uploads.of(lines).lines;
        place(line_shader, pass, lines->origin);
        line_shader.set("line_colour", lines->colour);
        line_shader.set("width", lines->width * pass.look.content_scale);
        line_shader.set("lift", on_top ? 0.f : pass.lift);
        line_shader.set("round_ends", true);
        glBindVertexArray(buffer.array);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, buffer.lines);
    }
}

void Renderer::Gpu::draw_points(const Pass& pass, bool on_top)
{
    point_shader.use();
    for (const auto& points : pass.scene.points) {
        if (points->on_top != on_top)
            continue;
        const PointBuffer& buffer = uploads.of(points);
        constexpr float least_with_rim = 7; // pixels
        const float rim = points->size >= least_with_rim ? 1.6f : 0;
        place(point_shader, pass, points->origin);
        point_shader.set("dot_colour", points->colour);
        point_shader.set("rim_colour", lightness(points->colour) > 0.72 ? ink : Colour{1, 1, 1, 1});
        point_shader.set("diameter", (points->size + 2 * rim) * pass.look.content_scale);
        point_shader.set("rim", rim * pass.look.content_scale);
        point_shader.set("lift", on_top ? 0.f : 2 * pass.lift);
        glBindVertexArray(buffer.array);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, buffer.points);
    }
}

/// What an image shows; holding the scene keeps its objects, so that their addresses tell whether it is the same one.
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
    gpu_ = std::make_unique<Gpu>(shader_folder);
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
    gpu_->draw(scene, camera, Tile{.picture = {width, height}, .size = {width, height}}, look);
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
    // Even, so that the groups of 2 x 2 pixels from which slopes are taken are the same in every tiling.
    const int side = std::max(2, std::min(largest_tile, longest_side()) / 2 * 2);
    for (int y = 0; y < height; y += side)
        for (int x = 0; x < width; x += side) {
            const Tile tile{.picture = {width, height},
                            .corner = {x, y},
                            .size = {std::min(side, width - x), std::min(side, height - y)}};
            const Offscreen target(tile.size.x, tile.size.y, look.samples);
            target.begin();
            gpu_->draw(scene, camera, tile, look);
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

int Renderer::pictures_drawn() const { return gpu_->pictures; }
size_t Renderer::uploads() const { return gpu_->uploads.count(); }

} // namespace spia::viewer
