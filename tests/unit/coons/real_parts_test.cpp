#include "tests/unit/coons/real_parts.h"

#include <complex>
#include <gtest/gtest.h>

#include "engine/coons/boundary.h"
#include "engine/coons/grid.h"
#include "engine/coons/lift.h"

namespace spia {

class RealPart : public testing::TestWithParam<const char*> {};

TEST_P(RealPart, HasNoFoldedCellOnADiskNorOnABlankThatOverlapsItself)
{
    if (!std::filesystem::exists(real_parts::folder() / GetParam()))
        GTEST_SKIP() << "no " << real_parts::folder() / GetParam();
    const TriMesh part = real_parts::read(GetParam());
    const Blank disk{real_parts::onto_a_disk(part, 1)};
    Blank winding = disk; // an ellipse, wound around the origin by 8 radians
    for (int v = 0; v < part.vertices(); ++v) {
        const auto w = std::exp(std::complex<double>(0.4 * disk.position(0, v), 4 * disk.position(1, v)));
        winding.position.col(v) << w.real(), w.imag();
    }
    for (const Blank& blank : {disk, winding})
        for (const GridMethod method : {GridMethod::automatic, GridMethod::harmonic}) {
            const BlankBoundary boundary = split_boundary(blank, part, propose_corners(blank, part));
            const GridResult grid = coons_grid(part, blank, boundary, {.method = method});
            EXPECT_EQ(grid.quality.folded_cells, 0);
            EXPECT_EQ(grid.nodes_outside, 0);
            const LiftResult lifted = lift(grid);
            EXPECT_TRUE(lifted.lifted.position.allFinite());
            for (size_t k = 0; k < 4; ++k) // the corners of the grid are the corner vertices of the
                                           // part
                EXPECT_EQ(lifted.lifted.position.col(k == 0   ? lifted.lifted.node(0, 0)
                                                     : k == 1 ? lifted.lifted.node(grid.planar.columns, 0)
                                                     : k == 2
                                                         ? lifted.lifted.node(grid.planar.columns, grid.planar.rows)
                                                         : lifted.lifted.node(0, grid.planar.rows)),
                          part.position.col(boundary.corner[k]));
        }
}

INSTANTIATE_TEST_SUITE_P(Scans, RealPart,
                         testing::Values("nefertiti.off", "three_peaks.off", "lilium.obj", "halftunnel.off",
                                         "camel_b.obj", "camelhead.off", "beetle.off"),
                         [](const auto& param) {
                             const std::string name = param.param;
                             return name.substr(0, name.find('.'));
                         });

} // namespace spia
