#pragma once
#include <array>
#include <fmt/core.h>
#include <string>
#include <string_view>
#include <utility>

#include "app/viewer/model/actions/actions.h"
#include "app/viewer/model/reports/lights.h"
#include "engine/core/error.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"
#include "engine/options/surface_options.h"

/// The names that enumerations have in scripts, projects and reports: one table each.
namespace spia::viewer {

struct NoNames {};
template <class E> inline constexpr NoNames names_of{}; ///< specialised: an array of (value, name)
template <class E> using Names = std::pair<E, std::string_view>;

/// As the choices of an option are called.
template <class E, size_t count> constexpr std::array<Names<E>, count> names_by(const Choice (&choices)[count])
{
    std::array<Names<E>, count> names;
    for (size_t i = 0; i < count; ++i)
        names[i] = {E(i), choices[i].name};
    return names;
}

template <>
inline constexpr std::array names_of<RegionKind>{
    Names<RegionKind>{RegionKind::fixed, "fixed"},       Names<RegionKind>{RegionKind::binder, "binder"},
    Names<RegionKind>{RegionKind::pad, "pad"},           Names<RegionKind>{RegionKind::punch, "punch"},
    Names<RegionKind>{RegionKind::material, "material"}, Names<RegionKind>{RegionKind::other, "other"}};
template <>
inline constexpr std::array names_of<LineKind>{Names<LineKind>{LineKind::drawbead, "drawbead"},
                                               Names<LineKind>{LineKind::pilot, "pilot"}};
template <>
inline constexpr std::array names_of<UnfoldKind>{Names<UnfoldKind>{UnfoldKind::lay, "lay"},
                                                 Names<UnfoldKind>{UnfoldKind::unroll, "unroll"},
                                                 Names<UnfoldKind>{UnfoldKind::flatten, "flatten"}};
template <>
inline constexpr std::array names_of<View>{Names<View>{View::part, "part"}, Names<View>{View::blank, "blank"},
                                           Names<View>{View::quads, "quads"}, Names<View>{View::surface, "surface"}};
template <>
inline constexpr std::array names_of<Tool>{Names<Tool>{Tool::look, "look"},
                                           Names<Tool>{Tool::pick, "pick"},
                                           Names<Tool>{Tool::box, "box"},
                                           Names<Tool>{Tool::lasso, "lasso"},
                                           Names<Tool>{Tool::brush, "brush"},
                                           Names<Tool>{Tool::flood, "flood"},
                                           Names<Tool>{Tool::smooth_region, "smooth_region"},
                                           Names<Tool>{Tool::probe, "probe"},
                                           Names<Tool>{Tool::section, "section"},
                                           Names<Tool>{Tool::vertex, "vertex"},
                                           Names<Tool>{Tool::outline, "outline"},
                                           Names<Tool>{Tool::line, "line"},
                                           Names<Tool>{Tool::shape, "shape"},
                                           Names<Tool>{Tool::measure, "measure"},
                                           Names<Tool>{Tool::corners, "corners"}};
template <>
inline constexpr std::array names_of<MouseStyle>{
    Names<MouseStyle>{MouseStyle::spia, "spia"},       Names<MouseStyle>{MouseStyle::nx, "nx"},
    Names<MouseStyle>{MouseStyle::catia, "catia"},     Names<MouseStyle>{MouseStyle::solidworks, "solidworks"},
    Names<MouseStyle>{MouseStyle::inspire, "inspire"}, Names<MouseStyle>{MouseStyle::blender, "blender"}};
template <>
inline constexpr std::array names_of<MeasureKind>{
    Names<MeasureKind>{MeasureKind::distance, "distance"}, Names<MeasureKind>{MeasureKind::angle, "angle"},
    Names<MeasureKind>{MeasureKind::faces, "faces"}, Names<MeasureKind>{MeasureKind::circle, "circle"},
    Names<MeasureKind>{MeasureKind::rounding, "rounding"}};
template <>
inline constexpr std::array names_of<ClipAxis>{Names<ClipAxis>{ClipAxis::x, "x"}, Names<ClipAxis>{ClipAxis::y, "y"},
                                               Names<ClipAxis>{ClipAxis::z, "z"},
                                               Names<ClipAxis>{ClipAxis::view, "view"}};
template <>
inline constexpr std::array names_of<HandleKind>{Names<HandleKind>{HandleKind::control, "control"},
                                                 Names<HandleKind>{HandleKind::lattice, "lattice"}};
template <>
inline constexpr std::array names_of<SurfaceLook>{
    Names<SurfaceLook>{SurfaceLook::plain, "plain"},
    Names<SurfaceLook>{SurfaceLook::deviation, "deviation"},
    Names<SurfaceLook>{SurfaceLook::tolerance, "tolerance"},
    Names<SurfaceLook>{SurfaceLook::patches, "patches"},
    Names<SurfaceLook>{SurfaceLook::zebra, "zebra"},
    Names<SurfaceLook>{SurfaceLook::mean_curvature, "mean_curvature"},
    Names<SurfaceLook>{SurfaceLook::gaussian_curvature, "gaussian_curvature"}};
template <>
inline constexpr std::array names_of<Stage>{Names<Stage>{Stage::read, "read"}, Names<Stage>{Stage::solve, "solve"},
                                            Names<Stage>{Stage::grid, "grid"}, Names<Stage>{Stage::lift, "lift"},
                                            Names<Stage>{Stage::fit, "fit"}};
template <> inline constexpr auto names_of<Skin> = names_by<Skin>(option::skins_of_solid);
template <> inline constexpr auto names_of<GridMethod> = names_by<GridMethod>(option::grid_methods);
template <>
inline constexpr std::array names_of<InterpolateOptions::Parameters>{
    Names<InterpolateOptions::Parameters>{InterpolateOptions::Parameters::chord, "chord"},
    Names<InterpolateOptions::Parameters>{InterpolateOptions::Parameters::centripetal, "centripetal"},
    Names<InterpolateOptions::Parameters>{InterpolateOptions::Parameters::uniform, "uniform"}};
template <> inline constexpr auto names_of<CurveEnds> = names_by<CurveEnds>(option::curve_ends);
template <> inline constexpr auto names_of<FitParameters> = names_by<FitParameters>(option::fit_parameter_choices);
template <>
inline constexpr std::array names_of<LimitsOptions::Source>{
    Names<LimitsOptions::Source>{LimitsOptions::Source::automatic, "automatic"},
    Names<LimitsOptions::Source>{LimitsOptions::Source::keeler_brazier, "keeler_brazier"},
    Names<LimitsOptions::Source>{LimitsOptions::Source::points, "points"},
    Names<LimitsOptions::Source>{LimitsOptions::Source::none, "none"}};
template <> inline constexpr auto names_of<LengthUnit> = names_by<LengthUnit>(option::units);
template <>
inline constexpr std::array names_of<DxfVersion>{Names<DxfVersion>{DxfVersion::r12, "r12"},
                                                 Names<DxfVersion>{DxfVersion::r2000, "r2000"}};
template <>
inline constexpr std::array names_of<DxfCurves>{Names<DxfCurves>{DxfCurves::arcs, "arcs"},
                                                Names<DxfCurves>{DxfCurves::polylines, "polylines"},
                                                Names<DxfCurves>{DxfCurves::splines, "splines"}};
template <>
inline constexpr std::array names_of<SeamOptions::Mode>{
    Names<SeamOptions::Mode>{SeamOptions::Mode::automatic, "automatic"},
    Names<SeamOptions::Mode>{SeamOptions::Mode::none, "none"},
    Names<SeamOptions::Mode>{SeamOptions::Mode::given, "given"},
    Names<SeamOptions::Mode>{SeamOptions::Mode::corners, "corners"}};
template <>
inline constexpr auto names_of<TensileOptions::Kind> = names_by<TensileOptions::Kind>(option::stress_measures);
template <>
inline constexpr std::array names_of<PickMode>{Names<PickMode>{PickMode::replace, "replace"},
                                               Names<PickMode>{PickMode::add, "add"},
                                               Names<PickMode>{PickMode::remove, "remove"}};
template <>
inline constexpr std::array names_of<StandardView>{Names<StandardView>{StandardView::top, "top"},
                                                   Names<StandardView>{StandardView::bottom, "bottom"},
                                                   Names<StandardView>{StandardView::front, "front"},
                                                   Names<StandardView>{StandardView::back, "back"},
                                                   Names<StandardView>{StandardView::left, "left"},
                                                   Names<StandardView>{StandardView::right, "right"},
                                                   Names<StandardView>{StandardView::isometric, "isometric"}};
template <>
inline constexpr std::array names_of<ColourMap>{Names<ColourMap>{ColourMap::viridis, "viridis"},
                                                Names<ColourMap>{ColourMap::diverging, "diverging"},
                                                Names<ColourMap>{ColourMap::grey, "grey"}};
template <>
inline constexpr std::array names_of<ChainStep>{
    Names<ChainStep>{ChainStep::part, "part"}, Names<ChainStep>{ChainStep::sheet, "sheet"},
    Names<ChainStep>{ChainStep::unfold, "unfold"}, Names<ChainStep>{ChainStep::grid, "grid"},
    Names<ChainStep>{ChainStep::surface, "surface"}};
template <>
inline constexpr std::array names_of<SheetSource>{
    Names<SheetSource>{SheetSource::assumed, "assumed"}, Names<SheetSource>{SheetSource::before, "before"},
    Names<SheetSource>{SheetSource::file, "file"}, Names<SheetSource>{SheetSource::chosen, "chosen"},
    Names<SheetSource>{SheetSource::preference, "preference"}};
template <>
inline constexpr std::array names_of<Severity>{
    Names<Severity>{Severity::hint, "hint"}, Names<Severity>{Severity::done, "done"},
    Names<Severity>{Severity::warning, "warning"}, Names<Severity>{Severity::error, "error"}};

template <class E> std::string_view name_in_table(E value)
{
    for (const auto& [each, name] : names_of<E>)
        if (each == value)
            return name;
    return "";
}

/// @throws InputError  lists the names there are
template <class E> E value_by_name(std::string_view name)
{
    std::string known;
    for (const auto& [value, each] : names_of<E>) {
        if (each == name)
            return value;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", each);
    }
    throw InputError(fmt::format("\"{}\" is none of {}", name, known));
}

} // namespace spia::viewer
