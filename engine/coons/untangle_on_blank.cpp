#include "engine/coons/untangle_on_blank.h"

#include <algorithm>
#include <array>
#include <vector>

#include "engine/coons/locate_nodes.h"
#include "engine/coons/untangle.h"

namespace spia {

namespace {

constexpr int most_rounds = 10; // of drawing nodes back
constexpr double first_pull = 10, stronger = 10, strongest_pull = 1e5;

/// The smallest sine of the corners that change when an inner node moves to a point.
double least_sine_around(const QuadGrid& grid, int node, const Eigen::Vector2d& point)
{
    const std::array<int, 8> around = ring(grid, node);
    const auto at = [&](int k) -> Eigen::Vector2d { return grid.position.col(around[size_t(k % 8)]).head<2>(); };
    const auto sine = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        const double lengths = a.norm() * b.norm();
        return lengths > 0 ? (a.x() * b.y() - a.y() * b.x()) / lengths : 0;
    };
    double least = 1;
    for (int k = 0; k < 8; k += 2) { // the cell of the node, its neighbours k and k + 2, and k + 1
                                     // across
        least = std::min(least, sine(at(k) - point, at(k + 2) - point));
        least = std::min(least, sine(at(k + 1) - at(k), point - at(k)));
        least = std::min(least, sine(point - at(k + 2), at(k + 1) - at(k + 2)));
    }
    return least;
}

/// The place on the blank where a node outside makes the best cells while its neighbours stay; face
/// -1 if none does.
MeshPoint best_place_for(const BlankSearch& blank, const GridResult& grid, int node)
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
            const MeshPoint place =
                blank.overlaps_itself() ? blank.place_next_to(point, around) : blank.unique_place(point);
            if (place.face >= 0) {
                best = place;
                best_sine = sine;
            }
        }
    return best;
}

/// Where to draw a node that has left the blank: a little way in from its nearest edge, or to a
/// neighbour that is inside where other layers of the blank are in the way.
Eigen::Vector2d way_back(const BlankSearch& blank, const GridResult& grid, int node)
{
    const Eigen::Vector2d here = grid.planar.position.col(node).head<2>();
    const std::vector<MeshPoint> around = places_around(grid, node);
    if (blank.overlaps_itself() && !around.empty()) {
        Eigen::Vector2d nearest = blank.position(around[0]);
        for (const MeshPoint& place : around)
            if ((blank.position(place) - here).norm() < (nearest - here).norm())
                nearest = blank.position(place);
        return nearest;
    }
    MeshPoint place = blank.nearest(here);
    constexpr double inwards = 0.3; // of the way to the middle of the face
    place.barycentric = (1 - inwards) * place.barycentric + Eigen::Vector3d::Constant(inwards / 3);
    return blank.position(place);
}

} // namespace

void untangle_on_blank(const BlankSearch& blank, GridResult& grid, const Progress& progress,
                       const UntangleOptions& options)
{
    grid.route = GridRoute::untangled;
    std::vector<Pull> pulls;
    std::vector<int> pull_of(size_t(grid.planar.nodes()), -1);
    for (int round = 0; round < most_rounds; ++round) {
        untangle(grid.planar, pulls, options,
                 progress.part(double(round) / most_rounds, double(round + 1) / most_rounds));
        locate_nodes(blank, grid);
        if (is_sound(grid) || grid.quality.folded_cells > 0)
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
            const MeshPoint place = best_place_for(blank, settled, n);
            pull.target = place.face >= 0 ? blank.position(place) : way_back(blank, grid, n);
            if (place.face >= 0) {
                settled.place[size_t(n)] = place;
                settled.planar.position.col(n) << pull.target, 0;
            }
        }
        locate_nodes(blank, settled);
        if (is_sound(settled)) {
            grid = std::move(settled);
            return;
        }
    }
}

} // namespace spia
