#include "app/viewer/panels/mouse_trail.h"

#include <gtest/gtest.h>

namespace spia::viewer {

TEST(MouseTrail, AFrameThatComesLateSeesThePressWhereItWas)
{
    MouseTrail mouse;
    mouse.moved({10, 20});
    mouse.button(true);
    mouse.moved({300, 200}); // all before the next frame
    EXPECT_EQ(mouse.next(), glm::dvec2(10, 20));
    EXPECT_EQ(mouse.next(), std::nullopt) << "from then on the mouse is where it is";
}

TEST(MouseTrail, AWholeDragBetweenTwoFramesKeepsBothItsEnds)
{
    MouseTrail mouse;
    mouse.moved({10, 20});
    mouse.button(true);
    mouse.moved({300, 200});
    mouse.button(false);
    mouse.moved({5, 5});
    EXPECT_EQ(mouse.next(), glm::dvec2(10, 20));
    EXPECT_EQ(mouse.next(), glm::dvec2(300, 200));
    EXPECT_EQ(mouse.next(), std::nullopt);
}

TEST(MouseTrail, OfTwoClicksInOneFrameTheLastCounts)
{
    MouseTrail mouse;
    for (const double x : {1., 2.}) {
        mouse.moved({x, 0});
        mouse.button(true);
        mouse.button(false);
    }
    EXPECT_EQ(mouse.next(), glm::dvec2(2, 0));
    EXPECT_EQ(mouse.next(), glm::dvec2(2, 0));
    EXPECT_EQ(mouse.next(), std::nullopt);
}

} // namespace spia::viewer
