#include "tests/support/check_grid.h"

#include <fmt/core.h>

#include "engine/coons/boundary.h"
#include "engine/core/error.h"
#include "engine/mesh/orient2d.h"

namespace spia::shapes {

namespace {

Eigen::Vector2d at(const GridResult& grid, int i, int j)
{
    return grid.planar.position.col(grid.planar.node(i, j)).head<2>();
}

std::string fault_of_cells(const GridResult& grid)
{
    for (int j = 0; j < grid.planar.rows; ++j)
        for (int i = 0; i < grid.planar.columns; ++i) {
            const Eigen::Vector2d a = at(grid, i, j), b = at(grid, i + 1, j), c = at(grid, i + 1, j + 1),
                                  d = at(grid, i, j + 1);
            if (orient2d(a, b, c) <= 0 || orient2d(b, c, d) <= 0 || orient2d(c, d, a) <= 0 || orient2d(d, a, b) <= 0)
                return fmt::format("cell {}, {} of {} x {} folds", i, j, grid.planar.columns, grid.planar.rows);
        }
    return "";
}

std::string fault_of_places(const GridResult& grid)
{
    const double tolerance = 1e-12 * grid.filled->plane.cwiseAbs().maxCoeff();
    for (int n = 0; n < grid.planar.nodes(); ++n) {
        const MeshPoint& place = grid.place[size_t(n)];
        if (place.face < 0 || place.barycentric.minCoeff() < 0)
            return fmt::format("node {} is not on the blank", n);
        Eigen::Vector2d p = Eigen::Vector2d::Zero();
        for (int k = 0; k < 3; ++k)
            p += place.barycentric[k] * grid.filled->plane.col(grid.filled->mesh.triangle(k, place.face));
        const double off = (p - grid.planar.position.col(n).head<2>()).norm();
        if (!(off <= 1e3 * tolerance))
            return fmt::format("node {} is {} away from its place", n, off);
    }
    return "";
}

/// Whether the place of a border node is on the edges of a side, and how far along: vertex index
/// and share of the edge.
double along_side(const MeshPoint& place, const GridResult& grid, const std::vector<int>& side)
{
    const Eigen::Vector3i vertex = grid.filled->mesh.triangle.col(place.face);
    for (size_t s = 0; s + 1 < side.size(); ++s)
        for (int k = 0; k < 3; ++k)
            if (vertex[k] == side[s] && vertex[(k + 1) % 3] == side[s + 1] && place.barycentric[(k + 2) % 3] == 0)
                return double(s) + place.barycentric[(k + 1) % 3];
    return -1;
}

std::string fault_of_border(const GridResult& grid, const BlankBoundary& boundary)
{
    const QuadGrid& q = grid.planar;
    for (int k = 0; k < 4; ++k) {
        const int cells = k % 2 == 0 ? q.columns : q.rows;
        const std::vector<int>& side = boundary.side[size_t(k)];
        double before = -1;
        for (int i = 0; i < cells; ++i) {
            const std::array<int, 4> node = {q.node(i, 0), q.node(q.columns, i), q.node(q.columns - i, q.rows),
                                             q.node(0, q.rows - i)};
            const int n = node[size_t(k)];
            if (i == 0 && q.position.col(n).head<2>() != grid.filled->plane.col(boundary.corner[size_t(k)]))
                return fmt::format("corner {} is not on its vertex", k);
            const double here = along_side(grid.place[size_t(n)], grid, side);
            if (here < 0)
                return fmt::format("node {} of side {} is not on an edge of it", i, k);
            if (here <= before)
                return fmt::format("node {} of side {} is not behind the one before", i, k);
            before = here;
        }
    }
    return "";
}

} // namespace

std::string fault_of(const GridResult& grid, const BlankBoundary& boundary)
{
    for (const std::string& fault : {fault_of_cells(grid), fault_of_places(grid), fault_of_border(grid, boundary)})
        if (!fault.empty())
            return fault;
    return "";
}

RandomGrid random_grid(const RandomOutline& drawn)
{
    const Blank blank{drawn.part.position.topRows(2)};
    const BlankBoundary boundary = split_boundary(blank, drawn.part, drawn.corner);
    try {
        const GridResult grid = coons_grid(drawn.part, blank, boundary);
        return {fault_of(grid, boundary), false, grid.attempts};
    } catch (const InputError& error) {
        const std::string why = error.what();
        const bool refused = why.find("winds too much for one four-sided patch") != std::string::npos;
        return {refused ? "" : why, refused, {}};
    }
}

} // namespace spia::shapes
