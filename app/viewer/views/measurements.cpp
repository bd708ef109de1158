#include "app/viewer/views/measurements.h"

#include <fmt/core.h>

#include "app/viewer/model/measuring.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"

namespace spia::viewer {
namespace {

using Found = std::vector<std::shared_ptr<const Measured>>;

StageShape shape_of(const Found& found)
{
    StageShape shape;
    for (const auto& each : found)
        for (const Eigen::Matrix3Xd& polyline : each->line) {
            Eigen::Matrix2Xi end(2, polyline.cols() - 1);
            for (int k = 0; k + 1 < polyline.cols(); ++k)
                end.col(k) << k, k + 1;
            for (const auto& [colour, width] : {std::pair(palette::casing, 3.5f), std::pair(palette::measure, 1.5f)}) {
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

void add_measurements(Scene& scene, const ViewerState& state, SceneCache& cache)
{
    const std::vector<Measurement>& all = state.document.measurements;
    if (all.empty())
        return;
    Found found;
    for (const Measurement& each : all)
        found.push_back(each.found);
    const StageShape& shape = cache.measurements.of({found}, [&] { return shape_of(found); });
    scene.lines.insert(scene.lines.end(), shape.lines.begin(), shape.lines.end());
    const Colour text = palette::text(state.view.dark);
    for (size_t k = 0; k < all.size(); ++k)
        scene.labels.push_back(
            {found[k]->label, fmt::format("M{}  {}", k + 1, text_of(all[k], state.preferences.lengths)), text});
}

} // namespace spia::viewer
