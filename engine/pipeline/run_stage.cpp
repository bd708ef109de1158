#include "engine/pipeline/run_stage.h"

#include <algorithm>
#include <chrono>
#include <fmt/core.h>

#include "engine/coons/boundary.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/exchange/read_part.h"
#include "engine/forming/process/rolling.h"
#include "engine/forming/solver/flips.h"
#include "engine/forming/solver/placing.h"
#include "engine/forming/solver/seen_along.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/blank_chart.h"
#include "engine/options/part_options.h"
#include "engine/options/surface_options.h"
#include "engine/part/vertex_numbers.h"
#include "engine/pipeline/blank/missing_bends.h"
#include "engine/pipeline/blank/part_bends.h"
#include "engine/pipeline/blank/sharp_folds.h"
#include "engine/pipeline/make_surface.h"
#include "engine/pipeline/session.h"
#include "engine/pipeline/usual_tolerance.h"
#include "engine/unfold/step/polish.h"
#include "engine/unfold/step/relaid_blank.h"
#include "engine/unfold/step/stepped_blank.h"
#include "engine/unfold/step/upright.h"

namespace spia {
namespace {

/// Vertices are named to people by their number in the file; one that the seam or the doctor
/// doubled is several of the mesh.
/// @returns every choice of four different ones, first copies first
std::vector<std::array<int, 4>> corners_in_mesh(const PartFile& part, const std::array<int, 4>& in_file)
{
    std::vector<std::array<int, 4>> choices{{}};
    for (size_t k = 0; k < 4; ++k) {
        const std::vector<int> copies = vertices_called(part, in_file[k]);
        if (copies.empty())
            throw InputError(
                fmt::format("corner {} is not a vertex of the part (they count from 0 in the file's order); "
                            "choose four vertices of the outer boundary",
                            in_file[k]));
        std::vector<std::array<int, 4>> longer;
        for (std::array<int, 4> choice : choices)
            for (const int copy : copies) {
                choice[k] = copy;
                if (std::find(choice.begin(), choice.begin() + long(k), choice[k]) == choice.begin() + long(k))
                    longer.push_back(choice);
            }
        if (longer.empty())
            throw InputError(fmt::format("vertex {} is given as a corner {} times; four different ones are needed",
                                         in_file[k],
                                         std::count(in_file.begin(), in_file.begin() + long(k) + 1, in_file[k])));
        choices = std::move(longer);
    }
    return choices;
}

/// Whether the four follow each other along the loop, either way round.
bool in_order(const std::vector<int>& loop, const std::array<int, 4>& corners)
{
    std::array<long, 4> place;
    for (size_t k = 0; k < 4; ++k) {
        place[k] = std::find(loop.begin(), loop.end(), corners[k]) - loop.begin();
        if (place[k] == long(loop.size()))
            return false;
    }
    const auto steps = [&](size_t k) { return (place[k] - place[0] + long(loop.size())) % long(loop.size()); };
    return (steps(1) < steps(2) && steps(2) < steps(3)) || (steps(1) > steps(2) && steps(2) > steps(3));
}

std::array<int, 4> corners_on_outline(const PartFile& part, const Blank& blank, const std::array<int, 4>& in_file)
{
    const auto choices = corners_in_mesh(part, in_file);
    if (choices.size() == 1)
        return choices.front();
    const auto loops = boundary_loops(part.mesh);
    const std::vector<int>& outline = loops[size_t(outer_loop(loops, blank.position))];
    const auto fits = std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return in_order(outline, c); });
    return fits != choices.end() ? *fits : choices.front(); // split_boundary() says what is wrong
                                                            // with it
}

void read(Session& session, const Progress& progress)
{
    session.part = std::make_shared<PartFile>(read_part(session.file, session.options.read, progress));
}

/// Tools act on the part as a whole, which steps do not know.
void require_no_tools(const ProcessConditions& process)
{
    if (has_tools(process))
        throw InputError(
            "the steps of unfolding leave out contact, drawbeads, pilots and edge restraint; remove these, or solve "
            "the part in one step");
}

/// As the blank of steps lies: straight on the sheet, whatever way the part lay. All that follows
/// is told in these axes.
/// @param rolling  in the axes in which the blank lies
void lay_straight(const TriMesh& part, const std::optional<Eigen::Vector2d>& rolling, FlattenResult& flat)
{
    const Eigen::Matrix2d turn = upright_turn(part, flat.blank.position, rolling);
    Eigen::Matrix2Xd position = turn * flat.blank.position;
    position.colwise() -= Eigen::Vector2d(position.rowwise().minCoeff());
    if (const int flips = flipped_triangles(part.triangle, position); flips > 0) {
        flat.report.reason += fmt::format(
            "; the blank is not laid straight, for {} triangles are so thin that they would flip by rounding", flips);
        return;
    }
    flat.blank.position = std::move(position);
    flat.report.resultant.head<2>() = turn * flat.report.resultant.head<2>();
    flat.overlap = overlap(part, flat.blank.position);
}

/// Where the rolling direction lies on the blank. Where the sheet is strained, r-values have turned
/// the blank to the direction as it is seen; sheet that is only bent may be turned anyhow, and has
/// the direction in its faces.
std::optional<Eigen::Vector2d> rolling_on(const TriMesh& part, const ProcessConditions& process,
                                          const FlattenResult& flat)
{
    auto seen = rolling_in(process, blank_plane(flat.stamping.direction));
    if (!seen || flat.face.strain_equivalent.maxCoeff() > most_relaid_strain)
        return seen;
    return carried_to_blank(part, flat.blank.position, *process.rolling, *seen);
}

/// Where the rolling direction lies on the blank of steps, and on what was laid onto it.
std::optional<Eigen::Vector2d> rolling_on_steps(const ProcessConditions& process)
{
    return process.rolling ? std::optional<Eigen::Vector2d>(Eigen::Vector2d::UnitX()) : std::nullopt;
}

/// Steps know nothing of the neutral fibre. Where they only bend the sheet, the blank is solved
/// again with its lengths.
void lay_steps_anew(const TriMesh& part, const FlattenOptions& options, NeutralFibre& fibre, FlattenResult& flat,
                    const Progress& progress, const StepWatch& watch)
{
    if (fibre.laid.empty())
        return;
    if (flat.face.strain_equivalent.maxCoeff() > most_relaid_strain) {
        keep_triangles(fibre, "the steps strain the sheet, and their blank is kept as it is",
                       "unfold it in one step, or in steps that only bend");
        return;
    }
    SolveReport of_steps = std::move(flat.report);
    StampingDirection stamping = std::move(flat.stamping);
    flat = relaid_blank(part, flat.blank.position, fibre.laid, options, progress, watch);
    flat.stamping = std::move(stamping);
    lay_straight(part, rolling_on_steps(options.process), flat);
    if (flat.report.whole())
        flat.report = std::move(of_steps);
}

/// Who looks on sees every shape straight, as the result will lie.
/// @param part   outlives the watch
/// @param start  of the solve, if it has one: the blank of steps
StepWatch straightened(const StepWatch& watch, const TriMesh& part, const FlattenOptions& options, const Blank* start)
{
    if (!watch)
        return watch;
    return [&part, watch, process = options.process, chosen = options.direction,
            lain = start ? std::optional(start->position) : std::nullopt,
            straight = std::make_shared<std::optional<LiveUpright>>()](const Eigen::Matrix2Xd& X,
                                                                       const NewtonStep& step) {
        if (!*straight) { // only now the part is known to be sound
            const auto plane = blank_plane((chosen ? seen_along(part, *chosen) : stamping_direction(part)).direction);
            straight->emplace(part, lain ? *lain : Eigen::Matrix2Xd(plane.transpose() * part.position),
                              rolling_in(process, plane));
        }
        watch((**straight)(X), step);
    };
}

void solve(Session& session, const Progress& whole, const StepWatch& onlooker)
{
    const TriMesh& part = session.part->mesh;
    const auto& steps = session.options.steps;
    const FlattenOptions& options = session.options.flatten;
    const StepWatch watch =
        straightened(onlooker, part, options, steps && steps->run->blank ? &*steps->run->blank : nullptr);
    const bool twice =
        session.options.read.seam.mode == SeamOptions::Mode::corners && !session.part->seam.empty() && !steps;
    const Progress progress = whole.part(0, twice ? 0.5 : 1);
    progress.checkpoint(0, "looking for bends");
    NeutralFibre fibre = part_bends(*session.part, options.thickness, session.options.k_factor);
    FlattenResult flat;
    if (steps) {
        require_no_tools(options.process);
        progress.checkpoint(0, "taking the blank of the steps");
        if (steps->polish) {
            flat = polish(part, *steps->run, options, progress, watch).whole;
            lay_straight(part, rolling_on_steps(options.process), flat);
        } else
            flat = stepped_blank(part, *steps->run, options);
        lay_steps_anew(part, options, fibre, flat, progress, watch);
    } else {
        flat = flatten_laid(part, fibre.laid, nullptr, options, progress, watch);
        lay_straight(part, rolling_on(part, options.process, flat), flat);
    }
    place_on_blank(fibre, part, flat.blank);
    add_sharp_folds(*session.part, flat.blank, fibre.table);
    doubt_missing_bends(*session.part, fibre.table);
    if (twice) {
        whole.checkpoint(0.5, "unfolding with the corners joined, to compare");
        session.corner_cut = corner_cut(*session.part, flat, options, whole.part(0.5, 1));
    }
    session.blank = std::make_shared<FlattenResult>(std::move(flat));
    session.bends = std::make_shared<BendTable>(std::move(fibre.table));
}

void grid(Session& session, const Progress& progress)
{
    const TriMesh& part = session.part->mesh;
    const Blank& blank = session.blank->blank;
    const auto corners = session.options.corners ? corners_on_outline(*session.part, blank, *session.options.corners)
                                                 : propose_corners(blank, part);
    BlankBoundary boundary = split_boundary(blank, part, corners, session.part->source_vertex);
    GridResult result = coons_grid(part, blank, boundary, session.options.grid, progress, session.part->source_vertex);
    session.grid = std::make_shared<GridStage>(GridStage{std::move(boundary), std::move(result)});
}

/// A blank without a grid for one patch may have one for several.
void try_grid(Session& session, const Progress& progress)
{
    try {
        grid(session, progress);
    } catch (const InputError& reason) {
        session.no_grid = reason.what();
    }
}

bool goes_without_grid(const Session& session)
{
    return session.options.patches || (session.options.best_surface && !session.no_grid.empty());
}

void lift_grid(Session& session, const Progress& progress)
{
    progress.checkpoint(0, "lifting the grid");
    try {
        session.lifted = std::make_shared<LiftResult>(lift(session.grid->result));
    } catch (const InputError& reason) {
        if (!session.options.best_surface)
            throw;
        session.no_grid = reason.what();
        session.grid = nullptr;
    }
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

std::string_view name(const std::optional<BlankOfSteps>& steps)
{
    return !steps ? "one step" : steps->polish ? "steps, polished" : "steps";
}

MultiPatch fitted_patches(const SurfaceStage& stage)
{
    return stage.patches ? stage.patches->patches : MultiPatch{{stage.result.surface}, {}};
}

MultiPatch surface_patches(const Session& session)
{
    return session.deformed ? session.deformed->result.patches : fitted_patches(*session.surface);
}

const Certificate& surface_certificate(const Session& session)
{
    return session.deformed ? session.deformed->certificate : session.surface->certificate;
}

bool made_of_patches(const Session& session)
{
    const SessionOptions& options = session.options;
    return options.patches || (options.best_surface && session.surface && session.surface->patches);
}

Session deform_surface(Session session, bool measure, const Progress& progress)
{
    require(session.surface != nullptr, "fit the surface");
    session.deformed = nullptr;
    if (session.options.deformation) {
        DeformedSurface deformed;
        deformed.result = deform(fitted_patches(*session.surface), *session.options.deformation, measure);
        if (measure)
            deformed.certificate = certify(deformed.result.patches, progress);
        session.deformed = std::make_shared<DeformedSurface>(std::move(deformed));
    }
    return session;
}

void require_possible(const Session& session)
{
    require(session.part != nullptr, "read a part");
    if (!session.options.corners)
        return;
    std::vector<char> on_boundary(size_t(session.part->mesh.vertices()), 0);
    for (const std::vector<int>& loop : boundary_loops(session.part->mesh))
        for (const int v : loop)
            on_boundary[size_t(v)] = 1;
    const auto choices = corners_in_mesh(*session.part, *session.options.corners);
    for (size_t k = 0; k < 4; ++k)
        if (std::none_of(choices.begin(), choices.end(), [&](const auto& c) { return on_boundary[size_t(c[k])]; }))
            throw InputError(fmt::format("corner vertex {} is not on the boundary of the part; pick boundary vertices",
                                         (*session.options.corners)[k]));
}

Session judge_limits(Session session)
{
    require(session.blank != nullptr, "solve for the blank");
    const FlattenOptions& sheet = session.options.flatten;
    LimitsResult limits = forming_limits(session.part->mesh, session.blank->face, sheet.material, sheet.thickness,
                                         session.options.limits, sheet.process.tailored);
    const FlattenResult& flat = *session.blank;
    if (flat.necking_triangles > 0 && flat.report.trusted_strain < sheet.curve.trusted_strain)
        limits.notes.push_back(fmt::format(
            "{} strained beyond {:.2f}{}, from which on the hardening curve was continued: in tension the strain of a "
            "real sheet localizes there, and it cracks earlier than the zones say",
            counted(flat.necking_triangles, "face is", "faces are"), flat.report.trusted_strain,
            sheet.process.tailored.empty() ? "" : " (other grades beyond their own)"));
    if (!sheet.process.pilots.empty())
        limits.notes.push_back(
            "a pilot holds the sheet at single vertices: the strains of the faces around them are those of a point "
            "load, and increase with finer meshes");
    if (flat.report.process_share < 1)
        limits.notes.push_back(
            fmt::format("the zones are those with {:.2g} % of the tool forces", 100 * flat.report.process_share));
    session.limits = std::make_shared<LimitsResult>(std::move(limits));
    return session;
}

Session run_stage(Stage stage, Session session, const Progress& progress, const StepWatch& watch)
{
    const auto clock = std::chrono::steady_clock::now();
    if (stage <= Stage::fit) {
        session.surface = nullptr;
        session.deformed = nullptr;
    }
    if (stage <= Stage::lift)
        session.lifted = nullptr;
    if (stage <= Stage::grid) {
        session.grid = nullptr;
        session.no_grid.clear();
    }
    if (stage <= Stage::solve) {
        session.blank = nullptr;
        session.bends = nullptr;
        session.corner_cut = nullptr;
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
        solve(session, progress, watch);
        session = judge_limits(std::move(session));
        break;
    case Stage::grid:
        require(session.blank != nullptr, "solve for the blank");
        if (session.options.best_surface)
            try_grid(session, progress);
        else if (!session.options.patches)
            grid(session, progress);
        break;
    case Stage::lift:
        if (goes_without_grid(session))
            break;
        require(session.grid != nullptr, "make a grid");
        lift_grid(session, progress);
        break;
    case Stage::fit:
        require(session.blank != nullptr, "solve for the blank");
        require(goes_without_grid(session) || session.lifted, "lift the grid");
        make_surface(session, progress);
        session = deform_surface(std::move(session), true, progress.part(1, 1));
        break;
    }
    session.seconds[stage] = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    return session;
}

} // namespace spia
