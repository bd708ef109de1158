#include "engine/coons/locate_nodes.h"

#include <algorithm>

#include "engine/core/parallel.h"

namespace spia {

bool is_border(const QuadGrid& grid, int node)
{
    const int i = node % (grid.columns + 1), j = node / (grid.columns + 1);
    return i == 0 || j == 0 || i == grid.columns || j == grid.rows;
}

/// The eight nodes around an inner one, counter-clockwise.
std::array<int, 8> ring(const QuadGrid& grid, int node)
{
    const int up = grid.columns + 1;
    return {node + 1, node + 1 + up, node + up, node - 1 + up, node - 1, node - 1 - up, node - up, node + 1 - up};
}

std::vector<MeshPoint> places_around(const GridResult& grid, int node)
{
    std::vector<MeshPoint> places;
    for (const int other : ring(grid.planar, node))
        if (grid.place[size_t(other)].face >= 0)
            places.push_back(grid.place[size_t(other)]);
    return places;
}

namespace {

void locate_layer_by_layer(const BlankSearch& blank, GridResult& grid)
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
                    place = blank.place_next_to(grid.planar.position.col(other).head<2>(), places_around(grid, other));
                    if (place.face >= 0)
                        next.push_back(other);
                }
        }
    }
}

} // namespace

void locate_nodes(const BlankSearch& blank, GridResult& grid)
{
    if (blank.overlaps_itself())
        locate_layer_by_layer(blank, grid);
    else
        parallel_for(grid.planar.nodes(), [&](int n) {
            if (!is_border(grid.planar, n))
                grid.place[size_t(n)] = blank.unique_place(grid.planar.position.col(n).head<2>());
        });
    grid.nodes_outside =
        int(std::count_if(grid.place.begin(), grid.place.end(), [](const MeshPoint& place) { return place.face < 0; }));
    grid.quality = cell_quality(grid.planar);
}

bool is_sound(const GridResult& grid) { return grid.quality.folded_cells == 0 && grid.nodes_outside == 0; }

} // namespace spia
