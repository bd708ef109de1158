#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/blank/bends_for_shop.h"
#include "engine/pipeline/blank/drawn_blank.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/session.h"
#include "tests/support/cad/drawn_solid.h"
#include "tests/support/cad/random_bent_solid.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::drawn_bends_test {
namespace {

namespace fs = std::filesystem;
using shapes::CadForm;
constexpr double degree = std::numbers::pi / 180;

Session solved(const fs::path& file)
{
    Session session;
    session.file = file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session = run_stage(Stage::read, session);
    session.options.flatten.thickness = session.part->thickness_mm.value();
    return run_stage(Stage::solve, session);
}

BlankDrawing drawing_of(const Session& session)
{
    return drawn_blank(*session.part, bends_for_shop(*session.part), session.blank->blank, session.blank->face, true,
                       session.bends.get());
}

std::string describe(const std::vector<SheetBend>& bends)
{
    std::string words;
    for (const SheetBend& bend : bends)
        words += fmt::format("R {:.5g}, {:.5g} degrees, {:.4g} long {}; ", bend.inner_radius, bend.angle / degree,
                             bend.length, bend.why_not);
    return words;
}

std::string describe(const BlankDrawing& drawing)
{
    std::string words;
    for (const DrawnBend& bend : drawing.bends)
        words += fmt::format("R {:.4g}, {:.4g} degrees; ", bend.inner_radius, bend.angle / degree);
    return words;
}

fs::path file_of(const ScratchFolder& folder, CadForm form) { return folder / (std::string("part") + extension(form)); }

class DrawnBends : public testing::TestWithParam<std::uint64_t> {
protected:
    void expect_none(CadForm form)
    {
        SCOPED_TRACE(write_drawn_solid(file_of(folder_, form), GetParam(), form).kind);
        expect_none(solved(file_of(folder_, form)));
    }
    static void expect_none(const Session& session)
    {
        for (const SheetBend& bend : session.bends->bends)
            ADD_FAILURE() << "a row: R " << bend.inner_radius << ", " << bend.angle / degree << " degrees, "
                          << bend.length << " long" << (bend.sharp ? ", sharp " : " ") << bend.why_not;
        const BlankDrawing drawing = drawing_of(session);
        EXPECT_TRUE(drawing.bends.empty()) << describe(drawing);
    }
    void expect_all(CadForm form)
    {
        const shapes::BentSolid solid = shapes::random_embossed_bracket(GetParam());
        SCOPED_TRACE(fmt::format("{}, t {:.4g}, {} embosses", solid.kind, solid.thickness, solid.emboss.size()));
        write_bent_solid(file_of(folder_, form), solid, form);
        const Session session = solved(file_of(folder_, form));
        const auto& bends = session.bends->bends;
        const double within = form == CadForm::stl ? 3e-3 : 1e-3;
        EXPECT_EQ(bends.size(), solid.bend.size());
        for (const shapes::SolidBend& made : solid.bend)
            EXPECT_TRUE(std::any_of(bends.begin(), bends.end(),
                                    [&](const SheetBend& bend) {
                                        return std::abs(bend.inner_radius - made.inner_radius) <
                                                   within * (made.inner_radius + solid.thickness) &&
                                               std::abs(bend.angle - std::abs(made.angle)) < within && bend.laid &&
                                               std::abs(bend.length - solid.width) < 0.02 * solid.width;
                                    }))
                << "R " << made.inner_radius << ", " << made.angle / degree << " degrees, " << solid.width
                << " long; found " << describe(bends);
        const BlankDrawing drawing = drawing_of(session);
        EXPECT_EQ(drawing.bends.size(), solid.bend.size()) << describe(drawing);
        for (const DrawnBend& bend : drawing.bends)
            EXPECT_EQ(bend.middle.size(), 1u);
    }
    ScratchFolder folder_;
};

} // namespace

TEST_P(DrawnBends, OfAStepFileAreNoneForAPressBrake) { expect_none(CadForm::step); }
TEST_P(DrawnBends, OfAnStlFileAreNoneForAPressBrake) { expect_none(CadForm::stl); }
TEST_P(DrawnBends, OfARolledSheetAreNoneForAPressBrake)
{
    shapes::write_waved_sheet(folder_ / "part.step", GetParam());
    expect_none(solved(folder_ / "part.step"));
}
TEST_P(DrawnBends, BesideAnEmbossOfAStepFileAreAsTheyWereMade) { expect_all(CadForm::step); }
TEST_P(DrawnBends, BesideAnEmbossOfAnStlFileAreAsTheyWereMade) { expect_all(CadForm::stl); }

INSTANTIATE_TEST_SUITE_P(Family, DrawnBends, testing::Range<std::uint64_t>(1, 13));

} // namespace spia::drawn_bends_test
