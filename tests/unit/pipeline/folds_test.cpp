// Flats that are folded without a radius.
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "engine/forming/material_library.h"
#include "engine/pipeline/outputs.h"
#include "engine/pipeline/session.h"
#include "tests/support/cad/prism.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

/// Rows of text that tell a bend.
std::vector<std::string> texts(const std::filesystem::path& dxf)
{
    std::vector<std::string> result;
    std::ifstream file(dxf);
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("UP ") || line.starts_with("DOWN "))
            result.push_back(line.substr(0, line.find('\r')));
    return result;
}

TEST(Folds, OfCadFlatsAreDrawnHoweverLittleTheyTurn)
{
    constexpr double degree = std::numbers::pi / 180;
    std::mt19937 draw(59);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(draw); };
    for (int i = 0; i < 12; ++i) {
        const int flats = 2 + int(draw() % 5), whole = 3 + int(draw() % 40);
        const double thickness = between(0.5, 2), width = between(8, 12) * thickness, length = between(30, 80);
        SCOPED_TRACE(fmt::format("{} flats of {:.4g} mm, {} degrees", flats, width, whole));
        const ScratchFolder folder;
        shapes::write_prism(folder / "part.step", shapes::folded_section(flats, width, whole * degree, thickness),
                            length);
        Session session;
        session.file = folder / "part.step";
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        session.options.flatten.thickness = thickness;
        session = run_stage(Stage::solve, run_stage(Stage::read, std::move(session)));
        const Eigen::Matrix2Xd& X = session.blank->blank.position;
        const Eigen::Vector2d size = X.rowwise().maxCoeff() - X.rowwise().minCoeff();
        EXPECT_NEAR(size.maxCoeff(), std::max(flats * width, length), 1e-5);
        EXPECT_NEAR(size.minCoeff(), std::min(flats * width, length), 1e-5);
        write_outputs(session, folder / "out", {"dxf"});
        const auto found = texts(folder / "out/part.dxf");
        EXPECT_EQ(found.size(), size_t(flats - 1));
        for (const std::string& text : found)
            EXPECT_NE(text.find(fmt::format(" {}%%d R0 ", whole)), std::string::npos) << text;
    }
}

} // namespace
} // namespace spia
