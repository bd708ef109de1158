#include "engine/pipeline/shortcomings/shortcomings.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <iterator>

#include "engine/core/place_text.h"
#include "engine/core/text.h"
#include "engine/forming/material/membrane_law.h"
#include "engine/pipeline/applied_process.h"
#include "engine/pipeline/blank/bend_report.h"
#include "engine/pipeline/shortcomings/surface_shortcomings.h"
#include "engine/pipeline/shortcomings/unsuited_surface.h"

namespace spia {
namespace {

/// What was given may be meant in another unit.
std::vector<std::string> unlikely_input(const PartFile& part, const FlattenOptions& options)
{
    std::vector<std::string> list;
    constexpr double least_MPa = 10, greatest_MPa = 2500; // lead; the strongest press-hardened
                                                          // steels stay below
    const auto check = [&](const Material& material) {
        const double yields = MembraneLaw(material).curve().yield_stress();
        if (yields < least_MPa || yields > greatest_MPa)
            list.push_back(fmt::format("{} yields at {:.3g} MPa: are its stresses in MPa?", material.name, yields));
    };
    check(options.material);
    for (const TailoredPiece& piece : options.process.tailored)
        check(piece.material);
    const auto gauge = [&](const std::string& what, double thickness) {
        constexpr double thinnest = 0.02, thickest = 20; // foil; plate, which no membrane stands
                                                         // for
        if (thickness < thinnest || thickness > thickest)
            list.push_back(fmt::format("{} is {:.3g} mm thick: is that in mm?", what, thickness));
    };
    if (!unit_is_stated(part) || options.thickness != part.thickness_mm)
        gauge("the sheet", options.thickness);
    for (const TailoredPiece& piece : options.process.tailored)
        gauge(piece.name, piece.thickness);
    for (const ContactRegion& region : options.process.contact)
        if (region.friction > 1)
            list.push_back(fmt::format("the friction coefficient of {} is {:.3g}: values above 1 are not usual",
                                       region.name, region.friction));
    for (const Drawbead& bead : options.process.drawbeads)
        if (const double lock = lock_force(options.material, options.thickness); bead.force_N_mm > lock)
            list.push_back(fmt::format(
                "the drawbead {} restrains with {:.4g} N/mm, more than the {:.4g} N/mm at which the sheet tears",
                bead.name, bead.force_N_mm, lock));
        else if (bead.force_N_mm == 0)
            list.push_back(
                fmt::format("the drawbead {} has no effect: it is too shallow to bend the sheet", bead.name));
    return list;
}

/// A solid has its thickness.
std::vector<std::string> other_thickness(const PartFile& part, double thickness)
{
    constexpr double rounding = 1e-6; // of it
    if (!part.solid || !part.thickness_mm || std::abs(thickness - *part.thickness_mm) <= rounding * thickness)
        return {};
    return {fmt::format("the solid is {:.6g} mm thick and the sheet is calculated as {:.6g} mm: its bends are laid "
                        "with the thickness of the solid, strains and forces are not; give {:.6g} mm",
                        *part.thickness_mm, thickness, *part.thickness_mm)};
}

/// What is only bent is strained where it is joined.
std::vector<std::string> closed_corners(const PartFile& part)
{
    const Finding* corners = part.doctor.find(Fault::closed_corner);
    return corners ? std::vector{corners->text + "; " + corners->advice} : std::vector<std::string>{};
}

/// What was asked for and does not act as it was meant.
std::vector<std::string> idle_process(const Session& session)
{
    std::vector<std::string> list;
    // Steps leave the restraint out.
    if (session.options.steps || session.options.flatten.process.edge_restraint == 0)
        return list;
    constexpr double much = 0.1;
    const AppliedProcess process = applied_process(session);
    if (process.held_mm == 0)
        list.push_back("the edge restraint has no effect: all of the outer edge is a seam");
    else if (process.upright_mm > much * process.held_mm)
        list.push_back(fmt::format(
            "on {:.4g} of {:.4g} mm of the edge the sheet is parallel to the stamping direction: its sliding cannot be determined there, and the restraint may push instead of pull; give another direction",
            process.upright_mm, process.held_mm));
    return list;
}

std::vector<std::string> grid_shortcomings(const Session& session)
{
    std::vector<std::string> list;
    if (!session.grid)
        return list;
    const GridResult& grid = session.grid->result;
    if (grid.route == GridRoute::spiral)
        list.push_back(fmt::format(
            "between these corners the blank winds: a grid without folds needs long, skewed cells, {} x {} of them; corners at the ends of the winding strip give better cells",
            grid.planar.columns, grid.planar.rows));
    const bool asked_for = session.options.grid.line_grading > 0 || session.options.grid.even_cells;
    if (asked_for && grid.quality.folded_cells > 0) {
        list.push_back("grid lines were not moved to bends and cells not improved, because the grid folds before that");
        return list;
    }
    if (grid.no_bends)
        list.push_back(
            grid.planar.columns < 2 && grid.planar.rows < 2
                ? "the grid has no inner lines to move to bends; choose more cells"
                : "no grid lines were moved to bends, because none were found between its nodes; if the part has bends, choose more cells");
    else if (const double asked = session.options.grid.line_grading; grid.line_grading < asked)
        list.push_back(fmt::format(
            "{:.3g} % of the grid lines were moved to bends, not {:.3g} %: with more, cells would fold or leave the blank; choose more cells",
            100 * grid.line_grading, 100 * asked));
    if (session.options.grid.even_cells && !grid.evened)
        list.push_back(grid.planar.columns < 2 || grid.planar.rows < 2
                           ? "the grid has no inner nodes to move; choose more cells to improve cell angles"
                           : "cell angles were not improved: inner nodes would leave the blank; choose more cells");
    return list;
}

} // namespace

std::vector<std::string> shortcomings(const Session& session)
{
    std::vector<std::string> list;
    if (session.part) {
        list = session.part->doubts;
        for (std::string& line : closed_corners(*session.part))
            list.push_back(std::move(line));
    }
    if (session.blank) {
        for (std::string& line : unlikely_input(*session.part, session.options.flatten))
            list.push_back(std::move(line));
        for (std::string& line : other_thickness(*session.part, session.options.flatten.thickness))
            list.push_back(std::move(line));
        for (std::string& line : idle_process(session))
            list.push_back(std::move(line));
        if (session.bends)
            for (std::string& line : bend_doubts(*session.part, *session.bends, session.options.k_factor.has_value()))
                list.push_back(std::move(line));
        const FlattenResult& flat = *session.blank;
        if (!flat.report.whole())
            list.push_back(flat.report.reason);
        if (flat.necking_triangles > 0)
            list.push_back(
                fmt::format("{} strained beyond {:.2f}{}",
                            counted(flat.necking_triangles, "triangle is", "triangles are"), flat.report.trusted_strain,
                            session.options.flatten.process.tailored.empty() ? ""
                                                                             : " (other grades beyond their own)") +
                (flat.report.trusted_strain < session.options.flatten.curve.trusted_strain
                     ? ": there the hardening curve is extrapolated, and in tension the sheet necks"
                 : session.limits && session.limits->curve
                     ? ", farther than the hardening curve was measured: their stress is extrapolated, the forming "
                       "limits say whether they crack"
                     : ", extrapolated: the sheet would neck or crack there"));
        if (flat.flipped_triangles > 0)
            list.push_back(fmt::format("{} flipped", counted(flat.flipped_triangles, "triangle of the blank is",
                                                             "triangles of the blank are")));
        if (const auto& crossing = flat.overlap.crossings; !crossing.empty()) {
            const Eigen::Vector2d at = flat.blank.position.col(crossing[0].edge[0]);
            list.push_back(
                fmt::format("the outline of the blank crosses itself at {}, the first near {:.4g}, {:.4g} mm: the flat "
                            "sheet would overlap; cut the part or unfold it in steps",
                            counted(crossing.size(), "place", "places"), at[0], at[1]));
        }
        if (const auto& wound = flat.overlap.wound; !wound.empty())
            list.push_back(fmt::format(
                "the blank winds around {} more than once (first: vertex {}): the flat sheet would "
                "overlap; cut the part open to there",
                counted(wound.size(), "vertex", "vertices"), session.part->source_vertex[size_t(wound[0])]));
    }
    if (session.blank && session.blank->skins && session.blank->skins->sharp_faces > 0)
        list.push_back(fmt::format(
            "{} bent to a radius below one sheet thickness: the skin strains there are those for one thickness",
            counted(session.blank->skins->sharp_faces, "face is", "faces are")));
    if (session.grid && session.grid->result.quality.folded_cells > 0) {
        const CellQuality& quality = session.grid->result.quality;
        const auto [column, row] = session.grid->result.planar.column_and_row(quality.worst_cell);
        list.push_back(fmt::format("{} folded, worst the cell in column {}, row {} (scaled Jacobian {:.2f}); "
                                   "choose other corners or the harmonic method",
                                   counted(quality.folded_cells, "cell of the grid is", "cells of the grid are"),
                                   column, row, quality.min_scaled_jacobian));
    }
    for (std::string& lack : grid_shortcomings(session))
        list.push_back(std::move(lack));
    if (session.surface && session.surface->fit) {
        const FitReport& fit = *session.surface->fit;
        if (!fit.reached)
            list.push_back(fit.shortfall.text);
        else if (session.surface->deviation.max() > fit.tolerance)
            list.push_back(fmt::format(
                "the surface is within {:.3g} mm of the remeshed part, but up to {:.3g} mm from the part that was read: give the "
                "remeshing a smaller tolerance",
                fit.tolerance, session.surface->deviation.max()));
    }
    if (session.surface)
        std::ranges::move(surface_shortcomings(session), std::back_inserter(list));
    const bool by_deformation = session.deformed && session.surface && session.surface->certificate.suited() &&
                                !session.deformed->certificate.suited();
    if (session.surface && !by_deformation)
        if (const auto folded = folded_surface(session))
            list.push_back(*folded);
    if (session.surface)
        for (const HoleLeftFilled& hole : session.surface->trim.left_filled) {
            const Eigen::Vector3d at = session.part->mesh.position.col(hole.vertex);
            list.push_back(fmt::format("the hole near ({}) stays filled in the surface: {}; a "
                                       "smaller tolerance or other corners may help",
                                       place_text(at), hole.why));
        }
    if (by_deformation)
        list.push_back(fmt::format("the deformation makes the surface fold: {}; move its points less",
                                   unsuited(session.deformed->certificate).value_or("")));
    return list;
}

} // namespace spia
