// The way from one state to the next.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "app/viewer/model/document/step_motion.h"

namespace spia::viewer {
namespace {

using std::numbers::pi;

} // namespace

TEST(StepMotion, AFlangeTurnsAboutItsHingeOnAnArc)
{
    // A strip of two cells; the second one turns about the edge x = 1, which stays.
    const Eigen::Matrix3Xi triangle = (Eigen::Matrix3Xi(3, 4) << 0, 0, 2, 2, 2, 3, 4, 5, 3, 1, 5, 3).finished();
    Eigen::Matrix3Xd flat(3, 6);
    flat << 0, 0, 1, 1, 3, 3, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0;
    for (const double angle : {0.4, pi / 2, 2.5, pi}) {
        const auto turned = [&](double by) {
            Eigen::Matrix3Xd place = flat;
            for (const int v : {4, 5}) {
                place(0, v) = 1 + 2 * std::cos(by);
                place(2, v) = 2 * std::sin(by);
            }
            return place;
        };
        for (const double share : {0., 0.25, 0.5, 0.8, 1.}) {
            const Eigen::Matrix3Xd way = on_the_way(triangle, turned(angle), turned(0), share);
            for (const int v : {4, 5}) {
                const Eigen::Vector2d arm(way(0, v) - 1, way(2, v));
                EXPECT_NEAR(arm.norm(), 2, 1e-9) << angle << " " << share;
                EXPECT_NEAR(std::atan2(arm.y(), arm.x()), (1 - share) * angle, 1e-9) << angle << " " << share;
            }
            EXPECT_EQ(way.leftCols(4), flat.leftCols(4));
        }
    }
}

} // namespace spia::viewer
