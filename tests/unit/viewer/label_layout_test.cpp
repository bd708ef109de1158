#include "app/viewer/views/label_layout.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <utility>

namespace spia::viewer {
namespace {

const glm::dvec2 room(800, 600);

std::vector<LabelWish> crowd(int count)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> x(200, 500), y(200, 400), width(8, 90);
    std::vector<LabelWish> wishes;
    for (int i = 0; i < count; ++i)
        wishes.push_back({{x(random), y(random)}, {width(random), 16}, LabelKind(i % 3)});
    return wishes;
}

TEST(LabelLayout, NoLabelCoversAnotherOrADotOrTheLegendOrLeavesTheView)
{
    const PixelBox legend{{150, 250}, {300, 500}};
    const auto wishes = crowd(40);
    const auto placed = place_labels(wishes, room, {legend});
    EXPECT_GT(placed.size(), 30u);
    for (size_t i = 0; i < placed.size(); ++i) {
        EXPECT_TRUE(inside(placed[i].box, room));
        EXPECT_FALSE(meet(placed[i].box, legend));
        EXPECT_LT(glm::length(placed[i].box.greatest - placed[i].box.least - wishes[placed[i].wish].size), 1e-9);
        for (size_t j = 0; j < i; ++j)
            EXPECT_FALSE(meet(placed[i].box, placed[j].box)) << i << " and " << j;
        for (const LabelWish& wish : wishes) {
            const bool dot = wish.kind != LabelKind::region;
            EXPECT_FALSE(dot && meet(placed[i].box, around(wish.place, {8, 8})));
        }
    }
}

TEST(LabelLayout, TheSameWishesGetTheSamePlaces)
{
    const auto once = place_labels(crowd(40), room, {}), again = place_labels(crowd(40), room, {});
    ASSERT_EQ(once.size(), again.size());
    for (size_t i = 0; i < once.size(); ++i) {
        EXPECT_EQ(once[i].wish, again[i].wish);
        EXPECT_EQ(once[i].box.least, again[i].box.least);
    }
}

TEST(LabelLayout, AWatchedPlaceChoosesBeforeACornerAndACornerBeforeARegion)
{
    const glm::dvec2 size(60, 16);
    const LabelWish region{{445, 292}, size, LabelKind::region}, corner{{400, 288}, size, LabelKind::corner},
        watched{{400, 300}, size, LabelKind::watched}; // any two want the same place
    for (const auto& [later, first] : {std::pair(region, corner), {region, watched}, {corner, watched}}) {
        const PixelBox wanted = place_labels({first}, room, {}).at(0).box;
        EXPECT_TRUE(meet(wanted, place_labels({later}, room, {}).at(0).box));
        const auto placed = place_labels({later, first}, room, {});
        ASSERT_EQ(placed.size(), 2u);
        EXPECT_EQ(placed[1].wish, 1u);
        EXPECT_EQ(placed[1].box.least, wanted.least);
    }
}

TEST(LabelLayout, OnlyALabelThatHadToGoFarIsPushed)
{
    const std::vector<LabelWish> wish{{{400, 300}, {60, 16}, LabelKind::watched}};
    EXPECT_FALSE(place_labels(wish, room, {}).at(0).pushed);
    const PixelBox wall{{320, 270}, {480, 330}};
    const auto pushed = place_labels(wish, room, {wall});
    ASSERT_EQ(pushed.size(), 1u);
    EXPECT_TRUE(pushed[0].pushed);
    const glm::dvec2 near = glm::clamp(wish[0].place, pushed[0].box.least, pushed[0].box.greatest);
    EXPECT_LT(glm::length(near - wish[0].place), 120);
}

TEST(LabelLayout, WhatIsOutsideOfTheViewHasNoLabel)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<LabelWish> wishes;
    for (const glm::dvec2 place : {glm::dvec2(-1, 300), {801, 300}, {400, -1}, {400, 601}, {nan, nan}})
        wishes.push_back({place, {40, 16}, LabelKind::watched});
    EXPECT_TRUE(place_labels(wishes, room, {}).empty());
    wishes.push_back({{799, 1}, {40, 16}, LabelKind::watched}); // in the corner, but it fits in
    const auto placed = place_labels(wishes, room, {});
    ASSERT_EQ(placed.size(), 1u);
    EXPECT_EQ(placed[0].wish, 5u);
    EXPECT_TRUE(inside(placed[0].box, room));
}

} // namespace
} // namespace spia::viewer
