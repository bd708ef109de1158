// The K factor of the bends, and what cutting corners is worth, as the window has them.
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>
#include <numbers>
#include <random>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/k_choice.h"
#include "app/viewer/model/document/project_file.h"
#include "app/viewer/model/document/unfolding_steps.h"
#include "engine/core/file_content.h"
#include "engine/core/json_file.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "tests/support/bent_parts.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_file.h"
#include "tests/support/profile.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

constexpr double legs = 40 + 25, thickness = 2; // mm

struct KChoice : ModelFixture {
    ScratchFolder folder;

    /// A bend between two legs. @param middle  mm, radius of the middle surface
    void open_bracket(double middle, double angle)
    {
        const auto profile = shapes::Profile({0, 0}, 0).straight(40).bend(middle, angle).straight(25);
        shapes::write_mesh(folder / "bracket.obj", shapes::extruded(profile, 30, 6000).mesh);
        model.apply(OpenPart{folder / "bracket.obj", ""});
        wait();
        model.apply(SetThickness{thickness});
        model.apply(RunTo{Stage::solve});
        wait();
        ASSERT_NE(document.session.blank, nullptr);
        ASSERT_EQ(document.session.bends->bends.size(), 1u);
    }
    double length() const
    {
        const Eigen::Matrix2Xd& flat = document.session.blank->blank.position;
        return (flat.rowwise().maxCoeff() - flat.rowwise().minCoeff())[0];
    }
    std::string last_error() const
    {
        for (auto message = state.messages.rbegin(); message != state.messages.rend(); ++message)
            if (message->severity == Severity::error)
                return message->text;
        return "";
    }
    /// The part solved anew with this factor; what the panel showed before that are `shown`.
    void choose(const std::string& k, SheetBend& shown)
    {
        model.apply(SetKFactor{k});
        shown = with_wanted_k(document, document.session.bends->bends[0]);
        EXPECT_EQ(first_stale(document), Stage::solve) << k;
        wait();
        ASSERT_EQ(last_error(), "");
        EXPECT_GT(first_stale(document).value(), Stage::solve) << "it is solved at once";
    }
};

/// DIN 6935 as its formula reads.
double din(double ratio) { return ratio > 5 ? 0.5 : (0.65 + 0.5 * std::log10(ratio)) / 2; }

} // namespace

TEST_F(KChoice, FiguresFollowAtOnceAndTheBlankHasThem)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(0, 1);
    for (int trial = 0; trial < 4; ++trial) {
        // radii that meshes are known by
        const double inner = 2 + 2 * share(random), angle = 0.9 + 1.2 * share(random);
        ASSERT_NO_FATAL_FAILURE(open_bracket(inner + thickness / 2, angle));
        const double number = std::round(1000 * (0.3 + 0.2 * share(random))) / 1000;
        std::ofstream(folder / "k.csv") << "R/t;K\n0;0.3\n10;0.5\n";
        const double ratio = inner / thickness;
        const std::pair<std::string, double> choices[] = {
            {fmt::format("{}", number), number},
            {"din6935", din(ratio)},
            {(folder / "k.csv").string(), 0.3 + 0.02 * std::min(10., ratio)}};
        for (const auto& [text, k] : choices) {
            const double wanted = angle * (inner + k * thickness);
            SheetBend shown;
            ASSERT_NO_FATAL_FAILURE(choose(text, shown));
            EXPECT_NEAR(shown.k, k, 1e-3) << text; // the radius is that of a circle through
                                                   // vertices
            EXPECT_NEAR(shown.allowance, wanted, 1e-3 * wanted) << text;
            EXPECT_NEAR(length(), legs + wanted, 1e-3 * legs) << text;
            const SheetBend& made = document.session.bends->bends[0];
            EXPECT_NEAR(shown.allowance, made.allowance, 1e-9);
            EXPECT_NEAR(shown.deduction, made.deduction, 1e-9);
            EXPECT_TRUE(made.laid);
        }
        EXPECT_EQ(k_source(document.session.options.k_factor), KSource::table);
        EXPECT_EQ(k_words(document.session.options.k_factor), "k.csv");
    }
}

TEST_F(KChoice, BesideASkinItIsADoubtOfTheStepPartBeforeARun)
{
    shapes::BentSolid solid;
    solid.kind = "bracket";
    solid.leg = {40, 25};
    solid.bend = {{3, pi / 2}};
    shapes::write_bent_solid(folder / "part.step", solid);
    model.apply(OpenPart{folder / "part.step", ""});
    wait();
    model.apply(SetKFactor{"0.44"});
    const auto doubted = [&] {
        return std::ranges::count_if(*state.doubts, [](const Doubt& doubt) {
            return doubt.step == ChainStep::part && doubt.text.find("needs the middle surface") != std::string::npos;
        });
    };
    EXPECT_EQ(doubted(), 0);
    model.apply(SetReading{{.skin = Skin::outer}});
    wait();
    EXPECT_EQ(doubted(), 1);
    model.apply(SetReading{{.skin = Skin::middle}});
    wait();
    EXPECT_EQ(doubted(), 0);
}

TEST_F(KChoice, ABendThatIsNotLaidIsADoubtAndKeepsTheFiguresOfTheBlank)
{
    shapes::BentSolid solid;
    solid.kind = "bracket";
    solid.leg = {40, 25};
    solid.bend = {{0.01, pi / 2}}; // with so small a K next to nothing would be left of the bend
    shapes::write_bent_solid(folder / "part.step", solid);
    model.apply(OpenPart{folder / "part.step", ""});
    wait();
    model.apply(SetMaterial{"mild_steel"});
    model.apply(SetKFactor{"0.001"});
    model.apply(RunTo{Stage::solve});
    wait();
    ASSERT_NE(document.session.bends, nullptr) << last_error();
    ASSERT_EQ(document.session.bends->bends.size(), 1u);
    const SheetBend &made = document.session.bends->bends[0], shown = with_wanted_k(document, made);
    ASSERT_FALSE(made.laid);
    EXPECT_EQ(shown.k, 0.5);
    EXPECT_NEAR(shown.allowance, pi / 2 * (0.01 + solid.thickness / 2), 1e-6);
    EXPECT_EQ(shown.deduction, made.deduction);
    // What --strict counts is what the lights show.
    const auto poorer = shortcomings(as_made(document));
    EXPECT_EQ(state.doubts->size(), poorer.size());
    EXPECT_TRUE(std::ranges::any_of(*state.doubts, [](const Doubt& doubt) {
        return doubt.step == ChainStep::unfold &&
               doubt.text.find("is not laid with its allowance") != std::string::npos;
    }));
    EXPECT_FALSE(readiness(state).fine);
    EXPECT_TRUE(readiness(state).lists_doubts);
    for (const bool propose : {true, false}) {
        if (propose)
            model.apply(ProposeSteps{});
        else
            model.apply(RunSteps{});
        wait();
    }
    ASSERT_TRUE(all_steps_done(document)) << last_error();
    EXPECT_TRUE(std::ranges::any_of(state.messages, [](const Message& message) {
        return message.severity == Severity::warning && message.text.find("is not laid with") != std::string::npos;
    })) << "steps";
    EXPECT_FALSE(std::ranges::any_of(state.messages, [](const Message& message) {
        return message.severity == Severity::done && message.text.starts_with("Unfolded in");
    }));
}

TEST_F(KChoice, IsUndoneAndKeptInProjects)
{
    ASSERT_NO_FATAL_FAILURE(open_bracket(4, 1));
    std::ofstream(folder / "k.csv") << "0 0.35\n";
    for (const std::string& text : {std::string("0.42"), std::string("din6935"), (folder / "k.csv").string()}) {
        model.apply(SetKFactor{text});
        wait();
        save_project(folder / "a.spia", document, state.view);
        const auto kept = open_project(folder / "a.spia", assets / "materials").document.session.options.k_factor;
        EXPECT_EQ(kept, document.session.options.k_factor) << text;
    }
    std::filesystem::remove(folder / "k.csv");
    const auto rows = open_project(folder / "a.spia", assets / "materials").document.session.options.k_factor;
    EXPECT_EQ(rows, document.session.options.k_factor) << "of a table whose file has gone";
    Json without = parse_json(content_of(folder / "a.spia"), "project"); // as older ones
    without.erase("k_table_rows");
    std::ofstream(folder / "b.spia") << without.dump();
    try {
        open_project(folder / "b.spia", assets / "materials");
        ADD_FAILURE() << "the table is nowhere";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr((folder / "k.csv").string() + " no longer exists"));
    }
    model.apply(Undo{});
    EXPECT_FALSE(document.session.options.k_factor) << "changes in a row are one";
    EXPECT_GT(first_stale(document).value_or(Stage::fit), Stage::solve) << "and the blank of then";
}

TEST_F(KChoice, OfThePartBeforeIsSaidToBeGoneWhenAnotherIsOpened)
{
    const char* gone = "The K factor is 0.5 again; that of the part before was ";
    open_bracket(6, pi / 2);
    open_bracket(7, pi / 2);
    EXPECT_FALSE(says(Severity::hint, gone)) << "none was chosen";
    model.apply(SetKFactor{"0.42"});
    wait();
    model.apply(SaveProject{folder / "bracket.spia"});
    open_bracket(8, pi / 2);
    EXPECT_TRUE(says(Severity::hint, std::string(gone) + "0.42."));
    EXPECT_FALSE(document.session.options.k_factor);
    model.apply(OpenProject{folder / "bracket.spia"});
    wait();
    EXPECT_EQ(document.session.options.k_factor->name, "0.42") << "projects have their own";
}

TEST_F(KChoice, WhatIsNoneIsRefused)
{
    ASSERT_NO_FATAL_FAILURE(open_bracket(4, 1));
    for (const char* none : {"0", "1", "-0.2", "nowhere.csv", "nan"}) {
        model.apply(SetKFactor{none});
        EXPECT_NE(last_error(), "") << none;
        EXPECT_FALSE(document.session.options.k_factor) << none;
        model.apply(DismissMessages{});
    }
}

TEST_F(KChoice, CutCornersTellTheStrainWithAndWithout)
{
    const shapes::LippedBox box;
    shapes::write_mesh(folder / "tray.obj", shapes::lipped_box(box));
    model.apply(OpenPart{folder / "tray.obj", ""});
    wait();
    model.apply(SetSeam{{SeamOptions::Mode::corners, {}}});
    wait();
    ASSERT_EQ(last_error(), "");
    const auto cut = document.session.corner_cut;
    ASSERT_TRUE(cut);
    ASSERT_TRUE(cut->before) << cut->why_not;
    EXPECT_LT(cut->after.most, 1e-6);
    EXPECT_GT(cut->before->most, 0.1);
    const auto says = [](const Message& message) { return message.text.find("With the corners cut") == 0; };
    EXPECT_EQ(std::count_if(state.messages.begin(), state.messages.end(), says), 1);
    // Joined, the part is as without the wish.
    model.apply(SetSeam{});
    wait();
    EXPECT_FALSE(document.session.corner_cut);
    model.apply(RunTo{Stage::solve});
    wait();
    ASSERT_NE(document.session.blank, nullptr);
    EXPECT_NEAR(document.session.blank->face.strain_equivalent.maxCoeff(), cut->before->most, 1e-6);
}

} // namespace spia::viewer
