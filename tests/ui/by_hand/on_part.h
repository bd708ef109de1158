#pragma once
#include <algorithm>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <string>

#include "tests/ui/by_hand/hands.h"
#include "tests/ui/on_screen.h"

namespace spia::viewer {

/// A part that is open in the running program, whose panels and views a test uses by mouse and
/// keyboard.
class OnPart : public testing::Test {
protected:
    static constexpr double left_x = 150, left_y = 400;    ///< over the panel of the steps
    static constexpr double right_x = 1450, right_y = 500; ///< over the panel of the field
    std::filesystem::path folder = scratch_folder(
        std::string("by-hand-") + testing::UnitTest::GetInstance()->current_test_info()->test_suite_name() +
        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::unique_ptr<Hands> hands;

    /// A window of 1600 x 1000 pixels. @param file  of the part; it may be refused
    void start(const std::string& file)
    {
        hands = std::make_unique<Hands>(folder, std::vector<std::string>{file});
        hands->size(1600, 1000);
        hands->see_that("a file that has been read", [](const Json& now) {
            return now["job"]["running"] == false && (now["stages"]["read"] == true || now["doctor"].is_object());
        });
    }
    /// Blank, grid and surface.
    Json unfold()
    {
        hands->keys("F5");
        return hands->see_that("blank, grid and surface", [](const Json& now) {
            return now["job"]["running"] == false && now["stages"]["fit"] == true;
        });
    }
    /// Until something in the report has a value, and no job runs.
    Json value(const char* pointer, const Json& wanted)
    {
        return hands->see_that(std::string(pointer) + " is " + wanted.dump(), [&](const Json& now) {
            const Json::json_pointer at(pointer);
            return now.contains(at) && now.at(at) == wanted && now["job"]["running"] == false;
        });
    }
    /// Until a list in the report has so many entries.
    Json count(const char* pointer, size_t wanted)
    {
        return hands->see_that(std::string(pointer) + " has " + std::to_string(wanted), [&](const Json& now) {
            const Json::json_pointer at(pointer);
            return now.contains(at) && now.at(at).size() == wanted && now["job"]["running"] == false;
        });
    }
    /// Until an action was pushed, whatever it did.
    void pushed(const std::string& action)
    {
        hands->see_that(action, [&](const Json& now) {
            const Json& pushed = now["window"]["pushed"];
            return std::find(pushed.begin(), pushed.end(), action) != pushed.end();
        });
    }
    /// A place of the part, or with z = 0 of the blank, mm; pixels of the window.
    glm::dvec2 on_screen(View view, const Eigen::Vector3d& place)
    {
        return viewer::on_screen(hands->viewer().report(), view, place);
    }
    void click_in(View view, double x, double y)
    {
        const glm::dvec2 at = in_view(hands->viewer().report(), view, x, y);
        hands->click_at(at.x, at.y);
    }
    /// In the panel of the steps: scrolls until the line shows, and clicks it.
    void click_left(const std::string& line)
    {
        hands->scroll_to(line, left_x, left_y);
        hands->click(line);
    }
    void click_right(const std::string& line)
    {
        hands->scroll_to(line, right_x, right_y);
        hands->click(line);
    }
};

} // namespace spia::viewer
