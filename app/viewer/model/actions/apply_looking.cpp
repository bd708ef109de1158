#include "app/viewer/model/actions/apply.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/picking/clear_sight.h"
#include "app/viewer/model/picking/view_cube.h"
#include "app/viewer/model/reports/comparison.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

/// mm, that shows all of the bend that a face is in; 0: it is in none.
double bend_around(const Session& session, int face)
{
    if (!session.bends)
        return 0;
    const auto bend = std::ranges::find_if(
        session.bends->bends, [&](const SheetBend& each) { return std::ranges::binary_search(each.faces, face); });
    if (bend == session.bends->bends.end())
        return 0;
    Eigen::AlignedBox3d box;
    for (const int f : bend->faces)
        for (const int v : session.part->mesh.triangle.col(f))
            box.extend(session.part->mesh.position.col(v));
    constexpr double room = 1.3;
    return room * box.diagonal().norm();
}

/// mm, so that a face is seen among its neighbours
double some_faces(const TriMesh& mesh, int face)
{
    constexpr double faces = 12; // across the view
    const Eigen::Matrix3d corner = mesh.position(Eigen::all, mesh.triangle.col(face));
    double longest = 0;
    for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (corner.col((k + 1) % 3) - corner.col(k)).norm());
    return faces * longest;
}

} // namespace

void ViewerModel::Apply::operator()(const SetDisplay& action)
{
    state.history.remember("Change display", document,
                           true); // also while another file is being read, which takes it over
    document.display = action.display;
}

void ViewerModel::Apply::operator()(const SetViewSettings& action)
{
    if (action.view.dark != state.view.dark) // a theme that is chosen stays chosen
        state.preferences.dark = action.view.dark;
    if (action.view.mouse != state.view.mouse) // as its habits do
        state.preferences.mouse = action.view.mouse;
    state.view = action.view;
}

void ViewerModel::Apply::operator()(const KeepReference& action)
{
    state.reference = std::make_shared<const Reference>(reference_of(document, action.name, state.preferences.lengths));
    model.say(Severity::done, fmt::format("Kept as reference: {}.", state.reference->name));
}

void ViewerModel::Apply::operator()(const LookFrom& action)
{
    for (const View view : all_views)
        if (view == action.view || (state.view.linked && view != View::blank && action.view != View::blank))
            state.view.camera[size_t(view)] = look(state.view.camera[size_t(view)], action.from);
}

void ViewerModel::Apply::operator()(const LookFromSide& action)
{
    for (const View view : all_views)
        if (view == action.view || (state.view.linked && view != View::blank && action.view != View::blank))
            state.view.camera[size_t(view)] = look_from(state.view.camera[size_t(view)], action.side);
}

void ViewerModel::Apply::operator()(const FlyTo& action)
{
    const TriMesh& mesh = part().mesh;
    if (action.face < 0 || action.face >= mesh.triangles())
        throw InputError(fmt::format("The part has no face {}.", action.face));
    const auto t = mesh.triangle.col(action.face);
    const std::array<Camera, 4> before = left_at(state.spot ? &state.spot->back : nullptr);
    const FieldDisplay other =
        state.spot && state.spot->since == document.display ? state.spot->before : document.display;
    if (action.field && *action.field != document.display.field) {
        SetDisplay display{with_field(other, *action.field, state.preferences.map)};
        display.display.difference = false; // a limit is held against values
        (*this)(display);
    }
    look_at({t[0], t[1], t[2]}, bend_around(session, action.face), some_faces(mesh, action.face));
    state.spot = ShownSpot{action.face, {before, state.view.camera}, other, document.display, session.part};
}

void ViewerModel::Apply::operator()(const HideSpot&)
{
    if (!state.spot)
        return;
    go_back(state.spot->back);
    if (document.display == state.spot->since && document.display != state.spot->before)
        (*this)(SetDisplay{state.spot->before});
    state.spot.reset();
}

void ViewerModel::Apply::operator()(const HideFault&)
{
    if (!state.fault)
        return;
    go_back(state.fault->back);
    state.fault.reset();
}

/// From place to place the way back leads to where the first one was left.
std::array<Camera, 4> ViewerModel::Apply::left_at(const WayBack* way) const
{
    return way && way->since == state.view.camera ? way->before : state.view.camera;
}

void ViewerModel::Apply::go_back(const WayBack& way)
{
    for (const View view : all_views)
        if (state.view.camera[size_t(view)] == way.since[size_t(view)])
            state.view.camera[size_t(view)] = way.before[size_t(view)];
}

void ViewerModel::Apply::operator()(const FlyToVertex& action)
{
    require_vertices({action.vertex});
    look_at({action.vertex});
}

void ViewerModel::Apply::look_at(const std::vector<int>& vertices, double at_least, double usual)
{
    const TriMesh& mesh = part().mesh;
    const auto middle = [&](const auto& position) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const int v : vertices)
            sum.head(position.rows()) += position.col(v) / double(vertices.size());
        return glm::dvec3(sum[0], sum[1], sum[2]);
    };
    const double size = std::max(at_least, std::min(usual, 0.15 * bounding_diagonal(mesh)));
    for (const View view : all_views) {
        if (view == View::blank && !session.blank)
            continue;
        Camera& camera = state.view.camera[size_t(view)];
        camera.target = view == View::blank ? middle(session.blank->blank.position) : middle(mesh.position);
        if (view != View::blank)
            camera.turn = clear_sight(mesh, {camera.target.x, camera.target.y, camera.target.z}, camera.turn);
        camera.height = std::min(camera.height, size);
    }
}

void ViewerModel::Apply::operator()(const ShowFault& action)
{
    const PartFile* part = examined(state);
    if (!part)
        throw InputError("Open a part first.");
    const auto& findings = part->doctor.findings;
    if (action.finding < 0 || size_t(action.finding) >= findings.size())
        throw InputError(fmt::format("The mesh doctor has no finding {}.", action.finding));
    const auto& place = findings[size_t(action.finding)].place;
    if (action.entry < 0 || size_t(action.entry) >= place.size())
        throw InputError(fmt::format("This finding has no place {}.", action.entry));
    const Eigen::Vector3d& at = place[size_t(action.entry)];
    constexpr double beyond_any_part = 1e9; // mm
    if (!at.allFinite() || at.cwiseAbs().maxCoeff() > beyond_any_part)
        throw InputError("This place has no coordinates that could be shown.");
    const std::array<Camera, 4> before = left_at(state.fault ? &state.fault->back : nullptr);
    const double size = 0.15 * bounding_diagonal(part->mesh);
    for (const View view : all_views) {
        Camera& camera = state.view.camera[size_t(view)];
        if (view == View::part || (state.view.linked && view != View::blank && !shows_refused(state))) {
            camera.target = glm::dvec3(at[0], at[1], at[2]);
            camera.turn = clear_sight(part->mesh, at, camera.turn);
            if (size > 0)
                camera.height = std::min(camera.height, size);
        }
    }
    state.fault = ShownFault{action.finding, action.entry, at, {before, state.view.camera}};
}

} // namespace spia::viewer
