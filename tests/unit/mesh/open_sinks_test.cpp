// Walls that lean at a border, and those of countersinks that it opens.
#include <cmath>
#include <gtest/gtest.h>

#include "engine/mesh/solid/holes/open_sinks.h"
#include "tests/support/shapes.h"
#include "tests/support/sheet_solid.h"

namespace spia::open_sinks_test {
namespace {

/// A plate of 60 x 40 x 2 mm; its border at y = 0 goes that far into it in the middle, and leans by
/// the same angle everywhere.
TriMesh plate(double sag)
{
    TriMesh outer = shapes::rectangle(60, 40, 30, 8);
    Eigen::Matrix3Xd inwards(3, outer.vertices());
    outer.position.colwise() -= outer.position.col(0).eval();
    for (int v = 0; v < outer.vertices(); ++v) {
        auto p = outer.position.col(v);
        const double slope = -2 * sag * (p.x() / 30 - 1) / 30;
        inwards.col(v) << (p.y() == 0 ? Eigen::Vector2d(slope, -1).normalized() : Eigen::Vector2d::Zero()), -2;
        p.y() += sag * (1 - std::pow(p.x() / 30 - 1, 2)) * (1 - p.y() / 40);
    }
    return shapes::thickened(outer, inwards);
}

size_t sinks_of(const TriMesh& solid) { return open_sinks(solid, thin_solid(solid), {}).size(); }

} // namespace

TEST(OpenSinks, AreHollowAndTurnByMoreThanABorderDoes)
{
    EXPECT_EQ(sinks_of(plate(10)), 1u);
    EXPECT_EQ(sinks_of(plate(2)), 0u) << "gently hollow";
    EXPECT_EQ(sinks_of(plate(0)), 0u);
    EXPECT_EQ(sinks_of(plate(-10)), 0u) << "bulges";
}

} // namespace spia::open_sinks_test
