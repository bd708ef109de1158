#include "engine/report/figures/figures.h"

#include <gtest/gtest.h>

#include "engine/coons/cell_quality.h"
#include "tests/unit/report/report_samples.h"

namespace spia {

TEST(Figures, AreTheLeastAndGreatestOfAllVerticesFacesAndCells)
{
    const Session session = session_of(dome, Stage::grid);
    const TriMesh& mesh = session.part->mesh;
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
    for (int v = 0; v < mesh.vertices(); ++v)
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], mesh.position(k, v));
            high[k] = std::max(high[k], mesh.position(k, v));
        }
    const PartFigures part = part_figures(*session.part);
    EXPECT_EQ(part.size, high - low);
    EXPECT_NEAR(part.diagonal, (high - low).norm(), 1e-9);

    const SheetFigures sheet = sheet_figures(*session.blank);
    double least = 1e300, greatest = -1e300, strain = 0, minor = 1e300, major = -1e300;
    for (int f = 0; f < mesh.triangles(); ++f) {
        least = std::min(least, session.blank->face.thinning[f]);
        greatest = std::max(greatest, session.blank->face.thinning[f]);
        strain = std::max(strain, session.blank->face.strain_equivalent[f]);
        minor = std::min(minor, session.blank->face.strain_minor[f]);
        major = std::max(major, session.blank->face.strain_major[f]);
    }
    EXPECT_EQ(sheet.thinning, (std::array{least, greatest}));
    EXPECT_EQ(sheet.strain_equivalent, strain);
    EXPECT_EQ(sheet.strain_minor[0], minor);
    EXPECT_EQ(sheet.strain_major[1], major);

    const GridFigures grid = grid_figures(*session.grid, session.blank->blank);
    const QuadGrid& planar = session.grid->result.planar;
    const Eigen::VectorXd jacobian = scaled_jacobians(planar);
    for (const double value : jacobian)
        EXPECT_GE(value, grid.scaled_jacobian);
    EXPECT_EQ(jacobian[grid.column + grid.row * planar.columns], grid.scaled_jacobian);
    EXPECT_EQ(grid.column + grid.row * planar.columns, grid.worst_cell);
    double border = 0, around = 0; // the outline of the blank, as the loop of its boundary
    for (const double side : grid.side)
        border += side;
    for (const auto& side : session.grid->boundary.side)
        for (size_t k = 0; k + 1 < side.size(); ++k)
            around +=
                std::hypot(session.blank->blank.position(0, side[k]) - session.blank->blank.position(0, side[k + 1]),
                           session.blank->blank.position(1, side[k]) - session.blank->blank.position(1, side[k + 1]));
    EXPECT_NEAR(border, around, 1e-9);
}

} // namespace spia
