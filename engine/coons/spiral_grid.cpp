#include "engine/coons/spiral_grid.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/coons/area_balanced_map.h"
#include "engine/coons/border_check.h"
#include "engine/coons/graded_lines.h"
#include "engine/coons/locate_nodes.h"
#include "engine/coons/untangle_locally.h"
#include "engine/coons/untangle_on_blank.h"

namespace spia {

namespace {

constexpr std::array<double, 2> area_weights = {0.05, 0.3}; // of the map, tried in turn: the less,
                                                            // the less it shears
constexpr double share_to_long = 0.8;                       // of the lines, to where cells are long
constexpr double growth = 3;                                // of neighbouring spacings
constexpr int mean_of = 4;                                  // cells on either side
constexpr double too_coarse = 0.15;                         // of the cells fold before any is
                                                            // moved: a finer grid is tried at once,
constexpr int quick_cells = 160 * 160;                      // if there is one, unless they are so
                                                            // few that trying costs little

std::optional<SquareMap> slid_map(const GridContext& context, double area_weight, const Progress& progress)
{
    // Sides that slide from the start leave triangles folded that fixed ones unfold.
    std::optional<HarmonicMap> map =
        area_balanced_map(context.harmonic->map, {.area_weight = area_weight}, progress.part(0, 0.5));
    if (map)
        map = area_balanced_map(*map, {.slide = true, .area_weight = area_weight}, progress.part(0.5, 1));
    if (!map)
        return std::nullopt;
    return SquareMap(std::move(*map), GridRoute::spiral);
}

/// Per column (or row) the root of its longest edge across: lines spaced by it make long cells
/// shorter, but not all alike, as that would starve the others.
Eigen::VectorXd longest_edges(const QuadGrid& grid, bool along_u)
{
    Eigen::VectorXd longest = Eigen::VectorXd::Zero(along_u ? grid.columns : grid.rows);
    for (int j = 0; j + !along_u <= grid.rows; ++j)
        for (int i = 0; i + along_u <= grid.columns; ++i) {
            const auto a = grid.position.col(grid.node(i, j)),
                       b = grid.position.col(grid.node(i + along_u, j + !along_u));
            double& here = longest[along_u ? i : j];
            here = std::max(here, (b - a).norm());
        }
    return longest.cwiseSqrt();
}

GridResult grid_on(const SquareMap& map, const GridContext& context, const MapLines& lines)
{
    return grid_of_map(map, context, lines, border_of_map(map.map, context.boundary, lines));
}

GridResult locally_untangled(const SquareMap& map, const GridContext& context, int columns, int rows, bool last,
                             const Progress& progress)
{
    const GridResult even = grid_on(map, context, even_lines(columns, rows));
    GridResult grid = grid_on(map, context,
                              {graded_lines(longest_edges(even.planar, true), columns, share_to_long, growth),
                               graded_lines(longest_edges(even.planar, false), rows, share_to_long, growth)});
    if (!border_is_possible(grid, context.blank.overlaps_itself()) ||
        (!last && columns * rows > quick_cells && grid.quality.folded_cells > too_coarse * columns * rows))
        return grid;
    untangle_locally(grid.planar, mean_of, progress.part(0, 0.7));
    locate_nodes(context.blank, grid);
    if (grid.quality.folded_cells == 0 && grid.nodes_outside > 0)
        untangle_on_blank(context.blank, grid, progress.part(0.7, 1));
    grid.route = GridRoute::spiral;
    return grid;
}

} // namespace

std::optional<GridResult> spiral_grid(const GridContext& context, const std::vector<std::array<int, 2>>& counts,
                                      AttemptReport& report, const Progress& progress)
{
    struct WeighedMap {
        double area_weight;
        SquareMap map;
    };
    std::vector<WeighedMap> maps;
    for (size_t k = 0; k < area_weights.size(); ++k)
        if (auto map = slid_map(context, area_weights[k], progress.part(0.1 * double(k), 0.1 * double(k + 1))))
            maps.push_back({area_weights[k], std::move(*map)});
    std::optional<GridResult> sound;
    std::vector<PlannedAttempt> attempts;
    const double each = 0.8 / double(std::max<size_t>(1, counts.size() * maps.size()));
    for (const auto& [columns, rows] : counts)
        for (const WeighedMap& weighed : maps) {
            const double done = 0.2 + each * double(attempts.size());
            const auto on_map = [&, columns = columns, rows = rows, done](AttemptReport& own) {
                const bool last = std::array{columns, rows} == counts.back();
                GridResult grid =
                    locally_untangled(weighed.map, context, columns, rows, last, progress.part(done, done + each));
                own.reason = soundness(grid, context.blank.overlaps_itself());
                if (is_sound(grid))
                    sound = std::move(grid);
                return sound.has_value();
            };
            attempts.push_back(
                {fmt::format("{} x {} cells, area weight {}", columns, rows, weighed.area_weight), {}, on_map});
        }
    if (maps.empty())
        report.reason = "the maps fold";
    report.within = try_in_order(attempts);
    return sound;
}

} // namespace spia
