#include "engine/nurbs/blank_chart.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "engine/coons/place_border.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/interpolate.h"

namespace spia {

namespace {

constexpr const char* taking_points = "taking points of the part";

const GridResult& sound(const GridResult& grid)
{
    if (grid.quality.folded_cells > 0 || grid.nodes_outside > 0)
        throw InputError(
            fmt::format("{} cells of the grid fold and {} nodes are outside the blank: it cannot be made finer; "
                        "use the automatic or the harmonic grid",
                        grid.quality.folded_cells, grid.nodes_outside));
    return grid;
}

/// The cell of t among `cells` even ones, and how far in it t lies.
struct InCell {
    int cell;
    double share;
    InCell(double t, int cells)
        : cell(std::clamp(int(t * cells), 0, cells - 1)), share(std::clamp(t * cells - cell, 0.0, 1.0))
    {
    }
};

/// The chord-length parameters of nodes at t on a side whose first nodes have the given ones.
Eigen::VectorXd between_nodes(const Eigen::VectorXd& node, const std::vector<double>& t)
{
    const int cells = int(node.size()) - 1;
    Eigen::VectorXd result(Eigen::Index(t.size()));
    for (size_t i = 0; i < t.size(); ++i) {
        const InCell at(t[i], cells);
        result[Eigen::Index(i)] = node[at.cell] + at.share * (node[at.cell + 1] - node[at.cell]);
    }
    return result;
}

/// From 1 at the border to 0 at the end of the first row of cells, with no slope at both.
double fading(double t, int cells)
{
    const double s = std::min(1.0, t * std::max(2, cells));
    return (1 - s) * (1 - s) * (1 + 2 * s);
}

} // namespace

BlankChart::BlankChart(const GridResult& grid, const BlankBoundary& boundary)
    : grid_(sound(grid)), boundary_(boundary), search_(*grid.filled),
      plane_(interpolate(grid.planar, {.parameters = InterpolateOptions::Parameters::uniform}).surface)
{
}

Eigen::Vector2d BlankChart::in_plane(Between between, double u, double v) const
{
    if (between == Between::bicubic)
        return evaluate(plane_, u, v).position.head<2>();
    const QuadGrid& grid = grid_.planar;
    const InCell a(u, grid.columns), b(v, grid.rows);
    const auto at = [&](int i, int j) -> Eigen::Vector2d {
        return grid.position.col(grid.node(a.cell + i, b.cell + j)).head<2>();
    };
    return (1 - b.share) * ((1 - a.share) * at(0, 0) + a.share * at(1, 0)) +
           b.share * ((1 - a.share) * at(0, 1) + a.share * at(1, 1));
}

QuadGrid BlankChart::planar(Between between, const std::vector<double>& u, const std::vector<double>& v,
                            const QuadGrid& border, const Progress& progress) const
{
    QuadGrid result = border;
    const int m = border.columns, n = border.rows;
    // How far the outline is from the map's own border.
    const auto missing = [&](int i, int j) -> Eigen::Vector2d {
        return border.position.col(border.node(i, j)).head<2>() - in_plane(between, u[size_t(i)], v[size_t(j)]);
    };
    Eigen::Matrix2Xd at_v0(2, m + 1), at_v1(2, m + 1), at_u0(2, n + 1), at_u1(2, n + 1);
    for (int i = 0; i <= m; ++i) {
        at_v0.col(i) = missing(i, 0);
        at_v1.col(i) = missing(i, n);
    }
    for (int j = 0; j <= n; ++j) {
        at_u0.col(j) = missing(0, j);
        at_u1.col(j) = missing(m, j);
    }
    const int columns = grid_.planar.columns, rows = grid_.planar.rows;
    for_each_in_parts(result.nodes(), progress, taking_points, [&](int node) {
        const int i = node % (m + 1), j = node / (m + 1);
        if (i == 0 || j == 0 || i == m || j == n)
            return;
        const double s = u[size_t(i)], t = v[size_t(j)];
        result.position.col(node) << in_plane(between, s, t) + fading(t, rows) * at_v0.col(i) +
                                         fading(1 - t, rows) * at_v1.col(i) + fading(s, columns) * at_u0.col(j) +
                                         fading(1 - s, columns) * at_u1.col(j),
            0;
    });
    return result;
}

MeshPoint BlankChart::place_of(const Eigen::Vector2d& point, double u, double v, bool& outside) const
{
    MeshPoint place;
    if (!search_.overlaps_itself())
        place = search_.unique_place(point);
    else { // on the layer of the nodes around
        const InCell a(u, grid_.planar.columns), b(v, grid_.planar.rows);
        std::vector<MeshPoint> around;
        for (const int j : {0, 1})
            for (const int i : {0, 1})
                around.push_back(grid_.place[size_t(grid_.planar.node(a.cell + i, b.cell + j))]);
        place = search_.place_next_to(point, around);
    }
    outside = place.face < 0;
    return outside ? search_.nearest(point) : place;
}

GridResult BlankChart::refined(const std::vector<double>& u, const std::vector<double>& v,
                               const Progress& progress) const
{
    GridResult result;
    result.filled = grid_.filled;
    result.border = {between_nodes(grid_.border[0], u), between_nodes(grid_.border[1], v),
                     between_nodes(grid_.border[2], mirrored(u)), between_nodes(grid_.border[3], mirrored(v))};
    QuadGrid border;
    border.columns = int(u.size()) - 1;
    border.rows = int(v.size()) - 1;
    border.position = Eigen::Matrix3Xd::Zero(3, border.nodes());
    result.place.resize(size_t(border.nodes()));
    place_border(*grid_.filled, boundary_, result.border, border, result.place);

    result.planar = planar(Between::bicubic, u, v, border, progress.part(0, 0.3));
    progress.checkpoint(0.3, taking_points);
    result.quality = cell_quality(result.planar);
    if (result.quality.folded_cells > 0) {
        QuadGrid straight = planar(Between::bilinear, u, v, border, progress.part(0.3, 0.5));
        const CellQuality quality = cell_quality(straight);
        if (quality.folded_cells < result.quality.folded_cells) {
            result.planar = std::move(straight);
            result.quality = quality;
        }
    }
    const int m = border.columns, n = border.rows;
    std::vector<char> outside(result.place.size(), 0);
    for_each_in_parts(border.nodes(), progress.part(0.5, 1), taking_points, [&](int node) {
        const int i = node % (m + 1), j = node / (m + 1);
        if (i == 0 || j == 0 || i == m || j == n)
            return;
        bool missed = false;
        result.place[size_t(node)] =
            place_of(result.planar.position.col(node).head<2>(), u[size_t(i)], v[size_t(j)], missed);
        outside[size_t(node)] = missed;
    });
    result.nodes_outside = int(std::accumulate(outside.begin(), outside.end(), 0));
    return result;
}

} // namespace spia
