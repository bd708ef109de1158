// What is told of countersinks and counterbores that are no plain ones: in bends, open at a border,
// at the skin that is laid flat, in steps.
#include <algorithm>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <string>

#include "engine/exchange/read_part.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {

using shapes::BentSolid;
using shapes::CadForm;
using shapes::Sink;

TEST(SunkHoles, InABendAreToldAndDoubted)
{
    const ScratchFolder folder;
    for (const CadForm form : {CadForm::step, CadForm::stl}) {
        BentSolid solid;
        solid.thickness = 2.5;
        solid.width = 50;
        solid.leg = {50, 40};
        solid.bend = {{4, 1.2}};
        Sink sink;
        sink.centre = {51, 25}; // its circle is over the bend at both sides
        sink.hole = 2;
        sink.depth = 1.5;
        sink.wide = 3.5;
        sink.left = false;
        solid.sink = {sink};
        const auto file = folder / (std::string("part") + extension(form));
        shapes::write_bent_solid(file, solid, form);
        const PartFile part = read_part(file);
        ASSERT_TRUE(part.solid);
        const Finding* told = part.doctor.find(Fault::mark);
        ASSERT_TRUE(told);
        EXPECT_EQ(told->count, 1);
        EXPECT_EQ(told->what[0],
                  "countersink, of a hole of 4 mm, on the outer skin; a bend, a border or another hole cuts it off");
        EXPECT_EQ(part.solid->marks.size(), 1u);
        ASSERT_EQ(part.doubts.size(), 2u);
        EXPECT_NE(part.doubts[1].find("the edge of the middle surface is off that of the solid"), std::string::npos);
        EXPECT_NE(part.doubts[0].find("1 hole is sunk in a bend"), std::string::npos) << part.doubts[0];
        EXPECT_EQ(told->text.find("least diameter"), std::string::npos) << told->text << " but " << part.doubts[0];
        const auto skin_named = [](const std::string& text) {
            const size_t at = text.find(" at the ", text.find("edge"));
            return at == text.npos ? "none in " + text : text.substr(at, text.find(" skin", at) - at);
        };
        EXPECT_EQ(skin_named(told->text), skin_named(part.doubts[0]));
    }
}

TEST(SunkHoles, OpenAtABorderAreToldAndWithoutAStraightWallDoubted)
{
    const ScratchFolder folder;
    for (const double y : {0., 1., 3.}) // both circles are open at the border, from more than half
                                        // on
        for (const bool land : {false, true})
            for (const CadForm form : {CadForm::step, CadForm::stl}) {
                SCOPED_TRACE(fmt::format("at y {}, {}, {}", y, land ? "land" : "no land",
                                         form == CadForm::step ? "STEP" : "STL"));
                BentSolid solid;
                solid.thickness = 3;
                solid.width = 50;
                solid.leg = {80};
                Sink sink;
                sink.centre = {40, y};
                sink.hole = 5;
                sink.wide = 8;
                sink.depth = land ? 1.5 : solid.thickness;
                solid.sink = {sink};
                const auto file = folder / (std::string("part") + extension(form));
                shapes::write_bent_solid(file, solid, form);
                const PartFile part = read_part(file);
                ASSERT_TRUE(part.solid);
                const auto told = [](const std::vector<std::string>& texts) {
                    return std::ranges::any_of(
                        texts, [](const std::string& text) { return text.starts_with("1 countersink is open"); });
                };
                EXPECT_TRUE(told(part.notes));
                EXPECT_EQ(told(part.doubts), !land);
            }
}

TEST(SunkHoles, AtTheSkinThatIsLaidFlatAreDoubtedAndNotMarked)
{
    const ScratchFolder folder;
    for (const bool left : {false, true}) {
        BentSolid solid;
        solid.kind = "sunk at one side";
        solid.thickness = 4;
        solid.width = 80;
        solid.leg = {60, 60};
        solid.bend = {{4, 1.2}};
        solid.sink = {
            {.leg = 0, .centre = {30, 40}, .hole = 2.5, .wide = 9, .depth = 2, .counterbore = true, .left = left}};
        shapes::write_bent_solid(folder / "sunk.step", solid);
        for (const Skin skin : {Skin::outer, Skin::inner, Skin::middle}) {
            ReadOptions options;
            options.skin = skin;
            const PartFile part = read_part(folder / "sunk.step", options);
            ASSERT_TRUE(part.solid);
            // the bend turns to the left, so that its outside is on the right
            const bool cut_wide = skin == (left ? Skin::inner : Skin::outer);
            const auto wide = [](const std::string& doubt) {
                return doubt.find("1 hole is wider at the") == 0 && doubt.find("take the middle surface") != doubt.npos;
            };
            EXPECT_EQ(std::ranges::count_if(part.doubts, wide), cut_wide) << int(skin) << left;
            EXPECT_EQ(part.solid->marks.size(), cut_wide ? 0u : 1u) << int(skin) << left;
            for (const auto& [circle, label] : part.solid->marks) {
                EXPECT_EQ(label.kind, MarkLabel::Kind::counterbore);
                EXPECT_EQ(label.inner, left);
                EXPECT_EQ(label.outer, !left);
                EXPECT_NEAR(label.wide, 18, 1e-6);
                EXPECT_NEAR(label.deep, 2, 1e-6);
                EXPECT_NEAR(label.hole, 5, 1e-6);
            }
            const auto marked = [](const Finding& finding) {
                return finding.text.find("circles among the marks show where") != finding.text.npos;
            };
            EXPECT_EQ(std::ranges::count_if(part.doctor.findings, marked), !cut_wide) << int(skin) << left;
        }
    }
}

TEST(SunkHoles, InStepsAreToldAsSuchAndHaveNoDepthInTheDrawing)
{
    const ScratchFolder folder;
    for (const bool left : {false, true})
        for (const bool cone : {false, true})
            for (const bool two : {false, true}) {
                BentSolid solid;
                solid.kind = "steps";
                solid.thickness = 4;
                solid.width = 80;
                solid.leg = {90};
                Sink inner{.leg = 0, .centre = {40, 40}, .hole = 2.5, .wide = 4, .depth = 2.3, .left = left};
                inner.counterbore = !cone;
                Sink outer{.leg = 0, .centre = {40, 40}, .hole = 2.5, .wide = 6, .depth = 1.2, .left = left};
                outer.counterbore = true;
                solid.sink = {inner};
                if (two)
                    solid.sink.push_back(outer);
                shapes::write_bent_solid(folder / "steps.step", solid);
                const PartFile part = read_part(folder / "steps.step");
                ASSERT_TRUE(part.solid);
                const Finding* told = part.doctor.find(Fault::mark);
                ASSERT_TRUE(told);
                EXPECT_EQ(told->what.at(0).find("2.3 mm deep in all, in steps") != std::string::npos, two)
                    << told->what[0];
                ASSERT_EQ(part.solid->marks.size(), 1u);
                const MarkLabel& label = part.solid->marks[0].label;
                EXPECT_NEAR(label.wide, two ? 12 : 8, 1e-6);
                EXPECT_NEAR(label.deep, two ? 0 : 2.3, 1e-6);
            }
}

} // namespace spia
