// A material of a tensile test by mouse and keyboard.
#include <cmath>
#include <fmt/core.h>
#include <fstream>

#include "tests/ui/by_hand/on_part.h"

namespace spia::viewer {
namespace {

class TensileTestByHand : public OnPart {};

TEST_F(TensileTestByHand, BecomesTheMaterialOfThePart)
{
    {
        std::ofstream file(folder / "bar.csv");
        file << "true strain;true stress MPa\n"; // Swift: 500 (0.01 + e)^0.2
        constexpr double young = 210'000;
        for (int k = 0; k < 18; ++k)
            file << fmt::format("{};{}\n", 5e-5 * k, 5e-5 * k * young);
        for (int k = 0; k <= 40; ++k) {
            const double plastic = 0.005 * k, stress = 500 * std::pow(0.01 + plastic, 0.2);
            file << fmt::format("{};{}\n", plastic + stress / young, stress);
        }
    }
    start("assets/parts/dome.obj");
    hands->click("mild_steel");
    hands->click("From a tensile test...");
    hands->see("Choose a tensile test");
    hands->type((folder / "bar.csv").string());
    hands->keys("Return");
    hands->see("Material from a tensile test");
    hands->see_part_of_line("uniform true");
    hands->click("Save and use it");
    hands->see_that("the material of the test",
                    [&](const Json& r) { return r["options"]["material"] == (folder / "bar.json").string(); });
}

} // namespace
} // namespace spia::viewer
