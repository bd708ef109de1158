#include "engine/coons/wound_grid.h"

#include <algorithm>
#include <cmath>

#include "engine/coons/border_check.h"
#include "engine/coons/find_nodes.h"
#include "engine/coons/keep_shapes.h"
#include "engine/coons/line_spacing.h"
#include "engine/coons/mend.h"
#include "engine/coons/opened_map.h"

namespace spia {

namespace {

constexpr std::array<double, 2> area_weights = {0.05, 0.3}; // of the map, tried in turn: the less, the less it shears
constexpr double share_to_long = 0.8;                       // of the lines, to where cells are long
constexpr double growth = 3;                                // of neighbouring spacings
constexpr int mean_of = 4;                                  // cells on either side
constexpr double too_coarse = 0.15;    // of the cells fold before any is moved: a finer grid is tried at once,
constexpr int quick_cells = 160 * 160; // if there is one, unless they are so few that trying costs little

std::optional<SquareMap> slid_map(const GridWorkshop& shop, double area_weight, const Progress& progress)
{
    // Sides that slide from the start leave triangles folded that fixed ones unfold.
    std::optional<HarmonicMap> map =
        opened_map(shop.harmonic->map, {.area_weight = area_weight}, progress.part(0, 0.5));
    if (map)
        map = opened_map(*map, {.slide = true, .area_weight = area_weight}, progress.part(0.5, 1));
    if (!map)
        return std::nullopt;
    return SquareMap(std::move(*map), GridRoute::wound);
}

/// Per column (or row) the root of its longest edge across: lines spaced by it make long cells shorter, but not all alike, as
/// that would starve the others.
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

GridResult grid_on(const SquareMap& map, const GridWorkshop& shop, const MapLines& lines)
{
    return grid_of_map(map, shop, lines, border_of_map(map.map, shop.boundary, lines));
}

GridResult kept_shapes(const SquareMap& map, const GridWorkshop& shop, int columns, int rows, bool last,
                       const Progress& progress)
{
    const GridResult even = grid_on(map, shop, even_lines(columns, rows));
    GridResult grid = grid_on(map, shop,
                              {spaced_lines(longest_edges(even.planar, true), columns, share_to_long, growth),
                               spaced_lines(longest_edges(even.planar, false), rows, share_to_long, growth)});
    if (!border_is_possible(grid, shop.blank.overlaps_itself()) ||
        (!last && columns * rows > quick_cells && grid.quality.folded_cells > too_coarse * columns * rows))
        return grid;
    keep_shapes(grid.planar, mean_of, progress.part(0, 0.7));
    find_nodes(shop.blank, grid);
    if (grid.quality.folded_cells == 0 && grid.nodes_outside > 0)
        mend(shop.blank, grid, progress.part(0.7, 1));
    grid.route = GridRoute::wound;
    return grid;
}

} // namespace

std::optional<GridResult> wound_grid(const GridWorkshop& shop, const std::vector<std::array<int, 2>>& counts,
                                     const Progress& progress)
{
    std::vector<SquareMap> maps;
    for (size_t k = 0; k < area_weights.size(); ++k)
        if (auto map = slid_map(shop, area_weights[k], progress.part(0.1 * double(k), 0.1 * double(k + 1))))
            maps.push_back(std::move(*map));
    double done = 0.2;
    const double each = 0.8 / double(std::max<size_t>(1, counts.size() * maps.size()));
    for (const auto& [columns, rows] : counts)
        for (const SquareMap& map : maps) {
            const bool last = std::array{columns, rows} == counts.back();
            GridResult grid = kept_shapes(map, shop, columns, rows, last, progress.part(done, done + each));
            if (is_sound(grid))
                return grid;
            done += each;
        }
    return std::nullopt;
}

} // namespace spia
