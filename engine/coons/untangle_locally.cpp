#include "engine/coons/untangle_locally.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <vector>

#include "engine/coons/cell_quality.h"
#include "engine/coons/untangle_elements.h"

namespace spia {

namespace {

constexpr int most_local_steps = 150;
constexpr double area_weight = 0.3;             // of keeping the areas against keeping the shapes
constexpr double folded_mean = 1e-4;            // determinant over squared edges below which the
                                                // mean is taken of more cells
constexpr int least_reach = 4, most_reach = 64; // cells around folded ones that move along
constexpr int most_passes = 14;
constexpr double good_pass = 0.6;    // of the cells still fold: another one with the same reach,
                                     // else with twice that
constexpr double least_slant = 0.05; // of the wanted cells likewise: one that is nearly flat is
                                     // given some height

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

/// Per node 1 where it may move: inside of the grid, and at a cell not more than `reach` cells from
/// one that folds.
std::vector<char> movable(const QuadGrid& grid, const std::vector<int>& folded, int reach)
{
    std::vector<char> result(size_t(grid.nodes()), 0);
    for (const int cell : folded) {
        const int i = cell % grid.columns, j = cell / grid.columns;
        for (int b = std::max(1, j - reach); b <= std::min(grid.rows - 1, j + 1 + reach); ++b)
            for (int a = std::max(1, i - reach); a <= std::min(grid.columns - 1, i + 1 + reach); ++a)
                result[size_t(grid.node(a, b))] = 1;
    }
    return result;
}

/// The triangles at the corners of all cells with a node that moves.
struct Corners {
    PlanarElements elements;
    std::vector<int> node; ///< of the grid, per vertex
};

Corners cell_corners(const QuadGrid& grid, const std::vector<CellEdges>& wanted, const std::vector<char>& moves)
{
    Corners corners;
    PlanarElements& elements = corners.elements;
    std::vector<int> vertex(size_t(grid.nodes()), -1);
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            const std::array<int, 4> node = {grid.node(i, j), grid.node(i + 1, j), grid.node(i + 1, j + 1),
                                             grid.node(i, j + 1)};
            if (std::none_of(node.begin(), node.end(), [&](int n) { return moves[size_t(n)]; }))
                continue;
            for (const int n : node)
                if (vertex[size_t(n)] < 0) {
                    vertex[size_t(n)] = int(corners.node.size());
                    corners.node.push_back(n);
                }
            const CellEdges& edges = wanted[size_t(i + j * grid.columns)];
            const std::array<Eigen::Vector2d, 4> way = {edges.u, edges.v, -edges.u, -edges.v};
            for (size_t k = 0; k < 4; ++k) {
                triangles.emplace_back(vertex[size_t(node[k])], vertex[size_t(node[(k + 1) % 4])],
                                       vertex[size_t(node[(k + 3) % 4])]);
                Eigen::Matrix2d shape;
                shape << way[k], way[(k + 1) % 4];
                elements.to_shape.push_back(shape.inverse());
            }
        }
    elements.triangle.resize(3, Eigen::Index(triangles.size()));
    for (size_t t = 0; t < triangles.size(); ++t)
        elements.triangle.col(Eigen::Index(t)) = triangles[t];
    elements.weight = Eigen::VectorXd::Ones(Eigen::Index(triangles.size()));
    elements.fixed = Eigen::Matrix2Xi::Ones(2, Eigen::Index(corners.node.size()));
    for (size_t v = 0; v < corners.node.size(); ++v)
        if (moves[size_t(corners.node[v])])
            elements.fixed.col(Eigen::Index(v)).setZero();
    return corners;
}

double mean_area(const PlanarElements& elements)
{
    double sum = 0;
    for (const Eigen::Matrix2d& to_shape : elements.to_shape)
        sum += 1 / to_shape.determinant();
    return sum / double(elements.to_shape.size());
}

} // namespace

void untangle_locally(QuadGrid& planar, int around, const Progress& progress)
{
    if (planar.columns < 2 || planar.rows < 2)
        return; // no inner node
    std::vector<CellEdges> wanted;
    for (int j = 0; j < planar.rows; ++j)
        for (int i = 0; i < planar.columns; ++i)
            wanted.push_back(wanted_edges(planar, i, j, around));
    std::vector<int> folded = folded_cells(planar);
    int reach = least_reach;
    for (int pass = 0; pass < most_passes && !folded.empty() && reach <= most_reach; ++pass) {
        const Corners corners = cell_corners(planar, wanted, movable(planar, folded, reach));
        const Eigen::Matrix2Xd before = planar.position(Eigen::seq(0, 1), corners.node);
        Eigen::Matrix2Xd position = before;
        UntangleElementsOptions options;
        options.most_steps = most_local_steps;
        options.area_weight = area_weight;
        options.element_area = mean_area(corners.elements);
        untangle_elements(position, corners.elements, {}, options,
                          progress.part(double(pass) / most_passes, double(pass + 1) / most_passes));
        planar.position(Eigen::seq(0, 1), corners.node) = position;
        std::vector<int> now = folded_cells(planar);
        if (now.size() > folded.size()) { // others fold that did not
            planar.position(Eigen::seq(0, 1), corners.node) = before;
            now = folded;
        }
        if (double(now.size()) > good_pass * double(folded.size()))
            reach *= 2;
        folded = std::move(now);
    }
}

} // namespace spia
