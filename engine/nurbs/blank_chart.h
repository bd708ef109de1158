#pragma once
#include <vector>

#include "engine/coons/blank_search.h"
#include "engine/coons/grid.h"
#include "engine/core/progress.h"
#include "engine/nurbs/surface.h"

namespace spia {

/// A grid of the blank as a map that is known everywhere: (u, v) -> the plane -> the part. At i /
/// columns, j / rows it gives the grid's nodes; between them the bicubic surface through these,
/// drawn onto the outline within the first row of cells: the lines along the border lie on the
/// outline exactly, however fine they are.
class BlankChart {
public:
    /// @param grid  no folded cell, no node outside; must outlive the chart, as must the boundary
    /// it was made from
    /// @throws InputError  if a cell of the grid folds or a node is outside
    BlankChart(const GridResult& grid, const BlankBoundary& boundary);

    /// The nodes at u x v, with their places on the part (see lift()). If a cell folds, all nodes
    /// are taken from bilinear cells instead of the bicubic surface, where fewer fold then. Nodes
    /// that miss the blank, in a notch of the outline between two nodes of the first grid, are put
    /// on its nearest place; nodes_outside counts them. How the first grid came about (its route,
    /// what was done to it) is not said again.
    /// @param u, v  strictly rising from 0 to 1
    GridResult refined(const std::vector<double>& u, const std::vector<double>& v, const Progress& progress = {}) const;

private:
    enum class Between { bicubic, bilinear };

    Eigen::Vector2d in_plane(Between between, double u, double v) const;
    QuadGrid planar(Between between, const std::vector<double>& u, const std::vector<double>& v, const QuadGrid& border,
                    const Progress& progress) const;
    MeshPoint place_of(const Eigen::Vector2d& point, double u, double v, bool& outside) const;

    const GridResult& grid_;
    const BlankBoundary& boundary_;
    BlankSearch search_;
    NurbsSurface plane_; ///< through the nodes
};

} // namespace spia
