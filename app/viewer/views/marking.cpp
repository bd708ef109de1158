#include "app/viewer/views/marking.h"

#include <algorithm>
#include <fmt/core.h>
#include <limits>
#include <map>

#include "app/viewer/model/reports/viewer_words.h"
#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"

namespace spia::viewer {
namespace {

constexpr size_t most_regions = FaceMarks::region; // more share the last colour

/// mm, of the flat sheet at a face: that of the last piece of a tailored blank that covers it.
double flat_thickness(const ViewerState& state, int face)
{
    double thickness = state.document.made_with.flatten.thickness;
    for (const TailoredPiece& piece : state.document.made_with.flatten.process.tailored)
        if (std::find(piece.faces.begin(), piece.faces.end(), face) != piece.faces.end())
            thickness = piece.thickness;
    return thickness;
}

} // namespace

std::string extreme_words(const ViewerState& state, int face, double value, bool greatest)
{
    const FieldDisplay& display = state.document.display;
    const LengthUnit lengths = state.preferences.lengths;
    const std::string said = value_text(value, info(display.field).unit, lengths);
    const bool thinning = display.field == Field::thinning;
    if (display.difference || (!thinning && display.field != Field::thickness))
        return fmt::format("{} {}", greatest ? "max" : "min", said);
    const char* word = greatest == thinning ? "thinnest" : "thickest";
    if (!thinning)
        return fmt::format("{} {}", word, said);
    return fmt::format("{} {} ({})", word, fixed_length(flat_thickness(state, face) * (1 - value / 100), lengths, 3),
                       said);
}

std::shared_ptr<const FaceMarks> face_marks(int faces, const std::vector<int>& selected,
                                            const std::vector<FaceRegion>& regions)
{
    const auto there = [&](int face) { return face >= 0 && face < faces; };
    auto marks = std::make_shared<FaceMarks>();
    marks->mark.assign(size_t(faces), 0);
    for (size_t r = 0; r < regions.size(); ++r)
        for (const int face : regions[r].faces)
            if (there(face))
                marks->mark[size_t(face)] = uint8_t(std::min(r + 1, most_regions));
    for (const int face : selected)
        if (there(face))
            marks->mark[size_t(face)] |= FaceMarks::selected;
    if (std::all_of(marks->mark.begin(), marks->mark.end(), [](uint8_t mark) { return mark == 0; }))
        return nullptr;
    return marks;
}

void add_hovered(Scene& scene, const ViewerState& state, const Eigen::Matrix3Xd& position)
{
    const Eigen::Matrix3Xi& triangle = state.document.session.part->mesh.triangle;
    const std::optional<int> face = state.hovered;
    if (face && *face >= 0 && *face < triangle.cols())
        scene.hovered = {position.col(triangle(0, *face)), position.col(triangle(1, *face)),
                         position.col(triangle(2, *face))};
}

void add_spot(Scene& scene, const ViewerState& state, const Eigen::Matrix3Xd& position)
{
    const Eigen::Matrix3Xi& triangle = state.document.session.part->mesh.triangle;
    if (state.spot && state.spot->of == state.document.session.part && state.spot->face < triangle.cols())
        scene.rings.push_back({place_on(position, triangle, state.spot->face, Eigen::Vector3d::Constant(1. / 3))});
}

std::vector<Colour> region_colours(const std::vector<FaceRegion>& regions)
{
    std::vector<Colour> colours;
    for (size_t r = 0; r < std::min(regions.size(), most_regions); ++r)
        colours.push_back(regions[r].colour);
    return colours;
}

LineList outline_of_faces(const SceneMesh& mesh, const std::vector<int>& faces, float width, bool on_top,
                          const Colour& core_colour)
{
    // A repeated vertex is the one it repeats, or sharp edges inside would count as outline.
    const Eigen::Index vertices = mesh.position.cols() - Eigen::Index(mesh.repeated.size());
    const auto original = [&](uint32_t v) { return v < vertices ? v : mesh.repeated[size_t(v - vertices)]; };
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (const int f : faces)
        if (f >= 0 && f < mesh.triangle.cols())
            for (int k = 0; k < 3; ++k)
                ++uses[std::minmax(original(mesh.triangle(k, f)), original(mesh.triangle((k + 1) % 3, f)))];
    std::vector<Eigen::Vector3f> ends;
    for (const auto& [edge, count] : uses)
        if (count == 1) {
            ends.emplace_back(mesh.position.col(edge.first));
            ends.emplace_back(mesh.position.col(edge.second));
        }
    if (ends.empty())
        return {};
    auto casing = std::make_shared<SceneLines>();
    casing->origin = mesh.origin;
    casing->point.resize(3, Eigen::Index(ends.size()));
    for (size_t i = 0; i < ends.size(); ++i)
        casing->point.col(Eigen::Index(i)) = ends[i];
    casing->colour = palette::casing;
    casing->width = width + 2;
    casing->on_top = on_top;
    auto core = std::make_shared<SceneLines>(*casing);
    core->colour = core_colour;
    core->width = width;
    return {casing, core};
}

LineList region_borders(const SceneMesh& mesh, const std::vector<FaceRegion>& regions)
{
    LineList result;
    for (const FaceRegion& region : regions) {
        const LineList lines = outline_of_faces(mesh, region.faces, 3.5f, false, region.colour);
        result.insert(result.end(), lines.begin(), lines.end());
    }
    return result;
}

std::vector<SceneLabel> region_labels(const Eigen::Matrix3Xi& triangle, const Eigen::Matrix3Xd& position,
                                      const std::vector<FaceRegion>& regions, bool dark, LengthUnit lengths)
{
    std::vector<SceneLabel> labels;
    for (const FaceRegion& region : regions) {
        double area = 0;
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        const auto there = [&](int face) { return face >= 0 && face < triangle.cols(); };
        const auto centre = [&](int face) {
            return place_on(position, triangle, face, Eigen::Vector3d::Constant(1. / 3));
        };
        for (const int face : region.faces)
            if (there(face)) {
                const Eigen::Matrix3d corner = position(Eigen::all, triangle.col(face));
                const double twice = (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0)).norm();
                middle += twice * centre(face);
                area += twice;
            }
        if (!(area > 0))
            continue;
        middle /= area;
        double least = std::numeric_limits<double>::infinity();
        Eigen::Vector3d place = middle; // may lie beside the faces, as in the middle of a ring
        for (const int face : region.faces)
            if (there(face))
                if (const double away = (centre(face) - middle).squaredNorm(); away < least) {
                    least = away;
                    place = centre(face);
                }
        const std::string load = load_words(region, lengths);
        labels.push_back({place, load.empty() ? region.name : fmt::format("{}: {}", region.name, load),
                          palette::text(dark), LabelKind::region});
    }
    return labels;
}

Eigen::Vector3d place_on(const Eigen::Matrix3Xd& position, const Eigen::Matrix3Xi& triangle, int face,
                         const Eigen::Vector3d& barycentric)
{
    return position(Eigen::all, triangle.col(face)) * barycentric;
}

void add_watched_places(Scene& scene, const ViewerState& state, const FieldValues* values,
                        const Eigen::Matrix3Xd& position)
{
    add_spot(scene, state, position);
    const Eigen::Matrix3Xi& triangle = state.document.session.part->mesh.triangle;
    const FieldDisplay& display = state.document.display;
    const std::string_view unit = info(display.field).unit;
    const Colour text = palette::text(state.view.dark);
    const auto centre = [&](int face) { return place_on(position, triangle, face, Eigen::Vector3d::Constant(1. / 3)); };
    const auto dots = [&](const std::vector<Eigen::Vector3d>& places, const Colour& colour) {
        if (places.empty())
            return;
        Eigen::Matrix3Xd all(3, Eigen::Index(places.size()));
        for (size_t i = 0; i < places.size(); ++i)
            all.col(Eigen::Index(i)) = places[i];
        const auto points = scene_points(all);
        points->colour = colour;
        points->size = 9;
        scene.points.push_back(points);
    };

    const auto here = [&](int face) { return values->said.value[face]; };
    if (values && display.extremes && display.field != Field::zone && values->said.least >= 0 &&
        here(values->said.least) != here(values->said.greatest)) {
        std::vector<Eigen::Vector3d> places;
        for (const bool greatest : {false, true}) {
            const int at = greatest ? values->said.greatest : values->said.least;
            places.push_back(centre(at));
            scene.labels.push_back({places.back(), extreme_words(state, at, here(at), greatest), text});
        }
        dots(places, palette::extreme);
    }

    std::vector<Eigen::Vector3d> places;
    for (const Probe& probe : state.document.probes) {
        if (probe.face < 0 || probe.face >= triangle.cols())
            continue; // of another part; the user sees it in the list of probes
        places.push_back(place_on(position, triangle, probe.face, probe.barycentric));
        scene.labels.push_back({places.back(),
                                fmt::format("P{}  {}", &probe - state.document.probes.data() + 1,
                                            values ? value_text(here(probe.face), unit, state.preferences.lengths)
                                                   : fmt::format("face {}", probe.face)),
                                text});
    }
    dots(places, palette::probe);
}

} // namespace spia::viewer
