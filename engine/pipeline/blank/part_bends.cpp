#include "engine/pipeline/blank/part_bends.h"

#include <charconv>
#include <fmt/core.h>
#include <numbers>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file_content.h"
#include "engine/core/text.h"
#include "engine/options/sheet_options.h"
#include "engine/part/curved_faces.h"
#include "engine/unfold/step/relaid_blank.h"
#include "engine/unfold/step/upright.h"

namespace spia {
namespace {

SheetLayers layers_of(const PartFile& part, double thickness, const std::optional<KFactor>& k)
{
    SheetLayers layers;
    layers.thickness = part.solid ? part.solid->thickness : thickness;
    layers.k = k;
    if (part.solid) {
        layers.rounding = part.solid->rounding;
        const double half = layers.thickness / 2;
        const Skin skin = part.solid->skin;
        layers.mesh_at = skin == Skin::outer ? half : skin == Skin::inner ? -half : 0;
        layers.face_at = part.solid->side == SheetSide::inner ? -half : half;
    }
    return layers;
}

/// Zones on the cylinders that were measured on both skins of a solid; of those that were fitted to
/// its middle surface the rest, as a bend without an inner radius.
std::vector<BendZone> with_measured(const PartFile& part, std::vector<BendZone> fitted)
{
    std::vector<StatedSurface> surface;
    for (const int f : part.source_face)
        surface.push_back(part.solid->surface[size_t(f)]);
    std::vector<BendZone> zones = stated_zones(part.mesh, surface);
    std::vector<char> known(size_t(part.mesh.vertices()), 0);
    for (const BendZone& zone : zones)
        for (const int f : zone.face)
            for (const int v : part.mesh.triangle.col(f))
                known[size_t(v)] = 1;
    // What touches one is what a rim has left of its border.
    const auto beside = [&](int f) {
        return std::ranges::any_of(part.mesh.triangle.col(f), [&](int v) { return known[size_t(v)] != 0; });
    };
    constexpr double least = 0.5 * std::numbers::pi / 180; // triangles that a rim tilts turn by
                                                           // less
    for (BendZone& zone : fitted)
        if (zone.to - zone.from > least && std::ranges::none_of(zone.face, beside))
            zones.push_back(std::move(zone));
    return zones;
}

std::vector<BendZone> zones_of(const PartFile& part)
{
    if (part.cad && !part.cad->surface.empty()) {
        std::vector<StatedSurface> surface;
        for (const int f : part.source_face)
            surface.push_back(part.cad->surface[size_t(part.cad->face[size_t(f)])]);
        return stated_zones(part.mesh, surface, part.cad->sewing_tolerance);
    }
    std::vector<BendZone> zones = fitted_zones(part.mesh, find_bends(part.mesh), part.solid.has_value());
    return part.solid && !part.solid->surface.empty() ? with_measured(part, std::move(zones)) : zones;
}

/// Those of faces that have none yet.
void add_missing(LaidLengths& laid, const LaidLengths& more)
{
    LaidLengths all;
    size_t i = 0;
    const auto take = [&](const LaidLengths& from, size_t at) {
        all.face.push_back(from.face[at]);
        all.corner.push_back(from.corner[at]);
    };
    for (size_t k = 0; k < more.face.size(); ++k) {
        for (; i < laid.face.size() && laid.face[i] < more.face[k]; ++i)
            take(laid, i);
        if (i == laid.face.size() || laid.face[i] != more.face[k])
            take(more, k);
    }
    for (; i < laid.face.size(); ++i)
        take(laid, i);
    laid = std::move(all);
}

} // namespace

NeutralFibre part_bends(const PartFile& part, double thickness, const std::optional<KFactor>& k)
{
    NeutralFibre fibre = neutral_fibre(part.mesh, zones_of(part), layers_of(part, thickness, k));
    // A sheet that is given as triangles is these triangles, unless its bends are asked for. Of
    // solids and CAD faces they are ours or stand for arcs.
    if (!k && !part.cad && !part.solid)
        keep_triangles(fibre,
                       "the lengths are those of the mesh; a K factor, even 0.5, replaces them by arcs (" +
                           mention(option::k_factor) + ")",
                       "give a K factor (" + mention(option::k_factor) + ")");
    add_missing(fibre.laid, lengths_on_faces(part));
    return fibre;
}

void lay_anew(const TriMesh& part, const FlattenOptions& options, NeutralFibre& fibre, UnfoldRun& run,
              const Progress& progress)
{
    if (!run.blank || run.states.empty())
        return;
    if (!fibre.laid.empty()) {
        if (run.flipped > 0 || run.states.back().face.strain_equivalent.maxCoeff() > most_relaid_strain)
            keep_triangles(fibre, "the steps strain the sheet, and their blank is kept as it is",
                           "unfold it in one step, or in steps that only bend");
        else {
            Eigen::Matrix2Xd& position = run.blank->position;
            // Straight as before, from (0, 0) on; the blank of steps has the rolling direction
            // along x.
            const auto rolling =
                options.process.rolling ? std::optional<Eigen::Vector2d>(Eigen::Vector2d::UnitX()) : std::nullopt;
            position =
                upright(part, relaid_blank(part, position, fibre.laid, options, progress).blank.position, rolling);
        }
    }
    place_on_blank(fibre, part, *run.blank);
}

KFactor k_factor(const std::string& text)
{
    const std::string lower = lower_case(text);
    if (lower == "din6935")
        return din6935_k();
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc::invalid_argument && end == text.data() + text.size())
        return constant_k(fault == std::errc() ? value : 0);
    constexpr std::uintmax_t most_bytes = 1 << 20;
    std::error_code none;
    if (!std::filesystem::is_regular_file(text, none))
        throw InputError(fmt::format("{}: give a number above 0 and below 1, din6935, or a file with a table of "
                                     "R/t and K",
                                     mention(option::k_factor, text)));
    if (std::filesystem::file_size(text, none) > most_bytes)
        throw InputError(fmt::format("{}: a table of K factors has 1 MB at most", text));
    if (std::filesystem::file_size(text, none) == 0)
        throw InputError(fmt::format("{}: the file is empty; a table of K factors has two columns, R/t and K", text));
    return parse_k_table(file_content(text), text);
}

} // namespace spia
