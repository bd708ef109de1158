#include "engine/coons/keep_shapes.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <vector>

#include "engine/coons/unfold_elements.h"

namespace spia {

namespace {

constexpr int most_steps = 150;
constexpr double area_weight = 0.3;  // of keeping the areas against keeping the shapes
constexpr double folded_mean = 1e-4; // determinant over squared edges below which the mean is taken of more cells
constexpr double least_slant = 0.05; // of the wanted cells likewise: one that is nearly flat is given some height

/// The edges of a cell along u and along v.
struct CellEdges {
    Eigen::Vector2d u, v;

    double determinant() const { return u.x() * v.y() - u.y() * v.x(); }
    double slant() const { return determinant() / (u.squaredNorm() + v.squaredNorm()); }
};

CellEdges mean_edges(const QuadGrid& grid, int i, int j, int around)
{
    const int left = std::max(0, i - around), right = std::min(grid.columns, i + 1 + around);
    const int low = std::max(0, j - around), high = std::min(grid.rows, j + 1 + around);
    const auto at = [&](int a, int b) -> Eigen::Vector2d { return grid.position.col(grid.node(a, b)).head<2>(); };
    CellEdges mean{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
    for (int b = low; b <= high; ++b)
        mean.u += at(right, b) - at(left, b);
    for (int a = left; a <= right; ++a)
        mean.v += at(a, high) - at(a, low);
    mean.u /= (right - left) * (high - low + 1);
    mean.v /= (high - low) * (right - left + 1);
    return mean;
}

CellEdges wanted_edges(const QuadGrid& grid, int i, int j, int around)
{
    CellEdges edges = mean_edges(grid, i, j, around);
    while (edges.slant() < folded_mean && around < std::max(grid.columns, grid.rows))
        edges = mean_edges(grid, i, j, around = std::max(1, 2 * around));
    if (!(edges.u.squaredNorm() > 0)) // between border nodes in one place
        edges.u << 1, 0;
    if (const double lacks = least_slant - edges.slant(); lacks > 0) {
        const Eigen::Vector2d across(-edges.u.y(), edges.u.x());
        edges.v += across * (lacks * (edges.u.squaredNorm() + edges.v.squaredNorm()) / edges.u.squaredNorm());
    }
    return edges;
}

PlanarElements cell_corners(const QuadGrid& grid, int around)
{
    PlanarElements elements;
    const int cells = grid.columns * grid.rows;
    elements.triangle.resize(3, 4 * cells);
    elements.to_shape.resize(size_t(4 * cells));
    elements.weight = Eigen::VectorXd::Ones(4 * cells);
    elements.fixed = Eigen::Matrix2Xi::Ones(2, grid.nodes());
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            if (i > 0 && j > 0)
                elements.fixed.col(grid.node(i, j)).setZero();
            const std::array<int, 4> node = {grid.node(i, j), grid.node(i + 1, j), grid.node(i + 1, j + 1),
                                             grid.node(i, j + 1)};
            const CellEdges edges = wanted_edges(grid, i, j, around);
            const std::array<Eigen::Vector2d, 4> way = {edges.u, edges.v, -edges.u, -edges.v};
            for (size_t k = 0; k < 4; ++k) {
                const int element = 4 * (i + j * grid.columns) + int(k);
                elements.triangle.col(element) << node[k], node[(k + 1) % 4], node[(k + 3) % 4];
                Eigen::Matrix2d wanted;
                wanted << way[k], way[(k + 1) % 4];
                elements.to_shape[size_t(element)] = wanted.inverse();
            }
        }
    return elements;
}

double mean_area(const PlanarElements& elements)
{
    double sum = 0;
    for (const Eigen::Matrix2d& to_shape : elements.to_shape)
        sum += 1 / to_shape.determinant();
    return sum / double(elements.to_shape.size());
}

} // namespace

void keep_shapes(QuadGrid& planar, int around, const Progress& progress)
{
    if (planar.columns < 2 || planar.rows < 2)
        return; // no inner node
    const PlanarElements elements = cell_corners(planar, around);
    Eigen::Matrix2Xd position = planar.position.topRows(2);
    UnfoldOptions options;
    options.most_steps = most_steps;
    options.area_weight = area_weight;
    options.element_area = mean_area(elements);
    unfold_elements(position, elements, {}, options, progress);
    planar.position.topRows(2) = position;
}

} // namespace spia
