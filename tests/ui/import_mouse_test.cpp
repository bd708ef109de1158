// The dialog that looks into a file, by mouse.
#include <fstream>
#include <gtest/gtest.h>
#include <memory>

#include "tests/ui/viewer_process.h"
#include "tests/unit/exchange/sample_decks.h"

namespace spia::viewer {
namespace {

/// A window of 1366 by 768 pixels with a deck of two parts, 7 "Hood" of eight triangles and 9
/// "Rail" of four.
struct MouseOnImport : testing::Test {
    std::unique_ptr<OpenViewer> viewer;

    void SetUp() override
    {
        const std::filesystem::path folder = scratch_folder("mouse-on-import");
        std::ofstream(folder / "strip.k") << sample::dyna();
        viewer = std::make_unique<OpenViewer>(
            folder, std::vector<std::string>{"strip.k", "--width", "1366", "--height", "768"});
    }
    /// Where an item lies, by shares of its width and height.
    std::pair<double, double> place_of(const std::string& item, double x = 0.5, double y = 0.5)
    {
        const Json now = viewer->wait(item, [&](const Json& r) { return r["window"]["items"].contains(item); });
        const Json& place = now["window"]["items"][item];
        return {place["at"][0].get<double>() + x * place["size"][0].get<double>(),
                place["at"][1].get<double>() + y * place["size"][1].get<double>()};
    }
    /// As soon as it stands still under the mouse.
    void click(const std::string& item, double x = 0.5, double y = 0.5)
    {
        for (int tries = 0; tries < 20; ++tries) {
            const auto at = place_of(item, x, y);
            viewer->move(at.first, at.second);
            if (place_of(item, x, y) == at) {
                viewer->press(1);
                viewer->release(1);
                return;
            }
        }
        ADD_FAILURE() << item << " does not stand still";
    }
    void expect_triangles(int count)
    {
        const Json now = viewer->wait(std::to_string(count) + " triangles", [&](const Json& r) {
            return r["part"].is_object() && r["part"]["triangles"] == count && r["job"]["running"] == false;
        });
        EXPECT_TRUE(now["listing"].is_null()) << "the dialog is gone";
    }
};

TEST_F(MouseOnImport, ChoosesAPartInTheListAndAnotherInThePreview)
{
    const Json now = viewer->wait(
        "the items", [](const Json& r) { return r["listing"].is_object() && r["listing"]["items"].is_array(); });
    EXPECT_TRUE(now["part"].is_null()) << "nothing is read before it is chosen";
    click("import item 1");
    click("import open");
    expect_triangles(4);

    click("choose in the file");
    click("import preview", 0.4, 0.5); // the Hood lies on the left of the strip
    click("import open");
    expect_triangles(8);
}

} // namespace
} // namespace spia::viewer
