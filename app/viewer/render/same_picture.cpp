#include "app/viewer/render/same_picture.h"

#include <algorithm>
#include <tuple>

namespace spia::viewer {
namespace {

bool same_look(const SceneLayer& a, const SceneLayer& b)
{
    const auto all = [](const SceneLayer& layer) {
        const ColourScale& s = layer.scale;
        return std::tie(layer.mesh, layer.field, layer.marks, s.map, s.least, s.greatest, s.bands, s.isolines, s.ticks,
                        layer.colour, layer.back, layer.lit, layer.zebra, layer.edges, layer.features);
    };
    return all(a) == all(b);
}

/// Points are few and made anew for every frame.
bool same_points(const std::shared_ptr<const ScenePoints>& a, const std::shared_ptr<const ScenePoints>& b)
{
    return a->origin == b->origin && a->colour == b->colour && a->size == b->size && a->on_top == b->on_top &&
           a->point.cols() == b->point.cols() && a->point == b->point;
}

} // namespace

bool same_picture(const Scene& a, const Scene& b)
{
    return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(), same_look) &&
           a.lines == b.lines && a.region_colours == b.region_colours && a.kept == b.kept &&
           std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same_points);
}

} // namespace spia::viewer
