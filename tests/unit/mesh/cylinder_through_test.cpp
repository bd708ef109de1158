#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

#include "engine/mesh/solid/bends/unrolled_skin.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/seeded_random.h"

namespace spia {

TEST(CylinderThrough, PlacesOfAnArcIsTheirsWhereverThePartLies)
{
    shapes::SeededRandom random(6);
    for (int trial = 0; trial < 50; ++trial) {
        const double radius = random.between(0.3, 20), length = random.between(0.5, 100), turn = random.between(0.5, 6);
        const Eigen::Matrix3d pose = shapes::random_rotation(std::uint64_t(trial));
        const Eigen::Vector3d far(random.between(-3000, 3000), random.between(-3000, 3000),
                                  random.between(-3000, 3000));
        const int places = random.whole(4, 40);
        Eigen::Matrix3Xd place(3, 2 * places), normal(3, 2 * places);
        for (int i = 0; i < 2 * places; ++i) {
            const double angle = turn * (i / 2) / (places - 1);
            normal.col(i) = pose * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
            place.col(i) = far + radius * normal.col(i) + (i % 2) * length * pose.col(2);
        }
        const auto cylinder = cylinder_through(place, normal, 1e-6);
        ASSERT_TRUE(cylinder) << radius << " from " << far.transpose();
        EXPECT_NEAR(cylinder->radius, radius, 1e-8);
        EXPECT_NEAR(std::abs(cylinder->direction.dot(pose.col(2))), 1, 1e-9);
    }
}

} // namespace spia
