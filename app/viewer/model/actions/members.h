#pragma once
#include <cmath>
#include <tuple>

#include "app/viewer/model/actions/actions.h"
#include "app/viewer/model/actions/json_members.h"
#include "app/viewer/model/document/fit_choice.h"
#include "app/viewer/model/document/state.h"
#include "app/viewer/model/document/step_target.h"
#include "app/viewer/model/reports/report_options.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/outputs/outputs.h"

/// The members of the structs that scripts, projects and reports share.
namespace spia::viewer {

/// All members that options set.
template <class... Each> constexpr auto members_by(const std::tuple<Each...>& described)
{
    return std::apply([](const Each&... each) { return std::tuple{member(*each.option, each.member)...}; }, described);
}

/// Checks beyond a number's bounds: check(value, place) as in Member.
inline constexpr auto rising_range = [](const std::optional<std::array<double, 2>>& range, const Place& place) {
    if (range && !((*range)[0] < (*range)[1]))
        place.fail("must rise: the least value first, then a greater one");
};
inline constexpr auto is_barycentric = [](const Eigen::Vector3d& b, const Place& place) {
    constexpr double rounding = 1e-6; // of weights typed by hand
    if (!(b.minCoeff() >= -rounding && std::abs(b.sum() - 1) <= rounding))
        place.fail("must be three weights from 0 to 1 whose sum is 1");
};
inline constexpr auto is_rotation = [](const glm::dquat& turn, const Place& place) {
    constexpr double rounding = 1e-3; // of a quaternion typed by hand
    if (!(std::abs(glm::length(turn) - 1) <= rounding))
        place.fail("must be a unit quaternion w, x, y, z");
};
inline constexpr auto is_direction = [](const Eigen::Vector3d& direction, const Place& place) {
    if (!(direction.norm() > 0))
        place.fail("must have a length");
};
inline constexpr auto in_space = [](const glm::dvec3& place_mm, const Place& place) {
    for (int k = 0; k < 3; ++k)
        Between{-most_mm, most_mm}(place_mm[k], place.entry(size_t(k)));
};

template <>
inline constexpr auto members_of<GltfNodes> =
    std::tuple{member("part", &GltfNodes::part), member("blank", &GltfNodes::blank),
               member("quad_mesh", &GltfNodes::quad_mesh), member("surface", &GltfNodes::surface),
               member("control_net", &GltfNodes::control_net)};

template <>
inline constexpr auto members_of<CsvTables> = std::tuple{
    member("fields", &CsvTables::fields), member("outline", &CsvTables::outline), member("faces", &CsvTables::faces)};

template <>
inline constexpr auto members_of<DxfOptions> =
    std::tuple{member("unit", &DxfOptions::unit), member("version", &DxfOptions::version),
               member("curves", &DxfOptions::curves), member("tolerance", &DxfOptions::tolerance, Between{1e-6, 1})};

template <>
inline constexpr auto members_of<OutputOptions> =
    std::tuple{member("unit", &OutputOptions::unit), member("name", &OutputOptions::name),
               member("glb", &OutputOptions::glb), member("csv", &OutputOptions::csv),
               member("dxf", &OutputOptions::dxf)};

template <>
inline constexpr auto members_of<ReportTables> =
    std::tuple{member("key_figures", &ReportTables::key_figures), member("worst_spots", &ReportTables::worst_spots),
               member("assumptions", &ReportTables::assumptions), member("solver", &ReportTables::solver),
               member("repairs", &ReportTables::repairs)};

inline constexpr auto mm_or_inch = [](LengthUnit unit, const Place& place) {
    if (unit != LengthUnit::mm && unit != LengthUnit::inch)
        place.fail("must be \"mm\" or \"inch\"");
};
template <>
inline constexpr auto members_of<ViewerReportOptions> = std::tuple{
    member("title", &ViewerReportOptions::title),       member("remarks", &ViewerReportOptions::remarks),
    member("pictures", &ViewerReportOptions::pictures), member("standard_look", &ViewerReportOptions::standard_look),
    member("tables", &ViewerReportOptions::tables),     member("lengths", &ViewerReportOptions::lengths, mm_or_inch)};

inline constexpr auto is_path = [](const std::vector<std::vector<int>>& path, const Place& place) {
    for (size_t i = 0; i < path.size(); ++i)
        if (path[i].size() < 2)
            place.entry(i).fail("must be a list of two or more vertices");
};
template <>
inline constexpr auto members_of<SeamOptions> =
    std::tuple{member("mode", &SeamOptions::mode), member("path", &SeamOptions::path, is_path)};

inline constexpr Between gap_width{option::gap_width.least, option::gap_width.greatest}, ///< mm
    chord_height{option::chord_height.least, option::chord_height.greatest};             ///< mm
template <>
inline constexpr auto members_of<Reading> = std::tuple{member("weld", &Reading::weld),
                                                       member("weld_gap_mm", &Reading::weld_gap_mm, gap_width),
                                                       member(option::keep_largest, &Reading::keep_largest),
                                                       member(option::part, &Reading::parts),
                                                       member(option::skin, &Reading::skin),
                                                       member(option::sewing, &Reading::sewing_mm),
                                                       member(option::deflection, &Reading::deflection_mm),
                                                       member(option::skip_bad_faces, &Reading::leave_out_bad_faces),
                                                       member(option::no_remesh, &Reading::keep_triangles)};
template <>
inline constexpr auto members_of<RemeshOptions> = std::tuple{
    member(option::remesh_size, &RemeshOptions::size), member(option::remesh_tolerance, &RemeshOptions::tolerance)};

template <>
inline constexpr auto members_of<TensileOptions> = std::tuple{member(option::stress_measure, &TensileOptions::kind),
                                                              member(option::strain_unit, &TensileOptions::in_percent),
                                                              member(option::young, &TensileOptions::young_MPa)};
template <>
inline constexpr auto members_of<MaterialFitOptions> =
    std::tuple{member("law", &MaterialFitOptions::law),
               member("name", &MaterialFitOptions::name),
               member("test", &MaterialFitOptions::test),
               member(option::poisson, &MaterialFitOptions::poisson),
               member(option::density, &MaterialFitOptions::density_kg_m3),
               member("r0", &MaterialFitOptions::r0, Between{1e-3, 99}),
               member("r45", &MaterialFitOptions::r45, Between{1e-3, 99}),
               member("r90", &MaterialFitOptions::r90, Between{1e-3, 99})};

template <> inline constexpr auto members_of<GridOptions> = members_by(described<GridOptions>);

template <>
inline constexpr auto members_of<FitChoice> =
    std::tuple{member(option::tolerance, &FitChoice::tolerance),
               member(option::degree_u, &FitChoice::degree_u),
               member(option::degree_v, &FitChoice::degree_v),
               member(option::ends, &FitChoice::ends),
               member(option::fit_parameters, &FitChoice::parameters),
               member(option::max_control_points, &FitChoice::max_control_points)};

inline constexpr auto is_cut = [](const std::vector<LayoutCut>& cuts, const Place& place) {
    is_path(cuts, place);
    for (size_t i = 0; i < cuts.size(); ++i)
        any_index(cuts[i], place.entry(i));
};
template <>
inline constexpr auto members_of<LayoutOptions> =
    std::tuple{member("cuts", &LayoutOptions::cuts, is_cut), member("corners", &LayoutOptions::corners, any_index),
               member(option::patch_edges, &LayoutOptions::edge_deg),
               member(option::smooth_joins, &LayoutOptions::smooth_joins)};

inline constexpr Between lattice_points{2, 64}, lattice_degrees{1, 5};
template <>
inline constexpr auto members_of<LatticeChoice> = std::tuple{member("count", &LatticeChoice::count, lattice_points),
                                                             member("degree", &LatticeChoice::degree, lattice_degrees)};
template <>
inline constexpr auto members_of<ControlMove> =
    std::tuple{required("patch", &ControlMove::patch, any_index), required("i", &ControlMove::i, any_index),
               required("j", &ControlMove::j, any_index),
               required("by", &ControlMove::move, Between{-most_mm, most_mm})};

inline constexpr auto has_length = [](const Eigen::Vector3d& direction, const Place& place) {
    if (!(direction.norm() > 0))
        place.fail("must have a length");
};
template <>
inline constexpr auto members_of<TargetPlane> =
    std::tuple{required("origin", &TargetPlane::origin, Between{-most_mm, most_mm}),
               required("normal", &TargetPlane::normal, has_length)};
template <>
inline constexpr auto members_of<TargetCylinder> =
    std::tuple{required("origin", &TargetCylinder::origin, Between{-most_mm, most_mm}),
               required("axis", &TargetCylinder::axis, has_length),
               required("radius", &TargetCylinder::radius, Between{1e-9, most_mm})};
template <>
inline constexpr auto members_of<TargetCone> =
    std::tuple{required("apex", &TargetCone::apex, Between{-most_mm, most_mm}),
               required("axis", &TargetCone::axis, has_length),
               required("half_angle_deg", &TargetCone::half_angle_deg, Between{1e-3, 89.999})};
inline constexpr auto one_target = [](const StepTarget& target, const Place& place) {
    if (target.plane.has_value() + target.cylinder.has_value() + target.cone.has_value() > 1)
        place.fail("needs one of the members \"plane\", \"cylinder\" and \"cone\", or none");
};
inline constexpr auto one_target_if_any = [](const std::optional<StepTarget>& target, const Place& place) {
    if (target)
        one_target(*target, place);
};
template <>
inline constexpr auto members_of<StepTarget> = std::tuple{
    member("plane", &StepTarget::plane), member("cylinder", &StepTarget::cylinder), member("cone", &StepTarget::cone)};

template <>
inline constexpr auto members_of<LimitsChoice> =
    std::tuple{member("curve", &LimitsChoice::curve),
               member("table", &LimitsChoice::table),
               member(option::flc_n, &LimitsChoice::n),
               member(option::marginal, &LimitsChoice::margin),
               member(option::max_thinning, &LimitsChoice::max_thinning),
               member(option::max_thickening, &LimitsChoice::max_thickening),
               member("low_strain", &LimitsChoice::low_strain, Between{0, 1})};

/// Checks that a tool presses with one of the two.
inline constexpr auto force_or_pressure = [](const std::optional<ToolContact>& contact, const Place& place) {
    if (contact && contact->force_N.has_value() == contact->pressure_MPa.has_value())
        place.fail("needs either the member \"force_N\" or \"pressure_MPa\"");
};
template <>
inline constexpr auto members_of<ToolContact> =
    std::tuple{member("force_N", &ToolContact::force_N, Between{1e-9, 1e9}),
               member("pressure_MPa", &ToolContact::pressure_MPa, Between{1e-9, 1e5}),
               member("friction", &ToolContact::friction, Between{0, 10})};
/// Likewise of a step's target.
inline constexpr auto one_pressure = [](const std::optional<StepFriction>& friction, const Place& place) {
    if (friction && friction->force_N.has_value() == friction->pressure_MPa.has_value())
        place.fail("needs either the member \"force_N\" or \"pressure_MPa\"");
};
template <>
inline constexpr auto members_of<StepFriction> =
    std::tuple{member("force_N", &StepFriction::force_N, Between{1e-9, 1e9}),
               member("pressure_MPa", &StepFriction::pressure_MPa, Between{1e-9, 1e5}),
               member("friction", &StepFriction::friction, Between{0, 10}),
               member("sides", &StepFriction::sides, Between{1, 2})};
template <>
inline constexpr auto members_of<OwnSheet> = std::tuple{
    required("material", &OwnSheet::material), required("thickness", &OwnSheet::thickness, Between{1e-6, 1e3})};
template <>
inline constexpr auto members_of<BeadShape> =
    std::tuple{member("radius", &BeadShape::radius, Between{1e-6, 1e4}),
               member("shoulder_radius", &BeadShape::shoulder_radius, Between{1e-6, 1e4}),
               member("depth", &BeadShape::depth, Between{0, 1e4}),
               member("friction", &BeadShape::friction, Between{0, 10})};
inline constexpr auto has_places = [](const std::vector<Eigen::Vector3d>& point, const Place& place) {
    if (point.empty())
        place.fail("needs one place [x, y, z] at least");
    for (size_t i = 0; i < point.size(); ++i)
        for (size_t k = 0; k < 3; ++k)
            Between{-most_mm, most_mm}(point[i][Eigen::Index(k)], place.entry(i).entry(k));
};
template <>
inline constexpr auto members_of<ProcessLine> =
    std::tuple{member("kind", &ProcessLine::kind), member("name", &ProcessLine::name),
               required("point", &ProcessLine::point, has_places),
               member("force_N_mm", &ProcessLine::force_N_mm, Between{1e-9, 1e9}),
               member("shape", &ProcessLine::shape)};

template <>
inline constexpr auto members_of<Probe> =
    std::tuple{required("face", &Probe::face, any_index), member("barycentric", &Probe::barycentric, is_barycentric)};
template <>
inline constexpr auto members_of<Measurement> =
    std::tuple{required("kind", &Measurement::kind), required("at", &Measurement::at), member("on", &Measurement::on)};

template <>
inline constexpr auto members_of<FieldDisplay> = std::tuple{member("field", &FieldDisplay::field),
                                                            member("per_face", &FieldDisplay::per_face),
                                                            member("range", &FieldDisplay::range, rising_range),
                                                            member("map", &FieldDisplay::map),
                                                            member("bands", &FieldDisplay::bands, Between{0, 256}),
                                                            member("isolines", &FieldDisplay::isolines),
                                                            member("extremes", &FieldDisplay::extremes),
                                                            member("directions", &FieldDisplay::directions),
                                                            member("difference", &FieldDisplay::difference)};

template <>
inline constexpr auto members_of<Camera> =
    std::tuple{member("target", &Camera::target, in_space), member("turn", &Camera::turn, is_rotation),
               member("height", &Camera::height, Between{1e-9, most_mm}), member("perspective", &Camera::perspective),
               member("flat", &Camera::flat)};

template <>
inline constexpr auto members_of<ClipPlane> =
    std::tuple{member("on", &ClipPlane::on), member("axis", &ClipPlane::axis),
               member("place_mm", &ClipPlane::place_mm, Between{-most_mm, most_mm}), member("flip", &ClipPlane::flip),
               member("direction", &ClipPlane::direction, is_direction)};
template <>
inline constexpr auto members_of<ViewSettings> =
    std::tuple{member("camera", &ViewSettings::camera),
               member("linked", &ViewSettings::linked),
               member("maximised", &ViewSettings::maximised),
               member("split_x", &ViewSettings::split_x, Between{0.15, 0.85}),
               member("split_y", &ViewSettings::split_y, Between{0.15, 0.85}),
               member("tool", &ViewSettings::tool),
               member("measure", &ViewSettings::measure),
               member("mouse", &ViewSettings::mouse),
               member("clip", &ViewSettings::clip),
               member("flood_angle", &ViewSettings::flood_angle, Between{0, 180}),
               member("brush_radius", &ViewSettings::brush_radius, Between{0, 10000}),
               member("through", &ViewSettings::through),
               member("dark", &ViewSettings::dark),
               member("edges", &ViewSettings::edges),
               member("features", &ViewSettings::features),
               member("control_net", &ViewSettings::control_net),
               member("part_under_quads", &ViewSettings::part_under_quads),
               member("surface_look", &ViewSettings::surface_look),
               member("quad_quality", &ViewSettings::quad_quality),
               member("handles", &ViewSettings::handles),
               member("unfolded", &ViewSettings::unfolded, Between{0, 1e6}),
               member("step", &ViewSettings::step, any_index),
               member("field_on_steps", &ViewSettings::field_on_steps)};

template <>
inline constexpr auto members_of<Preferences> =
    std::tuple{member("dark", &Preferences::dark),
               member("interface_percent", &Preferences::interface_percent,
                      Between{least_interface_percent, most_interface_percent}),
               member("lengths", &Preferences::lengths, mm_or_inch),
               member("material", &Preferences::material),
               member("thickness_mm", &Preferences::thickness_mm, Between{1e-6, 1e3}),
               member("map", &Preferences::map),
               member("one_patch", &Preferences::one_patch),
               member("tolerance_mm", &Preferences::tolerance_mm, Between{1e-9, most_mm}),
               member("mouse", &Preferences::mouse)};

/// Takes over what `wanted` has otherwise than `seen`: two changes of different members made at the
/// same time, each from what was seen then, both count.
template <class T> void take_changes(const T& seen, const T& wanted, T& now)
{
    const auto take = [](const auto& was, const auto& is, auto& taken) {
        if (!(is == was))
            taken = is;
    };
    const auto take_member = [&](const auto& m) {
        if constexpr (IsArray<std::remove_cvref_t<decltype(now.*m.where)>>::value)
            for (size_t k = 0; k < (now.*m.where).size(); ++k)
                take((seen.*m.where)[k], (wanted.*m.where)[k], (now.*m.where)[k]);
        else
            take(seen.*m.where, wanted.*m.where, now.*m.where);
    };
    std::apply([&](const auto&... m) { (take_member(m), ...); }, members_of<T>);
}

} // namespace spia::viewer
