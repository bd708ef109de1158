#include "engine/coons/grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/coons/adapt_grid.h"
#include "engine/coons/area_balanced_map.h"
#include "engine/coons/blank_search.h"
#include "engine/coons/border_check.h"
#include "engine/coons/harmonic_map.h"
#include "engine/coons/locate_nodes.h"
#include "engine/coons/map_grid.h"
#include "engine/coons/place_border.h"
#include "engine/coons/spiral_grid.h"
#include "engine/coons/untangle_on_blank.h"
#include "engine/core/error.h"

namespace spia {

namespace {

constexpr int least_cells = 4;                        // of an automatic count
constexpr int most_refinements = 1;                   // of an automatic count: doubled
constexpr int sweeps_between_looks = 5;               // smoothing can fold what it has unfolded:
                                                      // stop as soon as it is good
constexpr std::array<double, 3> slides = {0, 1.5, 6}; // how far border nodes may slide, in cells:
                                                      // tried in turn

/// Bilinearly blended between opposite sides (eq. 25).
void blend_opposite_sides(QuadGrid& grid)
{
    const int m = grid.columns, n = grid.rows;
    const auto at = [&](int i, int j) -> Eigen::Vector3d { return grid.position.col(grid.node(i, j)); };
    for (int j = 1; j < n; ++j)
        for (int i = 1; i < m; ++i) {
            const double u = double(i) / m, v = double(j) / n;
            const Eigen::Vector3d along_v = (1 - v) * at(i, 0) + v * at(i, n);
            const Eigen::Vector3d along_u = (1 - u) * at(0, j) + u * at(m, j);
            const Eigen::Vector3d corners =
                (1 - v) * ((1 - u) * at(0, 0) + u * at(m, 0)) + v * ((1 - u) * at(0, n) + u * at(m, n));
            grid.position.col(grid.node(i, j)) = along_v + along_u - corners;
        }
}

void smooth_interior(QuadGrid& grid, int sweeps)
{
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (int j = 1; j < grid.rows; ++j)
            for (int i = 1; i < grid.columns; ++i)
                grid.position.col(grid.node(i, j)) =
                    0.25 * (grid.position.col(grid.node(i - 1, j)) + grid.position.col(grid.node(i + 1, j)) +
                            grid.position.col(grid.node(i, j - 1)) + grid.position.col(grid.node(i, j + 1)));
}

/// Cells as square as the mean length of the grid lines allows, `options.cells` along the longer
/// ones. (The sides alone would give an ellipse with its corners at the two ends far too few rows.)
void choose_counts(const GridContext& context, const GridOptions& options, int& columns, int& rows)
{
    QuadGrid trial =
        empty_grid(context, options.cells, options.cells, even_border(options.cells, options.cells)).planar;
    blend_opposite_sides(trial);
    double u = 0, v = 0;
    for (int j = 0; j <= trial.rows; ++j)
        for (int i = 0; i <= trial.columns; ++i) {
            if (i > 0)
                u += (trial.position.col(trial.node(i, j)) - trial.position.col(trial.node(i - 1, j))).norm();
            if (j > 0)
                v += (trial.position.col(trial.node(i, j)) - trial.position.col(trial.node(i, j - 1))).norm();
        }
    const auto count = [&](double here) {
        return std::max(std::min(least_cells, options.cells), int(std::lround(options.cells * here / std::max(u, v))));
    };
    columns = options.columns > 0 ? options.columns : count(u);
    rows = options.rows > 0 ? options.rows : count(v);
}

std::string soundness(const GridContext& context, const GridResult& grid)
{
    return soundness(grid, context.blank.overlaps_itself());
}

bool border_is_possible(const GridContext& context, const GridResult& grid)
{
    return border_is_possible(grid, context.blank.overlaps_itself());
}

GridResult coons_patch(const GridContext& context, int columns, int rows, const GridOptions& options,
                       AttemptReport& report, const Progress& progress)
{
    GridResult grid = empty_grid(context, columns, rows, even_border(columns, rows));
    const auto sound = [&] { return is_sound(grid); };
    const auto blend = [&](AttemptReport& own) {
        blend_opposite_sides(grid.planar);
        locate_nodes(context.blank, grid);
        own.reason = soundness(context, grid);
        return true;
    };
    const auto smooth = [&](AttemptReport& own) {
        for (int sweeps = 0; !is_sound(grid) && sweeps < options.smoothing; sweeps += sweeps_between_looks) {
            progress.checkpoint(double(sweeps) / options.smoothing, "smoothing the grid");
            smooth_interior(grid.planar, std::min(sweeps_between_looks, options.smoothing - sweeps));
            grid.route = GridRoute::smoothed_coons;
            locate_nodes(context.blank, grid);
        }
        own.reason = soundness(context, grid);
        return true;
    };
    report.within = try_in_order({{"blended between the sides", {}, blend, sound},
                                  {"smoothed", [&] { return options.smoothing > 0; }, smooth, sound}});
    return grid;
}

/// The grid of a map, untangled where it folds. Sound, or the last one tried.
GridResult untangled_grid(const SquareMap& map, const GridContext& context, const MapLines& lines,
                          const BorderParameters& border, AttemptReport& report, const Progress& progress)
{
    GridResult grid;
    const auto sound = [&] { return is_sound(grid); };
    const auto as_it_is = [&](AttemptReport& own) {
        grid = grid_of_map(map, context, lines, border);
        own.reason = soundness(context, grid);
        return true;
    };
    const auto untangle = [&](AttemptReport& own) {
        untangle_on_blank(context.blank, grid, progress.part(0, 0.5));
        own.reason = soundness(context, grid);
        return true;
    };
    // Where the map squeezes much of the blank into a corner, the patch is the better start.
    const auto untangle_patch = [&](AttemptReport& own) {
        blend_opposite_sides(grid.planar);
        untangle_on_blank(context.blank, grid, progress.part(0.5, 1));
        own.reason = soundness(context, grid);
        return true;
    };
    report.within = try_in_order(
        {{"map as it is", {}, as_it_is, [&] { return is_sound(grid) || !border_is_possible(context, grid); }},
         {"untangled", {}, untangle, sound},
         {"untangled from the Coons patch", [&] { return map.route == GridRoute::harmonic; }, untangle_patch, sound}});
    return grid;
}

/// Border nodes that divide the sides evenly, else that slide as little as they have to for cells
/// to follow the outline.
GridResult harmonic_grid(GridContext& context, int columns, int rows, AttemptReport& report, const Progress& progress)
{
    if (!context.harmonic)
        context.harmonic.emplace(harmonic_map(*context.filled, context.boundary, progress.part(0, 0.2)),
                                 GridRoute::harmonic);
    GridResult grid;
    std::vector<PlannedAttempt> attempts;
    for (const double reach : slides) {
        const auto with_border = [&, reach](AttemptReport& own) {
            const BorderParameters border = reach > 0
                                                ? slid_border(*context.filled, context.boundary, columns, rows, reach)
                                                : even_border(columns, rows);
            grid = untangled_grid(*context.harmonic, context, even_lines(columns, rows), border, own,
                                  progress.part(0.2, 1));
            return true;
        };
        attempts.push_back({reach > 0 ? fmt::format("border nodes slide {} cells", reach) : "border nodes stay even",
                            {},
                            with_border,
                            [&] { return is_sound(grid) || border_is_possible(context, grid); }});
    }
    report.within = try_in_order(attempts);
    return grid;
}

/// The same from a map that leaves lobes and windings their area; its sides slide.
/// @param best  not sound; becomes so, or one whose border is possible
/// @returns whether it has become another
bool area_balanced_grid(const GridContext& context, int columns, int rows, GridResult& best, AttemptReport& report,
                        const Progress& progress)
{
    std::optional<HarmonicMap> opened = area_balanced_map(
        context.harmonic->map, {.oblong = double(columns) / rows, .slide = true}, progress.part(0, 0.5));
    if (!opened) {
        report.reason = "the map folds";
        return false;
    }
    const MapLines lines = even_lines(columns, rows);
    const SquareMap map(std::move(*opened), GridRoute::area_balanced);
    GridResult grid = untangled_grid(map, context, lines, border_of_map(map.map, context.boundary, lines), report,
                                     progress.part(0.5, 1));
    const bool better = is_sound(grid) || (!border_is_possible(context, best) && border_is_possible(context, grid));
    if (better)
        best = std::move(grid);
    return better;
}

/// Length of the outline over that of a square of the same area: 1 for a square, about 1.5 for a
/// part with lobes.
double outline_over_square(const GridContext& context)
{
    const std::vector<int>& outline = context.filled->outline;
    const Eigen::Matrix2Xd& plane = context.filled->plane;
    double length = 0, area = 0;
    for (size_t i = 0; i < outline.size(); ++i) {
        const Eigen::Vector2d a = plane.col(outline[i]), b = plane.col(outline[(i + 1) % outline.size()]);
        length += (b - a).norm();
        area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return length / (4 * std::sqrt(std::max(area, 1e-300)));
}

/// For people, who count corners from 1.
std::string corner_words(const GridContext& context, int k, std::span<const int> file_number)
{
    const int v = context.boundary.corner[size_t(k)];
    return fmt::format("corner {} (vertex {})", k + 1, file_number.empty() ? v : file_number[size_t(v)]);
}

/// A corner into which no cell of so many fits, however its border nodes slide.
std::optional<StraightCorner> straight_corner(const GridContext& context, int columns, int rows)
{
    return straight_corner(*context.filled, context.boundary, columns, rows, 1 + slides.back());
}

/// What the maps would find only after they are made.
void require_corners(const GridContext& context, int columns, int rows, std::span<const int> file_number)
{
    if (const auto found = straight_corner(context, columns, rows))
        throw InputError(fmt::format("no cell fits into {}: the outline of the blank does not turn outwards there "
                                     "(inner angle {:.0f} degrees); choose a convex place, or let the corners be "
                                     "proposed",
                                     corner_words(context, found->corner, file_number), found->angle_deg));
}

[[noreturn]] void throw_impossible(const GridContext& context, const GridResult& grid, std::span<const int> file_number)
{
    const auto number = [&](int v) { return file_number.empty() ? v : file_number[size_t(v)]; };
    const auto& corner = context.boundary.corner;
    const int m = grid.planar.columns, n = grid.planar.rows;
    if (const int k = impossible_corner(grid.planar); k >= 0)
        throw InputError(fmt::format("the {} x {} grid folds at {}: the outline does not turn outwards there (inner "
                                     "angle {:.0f} degrees at the size of a cell), and no cell fits into such a place; "
                                     "choose a corner where the outline is convex, or let the corners be proposed",
                                     m, n, corner_words(context, k, file_number), corner_angle_deg(grid.planar, k)));
    if (!follows_outline(grid, context.blank.overlaps_itself())) {
        if (const auto [vertex, angle_deg] = widest_vertex(*context.filled); angle_deg > 360)
            throw InputError(fmt::format(
                "the blank overlaps itself around boundary vertex {} (inner angle {:.0f} degrees), and the cells of a "
                "{} x {} grid cannot turn around such a place; cut the part there into two",
                number(vertex), angle_deg, m, n));
        throw InputError(fmt::format("the outline of the blank is too intricate for a {} x {} grid: the border nodes, "
                                     "joined by straight lines, do not follow it; choose a finer grid",
                                     m, n));
    }
    if (const double winding = outline_over_square(context); winding > 4)
        throw InputError(fmt::format(
            "the blank winds too much for one four-sided patch: its outline is {:.0f} times as long as that of a square of the "
            "same area, and {} of the {} x {} cells stay folded; cut the part into simpler pieces",
            winding, grid.quality.folded_cells, m, n));
    const std::string corners =
        fmt::format("{}, {}, {}, {}", number(corner[0]), number(corner[1]), number(corner[2]), number(corner[3]));
    if (grid.quality.folded_cells > 0)
        throw InputError(fmt::format(
            "no {} x {} grid without folded cells was found between the corner vertices {}: {} "
            "cells stay folded, the first one in column {}, row {}; choose corners that divide the "
            "outline more evenly, or a finer grid",
            m, n, corners, grid.quality.folded_cells, grid.quality.first_folded % m, grid.quality.first_folded / m));
    throw InputError(fmt::format("the {} x {} grid between the corner vertices {} leaves the blank at {} of its nodes; "
                                 "choose a finer grid, or other corners",
                                 m, n, corners, grid.nodes_outside));
}

} // namespace

std::string_view name(GridRoute route)
{
    switch (route) {
    case GridRoute::coons: return "Coons patch";
    case GridRoute::smoothed_coons: return "smoothed Coons patch";
    case GridRoute::harmonic: return "harmonic map";
    case GridRoute::area_balanced: return "area-balanced map";
    case GridRoute::untangled: return "untangled harmonic map";
    case GridRoute::spiral: return "spiral grid";
    }
    return "";
}

namespace {

/// Cells along both sides where all else has failed and the counts are automatic.
std::vector<std::array<int, 2>> finer_counts(int cells)
{
    std::vector<std::array<int, 2>> counts;
    for (const int finer : {80, 160, 240, 400, 640})
        if (finer > cells)
            counts.push_back({finer, finer});
    if (counts.empty())
        counts.push_back({cells, cells});
    return counts;
}

/// The two maps, with cells of columns x rows, then with twice as many along both if they may be
/// more.
void add_map_attempts(std::vector<PlannedAttempt>& attempts, GridContext& context, GridResult& grid, int columns,
                      int rows, bool may_refine, const Progress& progress)
{
    const int levels = may_refine ? 1 + most_refinements : 1;
    for (int level = 0; level < levels; ++level) {
        const Progress here = progress.part(double(level) / levels, double(level + 1) / levels);
        const int m = columns << level, n = rows << level;
        const std::string finer = level > 0 ? ", twice the cells" : "";
        const auto harmonic = [&, here, level, m, n](AttemptReport& own) {
            grid = harmonic_grid(context, m, n, own, here.part(0, 0.5));
            grid.refinements = level;
            return true;
        };
        const auto area_balanced = [&, here, level, m, n](AttemptReport& own) {
            const bool kept = area_balanced_grid(context, m, n, grid, own, here.part(0.5, 1));
            grid.refinements = level;
            return kept;
        };
        const auto sound = [&] { return is_sound(grid); };
        // The smaller the cells, the straighter is the outline at a corner.
        const auto cells_fit = [&context, level, m, n] { return level == 0 || !straight_corner(context, m, n); };
        attempts.push_back({"harmonic map" + finer, cells_fit, harmonic, sound});
        attempts.push_back({"area-balanced map" + finer, cells_fit, area_balanced, sound});
    }
}

GridResult sound_grid(GridContext& context, const GridOptions& options, const Progress& progress,
                      std::span<const int> file_number)
{
    int columns = 0, rows = 0;
    choose_counts(context, options, columns, rows);
    const bool may_refine = options.columns == 0 && options.rows == 0;

    if (options.method != GridMethod::coons) // that may be asked for however it folds
        require_corners(context, columns, rows, file_number);

    GridResult grid;
    const auto coons = [&](AttemptReport& own) {
        grid = coons_patch(context, columns, rows, options, own, progress.part(0.1, 0.2));
        return true;
    };
    const auto spiral = [&](AttemptReport& own) {
        std::vector<std::array<int, 2>> counts = {{columns, rows}};
        if (may_refine)
            counts = finer_counts(options.cells);
        std::erase_if(counts, [&](const std::array<int, 2>& cells) {
            return straight_corner(context, cells[0], cells[1]).has_value();
        });
        std::optional<GridResult> made = spiral_grid(context, counts, own, progress.part(0.5, 1));
        if (made)
            grid = std::move(*made);
        return made.has_value();
    };
    std::vector<PlannedAttempt> attempts;
    if (options.method != GridMethod::harmonic)
        attempts.push_back({"Coons patch", {}, coons, [&] { return is_sound(grid); }});
    if (options.method != GridMethod::coons) {
        add_map_attempts(attempts, context, grid, columns, rows, may_refine, progress.part(0.2, 0.5));
        attempts.push_back({"spiral grid", [&] { return border_is_possible(context, grid); }, spiral});
    }
    grid.attempts = try_in_order(attempts);
    if (!is_sound(grid) && options.method != GridMethod::coons) {
        if (may_refine) // else finer ones were tried too
            require_corners(context, columns << most_refinements, rows << most_refinements, file_number);
        throw_impossible(context, grid, file_number);
    }
    return grid;
}

} // namespace

GridResult coons_grid(const TriMesh& part, const Blank& blank, const BlankBoundary& boundary,
                      const GridOptions& options, const Progress& progress, std::span<const int> file_number)
{
    if (!(options.line_grading >= 0 && options.line_grading <= 0.9))
        throw InputError("the share of the lines that go to bends must be from 0 to 0.9");
    auto filled = std::make_shared<const FilledMesh>(fill_holes(part, blank.position, progress.part(0, 0.1)));
    progress.checkpoint(0.1, "searching the blank");
    GridContext context{filled, boundary, BlankSearch(*filled)};
    const bool adapt = options.line_grading > 0 || options.even_cells;
    GridResult grid = sound_grid(context, options, adapt ? progress.part(0, 0.7) : progress, file_number);
    if (is_sound(grid)) { // the Coons patch may be asked for as it is
        if (options.line_grading > 0)
            grade_lines(context.blank, boundary, options.line_grading, grid, progress.part(0.7, 0.8));
        if (options.even_cells)
            even_cells(context.blank, grid, progress.part(0.8, 1));
    }
    return grid;
}

} // namespace spia
