#include "app/viewer/model/picking/mouse_style.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "app/viewer/model/actions/names.h"
#include "engine/core/error.h"

namespace spia::viewer {
namespace {

constexpr double slack = 3;
constexpr MouseHeld nothing{};
constexpr MouseHeld left{.left = true}, middle{.middle = true}, right{.right = true};

MouseHeld with(MouseHeld held, bool shift, bool ctrl)
{
    held.shift = shift;
    held.ctrl = ctrl;
    return held;
}

MouseHeld both(const MouseHeld& a, const MouseHeld& b)
{
    return {a.left || b.left, a.middle || b.middle, a.right || b.right, a.shift || b.shift, a.ctrl || b.ctrl};
}

/// A hand that presses and moves; every call is a frame.
struct Hand {
    MouseStyle style;
    bool left_is_free = true;
    Navigator navigator = {};

    Navigator::Step press(const MouseHeld& held) { return frame(held, true, {0, 0}); }
    Navigator::Step move(const MouseHeld& held, glm::dvec2 by = {20, 10}) { return frame(held, false, by); }
    Navigator::Step frame(const MouseHeld& held, bool pressed, glm::dvec2 by)
    {
        return navigator.follow(style, held, pressed, by, true, left_is_free, slack);
    }
    /// What a drag does that begins with these buttons and keys.
    Navigation drag(const MouseHeld& held)
    {
        press(held);
        const Navigation does = move(held).does;
        move(nothing);
        return does;
    }
};

} // namespace

TEST(MouseStyle, EveryStyleTurnsPansAndZoomsAndSaysHow)
{
    std::set<std::string_view> names;
    std::set<std::string> titles;
    for (const MouseStyle style : all_mouse_styles) {
        names.insert(name(style));
        titles.insert(title(style));
        EXPECT_EQ(mouse_style_by_name(name(style)), style);
        const std::vector<MouseHabit> list = habits(style);
        for (const char* does : {"turn", "pan", "zoom"})
            EXPECT_TRUE(std::any_of(list.begin(), list.end(),
                                    [&](const MouseHabit& each) { return each.does.rfind(does, 0) == 0; }))
                << name(style) << ": " << does;
        std::set<std::string> ways;
        for (const MouseHabit& each : list) {
            EXPECT_FALSE(each.how.empty() || each.does.empty());
            EXPECT_TRUE(ways.insert(each.how).second) << name(style) << " has " << each.how << " twice";
        }
    }
    EXPECT_EQ(names.size(), std::size(all_mouse_styles));
    EXPECT_EQ(titles.size(), std::size(all_mouse_styles));
    EXPECT_EQ(names_of<MouseStyle>.size(), std::size(all_mouse_styles));
    EXPECT_THROW(mouse_style_by_name("maya"), InputError);
}

TEST(MouseStyle, ButtonsAndKeysMeanWhatTheyMeanInThosePrograms)
{
    using N = Navigation;
    struct Row {
        MouseHeld held;
        std::map<MouseStyle, N> does; ///< in the others: nothing
    };
    const auto shift = [](const MouseHeld& held) { return with(held, true, false); };
    const auto ctrl = [](const MouseHeld& held) { return with(held, false, true); };
    const std::vector<Row> rows = {
        {left, {{MouseStyle::spia, N::turn}}},
        {right, {{MouseStyle::spia, N::turn}, {MouseStyle::inspire, N::pan}}},
        {shift(right), {{MouseStyle::spia, N::pan}, {MouseStyle::inspire, N::pan}}},
        {middle,
         {{MouseStyle::spia, N::pan},
          {MouseStyle::nx, N::turn},
          {MouseStyle::catia, N::pan},
          {MouseStyle::solidworks, N::turn},
          {MouseStyle::inspire, N::turn},
          {MouseStyle::blender, N::turn}}},
        {shift(middle),
         {{MouseStyle::spia, N::pan},
          {MouseStyle::nx, N::pan},
          {MouseStyle::catia, N::pan},
          {MouseStyle::solidworks, N::zoom},
          {MouseStyle::inspire, N::turn},
          {MouseStyle::blender, N::pan}}},
        {ctrl(middle),
         {{MouseStyle::spia, N::pan},
          {MouseStyle::nx, N::zoom},
          {MouseStyle::catia, N::zoom},
          {MouseStyle::solidworks, N::pan},
          {MouseStyle::inspire, N::turn},
          {MouseStyle::blender, N::zoom}}},
        {both(middle, right), {{MouseStyle::nx, N::pan}, {MouseStyle::catia, N::turn}}},
        {both(middle, left), {{MouseStyle::nx, N::zoom}, {MouseStyle::catia, N::turn}}},
    };
    for (const MouseStyle style : all_mouse_styles)
        for (size_t k = 0; k < rows.size(); ++k) {
            const auto wanted = rows[k].does.find(style);
            Hand hand{style};
            EXPECT_EQ(hand.drag(rows[k].held), wanted == rows[k].does.end() ? N::none : wanted->second)
                << name(style) << ", row " << k;
            EXPECT_FALSE(hand.navigator.busy());
        }
    for (const MouseStyle style : all_mouse_styles)
        EXPECT_EQ(forward_enlarges(style), style != MouseStyle::solidworks);
}

TEST(MouseStyle, TheLeftButtonIsTheToolsUnlessItHasNoUseForIt)
{
    for (const MouseStyle style : all_mouse_styles) {
        Hand hand{style, false};
        EXPECT_EQ(hand.drag(left), Navigation::none) << name(style);
        EXPECT_FALSE(hand.navigator.busy());
    }
}

TEST(MouseStyle, InCatiaTheSecondButtonTurnsWhileHeldAndZoomsOnceClicked)
{
    for (const MouseHeld& side : {left, right}) {
        Hand hand{MouseStyle::catia};
        hand.press(middle);
        EXPECT_EQ(hand.move(middle).does, Navigation::pan);
        hand.press(both(middle, side));
        EXPECT_EQ(hand.move(both(middle, side)).does, Navigation::turn);
        EXPECT_EQ(hand.move(middle).does, Navigation::zoom); // let go: a click, or the end of a
                                                             // turn
        EXPECT_EQ(hand.move(middle).does, Navigation::zoom);
        hand.press(both(middle, side));
        EXPECT_EQ(hand.move(both(middle, side)).does, Navigation::turn);
        EXPECT_EQ(hand.move(nothing).does, Navigation::none);
        EXPECT_FALSE(hand.navigator.busy());
    }
    Hand keys{MouseStyle::catia};
    keys.press(middle);
    EXPECT_EQ(keys.move(with(middle, false, true)).does, Navigation::turn); // Ctrl after the button
    EXPECT_EQ(keys.move(middle).does, Navigation::pan);
    keys.move(nothing);
    EXPECT_EQ(keys.drag(with(middle, false, true)), Navigation::zoom); // Ctrl before it
}

TEST(MouseStyle, InCatiaAClickOfTheMiddleButtonCentresAndADragDoesNot)
{
    for (const MouseStyle style : all_mouse_styles) {
        Hand hand{style};
        hand.press(middle);
        hand.move(middle, {1, 1}); // a hand shakes
        EXPECT_EQ(hand.move(nothing, {0, 0}).centre, style == MouseStyle::catia) << name(style);
        hand.press(middle);
        hand.move(middle, {30, 0});
        EXPECT_FALSE(hand.move(nothing).centre);
        hand.press(middle);
        hand.press(both(middle, right));
        hand.move(middle, {0, 0});
        EXPECT_FALSE(hand.move(nothing).centre) << "a click beside it means zoom";
    }
}

TEST(MouseStyle, AClickOfAnyButtonMovesNothingAndADragLosesNothing)
{
    for (const MouseHeld& button : {left, middle, right}) {
        Hand hand{MouseStyle::spia};
        glm::dvec2 sum(0);
        hand.press(button);
        for (const glm::dvec2 by : {glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(-1, 0)})
            sum += hand.move(button, by).drag;
        EXPECT_EQ(sum, glm::dvec2(0));
        EXPECT_FALSE(hand.navigator.dragged());
        for (const glm::dvec2 by : {glm::dvec2(5, 0), glm::dvec2(7, -2)})
            sum += hand.move(button, by).drag;
        EXPECT_EQ(sum, glm::dvec2(13, -1)) << "what was held back is made up for";
        EXPECT_TRUE(hand.navigator.dragged());
    }
}

TEST(MouseStyle, KeysCountAsTheyWereWhenAButtonWentDown)
{
    Hand hand{MouseStyle::solidworks};
    hand.press(with(middle, false, true));
    EXPECT_EQ(hand.move(with(middle, false, true)).does, Navigation::pan);
    EXPECT_EQ(hand.move(middle).does, Navigation::pan) << "Ctrl was let go first";
    hand.move(nothing);
    EXPECT_EQ(hand.drag(middle), Navigation::turn);
}

TEST(MouseStyle, APressOutsideOfAViewDoesNotBegin)
{
    Navigator navigator;
    navigator.follow(MouseStyle::nx, middle, true, {0, 0}, false, true, slack);
    EXPECT_FALSE(navigator.busy());
    EXPECT_EQ(navigator.follow(MouseStyle::nx, middle, false, {9, 9}, true, true, slack).does, Navigation::none)
        << "the mouse came in with the button down";
}

TEST(MouseStyle, ADragUpEnlargesAboutTheMiddle)
{
    Camera camera;
    camera.height = 80;
    camera.target = {1, 2, 3};
    const glm::dvec2 size(400, 200);
    const Camera larger = moved(camera, {Navigation::zoom, {7, -200}, false}, size);
    EXPECT_NEAR(larger.height, 10, 1e-12); // eightfold by the whole view
    EXPECT_EQ(larger.target, camera.target);
    const Camera back = moved(larger, {Navigation::zoom, {0, 200}, false}, size);
    EXPECT_NEAR(back.height, camera.height, 1e-12);
    EXPECT_EQ(moved(camera, {}, size), camera);
}

} // namespace spia::viewer
