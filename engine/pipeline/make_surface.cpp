#include "engine/pipeline/make_surface.h"

#include <algorithm>
#include <fmt/core.h>
#include <tuple>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/layout/simplify/simplify_layout.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/blank_chart.h"
#include "engine/options/part_options.h"
#include "engine/options/surface_options.h"
#include "engine/part/vertex_numbers.h"
#include "engine/pipeline/usual_tolerance.h"

namespace spia {
namespace {

/// A part as it was read, and the faces that fill holes of the remeshed one.
TriMesh with_holes_filled(const TriMesh& original, const TriMesh& filled, int part_triangles)
{
    const Eigen::Index faces = filled.triangles() - part_triangles;
    TriMesh result;
    result.position.resize(3, original.vertices() + filled.vertices());
    result.position << original.position, filled.position;
    result.triangle.resize(3, original.triangles() + faces);
    result.triangle << original.triangle, (filled.triangle.rightCols(faces).array() + original.vertices()).matrix();
    return result;
}

/// What is asked of one patch. Without a tolerance it runs through the nodes of the grid.
struct OnePatch {
    std::optional<double> tolerance; ///< mm
    int max_control_points = 0;
};

/// The surface within the tolerance, its points taken from the grid's map of the blank wherever
/// they are needed.
FitResult fit_within_tolerance(const Session& session, const SurfaceSource& source, const OnePatch& asked,
                               const Progress& progress)
{
    const SessionOptions& options = session.options;
    const FilledMesh& filled = *session.grid->result.filled;
    FitOptions fitting;
    fitting.tolerance = *asked.tolerance;
    fitting.degree_u = options.interpolate.degree_u;
    fitting.degree_v = options.interpolate.degree_v;
    fitting.ends = options.interpolate.ends;
    fitting.parameters = options.fit_parameters;
    fitting.max_control_points = asked.max_control_points;
    fitting.part_faces = source.part_faces;
    const std::vector<int> nearest = nearest_vertices(source.sheet, filled.mesh);
    const std::vector<int>& in_file = session.part->source_vertex;
    for (const int v : nearest) // of fill nothing is told
        fitting.file_number.push_back(v < int(in_file.size()) ? in_file[size_t(v)] : -1);
    const BlankChart chart(session.grid->result, session.grid->boundary);
    double at = 0; // how far the fit is, which asks for points now and then
    const Progress noted([&](double fraction, std::string_view step) { progress.checkpoint(at = fraction, step); });
    const Progress while_asked([&](double, std::string_view step) { progress.checkpoint(at, step); });
    FitSource points;
    points.at = [&](const std::vector<double>& u, const std::vector<double>& v) {
        const std::vector<MeshPoint> place = lift(chart.refined(u, v, while_asked)).place;
        Eigen::Matrix3Xd at_places(3, Eigen::Index(place.size()));
        for (size_t n = 0; n < place.size(); ++n)
            at_places.col(Eigen::Index(n)) = source.sheet.at(place[n]);
        return at_places;
    };
    FitResult result = fit(points, source.sheet.mesh, fitting, noted);
    for (int* vertex : {&result.report.shortfall.a, &result.report.shortfall.b})
        if (*vertex >= 0)
            *vertex = nearest[size_t(*vertex)];
    result.deviation.at_vertex.conservativeResize(filled.mesh.vertices());
    return result;
}

/// Of a remeshed part what counts is the one that was given; only at_vertex is of the mesh that is
/// shown.
/// @param shown, part_faces  the remeshed one, whose triangles after the first part_faces fill
/// holes
void judge_by_given(SurfaceStage& stage, const TriMesh& given, const TriMesh& shown, int part_faces,
                    DeviationOptions options, const Progress& progress)
{
    options.part_faces = given.triangles();
    Eigen::VectorXd at_vertex = std::move(stage.deviation.at_vertex);
    stage.deviation = deviation(stage.result.surface, with_holes_filled(given, shown, part_faces), options, progress);
    stage.deviation.at_vertex = std::move(at_vertex);
}

/// Within the tolerance of the sheet that the facets stand for.
void fit_one_patch(SurfaceStage& stage, const Session& session, const OnePatch& asked, const Progress& progress)
{
    const PartFile& part = *session.part;
    const double edge_deg = LayoutOptions{}.edge_deg;
    SurfaceSource source = surface_source(part, *session.grid->result.filled, *asked.tolerance, edge_deg);
    FitResult fitted = fit_within_tolerance(session, source, asked, progress.part(0, 0.8));
    stage.result.surface = std::move(fitted.surface);
    stage.result.u = std::move(fitted.u);
    stage.result.v = std::move(fitted.v);
    stage.deviation = std::move(fitted.deviation);
    stage.fit = std::move(fitted.report);
    if (part.remeshed && !part.cad) {
        PartFile given;
        given.mesh = *part.remeshed->original;
        const SurfaceSource whole = surface_source(given, *asked.tolerance, edge_deg);
        DeviationOptions options;
        options.tolerance = *asked.tolerance;
        judge_by_given(stage, whole.sheet.mesh, source.sheet.mesh, source.part_faces, options, progress.part(0.8, 1));
        source.facets_off = whole.facets_off;
    }
    stage.source = std::make_shared<SurfaceSource>(std::move(source));
}

/// Through the nodes of the grid.
void interpolate_one_patch(SurfaceStage& stage, const Session& session, const Progress& progress)
{
    const auto& remeshed = session.part->remeshed;
    const FilledMesh& filled = *session.grid->result.filled;
    DeviationOptions options;
    options.part_faces = filled.part_triangles;
    options.tolerance = usual_tolerance;
    stage.result = interpolate(session.lifted->lifted, session.options.interpolate, progress.part(0, 0.3));
    options.data_u = stage.result.u;
    options.data_v = stage.result.v;
    stage.deviation = deviation(stage.result.surface, filled.mesh, options, progress.part(0.3, remeshed ? 0.6 : 1));
    if (remeshed)
        judge_by_given(stage, *remeshed->original, filled.mesh, filled.part_triangles, options, progress.part(0.6, 1));
}

SurfaceStage one_patch(const Session& session, const OnePatch& asked, const Progress& progress)
{
    constexpr double made = 0.95; // what follows is the certificate
    SurfaceStage stage;
    if (asked.tolerance)
        fit_one_patch(stage, session, asked, progress.part(0, made));
    else
        interpolate_one_patch(stage, session, progress.part(0, made));
    stage.deviation.beyond.clear(); // needed no longer, and may be long
    if (!session.options.fill_holes)
        stage.trim = trim_holes(session.part->mesh, session.grid->boundary.corner[0], stage.result.surface, {},
                                progress.part(made, made));
    stage.certificate = certify(fitted_patches(stage), progress.part(made, 1));
    return stage;
}

int vertex_in_mesh(const PartFile& part, int in_file)
{
    const std::vector<int> copies = vertices_called(part, in_file);
    if (copies.empty())
        throw InputError(fmt::format(
            "vertex {} of the cuts is not one of the part; vertices count from 0 in the file's order", in_file));
    return copies.front();
}

/// Patches around the holes take the place of grid, lift and fit.
SurfaceStage several_patches(const Session& session, const Progress& progress)
{
    const PartFile& part = *session.part;
    if (session.blank->flipped_triangles > 0)
        throw InputError(fmt::format("the blank has triangles that are turned over: it cannot be divided into patches; "
                                     "remesh the part ({}), or take one patch ({})",
                                     mention(option::remesh), mention(option::patches, "one")));
    LayoutOptions layout = session.options.patches.value_or(LayoutOptions{});
    layout.file_number = part.source_vertex;
    for (int& v : layout.corners)
        v = vertex_in_mesh(part, v);
    for (LayoutCut& cut : layout.cuts)
        for (int& v : cut)
            v = vertex_in_mesh(part, v);
    PatchesFitOptions options;
    options.tolerance = surface_tolerance(session);
    options.degree = session.options.interpolate.degree_u;
    options.max_control_points = session.options.max_control_points;
    options.smooth_joins = layout.smooth_joins;
    SurfaceStage stage;
    stage.source = std::make_shared<SurfaceSource>(surface_source(part, options.tolerance, layout.edge_deg));
    const SmoothMesh& sheet = stage.source->sheet;
    const Blank blank{sheet.at_vertices(part.mesh, session.blank->blank.position)};
    auto fitted =
        std::make_shared<PatchesFit>(blank_patches(sheet.mesh, blank, layout, options, progress.part(0, 0.95)));
    fitted->at_vertex.conservativeResize(part.mesh.vertices());
    for (std::vector<MeshPoint>& places : fitted->place)
        for (MeshPoint& place : places)
            place = sheet.in_facets(place);
    stage.deviation.surface_to_mesh = fitted->surface_to_mesh;
    stage.deviation.mesh_to_surface = fitted->mesh_to_surface;
    stage.deviation.at_vertex = fitted->at_vertex;
    stage.fit.emplace();
    stage.fit->tolerance = options.tolerance;
    stage.fit->reached = fitted->reached;
    stage.fit->rounds = fitted->rounds;
    stage.fit->attempts = fitted->attempts;
    if (!fitted->reached) {
        FitShortfall& why = stage.fit->shortfall;
        const bool out = fitted->surface_to_mesh.max >= fitted->mesh_to_surface.max;
        why.where = out ? fitted->surface_to_mesh.where : fitted->mesh_to_surface.where;
        why.reason = FitShortfall::Reason::data;
        why.text = fmt::format(
            "the patches stay up to {:.3g} mm from the part, more than the tolerance of {:.3g} mm, near {:.6g}, "
            "{:.6g}, {:.6g} mm: a sharp edge or corner within a patch, or too few control points "
            "({}); let patches end on flatter edges ({}), cut along the edge ({}), or allow more",
            fitted->deviation_max(), options.tolerance, why.where.x(), why.where.y(), why.where.z(),
            mention(option::max_control_points), mention(option::patch_edges, option::patch_edges.value),
            mention(option::patches, "FILE"));
    }
    stage.patches = std::move(fitted);
    stage.certificate = certify(stage.patches->patches, progress.part(0.95, 1));
    return stage;
}

/// What is in the way of a surface, in words; empty: nothing.
std::string fault(const SurfaceStage& stage)
{
    const double deviation = stage.deviation.max();
    if (deviation > stage.fit->tolerance)
        return fmt::format("up to {:.3g} mm from the part with {} control points (tolerance {:.3g} mm)", deviation,
                           shared_controls(fitted_patches(stage)).count, stage.fit->tolerance);
    const Certificate& certificate = stage.certificate;
    for (const PatchCertificate& patch : certificate.patch)
        if (patch.refusal)
            return describe(*patch.refusal);
    if (const double least = certificate.poorest().least_scaled; least < well_shaped_jacobian)
        return fmt::format("the sharpest corner has a scaled Jacobian of {:.2g} (1 is best, less than {} is poor)",
                           least, well_shaped_jacobian);
    return "";
}

/// One patch if nothing is in its way, else several, else the better of both.
void make_best_surface(Session& session, const Progress& progress)
{
    std::optional<SurfaceStage> one;
    std::string against = "no grid, " + session.no_grid;
    if (session.lifted) {
        constexpr int most_of_one = 5000; // of 25 parts none that one patch held needed more than
                                          // 552, so that a long search is for nothing
        const OnePatch asked{surface_tolerance(session), std::min({session.options.max_control_points, most_of_one,
                                                                   enough_control_points(session.part->mesh)})};
        one = one_patch(session, asked, progress.part(0, 0.4));
        against = fault(*one);
    }
    if (one && against.empty()) {
        one->choice = fmt::format("one patch over the whole blank, within {:.3g} mm", one->fit->tolerance);
        session.surface = std::make_shared<SurfaceStage>(std::move(*one));
        return;
    }
    std::optional<SurfaceStage> several;
    std::string why_not;
    try {
        several = several_patches(session, progress.part(0.4, 1));
        why_not = fault(*several);
    } catch (const InputError& reason) {
        why_not = fmt::format("refused, {}", reason.what());
        if (!one)
            throw InputError(fmt::format("one patch over the whole blank: {}; several patches: {}", against, why_not));
    }
    if (!several || (one && !why_not.empty() && better(*one, *several))) {
        if (FitShortfall& lack = one->fit->shortfall; lack.reason == FitShortfall::Reason::control_points)
            lack.text += fmt::format("; one patch that is asked for ({}) may have more of them than the program takes",
                                     mention(option::patches, "one"));
        one->choice = fmt::format("one patch over the whole blank, with a fault: {}. Several patches are no better: {}",
                                  against, why_not);
        session.surface = std::make_shared<SurfaceStage>(std::move(*one));
        return;
    }
    const size_t count = several->patches->patches.patch.size();
    several->choice =
        fmt::format("{}, because one patch over the {} is not good enough: {}{}",
                    count == 1 ? "one patch between four corners of the outline" : counted(count, "patch", "patches"),
                    count == 1 ? "grid of the blank" : "whole blank", against,
                    why_not.empty() ? "" : fmt::format(". Not without fault either: {}", why_not));
    session.surface = std::make_shared<SurfaceStage>(std::move(*several));
    session.grid = nullptr;
    session.lifted = nullptr;
}

} // namespace

bool better(const SurfaceStage& a, const SurfaceStage& b)
{
    const auto beyond = [](const SurfaceStage& s) { return std::max(0., s.deviation.max() - s.fit->tolerance); };
    const auto rank = [&](const SurfaceStage& s) {
        return std::tuple(!s.certificate.suited(), beyond(s), -s.certificate.poorest().least_scaled);
    };
    return rank(a) < rank(b);
}

int enough_control_points(const TriMesh& part)
{
    constexpr int few = 552; // see make_best_surface(); an L bracket of 66 vertices needs 80
    return std::max(few, part.vertices());
}

double surface_tolerance(const Session& session)
{
    return session.options.tolerance.value_or(1e-3 * bounding_diagonal(session.part->mesh));
}

void make_surface(Session& session, const Progress& progress)
{
    const SessionOptions& options = session.options;
    if (options.best_surface)
        return make_best_surface(session, progress);
    session.surface = std::make_shared<SurfaceStage>(
        options.patches ? several_patches(session, progress)
                        : one_patch(session, {options.tolerance, options.max_control_points}, progress));
}

} // namespace spia
