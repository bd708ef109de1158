#include "engine/coons/grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>
#include <optional>

#include "engine/coons/blank_search.h"
#include "engine/coons/boundary.h"
#include "engine/coons/harmonic_map.h"
#include "engine/coons/place_border.h"
#include "engine/coons/untangle.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"

namespace spia
{

namespace
{

constexpr int least_cells = 4;      // of an automatic count
constexpr int most_refinements = 1; // of an automatic count: doubled
constexpr int sweeps_between_looks =
    5; // Laplacian smoothing can fold what it has unfolded: stop as soon as it is good
constexpr int most_rounds = 10; // of drawing nodes back into the blank
constexpr double first_pull = 10, stronger = 10, strongest_pull = 1e5;

/// Everything the ways to a grid share: the blank as a search structure, and the harmonic map once it is
/// needed.
struct Workshop {
    std::shared_ptr<const FilledMesh> filled;
    BlankBoundary boundary;
    BlankSearch blank;
    std::optional<HarmonicMap> map = {};
    std::optional<PlanarLocator> square = {};
};

GridResult empty_grid(const Workshop& shop, int columns, int rows)
{
    GridResult grid;
    grid.filled = shop.filled;
    grid.planar.columns = columns;
    grid.planar.rows = rows;
    grid.planar.position = Eigen::Matrix3Xd::Zero(3, grid.planar.nodes());
    grid.place.resize(size_t(grid.planar.nodes()));
    place_border(*shop.filled, shop.boundary, grid.planar, grid.place);
    return grid;
}

bool is_border(const QuadGrid& grid, int node)
{
    const int i = node % (grid.columns + 1), j = node / (grid.columns + 1);
    return i == 0 || j == 0 || i == grid.columns || j == grid.rows;
}

bool good(const GridResult& grid)
{
    return grid.quality.folded_cells == 0 && grid.nodes_outside == 0;
}

/// The eight nodes around an inner one, counter-clockwise.
std::array<int, 8> ring(const QuadGrid& grid, int node)
{
    const int up = grid.columns + 1;
    return {node + 1, node + 1 + up, node + up, node - 1 + up,
            node - 1, node - 1 - up, node - up, node + 1 - up};
}

std::vector<MeshPoint> places_around(const GridResult& grid, int node)
{
    std::vector<MeshPoint> places;
    for (const int other : ring(grid.planar, node))
        if (grid.place[size_t(other)].face >= 0)
            places.push_back(grid.place[size_t(other)]);
    return places;
}

/// Finds the inner nodes on a blank that overlaps itself: from the border inwards, each on the layer of its
/// neighbours.
void find_layer_by_layer(const Workshop& shop, GridResult& grid)
{
    std::vector<int> front, next;
    std::vector<char> queued(grid.place.size(), 0);
    for (int n = 0; n < grid.planar.nodes(); ++n) {
        if (is_border(grid.planar, n))
            front.push_back(n);
        else
            grid.place[size_t(n)] = {};
    }
    for (; !front.empty(); front = std::move(next), next.clear()) {
        std::fill(queued.begin(), queued.end(), char(0));
        for (const int n : front) { // ring neighbours of what was placed last, each once
            const int i = n % (grid.planar.columns + 1), j = n / (grid.planar.columns + 1);
            for (int b = std::max(1, j - 1); b <= std::min(grid.planar.rows - 1, j + 1); ++b)
                for (int a = std::max(1, i - 1); a <= std::min(grid.planar.columns - 1, i + 1); ++a) {
                    const int other = grid.planar.node(a, b);
                    MeshPoint& place = grid.place[size_t(other)];
                    if (place.face >= 0 || queued[size_t(other)])
                        continue;
                    queued[size_t(other)] = 1;
                    place = shop.blank.place_next_to(grid.planar.position.col(other).head<2>(),
                                                     places_around(grid, other));
                    if (place.face >= 0)
                        next.push_back(other);
                }
        }
    }
}

/// Finds the inner nodes on the blank, and judges the cells.
void inspect(const Workshop& shop, GridResult& grid)
{
    if (shop.blank.overlaps_itself())
        find_layer_by_layer(shop, grid);
    else
        parallel_for(grid.planar.nodes(), [&](int n) {
            if (!is_border(grid.planar, n))
                grid.place[size_t(n)] = shop.blank.unique_place(grid.planar.position.col(n).head<2>());
        });
    grid.nodes_outside = int(std::count_if(grid.place.begin(), grid.place.end(),
                                           [](const MeshPoint& place) { return place.face < 0; }));
    grid.quality = cell_quality(grid.planar);
}

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

/// Cells as square as the mean length of the grid lines allows, `options.cells` along the longer ones. (The
/// sides alone would give an ellipse with its corners at the two ends far too few rows.)
void choose_counts(const Workshop& shop, const GridOptions& options, int& columns, int& rows)
{
    QuadGrid trial = empty_grid(shop, options.cells, options.cells).planar;
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
        return std::max(std::min(least_cells, options.cells),
                        int(std::lround(options.cells * here / std::max(u, v))));
    };
    columns = options.columns > 0 ? options.columns : count(u);
    rows = options.rows > 0 ? options.rows : count(v);
}

GridResult coons_patch(const Workshop& shop, int columns, int rows, const GridOptions& options,
                       const Progress& progress)
{
    GridResult grid = empty_grid(shop, columns, rows);
    blend_opposite_sides(grid.planar);
    inspect(shop, grid);
    for (int sweeps = 0; !good(grid) && sweeps < options.smoothing; sweeps += sweeps_between_looks) {
        progress.checkpoint(double(sweeps) / options.smoothing, "smoothing the grid");
        smooth_interior(grid.planar, std::min(sweeps_between_looks, options.smoothing - sweeps));
        grid.route = GridRoute::smoothed_coons;
        inspect(shop, grid);
    }
    return grid;
}

/// The harmonic map, inverted at the nodes of the unit square. Each node keeps the triangle it was found in.
GridResult harmonic_grid(Workshop& shop, int columns, int rows, const Progress& progress)
{
    if (!shop.map) {
        shop.map = harmonic_map(*shop.filled, shop.boundary, progress);
        shop.square.emplace(shop.map->square, shop.map->triangle);
    }
    GridResult grid = empty_grid(shop, columns, rows);
    grid.route = GridRoute::harmonic;
    parallel_for(grid.planar.nodes(), [&](int n) {
        if (is_border(grid.planar, n))
            return;
        const Eigen::Vector2d uv(double(n % (columns + 1)) / columns, double(n / (columns + 1)) / rows);
        MeshPoint& place = grid.place[size_t(n)];
        place = shop.map->in_filled_mesh(shop.square->nearest(uv));
        grid.planar.position.col(n) << shop.blank.position(place), 0;
    });
    grid.quality = cell_quality(grid.planar);
    return grid;
}

/// The smallest sine of the corners that change when an inner node moves to a point.
double least_sine_around(const QuadGrid& grid, int node, const Eigen::Vector2d& point)
{
    const std::array<int, 8> around = ring(grid, node);
    const auto at = [&](int k) -> Eigen::Vector2d {
        return grid.position.col(around[size_t(k % 8)]).head<2>();
    };
    const auto sine = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        const double lengths = a.norm() * b.norm();
        return lengths > 0 ? (a.x() * b.y() - a.y() * b.x()) / lengths : 0;
    };
    double least = 1;
    for (int k = 0; k < 8; k += 2) { // the cell of the node, its neighbours k and k + 2, and k + 1 across
        least = std::min(least, sine(at(k) - point, at(k + 2) - point));
        least = std::min(least, sine(at(k + 1) - at(k), point - at(k)));
        least = std::min(least, sine(point - at(k + 2), at(k + 1) - at(k + 2)));
    }
    return least;
}

/// The place on the blank where a node outside makes the best cells while its neighbours stay; face -1 if
/// none does.
MeshPoint best_place_for(const Workshop& shop, const GridResult& grid, int node)
{
    constexpr int samples = 24; // per direction, over the box of the cells around
    constexpr double least_sine = 1e-4;
    Eigen::Vector2d low = grid.planar.position.col(node).head<2>(), high = low;
    for (const int other : ring(grid.planar, node)) {
        low = low.cwiseMin(grid.planar.position.col(other).head<2>());
        high = high.cwiseMax(grid.planar.position.col(other).head<2>());
    }
    const std::vector<MeshPoint> around = places_around(grid, node);
    MeshPoint best;
    double best_sine = least_sine;
    for (int j = 1; j < samples; ++j)
        for (int i = 1; i < samples; ++i) {
            const Eigen::Vector2d point =
                low + Eigen::Vector2d((high - low).x() * i / samples, (high - low).y() * j / samples);
            const double sine = least_sine_around(grid.planar, node, point);
            if (sine <= best_sine)
                continue;
            const MeshPoint place = shop.blank.overlaps_itself() ? shop.blank.place_next_to(point, around)
                                                                 : shop.blank.unique_place(point);
            if (place.face >= 0) {
                best = place;
                best_sine = sine;
            }
        }
    return best;
}

/// Where to draw a node that has left the blank: a little way in from its nearest edge, or to a neighbour
/// that is inside where other layers of the blank are in the way.
Eigen::Vector2d way_back(const Workshop& shop, const GridResult& grid, int node)
{
    const Eigen::Vector2d here = grid.planar.position.col(node).head<2>();
    const std::vector<MeshPoint> around = places_around(grid, node);
    if (shop.blank.overlaps_itself() && !around.empty()) {
        Eigen::Vector2d nearest = shop.blank.position(around[0]);
        for (const MeshPoint& place : around)
            if ((shop.blank.position(place) - here).norm() < (nearest - here).norm())
                nearest = shop.blank.position(place);
        return nearest;
    }
    MeshPoint place = shop.blank.nearest(here);
    constexpr double inwards = 0.3; // of the way to the middle of the face
    place.barycentric = (1 - inwards) * place.barycentric + Eigen::Vector3d::Constant(inwards / 3);
    return shop.blank.position(place);
}

/// Untangles the cells. Nodes may leave the blank on the way, into a bay that a cell bridges: those are put
/// back where the cells around allow it, else drawn back with growing force.
void mend(const Workshop& shop, GridResult& grid, const Progress& progress)
{
    grid.route = GridRoute::untangled;
    std::vector<Pull> pulls;
    std::vector<int> pull_of(size_t(grid.planar.nodes()), -1);
    for (int round = 0; round < most_rounds; ++round) {
        untangle(grid.planar, pulls, {},
                 progress.part(double(round) / most_rounds, double(round + 1) / most_rounds));
        inspect(shop, grid);
        if (good(grid) || grid.quality.folded_cells > 0)
            return;
        GridResult settled = grid;
        for (int n = 0; n < grid.planar.nodes(); ++n) {
            if (grid.place[size_t(n)].face >= 0)
                continue;
            if (pull_of[size_t(n)] < 0) {
                pull_of[size_t(n)] = int(pulls.size());
                pulls.push_back({n, Eigen::Vector2d::Zero(), first_pull / stronger});
            }
            Pull& pull = pulls[size_t(pull_of[size_t(n)])];
            pull.weight = std::min(pull.weight * stronger, strongest_pull);
            const MeshPoint place = best_place_for(shop, settled, n);
            pull.target = place.face >= 0 ? shop.blank.position(place) : way_back(shop, grid, n);
            if (place.face >= 0) {
                settled.place[size_t(n)] = place;
                settled.planar.position.col(n) << pull.target, 0;
            }
        }
        inspect(shop, settled);
        if (good(settled)) {
            grid = std::move(settled);
            return;
        }
    }
}

/// The inner angle of the outline at a corner, in degrees, between the first border nodes to both sides: 0 to
/// 360.
double corner_angle_deg(const QuadGrid& q, size_t k)
{
    const int m = q.columns, n = q.rows;
    const std::array<std::array<int, 3>, 4> corner = {{{q.node(0, 0), q.node(1, 0), q.node(0, 1)},
                                                       {q.node(m, 0), q.node(m, 1), q.node(m - 1, 0)},
                                                       {q.node(m, n), q.node(m - 1, n), q.node(m, n - 1)},
                                                       {q.node(0, n), q.node(0, n - 1), q.node(1, n)}}};
    const Eigen::Vector3d a = q.position.col(corner[k][1]) - q.position.col(corner[k][0]);
    const Eigen::Vector3d b = q.position.col(corner[k][2]) - q.position.col(corner[k][0]);
    const double angle = std::atan2(a.cross(b).z(), a.dot(b)) * 180 / std::numbers::pi;
    return angle > 0 ? angle : angle + 360;
}

/// The first corner at which no grid with these border nodes can have a cell, or -1.
int impossible_corner(const QuadGrid& grid)
{
    constexpr double rounding_deg = 1e-6;
    for (size_t k = 0; k < 4; ++k)
        if (corner_angle_deg(grid, k) > 180 - rounding_deg)
            return int(k);
    return -1;
}

/// How often the polygon of the border nodes turns around, counter-clockwise positive. Only 1 can bound
/// unfolded cells.
int border_turns(const QuadGrid& grid)
{
    std::vector<Eigen::Vector2d> border;
    const auto add = [&](int i, int j) {
        const Eigen::Vector2d point = grid.position.col(grid.node(i, j)).head<2>();
        if (border.empty() || point != border.back())
            border.push_back(point);
    };
    for (int i = 0; i < grid.columns; ++i)
        add(i, 0);
    for (int j = 0; j < grid.rows; ++j)
        add(grid.columns, j);
    for (int i = grid.columns; i > 0; --i)
        add(i, grid.rows);
    for (int j = grid.rows; j > 0; --j)
        add(0, j);
    double turning = 0;
    const size_t n = border.size();
    for (size_t k = 0; k < n; ++k) {
        const Eigen::Vector2d in = border[(k + 1) % n] - border[k],
                              out = border[(k + 2) % n] - border[(k + 1) % n];
        turning += std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
    }
    return int(std::lround(turning / (2 * std::numbers::pi)));
}

bool may_unfold(const QuadGrid& grid)
{
    return impossible_corner(grid) < 0 && border_turns(grid) == 1;
}

[[noreturn]] void throw_impossible(const GridResult& grid, const BlankBoundary& boundary)
{
    const int m = grid.planar.columns, n = grid.planar.rows;
    if (const int k = impossible_corner(grid.planar); k >= 0)
        throw InputError(fmt::format("the {} x {} grid folds at corner vertex {}: the outline does not turn "
                                     "outwards there (inner angle {:.0f} "
                                     "degrees at the size of a cell), and no cell fits into such a place; "
                                     "choose a corner where the outline is "
                                     "convex, or let the corners be proposed",
                                     m, n, boundary.corner[size_t(k)],
                                     corner_angle_deg(grid.planar, size_t(k))));
    if (const int turns = border_turns(grid.planar); turns != 1)
        throw InputError(fmt::format(
            "the outline of the blank is too intricate for a {} x {} grid: the border nodes, joined by "
            "straight lines, turn around {} times instead of once; choose a finer grid",
            m, n, turns));
    const std::string corners = fmt::format("{}", fmt::join(boundary.corner, ", "));
    if (grid.quality.folded_cells > 0)
        throw InputError(fmt::format(
            "no {} x {} grid without folded cells was found between the corner vertices {}: {} "
            "cells stay folded, the first one in column {}, row {}; choose corners that divide the "
            "outline more evenly, or a finer grid",
            m, n, corners, grid.quality.folded_cells, grid.quality.first_folded % m,
            grid.quality.first_folded / m));
    throw InputError(
        fmt::format("the {} x {} grid between the corner vertices {} leaves the blank at {} of its nodes; "
                    "choose a finer grid, or other corners",
                    m, n, corners, grid.nodes_outside));
}

} // namespace

std::string_view name(GridRoute route)
{
    switch (route) {
    case GridRoute::coons:
        return "Coons patch";
    case GridRoute::smoothed_coons:
        return "smoothed Coons patch";
    case GridRoute::harmonic:
        return "harmonic map";
    case GridRoute::untangled:
        return "untangled harmonic map";
    }
    return "";
}

GridResult coons_grid(const TriMesh& part, const Blank& blank, const BlankBoundary& boundary,
                      const GridOptions& options, const Progress& progress)
{
    auto filled = std::make_shared<const FilledMesh>(fill_holes(part, blank.position, progress.part(0, 0.1)));
    progress.checkpoint(0.1, "searching the blank");
    Workshop shop{filled, boundary, BlankSearch(*filled)};
    int columns = 0, rows = 0;
    choose_counts(shop, options, columns, rows);

    GridResult grid;
    if (options.method != GridMethod::harmonic) {
        grid = coons_patch(shop, columns, rows, options, progress.part(0.1, 0.2));
        if (good(grid) || options.method == GridMethod::coons)
            return grid;
    }
    const bool may_refine = options.columns == 0 && options.rows == 0;
    for (int refinement = 0; refinement <= (may_refine ? most_refinements : 0); ++refinement) {
        const Progress here = progress.part(0.2 + 0.2 * refinement, 0.4 + 0.2 * refinement);
        grid = harmonic_grid(shop, columns << refinement, rows << refinement, here.part(0, 0.3));
        grid.refinements = refinement;
        if (!good(grid) && may_unfold(grid.planar)) {
            mend(shop, grid, here.part(0.3, 0.6));
            if (!good(grid)) { // where the map squeezes much of the blank into a corner, the patch is the
                               // better start
                blend_opposite_sides(grid.planar);
                mend(shop, grid, here.part(0.6, 1));
            }
        }
        if (good(grid))
            return grid;
    }
    throw_impossible(grid, boundary);
}

} // namespace spia
