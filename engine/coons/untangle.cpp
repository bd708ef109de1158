#include "engine/coons/untangle.h"

#include <array>
#include <cmath>

namespace spia {

namespace {

double cell_width(const QuadGrid& grid, int i, int j)
{
    return (grid.position.col(grid.node(i + 1, j)) - grid.position.col(grid.node(i, j))).norm();
}

double cell_height(const QuadGrid& grid, int i, int j)
{
    return (grid.position.col(grid.node(i, j + 1)) - grid.position.col(grid.node(i, j))).norm();
}

double row_length(const QuadGrid& grid, int j)
{
    double sum = 0;
    for (int i = 0; i < grid.columns; ++i)
        sum += cell_width(grid, i, j);
    return sum;
}

double column_length(const QuadGrid& grid, int i)
{
    double sum = 0;
    for (int j = 0; j < grid.rows; ++j)
        sum += cell_height(grid, i, j);
    return sum;
}

/// All cells together, whatever the inner nodes.
double doubled_area(const QuadGrid& grid)
{
    double sum = 0;
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            const Eigen::Vector3d p = grid.position.col(grid.node(i + 1, j + 1)) - grid.position.col(grid.node(i, j));
            const Eigen::Vector3d q = grid.position.col(grid.node(i, j + 1)) - grid.position.col(grid.node(i + 1, j));
            sum += p.x() * q.y() - p.y() * q.x();
        }
    return sum;
}

/// Width and height of the cells that are wanted, the mean of all.
Eigen::Vector2d wanted_cell(const QuadGrid& grid)
{
    Eigen::Vector2d size((row_length(grid, 0) + row_length(grid, grid.rows)) / (2 * grid.columns),
                         (column_length(grid, 0) + column_length(grid, grid.columns)) / (2 * grid.rows));
    if (const double doubled = doubled_area(grid); doubled > 0)
        size *= std::sqrt(doubled / 2 / (grid.columns * grid.rows * size.prod()));
    return size;
}

/// Per column the width and per row the height of the cells that are wanted.
struct WantedCells {
    Eigen::VectorXd width, height;
};

WantedCells wanted_cells(const QuadGrid& grid, const Eigen::Vector2d& mean, bool keep_spacing)
{
    WantedCells cells{Eigen::VectorXd::Constant(grid.columns, mean.x()),
                      Eigen::VectorXd::Constant(grid.rows, mean.y())};
    if (!keep_spacing)
        return cells;
    for (int i = 0; i < grid.columns; ++i)
        cells.width[i] = cell_width(grid, i, 0) + cell_width(grid, i, grid.rows);
    for (int j = 0; j < grid.rows; ++j)
        cells.height[j] = cell_height(grid, 0, j) + cell_height(grid, grid.columns, j);
    cells.width *= mean.x() / cells.width.mean();
    cells.height *= mean.y() / cells.height.mean();
    return cells;
}

PlanarElements cell_corners(const QuadGrid& grid, const WantedCells& wanted)
{
    const int cells = grid.columns * grid.rows;
    PlanarElements elements;
    elements.triangle.resize(3, 4 * cells);
    elements.weight = Eigen::VectorXd::Ones(4 * cells);
    elements.fixed = Eigen::Matrix2Xi::Ones(2, grid.nodes());
    for (int j = 1; j < grid.rows; ++j)
        for (int i = 1; i < grid.columns; ++i)
            elements.fixed.col(grid.node(i, j)).setZero();
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            const Eigen::Vector2d size(wanted.width[i], wanted.height[j]);
            const Eigen::Matrix2d even = size.cwiseInverse().asDiagonal(),
                                  odd = size.reverse().cwiseInverse().asDiagonal();
            const std::array<int, 4> node = {grid.node(i, j), grid.node(i + 1, j), grid.node(i + 1, j + 1),
                                             grid.node(i, j + 1)};
            for (size_t k = 0; k < 4; ++k) {
                elements.triangle.col(Eigen::Index(elements.to_shape.size())) << node[k], node[(k + 1) % 4],
                    node[(k + 3) % 4];
                elements.to_shape.push_back(k % 2 == 0 ? even : odd);
            }
        }
    return elements;
}

} // namespace

void untangle(QuadGrid& planar, const std::vector<Pull>& pulls, const UntangleOptions& options,
              const Progress& progress)
{
    if (planar.columns < 2 || planar.rows < 2)
        return; // no inner node
    const Eigen::Vector2d size = wanted_cell(planar);
    Eigen::Matrix2Xd position = planar.position.topRows(2);
    UntangleElementsOptions element_options;
    element_options.most_steps = options.most_steps;
    element_options.area_weight = options.area_weight;
    element_options.element_area = size.prod();
    untangle_elements(position, cell_corners(planar, wanted_cells(planar, size, options.keep_spacing)), pulls,
                      element_options, progress);
    planar.position.topRows(2) = position;
}

} // namespace spia
