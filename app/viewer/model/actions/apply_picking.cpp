#include "app/viewer/model/actions/apply.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/picking/measuring.h"
#include "engine/part/vertex_numbers.h"

namespace spia::viewer {

void ViewerModel::Apply::select(std::vector<int> faces, PickMode mode, const char* name)
{
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    if (!faces.empty() && (faces.front() < 0 || faces.back() >= part().mesh.triangles()))
        throw InputError(fmt::format("The part has no face {}.", faces.front() < 0 ? faces.front() : faces.back()));
    FaceSet result = picked(document.selected, faces, mode);
    if (result == document.selected)
        return;
    change(name, name == std::string_view("Brush faces"));
    document.selected = std::move(result);
}

const RayPicker& ViewerModel::Apply::picker(View view)
{
    model.pickers_.follow_steps(state);
    if (view == View::part && shows_refused(state))
        throw InputError(
            "The view shows the file that was refused; go back to the part in the step Part to pick on it.");
    if (view == View::part && model.pickers_.on_the_way())
        throw InputError(
            "The part is shown between two steps; move the slider of the steps to a whole step to pick on it.");
    if (const RayPicker* found = model.pickers_.picker(session, view))
        return *found;
    throw InputError(!session.part         ? "Open a part first."
                     : view == View::blank ? "Unfold the part first."
                                           : "Make the grid and the surface first: the view shows nothing yet.");
}

void ViewerModel::Apply::operator()(const PickAt& action)
{
    const RayPicker& on = picker(action.view);
    select(faces_at(action, camera(action.view), on, model.pickers_.regions(session), kept(action.view)), action.mode,
           action.flood    ? "Flood fill"
           : action.smooth ? "Select smooth region"
                           : "Pick face");
}

void ViewerModel::Apply::operator()(const PickArea& action)
{
    const RayPicker& on = picker(action.view);
    select(faces_in(action, camera(action.view), *model.pickers_.mesh(session, action.view), on, kept(action.view)),
           action.mode, action.polygon.size() == 4 ? "Select by box" : "Select by lasso");
}

void ViewerModel::Apply::operator()(const PickBrush& action)
{
    const RayPicker& on = picker(action.view);
    select(faces_under(action, camera(action.view), *model.pickers_.mesh(session, action.view), on, kept(action.view)),
           action.mode, "Brush faces");
}

void ViewerModel::Apply::operator()(const GrowSelection&)
{
    select(grown(part().mesh, document.selected), PickMode::replace, "Grow selection");
}

void ViewerModel::Apply::operator()(const ShrinkSelection&)
{
    select(shrunk(part().mesh, document.selected), PickMode::replace, "Shrink selection");
}

void ViewerModel::Apply::operator()(const InvertSelection&)
{
    select(inverted(document.selected, part().mesh.triangles()), PickMode::replace, "Invert selection");
}

void ViewerModel::Apply::operator()(const ClearSelection&)
{
    std::vector<int>* const picked[] = {&document.selected, &document.vertices, &document.controls,
                                        &document.lattice_points};
    if (std::all_of(std::begin(picked), std::end(picked), [](const auto* list) { return list->empty(); }))
        return;
    change("Clear selection");
    for (std::vector<int>* list : picked)
        list->clear();
}

void ViewerModel::Apply::select_vertices(std::vector<int> vertices, PickMode mode, const char* name)
{
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    require_vertices(vertices);
    std::vector<int> result = picked(document.vertices, vertices, mode);
    if (result == document.vertices)
        return;
    change(name);
    document.vertices = std::move(result);
}

void ViewerModel::Apply::require_vertices(const std::vector<int>& vertices) const
{
    if (!vertices.empty() && (vertices.front() < 0 || vertices.back() >= part().mesh.vertices()))
        throw InputError(
            fmt::format("The part has no vertex {}.", vertices.front() < 0 ? vertices.front() : vertices.back()));
}

void ViewerModel::Apply::operator()(const PickVertex& action)
{
    picker(action.view); // says what is missing
    const std::optional<int> vertex = model.pickers_.vertex_at(session, action, camera(action.view), kept(action.view));
    select_vertices(vertex ? std::vector{*vertex} : std::vector<int>{}, action.mode,
                    action.boundary ? "Pick boundary vertex" : "Pick vertex");
}

void ViewerModel::Apply::operator()(const UseVerticesAsCorners&)
{
    require_one_patch();
    const PartFile& file = part();
    std::array<int, 4> corners = corners_of(document.vertices, model.pickers_.outline(session), file.source_vertex);
    if (session.blank) { // begin where the automatic ones would: lowest to the left
        const Eigen::Matrix2Xd& plane = session.blank->blank.position;
        const auto height = [&](int v) { return plane.col(v).sum(); };
        std::rotate(
            corners.begin(),
            std::min_element(corners.begin(), corners.end(), [&](int a, int b) { return height(a) < height(b); }),
            corners.end());
    }
    change("Use vertices as corners");
    for (int& corner : corners)
        corner = number_of(file, corner);
    session.options.corners = corners;
    if (session.blank)
        model.run_to(Stage::fit, "Making the grid");
}

size_t ViewerModel::Apply::region(int number) const
{
    if (number < 0 || size_t(number) >= document.regions.size())
        throw InputError(fmt::format("There is no region {}.", number + 1));
    return size_t(number);
}

void ViewerModel::Apply::require_some_free(RegionKind kind, const std::vector<int>& faces) const
{
    if (kind == RegionKind::fixed && int(faces.size()) == part().mesh.triangles())
        throw InputError(
            "That is the whole part: nothing would be left to be unfolded. Select one flat side of it, with "
            "the tool Smooth (N).");
}

void ViewerModel::Apply::operator()(const MakeRegion& action)
{
    constexpr size_t most = 62; // FaceMarks
    static constexpr std::array<Colour, 6> colours = {Colour{0.96f, 0.76f, 0.18f, 1}, {0.30f, 0.69f, 0.36f, 1},
                                                      {0.35f, 0.60f, 0.92f, 1},       {0.86f, 0.42f, 0.64f, 1},
                                                      {0.55f, 0.47f, 0.85f, 1},       {0.30f, 0.72f, 0.74f, 1}};
    if (document.selected.empty())
        throw InputError("Select faces first; a region is made of them.");
    if (document.regions.size() >= most)
        throw InputError(fmt::format("There are {} regions already; remove one first.", most));
    require_some_free(action.kind, document.selected);
    change("Make region");
    FaceRegion made;
    made.kind = action.kind;
    made.name =
        action.name.empty() ? fmt::format("{} {}", name(action.kind), document.regions.size() + 1) : action.name;
    made.colour = colours[document.regions.size() % colours.size()];
    made.faces = document.selected;
    document.regions.push_back(std::move(made));
}

void ViewerModel::Apply::operator()(const SelectRegion& action)
{
    select(document.regions[region(action.region)].faces, action.mode, "Select region");
}

void ViewerModel::Apply::operator()(const AddProbe& action)
{
    if (action.probe.face < 0 || action.probe.face >= part().mesh.triangles())
        throw InputError(fmt::format("The part has no face {}.", action.probe.face));
    change("Pin probe");
    document.probes.push_back(action.probe);
}

void ViewerModel::Apply::operator()(const RemoveProbe& action)
{
    if (action.probe < 0 || size_t(action.probe) >= document.probes.size())
        throw InputError(fmt::format("There is no probe {}.", action.probe + 1));
    change("Remove probe");
    document.probes.erase(document.probes.begin() + action.probe);
}

void ViewerModel::Apply::operator()(const ClearProbes&)
{
    change("Remove all probes");
    document.probes.clear();
}

void ViewerModel::Apply::operator()(const DrawSection& action)
{
    if (action.view == View::part && step_position(state) > 0)
        throw InputError("Sections are cut through the formed part; move the slider of the steps back to the part.");
    const RayPicker& on = picker(action.view);
    const Camera& from = camera(action.view);
    const Ray a = ray_through(from, on.box(), action.from, action.size),
              b = ray_through(from, on.box(), action.to, action.size);
    // Both ends at the same depth, that of the place nearest to the first end that is on the sheet.
    constexpr int looks = 200;
    std::optional<Eigen::Vector3d> found;
    for (int k = 0; k <= looks && !found; ++k) {
        const glm::dvec2 pixel = glm::mix(action.from, action.to, double(k) / looks);
        const RayHit there = hit_at(from, on, pixel, action.size, kept(action.view));
        const Ray ray = ray_through(from, on.box(), pixel, action.size);
        if (there.face >= 0)
            found = ray.origin + there.distance * ray.direction;
    }
    if (!found)
        throw InputError("The section line does not cross the sheet; draw it across the sheet.");
    const Eigen::Vector3d hit = *found;
    const Eigen::Vector3d sight = ray_through(from, on.box(), action.size / 2., action.size).direction;
    const auto at_depth = [&](const Ray& ray) -> Eigen::Vector3d {
        return ray.origin + sight.dot(hit - ray.origin) / sight.dot(ray.direction) * ray.direction;
    };
    SectionLine line{at_depth(a), at_depth(b), sight, action.view == View::blank};
    if (!((line.to - line.from).norm() > 0))
        throw InputError("Drag the mouse to draw a section line.");
    change("Draw section");
    document.section = line;
}

void ViewerModel::Apply::operator()(const ClearSection&)
{
    change("Remove section");
    document.section.reset();
}

void ViewerModel::Apply::operator()(const AddMeasurement& action)
{
    part();
    Measurement made = action.measurement;
    const std::shared_ptr<const TriMesh> mesh = measured_mesh(state, made.on);
    if (!mesh)
        throw InputError(fmt::format("There is nothing to measure in the view {} yet.", title(made.on)));
    const bool by_region = made.kind == MeasureKind::rounding && made.on == View::part;
    made.found =
        std::make_shared<const Measured>(measured(*mesh, made, by_region ? &model.pickers_.regions(session) : nullptr));
    change("Measure");
    document.measurements.push_back(std::move(made));
}

void ViewerModel::Apply::operator()(const RemoveMeasurement& action)
{
    if (action.measurement < 0 || size_t(action.measurement) >= document.measurements.size())
        throw InputError(fmt::format("There is no measurement {}.", action.measurement + 1));
    change("Remove measurement");
    document.measurements.erase(document.measurements.begin() + action.measurement);
}

void ViewerModel::Apply::operator()(const ClearMeasurements&)
{
    change("Remove all measurements");
    document.measurements.clear();
}

} // namespace spia::viewer
