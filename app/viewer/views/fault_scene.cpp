#include "app/viewer/views/fault_scene.h"

#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"
#include "engine/report/text/lengths.h"
#include "engine/report/text/shown_lengths.h"

namespace spia::viewer {
namespace {

std::shared_ptr<const ScenePoints> dots(const Eigen::Matrix3Xd& place, const Colour& colour, float size)
{
    const auto points = scene_points(place);
    points->colour = colour;
    points->size = size;
    return points;
}

Eigen::Matrix3Xd places_of_fatal(const DoctorReport& report)
{
    std::vector<Eigen::Vector3d> place;
    for (const Finding& finding : report.findings)
        if (finding.severity == spia::Severity::fatal)
            for (const Eigen::Vector3d& p : finding.place)
                if (p.allFinite())
                    place.push_back(p);
    Eigen::Matrix3Xd all(3, Eigen::Index(place.size()));
    for (size_t i = 0; i < place.size(); ++i)
        all.col(Eigen::Index(i)) = place[i];
    return all;
}

} // namespace

Scene refused_scene(const ViewerState& state, SceneCache& cache)
{
    Scene result;
    const PartFile& part = *state.refused;
    if (part.mesh.triangles() == 0) {
        result.empty = "This file holds no sheet that could be shown; the step Part says why.";
        return result;
    }
    const StageShape& shape = cache.refused.of({state.refused}, [&] {
        StageShape made;
        SceneLayer layer;
        layer.mesh = std::make_shared<SceneMesh>(scene_mesh(part.mesh));
        made.layers.push_back(layer);
        made.box =
            Eigen::AlignedBox3d(part.mesh.position.rowwise().minCoeff(), part.mesh.position.rowwise().maxCoeff());
        if (const Eigen::Matrix3Xd place = places_of_fatal(part.doctor); place.cols() > 0)
            made.points = {dots(place, palette::casing, 9), dots(place, palette::folded, 7)};
        return made;
    });
    result.layers = shape.layers;
    result.layers[0].edges = state.view.edges;
    result.points = shape.points;
    result.box = shape.box;
    return result;
}

void add_shown_fault(Scene& scene, const ViewerState& state)
{
    if (!state.fault || !state.fault->place.allFinite())
        return;
    const PartFile* part = examined(state);
    if (!part || size_t(state.fault->finding) >= part->doctor.findings.size())
        return;
    const Eigen::Matrix3Xd place = state.fault->place;
    for (const auto& [colour, size] :
         {std::pair(palette::casing, 17.f), std::pair(palette::probe, 14.f), std::pair(palette::casing, 8.f)})
        scene.points.push_back(dots(place, colour, size));
    const Finding& finding = part->doctor.findings[size_t(state.fault->finding)];
    const auto entry = size_t(state.fault->entry);
    const std::string what =
        entry < finding.what.size() ? ": " + in_shown_lengths(finding.what[entry], state.preferences.lengths) : "";
    scene.labels.push_back(
        {state.fault->place, std::string(name(finding.fault)) + what, palette::text(state.view.dark)});
}

} // namespace spia::viewer
