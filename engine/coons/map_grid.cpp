#include "engine/coons/map_grid.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "engine/coons/locate_nodes.h"
#include "engine/core/parallel.h"

namespace spia {

MapLines even_lines(int columns, int rows)
{
    const auto even = [](int intervals) {
        Eigen::VectorXd line(intervals + 1);
        for (int i = 0; i <= intervals; ++i)
            line[i] = double(i) / intervals;
        return line;
    };
    return {even(columns), even(rows)};
}

BorderParameters border_of_map(const HarmonicMap& map, const BlankBoundary& boundary, const MapLines& lines)
{
    const Eigen::VectorXd back_u = (1 - lines.u.array()).reverse(), back_v = (1 - lines.v.array()).reverse();
    BorderParameters border = {lines.u, lines.v, back_u, back_v}; // along the sides of the square
    for (size_t k = 0; k < 4; ++k) {
        const std::vector<int>& side = boundary.side[k];
        const Eigen::VectorXd chord = chord_parameters(side, map.plane);
        std::vector<double> along; // the side of the square, from 0 to 1
        for (const int v : side) {
            const double x = map.square(Eigen::Index(k % 2), v);
            along.push_back(k < 2 ? x : 1 - x);
        }
        const Eigen::Index cells = border[k].size() - 1;
        for (Eigen::Index i = 1; i < cells; ++i) {
            const double wanted = border[k][i];
            const auto next = std::upper_bound(along.begin() + 1, along.end() - 1, wanted);
            const Eigen::Index b = next - along.begin(), a = b - 1;
            const double width = along[size_t(b)] - along[size_t(a)];
            const double share = width > 0 ? std::clamp((wanted - along[size_t(a)]) / width, 0.0, 1.0) : 0;
            border[k][i] = chord[a] + share * (chord[b] - chord[a]);
        }
    }
    return border;
}

GridResult empty_grid(const GridContext& context, int columns, int rows, const BorderParameters& border)
{
    GridResult grid;
    grid.filled = context.filled;
    grid.border = border;
    grid.planar.columns = columns;
    grid.planar.rows = rows;
    grid.planar.position = Eigen::Matrix3Xd::Zero(3, grid.planar.nodes());
    grid.place.resize(size_t(grid.planar.nodes()));
    place_border(*context.filled, context.boundary, border, grid.planar, grid.place);
    return grid;
}

GridResult grid_of_map(const SquareMap& map, const GridContext& context, const MapLines& lines,
                       const BorderParameters& border)
{
    const int columns = int(lines.u.size()) - 1, rows = int(lines.v.size()) - 1;
    GridResult grid = empty_grid(context, columns, rows, border);
    grid.route = map.route;
    parallel_for(grid.planar.nodes(), [&](int n) {
        if (is_border(grid.planar, n))
            return;
        MeshPoint& place = grid.place[size_t(n)];
        place = map.map.in_filled_mesh(map.square.nearest({lines.u[n % (columns + 1)], lines.v[n / (columns + 1)]}));
        grid.planar.position.col(n) << context.blank.position(place), 0;
    });
    grid.quality = cell_quality(grid.planar);
    return grid;
}

} // namespace spia
