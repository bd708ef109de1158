#include "engine/report/figures/figures.h"

#include <cmath>

#include "engine/coons/cell_quality.h"
#include "engine/mesh/topology.h"
#include "engine/report/figures/face_values.h"

namespace spia {
namespace {

/// As face_values() says them, in shares.
std::array<double, 2> range(const Eigen::VectorXd& value)
{
    const double floor = noise(Field::strain_major, 0);
    const auto said = [&](double v) { return std::abs(v) < floor ? 0 : v; };
    return {said(value.minCoeff()), said(value.maxCoeff())};
}

} // namespace

PartFigures part_figures(const PartFile& part)
{
    const Eigen::Matrix3Xd& position = part.mesh.position;
    if (position.cols() == 0)
        return {};
    return {position.rowwise().maxCoeff() - position.rowwise().minCoeff(), bounding_diagonal(part.mesh)};
}

SheetFigures sheet_figures(const FlattenResult& flat)
{
    const Eigen::Matrix2Xd& plane = flat.blank.position;
    return {plane.rowwise().maxCoeff() - plane.rowwise().minCoeff(), range(flat.face.thinning),
            range(flat.face.strain_major), range(flat.face.strain_minor), range(flat.face.strain_equivalent)[1]};
}

GridFigures grid_figures(const GridStage& grid, const Blank& blank)
{
    GridFigures figures;
    for (size_t k = 0; k < 4; ++k) {
        const std::vector<int>& side = grid.boundary.side[k];
        for (size_t i = 1; i < side.size(); ++i)
            figures.side[k] += (blank.position.col(side[i]) - blank.position.col(side[i - 1])).norm();
    }
    const QuadGrid& planar = grid.result.planar;
    figures.scaled_jacobian = scaled_jacobians(planar).minCoeff(&figures.worst_cell);
    figures.column = figures.worst_cell % planar.columns;
    figures.row = figures.worst_cell / planar.columns;
    return figures;
}

} // namespace spia
