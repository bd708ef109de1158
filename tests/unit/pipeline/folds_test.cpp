// Flats that are folded without a radius.
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "engine/forming/material/material_library.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/run_stage.h"
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

/// Of extended data: of how many lines and texts they tell this.
long told(const std::filesystem::path& dxf, const std::string& name)
{
    const std::string text = content_of(dxf);
    long count = 0;
    for (size_t at = text.find(name + "\n"); at != text.npos; at = text.find(name + "\n", at + 1))
        count += text[at - 1] == '\n';
    return count;
}

/// The table has them as sharp: what it deducts from the outer lengths of the legs, up to where
/// their outer sides meet, gives the blank.
void expect_rows(const Session& session, int flats, double width, double angle, double length)
{
    const auto& bends = session.bends->bends;
    ASSERT_EQ(int(bends.size()), flats - 1);
    const double thickness = session.bends->thickness, reach = thickness / 2 * std::tan(angle / 2);
    double outer = 0, deducted = 0;
    for (int leg = 0; leg < flats; ++leg)
        outer += width + (leg == 0 || leg == flats - 1 ? 1 : 2) * reach;
    std::vector<double> at;
    for (const SheetBend& bend : bends) {
        EXPECT_TRUE(bend.sharp && bend.laid);
        EXPECT_EQ(bend.inner_radius, 0);
        EXPECT_NEAR(bend.angle, angle, 1e-6);
        EXPECT_NEAR(bend.length, length, 1e-5);
        EXPECT_NEAR(bend.allowance, 2 * reach, 1e-6)
            << "of the middle of the sheet, between the inner corners of the legs";
        deducted += bend.deduction;
        ASSERT_EQ(bend.line.size(), 1u);
        const Eigen::Vector2d along = (bend.line[0].to - bend.line[0].from).normalized();
        at.push_back(std::abs(along[0] * bend.line[0].from[1] - along[1] * bend.line[0].from[0]));
    }
    EXPECT_NEAR(outer - deducted, flats * width, 1e-5);
    std::sort(at.begin(), at.end());
    for (size_t i = 0; i < at.size(); ++i)
        EXPECT_NEAR(at[i], double(i + 1) * width, 1e-5) << "where the middle lines of the legs meet";
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
        EXPECT_GE(told(folder / "out/part.dxf", "inner_radius"), flats - 1);
        EXPECT_EQ(told(folder / "out/part.dxf", "k"), 0);
        for (const std::string& text : found)
            EXPECT_TRUE(text.ends_with(fmt::format(" {}%%d R0", whole))) << text << ", it has no K";
        expect_rows(session, flats, width, whole * degree, length);
    }
}

} // namespace
} // namespace spia
