#include "engine/exchange/remesh_part.h"

#include <algorithm>
#include <fmt/core.h>
#include <numbers>
#include <utility>

#include "engine/exchange/read_part.h"

namespace spia {

void remesh_part(PartFile& part, const RemeshOptions& options, const Progress& progress)
{
    std::vector<int> sheet; // parts of a deck may differ in thickness and grade
    if (part.deck)
        for (const int face : part.source_face)
            sheet.push_back(part.deck->part_of[size_t(face)]);
    RemeshResult result = remesh(part.mesh, options, sheet, progress);
    Remeshed& remeshed = part.remeshed.emplace();
    remeshed.before = result.before;
    remeshed.after = result.after;
    remeshed.size = result.size;
    remeshed.tolerance = result.tolerance;
    remeshed.distance = result.distance;
    remeshed.lines = result.lines;
    remeshed.corners = result.corners;
    remeshed.seconds = result.seconds;
    for (int& v : result.nearest_vertex)
        v = part.source_vertex[size_t(v)];
    for (int& f : result.nearest_face)
        f = part.source_face[size_t(f)];
    remeshed.original_vertex = std::exchange(part.source_vertex, std::move(result.nearest_vertex));
    part.source_face = std::move(result.nearest_face);
    remeshed.original = std::make_shared<TriMesh>(std::exchange(part.mesh, std::move(result.mesh)));
    part.notes.push_back(in_words(remeshed));
}

std::vector<int> vertices_called(const PartFile& part, int number)
{
    std::vector<int> result;
    const std::vector<int>& called = part.remeshed ? part.remeshed->original_vertex : part.source_vertex;
    const auto [from, to] = std::equal_range(called.begin(), called.end(), number);
    for (auto copy = from; copy != to; ++copy) {
        int vertex = int(copy - called.begin());
        if (part.remeshed) {
            Eigen::Index nearest;
            (part.mesh.position.colwise() - part.remeshed->original->position.col(vertex))
                .colwise()
                .squaredNorm()
                .minCoeff(&nearest);
            vertex = int(nearest);
        }
        result.push_back(vertex);
    }
    return result;
}

std::string in_words(const Remeshed& remeshed)
{
    constexpr double degrees = 180 / std::numbers::pi;
    return fmt::format(
        "remeshed from {} to {} triangles with edges up to {:.3g} mm: smallest angle {:.3g} -> {:.3g} degrees (99 % "
        "above {:.3g} -> {:.3g}), edge ratio {:.3g} -> {:.3g}; nowhere more than {:.3g} mm from the original "
        "mesh (tolerance {:.3g} mm)",
        remeshed.before.triangles, remeshed.after.triangles, remeshed.size, remeshed.before.least_angle * degrees,
        remeshed.after.least_angle * degrees, remeshed.before.least_angle_of_99 * degrees,
        remeshed.after.least_angle_of_99 * degrees, remeshed.before.edge_ratio, remeshed.after.edge_ratio,
        remeshed.distance, remeshed.tolerance);
}

} // namespace spia
