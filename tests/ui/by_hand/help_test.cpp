// The manual inside the program, and what it says of itself.
#include <gtest/gtest.h>
#include <memory>

#include "tests/ui/by_hand/hands.h"

namespace spia::viewer {
namespace {

class HelpByHand : public testing::Test {
protected:
    std::filesystem::path folder =
        scratch_folder(std::string("help-by-hand-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::unique_ptr<Hands> hands;

    void SetUp() override
    {
        hands = std::make_unique<Hands>(folder, std::vector<std::string>{"assets/parts/dome.obj"});
        hands->size(1600, 1000);
        hands->see_that("the part", [](const Json& now) { return now["stages"]["read"] == true; });
    }
};

TEST_F(HelpByHand, TheManualIsReadAndSearched)
{
    hands->menu("Help", "Manual");
    hands->see("Search the manual");
    hands->see("First steps");
    hands->click("What amber lights mean");
    hands->see_part_of_line("amber");
    hands->click("Search the manual");
    hands->type("shoulder");
    hands->see("Process conditions"); // the chapter in which it stands
    hands->see_no("Keys and mouse");
    hands->click("Process conditions");
    hands->see_part_of_line("Shoulder");
    hands->click("shoulder");
    hands->keys("ctrl+a");
    hands->type("zzzz");
    hands->see("Nothing was found.");
    hands->keys("Escape"); // what was typed is taken back
    hands->see_no("Nothing was found.");
    hands->keys("Escape");
    hands->see_no("Process conditions");

    hands->menu("Help", "Manual");
    hands->see("Search the manual"); // what was looked for the last time is gone
    hands->see("What amber lights mean");
    hands->click("Search the manual");
    hands->type("rolling direction");
    hands->see("Process conditions");
    hands->click_beside("Process conditions", 0, 18); // the words below the name are as good
    hands->see_part_of_line("Rolling direction");
    hands->keys("Escape");
}

TEST_F(HelpByHand, VersionsAreListed)
{
    hands->menu("Help", "About...");
    hands->see("OpenCASCADE");
    hands->see_part_of_line("GPL-3.0-or-later");
    hands->click("Copy all");
    hands->click("Close");
    hands->see_no("OpenCASCADE");
}

} // namespace
} // namespace spia::viewer
