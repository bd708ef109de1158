#include "engine/coons/cell_quality.h"

#include <algorithm>
#include <array>

#include "engine/mesh/orient2d.h"

namespace spia {

namespace {

constexpr double least_sine = 1e-9; // below it a corner is right but of no use: any rounding turns
                                    // it

double sine(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
    const double lengths = a.norm() * b.norm();
    return lengths > 0 ? (a.x() * b.y() - a.y() * b.x()) / lengths : 0;
}

std::array<Eigen::Vector2d, 4> corners_of(const QuadGrid& planar, int i, int j)
{
    const auto at = [&](int a, int b) -> Eigen::Vector2d { return planar.position.col(planar.node(a, b)).head<2>(); };
    return {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
}

double least_sine_of(const std::array<Eigen::Vector2d, 4>& corner)
{
    double smallest = 1;
    for (size_t k = 0; k < 4; ++k)
        smallest = std::min(smallest, sine(corner[(k + 1) % 4] - corner[k], corner[(k + 3) % 4] - corner[k]));
    return smallest;
}

} // namespace

bool turns_left_everywhere(const std::array<Eigen::Vector2d, 4>& corner)
{
    for (size_t k = 0; k < 4; ++k)
        if (orient2d(corner[k], corner[(k + 1) % 4], corner[(k + 3) % 4]) <= 0)
            return false;
    return true;
}

Eigen::VectorXd scaled_jacobians(const QuadGrid& planar)
{
    Eigen::VectorXd result(Eigen::Index(planar.columns) * planar.rows);
    for (int j = 0; j < planar.rows; ++j)
        for (int i = 0; i < planar.columns; ++i)
            result[i + Eigen::Index(j) * planar.columns] = least_sine_of(corners_of(planar, i, j));
    return result;
}

namespace {

bool folds(const QuadGrid& planar, const Eigen::VectorXd& jacobian, int cell)
{
    return !(jacobian[cell] > least_sine &&
             turns_left_everywhere(corners_of(planar, cell % planar.columns, cell / planar.columns)));
}

} // namespace

std::vector<int> folded_cells(const QuadGrid& planar)
{
    const Eigen::VectorXd jacobian = scaled_jacobians(planar);
    std::vector<int> folded;
    for (int cell = 0; cell < jacobian.size(); ++cell)
        if (folds(planar, jacobian, cell))
            folded.push_back(cell);
    return folded;
}

CellQuality cell_quality(const QuadGrid& planar)
{
    const Eigen::VectorXd jacobian = scaled_jacobians(planar);
    CellQuality quality;
    quality.min_scaled_jacobian = jacobian.size() > 0 ? jacobian.minCoeff(&quality.worst_cell) : 1;
    for (int cell = 0; cell < jacobian.size(); ++cell)
        if (folds(planar, jacobian, cell) && quality.folded_cells++ == 0)
            quality.first_folded = cell;
    return quality;
}

} // namespace spia
