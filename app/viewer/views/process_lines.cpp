#include "app/viewer/views/process_lines.h"

#include <fmt/core.h>

#include "app/viewer/views/marking.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"
#include "engine/core/error.h"
#include "engine/forming/process/line_on_part.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

constexpr int most_pieces = 400; // of a line

Eigen::Matrix3Xd on_sheet(const std::vector<ClosestPoint>& places, const Eigen::Matrix3Xd& position,
                          const Eigen::Matrix3Xi& triangle)
{
    Eigen::Matrix3Xd result(3, Eigen::Index(places.size()));
    for (size_t i = 0; i < places.size(); ++i)
        result.col(Eigen::Index(i)) = place_on(position, triangle, places[i].face, places[i].barycentric);
    return result;
}

const Colour& colour_of(LineKind kind) { return kind == LineKind::drawbead ? palette::drawbead : palette::pilot; }

std::string words(const Document& document, size_t line)
{
    const std::string& name = document.lines[line].name;
    const std::optional<double> force = bead_force(document, line);
    return force ? fmt::format("{}  {:.3g} N/mm", name, *force) : name;
}

LineShapes shapes(const std::vector<ProcessLine>& lines, const std::vector<std::vector<ClosestPoint>>& places,
                  const Eigen::Matrix3Xd& position, const Eigen::Matrix3Xi& triangle)
{
    LineShapes made;
    for (size_t k = 0; k < lines.size(); ++k) {
        const Eigen::Matrix3Xd place = on_sheet(places[k], position, triangle);
        if (place.cols() == 0)
            continue;
        if (place.cols() == 1) {
            for (const auto& [colour, size] : {std::pair(palette::casing, 13.f), {colour_of(lines[k].kind), 10.f}}) {
                const auto dot = scene_points(place);
                dot->colour = colour;
                dot->size = size;
                made.points.push_back(dot);
            }
            continue;
        }
        Eigen::Matrix2Xi ends(2, place.cols() - 1);
        for (Eigen::Index i = 0; i < ends.cols(); ++i)
            ends.col(i) << int(i), int(i + 1);
        for (const auto& [colour, width] : {std::pair(palette::casing, 6.f), {colour_of(lines[k].kind), 3.5f}}) {
            const auto line = scene_lines(place, ends);
            line->colour = colour;
            line->width = width;
            made.lines.push_back(line);
        }
    }
    return made;
}

} // namespace

std::vector<std::vector<ClosestPoint>> places_of_lines(const TriMesh& part, const std::vector<ProcessLine>& lines)
{
    std::vector<std::vector<ClosestPoint>> result(lines.size());
    if (lines.empty())
        return result;
    const LineOnPart on_part(part, bounding_diagonal(part) / most_pieces);
    for (size_t k = 0; k < lines.size(); ++k)
        try {
            const std::vector<Eigen::Vector3d>& point = lines[k].point;
            const std::vector<LinePlace> between =
                point.size() > 1 ? on_part.places("", point) : std::vector<LinePlace>{};
            result[k].push_back(on_part.at("", point.front()));
            for (const LinePlace& place : between)
                result[k].push_back(place.on_part);
            if (point.size() > 1)
                result[k].push_back(on_part.at("", point.back()));
        } catch (const InputError&) { // the solver says where it is off
            result[k].clear();
        }
    return result;
}

void add_process_lines(Scene& scene, const ViewerState& state, const Eigen::Matrix3Xd& position,
                       const std::shared_ptr<const SceneMesh>& mesh, SheetCache& cache, SceneCache& shared)
{
    const Document& document = state.document;
    if (document.lines.empty())
        return;
    const auto& part = document.session.part;
    const auto& places =
        shared.line_places.of({part, document.lines}, [&] { return places_of_lines(part->mesh, document.lines); });
    const LineShapes& shown = cache.process_lines.of(
        {mesh, part, document.lines}, [&] { return shapes(document.lines, places, position, part->mesh.triangle); });
    scene.lines.insert(scene.lines.end(), shown.lines.begin(), shown.lines.end());
    scene.points.insert(scene.points.end(), shown.points.begin(), shown.points.end());
    for (size_t k = 0; k < document.lines.size(); ++k)
        if (!places[k].empty()) {
            const ClosestPoint& middle = places[k][places[k].size() / 2];
            scene.labels.push_back({place_on(position, part->mesh.triangle, middle.face, middle.barycentric),
                                    words(document, k), palette::text(state.view.dark)});
        }
}

} // namespace spia::viewer
