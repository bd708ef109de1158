#include "app/viewer/views/measurements.h"

#include <fmt/core.h>

#include "app/viewer/model/picking/measuring.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"

namespace spia::viewer {
namespace {

using Found = std::vector<std::shared_ptr<const Measured>>;

StageShape shape_of(const Found& found, bool dark)
{
    StageShape shape;
    for (const auto& each : found)
        for (const Eigen::Matrix3Xd& polyline : each->line) {
            Eigen::Matrix2Xi end(2, polyline.cols() - 1);
            for (int k = 0; k + 1 < polyline.cols(); ++k)
                end.col(k) << k, k + 1;
            for (const auto& [colour, width] :
                 {std::pair(palette::measure_casing(dark), 3.5f), std::pair(palette::measure(dark), 1.5f)}) {
                const auto lines = scene_lines(polyline, end);
                lines->colour = colour;
                lines->width = width;
                lines->on_top = true;
                shape.lines.push_back(lines);
            }
        }
    return shape;
}

} // namespace

void add_measurements(Scene& scene, const ViewerState& state, View view, SceneCache& cache)
{
    const std::vector<Measurement>& all = state.document.measurements;
    Found found;
    for (const Measurement& each : all)
        if (each.on == view)
            found.push_back(each.found);
    if (found.empty())
        return;
    const bool dark = state.view.dark;
    const StageShape& shape = cache.measurements[size_t(view)].of({found, dark}, [&] { return shape_of(found, dark); });
    scene.lines.insert(scene.lines.end(), shape.lines.begin(), shape.lines.end());
    const Colour text = palette::text(dark);
    for (size_t k = 0; k < all.size(); ++k)
        if (all[k].on == view)
            scene.labels.push_back(
                {all[k].found->label, fmt::format("M{}  {}", k + 1, text_of(all[k], state.preferences.lengths)), text});
}

} // namespace spia::viewer
