#include "app/viewer/model/reports/state_report.h"

#include <algorithm>

#include "app/viewer/model/actions/members.h"
#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/grades.h"
#include "app/viewer/model/picking/handles.h"
#include "app/viewer/model/picking/measuring.h"
#include "app/viewer/model/picking/vertex_picking.h"
#include "app/viewer/model/reports/comparison.h"
#include "app/viewer/model/reports/lights.h"
#include "engine/report/figures/face_values.h"
#include "engine/report/json/report_json.h"

namespace spia::viewer {
namespace {

template <class Vector> Json vector_json(const Vector& v)
{
    return written(Eigen::Vector<double, Vector::RowsAtCompileTime>(v));
}

Json faces_json(const std::vector<int>& faces)
{
    constexpr size_t shown = 10;
    return {{"faces", faces.size()},
            {"first", std::vector<int>(faces.begin(), faces.begin() + long(std::min(shown, faces.size())))}};
}

Json part_json(const Session& session)
{
    if (!session.part)
        return nullptr;
    return {{"file", session.file.string()},
            {"vertices", session.part->mesh.vertices()},
            {"triangles", session.part->mesh.triangles()},
            {"format", session.part->format},
            {"unit", name(session.part->unit)},
            {"seam", session.part->seam},
            {"seam_length", session.part->seam_length}};
}

Json listing_json(const ViewerState& state)
{
    if (!state.listing)
        return nullptr;
    Json json = {{"file", state.listing->file.string()}, {"failure", state.listing->failure}, {"items", nullptr}};
    if (state.listing->listed) {
        json["items"] = Json::array();
        for (const FileItem& item : state.listing->listed->items.item)
            json["items"].push_back({{"choice", item.choice},
                                     {"name", item.name},
                                     {"kind", item.kind},
                                     {"faces", item.faces},
                                     {"parent", item.parent}});
    }
    return json;
}

Json options_json(const Document& document)
{
    const SessionOptions& options = document.session.options;
    return {{"material", document.material},
            {"thickness", options.flatten.thickness},
            {"material_from", name_in_table(document.material_from)},
            {"thickness_from", name_in_table(document.thickness_from)},
            {"blank_from", name(options.steps)},
            {"skins", options.flatten.skins},
            {"seam", written(options.read.seam)},
            {"direction", written(options.flatten.direction)},
            {"k_factor", options.k_factor ? Json(options.k_factor->name) : Json(nullptr)},
            {"corners", written(options.corners)},
            {"grid", written(options.grid)},
            {"fit", written(fit_choice(options))},
            {"patches", written(options.patches)},
            {"best_surface", options.best_surface},
            {"moved_controls", options.deformation ? options.deformation->moves.size() : 0},
            {"lattice", options.deformation && options.deformation->lattice
                            ? written(options.deformation->lattice->count)
                            : Json(nullptr)}};
}

Json stages_json(const Session& session)
{
    return {{"read", session.part != nullptr},
            {"solve", session.blank != nullptr},
            {"grid", session.grid != nullptr},
            {"lift", session.lifted != nullptr},
            {"fit", session.surface != nullptr}};
}

Json figures_json(const Document& document)
{
    Json figures = parse_json(report_json(as_made(document), {}, 0), "figures");
    figures.erase("files");
    return figures;
}

Json regions_json(const std::vector<FaceRegion>& regions)
{
    Json list = Json::array();
    for (const FaceRegion& region : regions) {
        Json json = {{"name", region.name}, {"kind", name(region.kind)}, {"colour", region.colour}};
        json.update(faces_json(region.faces));
        json["contact"] = written(region.contact);
        json["sheet"] = written(region.sheet);
        list.push_back(std::move(json));
    }
    return list;
}

bool shows_field(const Document& document)
{
    return document.display.field != Field::none && available(document.session, document.display.field);
}

/// The field shown, one value per face; empty if none is.
FaceValues shown_field(const ViewerState& state)
{
    return shows_field(state.document) ? face_values(session_of_field(state), state.document.display.field)
                                       : FaceValues();
}

/// The same, its means at the vertices.
Eigen::VectorXd shown_at_vertices(const ViewerState& state)
{
    return shows_field(state.document) ? values(session_of_field(state), state.document.display.field, false)
                                       : Eigen::VectorXd();
}

Json field_json(const Document& document, const FaceValues& field)
{
    if (field.value.size() == 0)
        return nullptr;
    return {
        {"unit", info(document.display.field).unit}, {"least", field.extremes()[0]}, {"greatest", field.extremes()[1]}};
}

Json probes_json(const Document& document, const FaceValues& field)
{
    Json list = Json::array();
    for (const Probe& probe : document.probes) {
        Json json = written(probe);
        if (document.session.part && probe.face >= 0 && probe.face < document.session.part->mesh.triangles()) {
            const TriMesh& mesh = document.session.part->mesh;
            const Eigen::Vector3i corner = mesh.triangle.col(probe.face);
            json["at"] = vector_json(mesh.position(Eigen::all, corner) * probe.barycentric);
            json["value"] = field.value.size() == 0 ? Json(nullptr) : Json(field.value[probe.face]);
        }
        list.push_back(std::move(json));
    }
    return list;
}

Json measurements_json(const Document& document)
{
    Json list = Json::array();
    for (const Measurement& each : document.measurements) {
        Json json = written(each);
        json["value"] = each.found->value;
        json["text"] = text_of(each, LengthUnit::mm);
        json["residual"] = written(each.found->residual);
        json["on_blank"] = written(on_blank(document.session, each));
        list.push_back(std::move(json));
    }
    return list;
}

Json vertices_json(const ViewerState& state)
{
    const Document& document = state.document;
    Json list = Json::array();
    const Session& session = document.session;
    if (document.vertices.empty() || !session.part)
        return list;
    const std::vector<int> boundary = boundary_vertices(session.part->mesh).vertex;
    const Eigen::VectorXd field = shown_at_vertices(state);
    for (const int v : document.vertices)
        list.push_back({{"vertex", v},
                        {"in_file", session.part->source_vertex[size_t(v)]},
                        {"boundary", std::binary_search(boundary.begin(), boundary.end(), v)},
                        {"at", vector_json(session.part->mesh.position.col(v))},
                        {"blank", session.blank ? vector_json(session.blank->blank.position.col(v)) : Json(nullptr)},
                        {"value", field.size() == 0 ? Json(nullptr) : Json(field[v])}});
    return list;
}

/// What is picked of the surface's control points or of its lattice, and where it is now.
Json handles_json(const ViewerState& state)
{
    const Document& document = state.document;
    const HandleKind kind = state.view.handles;
    const std::vector<int>& picked = kind == HandleKind::control ? document.controls : document.lattice_points;
    Json list = Json::array();
    if (!picked.empty()) {
        const Eigen::Matrix3Xd place = handle_positions(document.session, kind);
        for (const int handle : picked)
            if (handle < place.cols())
                list.push_back({{"number", handle}, {"at", vector_json(place.col(handle))}});
    }
    return {{"kind", name_in_table(kind)}, {"picked", list}};
}

Json distance_json(const Document& document)
{
    const auto distance = distance_of_picked(document);
    return distance ? Json{{"part", distance->on_part}, {"blank", written(distance->on_blank)}} : Json(nullptr);
}

Json corners_json(const Session& session)
{
    if (!session.grid)
        return nullptr;
    Json list = Json::array();
    for (const int vertex : session.grid->boundary.corner)
        list.push_back({{"vertex", vertex},
                        {"at", vector_json(session.part->mesh.position.col(vertex))},
                        {"blank", vector_json(session.blank->blank.position.col(vertex))}});
    return list;
}

Json unfolding_json(const ViewerState& state)
{
    const Document& document = state.document;
    const size_t done = steps_done(document);
    Json list = Json::array();
    for (size_t k = 0; k < document.steps.size(); ++k) {
        const PlannedStep& step = *document.steps[k];
        Json json = {{"name", step.name},
                     {"kind", name(step.kind)},
                     {"carrying", carrying_faces(step).size()},
                     {"freed", step.pick.freed.size()},
                     {"offset_mm", step.offset_mm},
                     {"within_mm", step.within_mm},
                     {"extent_mm", written(step.extent_mm)},
                     {"tolerance", written(step.tolerance)},
                     {"target", written(numbers_of(step))},
                     {"friction", written(numbers_of(step.pick.friction))},
                     {"status", name(step_status(document, k))}};
        if (k < done) {
            const UnfoldState& after = document.unfolding->run.states[k];
            const StepFigures& figure = document.unfolding->figure[k];
            json["on"] = after.plain;
            json["thinning"] = figure.thinning;
            json["strain_equivalent"] = figure.strain_equivalent;
            json["reason"] = after.reason;
            json["reach_mm"] = after.reach.farthest_mm;
            json["faces_without_room"] = after.reach.without_room;
            if (figure.hinge)
                json["hinge"] = {{"distance_mm", figure.hinge->distance_mm},
                                 {"angle_deg", figure.hinge->angle_deg},
                                 {"bad", figure.hinge->bad}};
        }
        list.push_back(std::move(json));
    }
    Json json = {{"steps", list}, {"done", done}, {"position", step_position(state)}, {"blank", nullptr}};
    json["still_proposed"] = still_proposed(document);
    json["given_up"] = document.unfolding ? document.unfolding->given_up : std::vector<std::string>{};
    json["failure"] = document.unfolding ? document.unfolding->run.failure : "";
    if (all_steps_done(document) && document.unfolding->run.blank) {
        const Eigen::Matrix2Xd& flat = document.unfolding->run.blank->position;
        json["blank"] = {{"size", vector_json(flat.rowwise().maxCoeff() - flat.rowwise().minCoeff())},
                         {"flipped", document.unfolding->run.flipped}};
    }
    return json;
}

Json messages_json(const std::vector<Message>& messages)
{
    Json list = Json::array();
    for (const Message& message : messages)
        if (message.shown())
            list.push_back({{"severity", name_in_table(message.severity)}, {"text", message.text}});
    return list;
}

/// What is poor, and what the light at the foot of the window says of it.
Json doubts_json(const ViewerState& state)
{
    Json list = Json::array();
    for (const Doubt& doubt : state.doubts ? *state.doubts : std::vector<Doubt>())
        list.push_back({{"step", name_in_table(doubt.step)},
                        {"text", doubt.text},
                        {"next", doubt.next},
                        {"button", doubt.button}});
    return list;
}

Json doctor_json(const ViewerState& state)
{
    const PartFile* part = examined(state);
    if (!part)
        return nullptr;
    Json findings = Json::array();
    for (const Finding& finding : part->doctor.findings)
        findings.push_back({{"fault", name(finding.fault)}, {"count", finding.count}, {"text", finding.text}});
    Json json = {{"refused", part == state.refused.get()}, {"findings", findings}};
    if (state.refused_file)
        json["refused_file"] = {{"file", state.refused_file->file.string()}, {"shown", state.refused_file->shown}};
    if (state.fault)
        json["shown"] = vector_json(state.fault->place);
    return json;
}

/// Grades by their labels, those at fault apart.
Json grades_json(const ViewerState& state)
{
    Json built_in = Json::array(), own = Json::array(), at_fault = Json::object();
    for (const Grade& grade : state.grades ? *state.grades : std::vector<Grade>()) {
        (grade.own ? own : built_in).push_back(grade.label());
        if (!grade.material)
            at_fault[grade.label()] = grade.problem;
    }
    return {{"built_in", built_in}, {"own", own}, {"at_fault", at_fault}};
}

Json comparison_json(const ViewerState& state)
{
    if (!state.reference)
        return nullptr;
    Json json = {{"reference", state.reference->name}};
    if (const auto& differences = state.differences) {
        json["by_face"] = differences->none_because.empty();
        json["outline_distance"] =
            differences->none_because.empty() ? Json(differences->outline_distance) : Json(nullptr);
        Json& figures = json["figures"] = Json::object();
        for (const ComparedFigure& each : compared_figures(*state.reference, state.document.session))
            figures[each.name] = {{"reference", written(each.reference)}, {"now", written(each.now)}};
    }
    return json;
}

} // namespace

Json state_report(const ViewerState& state)
{
    const Document& document = state.document;
    const FaceValues field = shown_field(state);
    return {{"schema", "spia-state/1"},
            {"part", part_json(document.session)},
            {"listing", listing_json(state)},
            {"options", options_json(document)},
            {"stages", stages_json(document.session)},
            {"figures", figures_json(document)},
            {"selection", faces_json(document.selected)},
            {"vertices", vertices_json(state)},
            {"distance", distance_json(document)},
            {"handles", handles_json(state)},
            {"regions", regions_json(document.regions)},
            {"lines", written(document.lines)},
            {"process", {{"edge_restraint", document.edge_restraint}, {"rolling", written(document.rolling)}}},
            {"limits", written(document.limits)},
            {"grades", grades_json(state)},
            {"comparison", comparison_json(state)},
            {"unfolding", unfolding_json(state)},
            {"probes", probes_json(document, field)},
            {"measurements", measurements_json(document)},
            {"spot", state.spot ? Json(state.spot->face) : Json(nullptr)},
            {"display", written(document.display)},
            {"field", field_json(document, field)},
            {"view", written(state.view)},
            {"preferences", written(state.preferences)},
            {"corners", corners_json(document.session)},
            {"history", {{"undo", state.history.undo_name()}, {"redo", state.history.redo_name()}}},
            {"messages", messages_json(state.messages)},
            {"doubts", doubts_json(state)},
            {"ready", {{"fine", readiness(state).fine}, {"text", readiness(state).text}}},
            {"doctor", doctor_json(state)},
            {"job",
             {{"running", state.job.running},
              {"cancelling", state.job.cancelling},
              {"title", state.job.title},
              {"step", state.job.step},
              {"fraction", state.job.fraction},
              {"steps", state.job.residual.size()}}},
            {"project",
             {{"file", state.project.string()},
              {"unsaved", state.document.unsaved},
              {"waits", state.read_and_waits ? state.read_and_waits->string() : ""}}},
            {"hovered", state.hovered ? Json(*state.hovered) : Json(nullptr)},
            {"hovered_vertex", written(state.hovered_vertex)}};
}

} // namespace spia::viewer
