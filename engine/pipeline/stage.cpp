#include <algorithm>
#include <chrono>
#include <fmt/core.h>

#include "engine/coons/boundary.h"
#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/session.h"

namespace spia {
namespace {

/// Vertices are named to people by their number in the file.
std::array<int, 4> corners_in_mesh(const PartFile& part, const std::array<int, 4>& in_file)
{
    std::array<int, 4> result;
    for (size_t k = 0; k < 4; ++k) {
        const auto found = std::find(part.source_vertex.begin(), part.source_vertex.end(), in_file[k]);
        if (found == part.source_vertex.end())
            throw InputError(
                fmt::format("corner {} is not a vertex of the part (they count from 0 in the file's order); "
                            "choose four vertices of the outer boundary",
                            in_file[k]));
        result[k] = int(found - part.source_vertex.begin());
    }
    return result;
}

void read(Session& session, const Progress& progress)
{
    session.part = std::make_shared<PartFile>(read_part(session.file, session.options.read, progress));
}

void solve(Session& session, const Progress& progress)
{
    session.blank = std::make_shared<FlattenResult>(flatten(session.part->mesh, session.options.flatten, progress));
}

void grid(Session& session, const Progress& progress)
{
    const TriMesh& part = session.part->mesh;
    const Blank& blank = session.blank->blank;
    const auto corners = session.options.corners ? corners_in_mesh(*session.part, *session.options.corners)
                                                 : propose_corners(blank, part);
    BlankBoundary boundary = split_boundary(blank, part, corners, session.part->source_vertex);
    GridOptions options = session.options.grid;
    options.file_number = session.part->source_vertex;
    GridResult result = coons_grid(part, blank, boundary, options, progress);
    session.grid = std::make_shared<GridStage>(GridStage{std::move(boundary), std::move(result)});
}

void lift_grid(Session& session, const Progress& progress)
{
    progress.checkpoint(0, "lifting the grid");
    session.lifted = std::make_shared<LiftResult>(lift(session.grid->result));
}

void fit(Session& session, const Progress& progress)
{
    InterpolateResult result = interpolate(session.lifted->lifted, session.options.interpolate, progress.part(0, 0.3));
    DeviationOptions options;
    options.part_faces = session.grid->result.filled->part_triangles;
    options.data_u = result.u;
    options.data_v = result.v;
    Deviation measured = deviation(result.surface, session.grid->result.filled->mesh, options, progress.part(0.3, 1));
    session.surface = std::make_shared<SurfaceStage>(SurfaceStage{std::move(result), std::move(measured)});
}

void require(bool there, const char* what)
{
    if (!there)
        throw InputError(fmt::format("{} first", what));
}

} // namespace

std::string_view name(Stage stage)
{
    switch (stage) {
    case Stage::read: return "read";
    case Stage::solve: return "solve";
    case Stage::grid: return "grid";
    case Stage::lift: return "lift";
    case Stage::fit: return "fit";
    }
    return "";
}

void require_possible(const Session& session)
{
    require(session.part != nullptr, "read a part");
    if (!session.options.corners)
        return;
    const auto loops = boundary_loops(session.part->mesh);
    const auto corners = corners_in_mesh(*session.part, *session.options.corners);
    for (size_t k = 0; k < 4; ++k) {
        if (std::none_of(loops.begin(), loops.end(), [&](const auto& loop) {
                return std::find(loop.begin(), loop.end(), corners[k]) != loop.end();
            }))
            throw InputError(fmt::format("corner vertex {} is not on the boundary of the part; pick boundary vertices",
                                         (*session.options.corners)[k]));
        if (std::count(corners.begin(), corners.end(), corners[k]) > 1)
            throw InputError(fmt::format("vertex {} is given as a corner twice; four different ones are needed",
                                         (*session.options.corners)[k]));
    }
}

Session judge_limits(Session session)
{
    require(session.blank != nullptr, "solve for the blank");
    const FlattenOptions& sheet = session.options.flatten;
    session.limits = std::make_shared<LimitsResult>(forming_limits(
        session.part->mesh, session.blank->face, sheet.material, sheet.thickness, session.options.limits));
    return session;
}

Session run_stage(Stage stage, Session session, const Progress& progress)
{
    const auto clock = std::chrono::steady_clock::now();
    if (stage <= Stage::fit)
        session.surface = nullptr;
    if (stage <= Stage::lift)
        session.lifted = nullptr;
    if (stage <= Stage::grid)
        session.grid = nullptr;
    if (stage <= Stage::solve) {
        session.blank = nullptr;
        session.limits = nullptr;
    }
    if (stage <= Stage::read)
        session.part = nullptr;
    for (const Stage later : chain)
        if (later >= stage)
            session.seconds.erase(later);

    switch (stage) {
    case Stage::read: read(session, progress); break;
    case Stage::solve:
        require(session.part != nullptr, "read a part");
        solve(session, progress);
        session = judge_limits(std::move(session));
        break;
    case Stage::grid:
        require(session.blank != nullptr, "solve for the blank");
        grid(session, progress);
        break;
    case Stage::lift:
        require(session.grid != nullptr, "make a grid");
        lift_grid(session, progress);
        break;
    case Stage::fit:
        require(session.lifted != nullptr, "lift the grid");
        fit(session, progress);
        break;
    }
    session.seconds[stage] = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    return session;
}

} // namespace spia
