#include "app/viewer/views/import_scene.h"

#include <algorithm>
#include <numeric>

#include "app/viewer/views/palette.h"

namespace spia::viewer {
namespace {

/// Per item, whether it or what holds it is chosen.
std::vector<char> with_what_they_hold(const FileItems& items, const std::vector<char>& chosen)
{
    std::vector<char> all = chosen;
    for (size_t i = 0; i < items.item.size(); ++i) // holders come first
        if (const int holder = items.item[i].parent; holder >= 0 && all[size_t(holder)])
            all[i] = 1;
    return all;
}

} // namespace

Scene import_scene(const ListedFile& listed, const std::shared_ptr<const SceneMesh>& mesh,
                   const std::vector<char>& chosen, std::optional<int> hovered)
{
    const FileItems& items = listed.items;
    const bool everything = std::none_of(chosen.begin(), chosen.end(), [](char c) { return c != 0; });
    const std::vector<char> taken = with_what_they_hold(items, chosen);
    auto marks = std::make_shared<FaceMarks>();
    for (const int p : listed.polygon) {
        const int item = items.item_of[size_t(p)];
        const bool in = everything || (item >= 0 && taken[size_t(item)]);
        const bool lit = hovered && item >= 0 && lies_in(items, item, *hovered);
        marks->mark.push_back(uint8_t((in ? 1 : 0) | (lit ? FaceMarks::hovered : 0)));
    }
    SceneLayer layer;
    layer.mesh = mesh;
    layer.marks = std::move(marks);
    layer.colour = {0.52f, 0.55f, 0.59f, 1};
    layer.back = layer.colour;
    Scene scene;
    scene.region_colours = {everything ? palette::surface : palette::chosen};
    scene.layers.push_back(std::move(layer));
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
