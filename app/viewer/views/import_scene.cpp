#include "app/viewer/views/import_scene.h"

#include <algorithm>

#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"

namespace spia::viewer {
namespace {

PreviewPiece piece_of(const ListedFile& listed, std::vector<int> triangle)
{
    PreviewPiece piece;
    TriMesh mesh;
    std::vector<int> number(size_t(listed.mesh.vertices()), -1), vertex;
    mesh.triangle.resize(3, Eigen::Index(triangle.size()));
    for (size_t t = 0; t < triangle.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            int& v = number[size_t(listed.mesh.triangle(k, triangle[t]))];
            if (v < 0) {
                v = int(vertex.size());
                vertex.push_back(listed.mesh.triangle(k, triangle[t]));
            }
            mesh.triangle(k, Eigen::Index(t)) = v;
        }
    mesh.position = listed.mesh.position(Eigen::all, vertex);
    if (!triangle.empty())
        piece.mesh = std::make_shared<SceneMesh>(scene_mesh(mesh));
    piece.triangle = std::move(triangle);
    return piece;
}

SceneLayer layer_of(const ListedFile& listed, const PreviewPiece& piece, const Colour& colour,
                    std::optional<int> hovered)
{
    SceneLayer layer;
    layer.mesh = piece.mesh;
    layer.colour = layer.back = colour;
    if (!hovered)
        return layer;
    std::vector<char> lit(listed.items.item.size(), 0);
    lit[size_t(*hovered)] = 1;
    lit = with_what_they_hold(listed.items, std::move(lit));
    auto marks = std::make_shared<FaceMarks>();
    marks->mark.reserve(piece.triangle.size());
    for (const int t : piece.triangle) {
        const int item = listed.items.item_of[size_t(listed.polygon[size_t(t)])];
        marks->mark.push_back(item >= 0 && lit[size_t(item)] ? FaceMarks::hovered : 0);
    }
    layer.marks = std::move(marks);
    return layer;
}

} // namespace

PreviewShape preview_shape(const ListedFile& listed, const std::vector<char>& chosen)
{
    PreviewShape shape;
    shape.everything = std::none_of(chosen.begin(), chosen.end(), [](char c) { return c != 0; });
    const std::vector<char> taken = with_what_they_hold(listed.items, chosen);
    std::vector<int> in, out;
    for (int t = 0; t < listed.mesh.triangles(); ++t) {
        const int item = listed.items.item_of[size_t(listed.polygon[size_t(t)])];
        (shape.everything || (item >= 0 && taken[size_t(item)]) ? in : out).push_back(t);
    }
    shape.chosen = piece_of(listed, std::move(in));
    shape.rest = piece_of(listed, std::move(out));
    return shape;
}

Scene import_scene(const ListedFile& listed, const PreviewShape& shape, std::optional<int> hovered)
{
    Scene scene;
    if (shape.chosen.mesh)
        scene.layers.push_back(
            layer_of(listed, shape.chosen, shape.everything ? palette::surface : palette::chosen, hovered));
    if (shape.rest.mesh)
        scene.layers.push_back(layer_of(listed, shape.rest, palette::ghost, hovered));
    if (listed.picker)
        scene.box = listed.picker->box();
    return scene;
}

Camera import_camera(const ListedFile& listed, glm::dvec2 size)
{
    constexpr double around = 14; // pixels
    const Camera camera = look(Camera{}, StandardView::isometric);
    return fit(camera, listed.mesh.position, size, {around, around, around, around});
}

} // namespace spia::viewer
