#include "app/viewer/model/actions/script.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <type_traits>

#include "app/viewer/model/actions/members.h"
#include "engine/core/error.h"
#include "engine/forming/material/material_text.h"

namespace spia::viewer {

template <> inline constexpr auto members_of<Wait> = std::tuple{member("seconds", &Wait::seconds, Between{0, 1e6})};
template <>
inline constexpr auto members_of<Expect> =
    std::tuple{required("at", &Expect::at),           member("equals", &Expect::equals),
               member("above", &Expect::above),       member("below", &Expect::below),
               member("near", &Expect::near),         member("tolerance", &Expect::tolerance, Between{0, 1e300}),
               member("contains", &Expect::contains), member("exists", &Expect::exists)};

/// A grade is written as in its file.
template <> void read(const Json& json, Material& material, const Place& place)
{
    material = material_from(json.dump(), place.text());
}
template <> Json written(const Material& material) { return Json::parse(material_text(material)); }

namespace {

constexpr std::string_view schema = "spia-script/1";

/// An action's name and members; `inner`, if it is not null, is the only member of the action, and
/// the members are its.
template <class T, class Inner, class... M> struct Form {
    std::string_view name;
    Inner T::*inner;
    std::tuple<M...> members;
};
struct Nothing {};
template <class... Each> struct Forms : Each... {
};
template <class... Each> Forms(Each...) -> Forms<Each...>;
template <class T, class... M> constexpr Form<T, Nothing, M...> form(std::string_view name, M... members)
{
    return {name, nullptr, std::tuple{members...}};
}
template <class T, class Inner> constexpr auto form_of_inner(std::string_view name, Inner T::*inner)
{
    return std::apply(
        [&](auto... m) {
            return Form<T, Inner, decltype(m)...>{name, inner, std::tuple{m...}};
        },
        members_of<Inner>);
}

constexpr auto has_a_direction = [](const std::optional<Eigen::Vector3d>& direction, const Place& place) {
    if (direction && !(direction->norm() > 0))
        place.fail("must have a length; null stands for the automatic direction");
};
constexpr auto not_empty = [](const auto& list, const Place& place) {
    if (list.empty())
        place.fail("must not be empty");
};
constexpr auto has_extent = [](const glm::dvec2& size, const Place& place) {
    if (!(size.x > 0 && size.y > 0))
        place.fail("must be the width and height of the view in pixels");
};
constexpr auto encloses = [](const std::vector<glm::dvec2>& polygon, const Place& place) {
    if (polygon.size() < 3)
        place.fail("must have at least three corners");
};
constexpr Between share{0, 1}, pixels{0, 16384};

// Every action.
constexpr Forms forms{
    form<ListFile>("list_file", required("file", &ListFile::file, not_empty), member("again", &ListFile::again)),
    form<CloseList>("close_list"),
    form<OpenPart>("open_part", required("file", &OpenPart::file, not_empty), member("unit", &OpenPart::unit),
                   member("reading", &OpenPart::reading)),
    form<SetUnit>("set_unit", required("unit", &SetUnit::unit)),
    form_of_inner("set_reading", &SetReading::reading),
    form<ReadAgain>("read_again", member("unit", &ReadAgain::unit), member("reading", &ReadAgain::reading)),
    form_of_inner("set_seam", &SetSeam::seam),
    form<SetRemeshing>("set_remeshing", member("remesh", &SetRemeshing::remesh)),
    form<RunTo>("run_to", member("stage", &RunTo::stage)),
    form<CancelJob>("cancel_job"),
    form<SetMaterial>("set_material", required("material", &SetMaterial::material, not_empty)),
    form<FitMaterial>("fit_material", required("table", &FitMaterial::table, not_empty),
                      required("out", &FitMaterial::out, not_empty), member("fit", &FitMaterial::fit)),
    form<SaveMaterial>("save_material", required("material", &SaveMaterial::material),
                       member("replaces", &SaveMaterial::replaces)),
    form<RemoveMaterial>("remove_material", required("material", &RemoveMaterial::material, not_empty)),
    form<SetThickness>("set_thickness", required("thickness", &SetThickness::thickness, Between{1e-6, 1e6})),
    form<SetSkins>("set_skins", required("skins", &SetSkins::skins)),
    form<SetDirection>("set_direction", member("direction", &SetDirection::direction, has_a_direction)),
    form<SetKFactor>("set_k_factor", member("k_factor", &SetKFactor::k_factor)),
    form<SetCorner>("set_corner", required("corner", &SetCorner::corner, Between{0, 3}),
                    required("vertex", &SetCorner::vertex, any_index), member("dragging", &SetCorner::dragging)),
    form<ProposeCorners>("propose_corners"),
    form_of_inner("set_grid", &SetGrid::grid),
    form_of_inner("set_fit", &SetFit::fit),
    form<SetPatches>("set_patches", member("patches", &SetPatches::patches), member("best", &SetPatches::best)),
    form<AddCut>("add_cut"),
    form<RemoveCut>("remove_cut", required("cut", &RemoveCut::cut, any_index)),
    form<SetLattice>("set_lattice", member("lattice", &SetLattice::lattice)),
    form<PickHandle>("pick_handle", member("kind", &PickHandle::kind), required("pixel", &PickHandle::pixel),
                     required("size", &PickHandle::size, has_extent), member("mode", &PickHandle::mode),
                     member("reach", &PickHandle::reach, pixels)),
    form<SelectHandles>("select_handles", member("kind", &SelectHandles::kind),
                        required("handles", &SelectHandles::handles, any_index), member("mode", &SelectHandles::mode)),
    form<MoveHandles>("move_handles", member("kind", &MoveHandles::kind),
                      required("by", &MoveHandles::by, Between{-most_mm, most_mm}),
                      member("dragging", &MoveHandles::dragging)),
    form<ResetHandles>("reset_handles", member("kind", &ResetHandles::kind)),
    form<OpenDeformation>("open_deformation", required("file", &OpenDeformation::file, not_empty)),
    form<SaveDeformation>("save_deformation", required("file", &SaveDeformation::file, not_empty)),
    form_of_inner("set_limits", &SetLimits::limits),
    form<ProposeSteps>("propose_steps", member("keep", &ProposeSteps::keep, any_index)),
    form<RunSteps>("run_steps"),
    form<UseBlankOfSteps>("use_blank_of_steps", member("polish", &UseBlankOfSteps::polish)),
    form<OpenSteps>("open_steps", required("file", &OpenSteps::file, not_empty)),
    form<SaveSteps>("save_steps", required("file", &SaveSteps::file, not_empty)),
    form<AddStep>("add_step", required("fixed", &AddStep::fixed, any_index),
                  member("freed", &AddStep::freed, any_index), member("name", &AddStep::name),
                  member("target", &AddStep::target, one_target), member("plane_of", &AddStep::plane_of, any_index)),
    form<ChangeStep>("change_step", required("step", &ChangeStep::step, any_index), member("name", &ChangeStep::name),
                     member("offset_mm", &ChangeStep::offset_mm, Between{-most_mm, most_mm}),
                     member("within_mm", &ChangeStep::within_mm, Between{0, most_mm}),
                     member("extent_mm", &ChangeStep::extent_mm, Between{1e-9, most_mm}),
                     member("tolerance", &ChangeStep::tolerance, Between{least_step_tolerance, most_step_tolerance}),
                     member("target", &ChangeStep::target, one_target_if_any),
                     member("friction", &ChangeStep::friction, one_pressure)),
    form<SetTargetPlane>("set_target_plane", required("step", &SetTargetPlane::step, any_index),
                         member("region", &SetTargetPlane::region, any_index)),
    form<SetCarrying>("set_carrying", required("step", &SetCarrying::step, any_index),
                      member("region", &SetCarrying::region, any_index)),
    form<RemoveStep>("remove_step", required("step", &RemoveStep::step, any_index)),
    form<MoveStep>("move_step", required("step", &MoveStep::step, any_index), required("to", &MoveStep::to, any_index)),
    form<ShowStep>("show_step", member("step", &ShowStep::step, any_index),
                   member("position", &ShowStep::position, Between{0, 1e6})),
    form<SelectFaces>("select_faces", required("faces", &SelectFaces::faces, any_index),
                      member("mode", &SelectFaces::mode)),
    form<PickAt>("pick_at", member("view", &PickAt::view), required("pixel", &PickAt::pixel),
                 required("size", &PickAt::size, has_extent), member("mode", &PickAt::mode),
                 member("flood", &PickAt::flood, Between{0, 180}), member("smooth", &PickAt::smooth)),
    form<PickArea>("pick_area", member("view", &PickArea::view), required("polygon", &PickArea::polygon, encloses),
                   required("size", &PickArea::size, has_extent), member("mode", &PickArea::mode),
                   member("through", &PickArea::through)),
    form<PickBrush>("pick_brush", member("view", &PickBrush::view), required("pixel", &PickBrush::pixel),
                    member("radius", &PickBrush::radius, pixels), required("size", &PickBrush::size, has_extent),
                    member("mode", &PickBrush::mode), member("through", &PickBrush::through)),
    form<SelectVertices>("select_vertices", required("vertices", &SelectVertices::vertices, any_index),
                         member("mode", &SelectVertices::mode)),
    form<PickVertex>("pick_vertex", member("view", &PickVertex::view), required("pixel", &PickVertex::pixel),
                     required("size", &PickVertex::size, has_extent), member("mode", &PickVertex::mode),
                     member("boundary", &PickVertex::boundary), member("reach", &PickVertex::reach, pixels)),
    form<UseVerticesAsCorners>("use_vertices_as_corners"),
    form<GrowSelection>("grow_selection"),
    form<ShrinkSelection>("shrink_selection"),
    form<InvertSelection>("invert_selection"),
    form<ClearSelection>("clear_selection"),
    form<MakeRegion>("make_region", member("name", &MakeRegion::name), member("kind", &MakeRegion::kind)),
    form<ChangeRegion>("change_region", required("region", &ChangeRegion::region, any_index),
                       member("name", &ChangeRegion::name), member("kind", &ChangeRegion::kind),
                       member("colour", &ChangeRegion::colour, share)),
    form<RemoveRegion>("remove_region", required("region", &RemoveRegion::region, any_index)),
    form<SetContact>("set_contact", required("region", &SetContact::region, any_index),
                     member("contact", &SetContact::contact, force_or_pressure)),
    form<SetOwnSheet>("set_own_sheet", required("region", &SetOwnSheet::region, any_index),
                      member("sheet", &SetOwnSheet::sheet)),
    form_of_inner("add_line", &AddLine::line),
    form<ChangeLine>("change_line", required("number", &ChangeLine::number, any_index),
                     required("line", &ChangeLine::line)),
    form<RemoveLine>("remove_line", required("number", &RemoveLine::number, any_index)),
    form<PinVertices>("pin_vertices"),
    form<SetProcess>("set_process", member("edge_restraint", &SetProcess::edge_restraint, share),
                     member("rolling", &SetProcess::rolling, has_a_direction)),
    form<SelectRegion>("select_region", required("region", &SelectRegion::region, any_index),
                       member("mode", &SelectRegion::mode)),
    form_of_inner("add_probe", &AddProbe::probe),
    form<RemoveProbe>("remove_probe", required("probe", &RemoveProbe::probe, any_index)),
    form<ClearProbes>("clear_probes"),
    form<DrawSection>("draw_section", member("view", &DrawSection::view), required("from", &DrawSection::from),
                      required("to", &DrawSection::to), required("size", &DrawSection::size, has_extent)),
    form<ClearSection>("clear_section"),
    form_of_inner("add_measurement", &AddMeasurement::measurement),
    form<RemoveMeasurement>("remove_measurement", required("measurement", &RemoveMeasurement::measurement, any_index)),
    form<ClearMeasurements>("clear_measurements"),
    form_of_inner("set_display", &SetDisplay::display),
    form_of_inner("set_view", &SetViewSettings::view),
    form_of_inner("set_preferences", &SetPreferences::preferences),
    form<FitView>("fit_view", member("view", &FitView::view)),
    form<LookFrom>("look_from", member("view", &LookFrom::view), required("from", &LookFrom::from)),
    form<LookFromSide>("look_from_side", member("view", &LookFromSide::view),
                       required("side", &LookFromSide::side, Between{-1, 1})),
    form<FlyTo>("fly_to", required("face", &FlyTo::face, any_index), member("field", &FlyTo::field)),
    form<HideSpot>("hide_spot"),
    form<FlyToVertex>("fly_to_vertex", required("vertex", &FlyToVertex::vertex, any_index)),
    form<ShowFault>("show_fault", required("finding", &ShowFault::finding, any_index),
                    member("entry", &ShowFault::entry, any_index)),
    form<HideFault>("hide_fault"),
    form<ShowRefused>("show_refused"),
    form<CloseRefused>("close_refused"),
    form<KeepReference>("keep_reference", member("name", &KeepReference::name)),
    form<DropReference>("drop_reference"),
    form<Undo>("undo"),
    form<Redo>("redo"),
    form<OpenProject>("open_project", required("file", &OpenProject::file, not_empty)),
    form<TakeOpened>("take_opened", member("without_saving", &TakeOpened::without_saving)),
    form<DropOpened>("drop_opened"),
    form<SaveProject>("save_project", member("file", &SaveProject::file)),
    form<ExportFiles>("export", required("folder", &ExportFiles::folder, not_empty),
                      required("formats", &ExportFiles::formats, not_empty), member("options", &ExportFiles::options)),
    form<WriteReport>("write_report", required("file", &WriteReport::file, not_empty),
                      member("options", &WriteReport::options)),
    form<Screenshot>("screenshot", required("file", &Screenshot::file, not_empty), member("view", &Screenshot::view),
                     member("width", &Screenshot::width, pixels), member("height", &Screenshot::height, pixels),
                     member("legend", &Screenshot::legend), member("labels", &Screenshot::labels),
                     member("transparent", &Screenshot::transparent)),
    form<SaveAnimation>("animation", required("file", &SaveAnimation::file, not_empty),
                        member("frames", &SaveAnimation::frames, Between{2, 500}),
                        member("seconds", &SaveAnimation::seconds, Between{0.1, 600}),
                        member("width", &SaveAnimation::width, Between{16, 4096}),
                        member("height", &SaveAnimation::height, Between{16, 4096}),
                        member("legend", &SaveAnimation::legend), member("back", &SaveAnimation::back)),
    form<DismissMessages>("dismiss_messages"),
    form<Quit>("quit")};

template <class T, class Inner, class... M>
constexpr const Form<T, Inner, M...>& form_among(const Form<T, Inner, M...>& form)
{
    return form;
}
template <class T> constexpr const auto& form_of = form_among<T>(forms);

/// What has the members: the action, or the struct in it.
template <class T, class Inner, class... M> auto& holder(const Form<T, Inner, M...>& form, auto& action)
{
    if constexpr (std::is_same_v<Inner, Nothing>)
        return action;
    else
        return action.*form.inner;
}

/// What the members that are not given keep.
template <class T> T before(const Json&, const ViewerState&) { return {}; }
template <> SetGrid before(const Json&, const ViewerState& state) { return {state.document.session.options.grid}; }
template <> SetDisplay before(const Json&, const ViewerState& state) { return {state.document.display}; }
template <> SetViewSettings before(const Json&, const ViewerState& state) { return {state.view}; }
template <> SetPreferences before(const Json&, const ViewerState& state) { return {state.preferences}; }
template <> ChangeRegion before(const Json& json, const ViewerState& state)
{
    const auto& regions = state.document.regions;
    const auto number = json.find("region");
    if (number == json.end() || !number->is_number_unsigned() || number->get<size_t>() >= regions.size())
        return {}; // reading complains, or carrying it out
    const FaceRegion& region = regions[number->get<size_t>()];
    return {number->get<int>(), region.name, region.kind, region.colour};
}

template <> SetReading before(const Json&, const ViewerState& state)
{
    SetReading result;
    result.reading.parts = state.document.session.options.read.parts;
    return result;
}

template <> ChangeStep before(const Json& json, const ViewerState& state)
{
    const StepList& steps = state.document.steps;
    const auto number = json.find("step");
    if (number == json.end() || !number->is_number_unsigned() || number->get<size_t>() >= steps.size())
        return {}; // reading complains, or carrying it out
    return ChangeStep::unchanged(number->get<int>(), *steps[number->get<size_t>()]);
}

/// A Form without its types.
struct AnyForm {
    std::string_view name;
    bool (*is_of)(const Action& action);
    Action (*read)(const Json& json, const ViewerState& base, const Place& place);
    void (*write_members)(const Action& action, Json& json);
};

template <class... T> constexpr auto any_forms(ActionKinds<T...>)
{
    return std::array{AnyForm{form_of<T>.name, [](const Action& action) { return action.is<T>(); },
                              [](const Json& json, const ViewerState& base, const Place& place) {
                                  T action = before<T>(json, base);
                                  read_members(json, holder(form_of<T>, action), form_of<T>.members, place, "do");
                                  return Action(std::move(action));
                              },
                              [](const Action& action, Json& json) {
                                  write_members(holder(form_of<T>, *action.as<T>()), form_of<T>.members, json);
                              }}...};
}
constexpr auto every_form = any_forms(AllActions{});

const AnyForm& form_of_action(const Action& action)
{
    return *std::find_if(every_form.begin(), every_form.end(), [&](const AnyForm& form) { return form.is_of(action); });
}

std::string known_actions()
{
    std::string list = "wait, expect";
    for (const AnyForm& form : every_form)
        list += fmt::format(", {}", form.name);
    return list;
}

/// The name of a step: its member "do".
std::string name_of_step(const Json& json, const Place& place)
{
    if (!json.is_object() || !json.contains("do") || !json["do"].is_string())
        place.fail("must be an object with the member \"do\": the name of an action");
    return json["do"].get<std::string>();
}

Action read_any_action(const Json& json, const ViewerState& base, const Place& place)
{
    const std::string name = name_of_step(json, place);
    const auto form =
        std::find_if(every_form.begin(), every_form.end(), [&](const AnyForm& each) { return each.name == name; });
    if (form == every_form.end())
        place.fail(fmt::format("is no action: \"{}\"; there are: {}", name, known_actions()));
    return form->read(json, base, place);
}

Expect read_expect(const Json& json, const Place& place)
{
    Expect expect;
    read_members(json, expect, members_of<Expect>, place, "do");
    try {
        Json::json_pointer pointer(expect.at);
    } catch (const Json::exception&) {
        place.member("at").fail("must be a JSON pointer like \"/selection/faces\"");
    }
    if (expect.near.has_value() != expect.tolerance.has_value())
        place.fail("needs \"near\" and \"tolerance\" together");
    if (!expect.equals && !expect.above && !expect.below && !expect.near && !expect.contains && !expect.exists)
        place.fail("expects nothing; give equals, above, below, near with tolerance, contains or exists");
    return expect;
}

Step read_step(const Json& json, const Place& place)
{
    const std::string name = name_of_step(json, place);
    if (name == "wait") {
        Wait wait;
        read_members(json, wait, members_of<Wait>, place, "do");
        return {wait, place.text()};
    }
    if (name == "expect")
        return {read_expect(json, place), place.text()};
    ViewerState any;
    read_any_action(json, any, place); // only to check it
    return {Perform{json}, place.text()};
}

std::vector<Step> read_script(const Json& json, const std::string& name)
{
    const Place place(name);
    if (!json.is_object() || !json.contains("schema") || json["schema"] != schema)
        place.fail(fmt::format("is no script of this version; it must begin with {{\"schema\": \"{}\"", schema));
    for (const auto& [key, unused] : json.items())
        if (key != "schema" && key != "actions")
            place.fail(fmt::format("has no member \"{}\"; there are: schema, actions", key));
    if (!json.contains("actions"))
        place.fail("needs the member \"actions\"");
    std::vector<Step> steps;
    const Place list = place.member("actions");
    read_list(json["actions"], list, -1,
              [&](size_t, const Json& each, const Place& at) { steps.push_back(read_step(each, at)); });
    return steps;
}

/// What a failed expectation shows of a long value.
std::string shortened(const Json& json)
{
    constexpr size_t most = 200;
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return text.size() > most ? text.substr(0, most) + " ..." : text;
}

bool contains(const Json& whole, const Json& piece)
{
    if (whole.is_string() && piece.is_string())
        return whole.get_ref<const std::string&>().find(piece.get_ref<const std::string&>()) != std::string::npos;
    if (whole.is_array())
        return std::find(whole.begin(), whole.end(), piece) != whole.end();
    return whole.is_object() && piece.is_string() && whole.contains(piece.get_ref<const std::string&>());
}

/// Says how far the pointer leads, and what is there.
std::string nothing_there(const std::string& at, const Json& report)
{
    Json::json_pointer known(at);
    while (!known.empty() && !report.contains(known))
        known.pop_back();
    const Json& last = report.at(known);
    std::string there;
    if (last.is_object())
        for (const auto& [key, unused] : last.items())
            there += (there.empty() ? "" : ", ") + key;
    else
        there = last.is_array() ? fmt::format("a list of {}", last.size()) : shortened(last);
    return fmt::format("there is nothing at {}; at \"{}\" there is: {}", at, known.to_string(), there);
}

} // namespace

Action action_from_json(const Json& json, const ViewerState& present, const std::string& place)
{
    return read_any_action(json, present, Place(place));
}

Action action_from_json(const Json& json)
{
    ViewerState new_program;
    return action_from_json(json, new_program);
}

std::string_view name(const Action& action) { return form_of_action(action).name; }

Json to_json(const Action& action)
{
    const AnyForm& form = form_of_action(action);
    Json json{{"do", form.name}};
    form.write_members(action, json);
    return json;
}

std::vector<Step> parse_script(const std::filesystem::path& file)
{
    return read_script(read_json(file, true), file.string());
}

std::vector<Step> parse_script(std::string_view text, const std::string& name)
{
    return read_script(parse_json(text, name, true), name);
}

Action action(const Perform& perform, const ViewerState& state, const std::string& place)
{
    return action_from_json(perform.action, state, place);
}

std::optional<std::string> unmet(const Expect& expect, const Json& report)
{
    const Json::json_pointer pointer(expect.at);
    bool there = false;
    try {
        there = report.contains(pointer);
    } catch (const Json::exception&) { // "/list/word"
    }
    if (expect.exists == false)
        return there ? std::optional(
                           fmt::format("{} is {} but should not be there", expect.at, shortened(report.at(pointer))))
                     : std::nullopt;
    if (!there)
        return nothing_there(expect.at, report);
    const Json& value = report.at(pointer);
    const auto failed = [&](const std::string& wish) {
        return fmt::format("{} is {} but should {}", expect.at, shortened(value), wish);
    };
    if (expect.equals && value != *expect.equals)
        return failed(fmt::format("equal {}", shortened(*expect.equals)));
    if (expect.contains && !contains(value, *expect.contains))
        return failed(fmt::format("contain {}", shortened(*expect.contains)));
    if (!expect.above && !expect.below && !expect.near)
        return {};
    if (!value.is_number())
        return failed("be a number");
    const double number = value.get<double>();
    if (expect.above && !(number > *expect.above))
        return failed(fmt::format("be above {}", *expect.above));
    if (expect.below && !(number < *expect.below))
        return failed(fmt::format("be below {}", *expect.below));
    if (expect.near && !(std::abs(number - *expect.near) <= *expect.tolerance))
        return failed(fmt::format("be {} give or take {}", *expect.near, *expect.tolerance));
    return {};
}

} // namespace spia::viewer
