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

TEST(MouseTrail, TheWayOfAFastStrokeBeginsAfterItsPress)
{
    MouseTrail mouse;
    mouse.moved({3, 3});
    mouse.button(true);
    mouse.moved({4, 4}); // of a stroke that is over before a frame has seen it
    mouse.button(false);
    mouse.moved({1, 1});
    mouse.button(true);
    mouse.moved({5, 1});
    mouse.moved({9, 9});
    mouse.button(false);
    EXPECT_EQ(mouse.next(), glm::dvec2(1, 1)); // the frame of the press: the mouse is there
    EXPECT_TRUE(mouse.take_path().empty());
    EXPECT_EQ(mouse.next(), glm::dvec2(9, 9));
    EXPECT_EQ(mouse.take_path(), (std::vector<glm::dvec2>{{5, 1}, {9, 9}}));
}

TEST(MouseTrail, TheWayIsWhatLiesBetweenPressAndRelease)
{
    MouseTrail mouse;
    mouse.moved({1, 1});
    mouse.button(true);
    mouse.moved({5, 1});
    mouse.moved({5, 9});
    EXPECT_EQ(mouse.take_path(), (std::vector<glm::dvec2>{{5, 1}, {5, 9}}));
    EXPECT_TRUE(mouse.take_path().empty());
    mouse.moved({0, 9});
    mouse.button(false);
    mouse.moved({70, 70});
    EXPECT_EQ(mouse.take_path(), (std::vector<glm::dvec2>{{0, 9}}));
    mouse.moved({80, 70});
    mouse.button(true); // another drag
    EXPECT_TRUE(mouse.take_path().empty());
}

} // namespace spia::viewer
