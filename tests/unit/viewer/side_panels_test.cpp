#include "app/viewer/panels/side_panels.h"

#include <gtest/gtest.h>

namespace spia::viewer {
namespace {

constexpr auto steps = SidePanels::steps, inspect = SidePanels::inspect;

} // namespace

TEST(SidePanels, AWideWindowShowsBothAndANarrowOneTheSteps)
{
    const SidePanels panels;
    EXPECT_TRUE(panels.shown(steps, false) && panels.shown(inspect, false));
    EXPECT_TRUE(panels.shown(steps, true) && !panels.shown(inspect, true));
    EXPECT_TRUE(is_narrow(900, 1) && !is_narrow(901, 1));
    EXPECT_TRUE(is_narrow(1800, 2) && !is_narrow(1801, 2));
}

TEST(SidePanels, AKeyAlwaysChangesWhatIsSeenOfItsPanel)
{
    // every order of six keys, in either width
    for (int order = 0; order < 1 << 12; ++order) {
        SidePanels panels;
        for (int k = 0; k < 6; ++k) {
            const auto which = order >> 2 * k & 1 ? inspect : steps;
            const bool narrow = order >> (2 * k + 1) & 1, before = panels.shown(which, narrow);
            panels.toggle(which, narrow);
            ASSERT_NE(panels.shown(which, narrow), before) << order;
            ASSERT_FALSE(panels.shown(steps, true) && panels.shown(inspect, true)) << order;
        }
    }
}

TEST(SidePanels, WhatANarrowWindowHasNoRoomForComesBackInAWideOne)
{
    SidePanels panels;
    panels.toggle(inspect, true);
    EXPECT_TRUE(panels.shown(inspect, true) && !panels.shown(steps, true));
    EXPECT_TRUE(panels.shown(inspect, false) && panels.shown(steps, false));
}

} // namespace spia::viewer
