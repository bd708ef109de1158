#include "engine/pipeline/run_chain.h"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/flat_thickness.h"
#include "engine/pipeline/run_stage.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

Session with_file(const std::filesystem::path& file)
{
    Session session;
    session.file = file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.grid.cells = 12;
    return session;
}

Session dome() { return with_file(SPIA_SOURCE_DIR "/assets/parts/dome.obj"); }

/// What the hooks are told, a word each.
struct Told {
    std::vector<std::string> words;

    ChainHooks hooks()
    {
        ChainHooks hooks;
        hooks.begins = [this](Stage stage) {
            words.push_back(fmt::format("{} begins", name(stage)));
            return Progress();
        };
        hooks.ended = [this](Stage stage, const Session& session) {
            words.push_back(fmt::format("{} ended{}", name(stage), session.seconds.count(stage) ? "" : ", untimed"));
        };
        hooks.part_is_ready = [this](const Session&) { words.push_back("part is ready"); };
        return hooks;
    }
};

/// A flat sheet of 4 x 4 shells of 10 mm in an LS-DYNA deck, 1.5 mm thick.
void write_deck(const std::filesystem::path& file)
{
    constexpr int n = 4;
    std::string text = "*NODE\n";
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            text += fmt::format("{},{},{},0\n", 1 + i + (n + 1) * j, 10 * i, 10 * j);
    text += "*ELEMENT_SHELL\n";
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = 1 + i + (n + 1) * j;
            text += fmt::format("{},5,{},{},{},{}\n", 1 + i + n * j, a, a + 1, a + n + 2, a + n + 1);
        }
    put(file, text + "*PART\nside\n5,8\n*SECTION_SHELL\n8,2\n1.5,1.5,1.5,1.5\n*END\n");
}

/// A progress whose owner asks to stop as soon as it hears of anything.
Progress cancelled_when_heard(const std::shared_ptr<std::atomic<bool>>& cancel)
{
    return Progress([cancel](double, std::string_view) { *cancel = true; }, cancel);
}

} // namespace

TEST(RunChain, RunsTheStagesInTheirOrderAndGivesWhatTheyGiveOneByOne)
{
    Told told;
    const ChainRun run = run_chain(dome(), Stage::read, Stage::fit, {}, told.hooks());
    EXPECT_EQ(told.words, (std::vector<std::string>{"read begins", "read ended", "part is ready", "solve begins",
                                                    "solve ended", "grid begins", "grid ended", "lift begins",
                                                    "lift ended", "fit begins", "fit ended"}));
    EXPECT_FALSE(run.failure);
    EXPECT_FALSE(run.error);
    Session one_by_one = dome();
    for (const Stage stage : chain)
        one_by_one = run_stage(stage, one_by_one);
    EXPECT_EQ(run.session.blank->blank.position, one_by_one.blank->blank.position);
    EXPECT_EQ(run.session.surface->result.surface.control, one_by_one.surface->result.surface.control);
    for (const Stage stage : chain)
        EXPECT_GE(run.session.seconds.at(stage), 0) << name(stage);
}

TEST(RunChain, BeginsAndStopsAtTheStagesThatAreWanted)
{
    const Session read = completed(run_chain(dome(), Stage::read, Stage::read));
    ASSERT_TRUE(read.part);
    EXPECT_FALSE(read.blank);
    Told told;
    const Session more = completed(run_chain(read, Stage::solve, Stage::grid, {}, told.hooks()));
    EXPECT_EQ(more.part, read.part) << "the same object, not read again";
    EXPECT_TRUE(more.grid);
    EXPECT_FALSE(more.lifted);
    EXPECT_EQ(told.words, (std::vector<std::string>{"solve begins", "solve ended", "grid begins", "grid ended"}));
}

TEST(RunChain, AStageWithoutAResultEndsItAndWhatWasMadeBeforeIsKept)
{
    Session session = dome();
    session.options.corners = {-1, 0, 1, 2};
    Told told;
    const ChainRun run = run_chain(session, Stage::read, Stage::fit, {}, told.hooks());
    ASSERT_TRUE(run.failure);
    EXPECT_EQ(run.failure->stage, Stage::grid);
    EXPECT_NE(run.failure->message.find("corner -1 is not a vertex of the part"), std::string::npos)
        << run.failure->message;
    EXPECT_TRUE(run.session.blank);
    EXPECT_FALSE(run.session.grid);
    EXPECT_EQ(told.words.back(), "grid begins");
    EXPECT_THROW(completed(run), InputError);
}

TEST(RunChain, TheFirstStageToFailLeavesTheSessionAsItWasGiven)
{
    const ChainRun run = run_chain(with_file("there-is-no-such-file.obj"));
    ASSERT_TRUE(run.failure);
    EXPECT_EQ(run.failure->stage, Stage::read);
    EXPECT_FALSE(run.session.part);
    EXPECT_EQ(run.session.file, "there-is-no-such-file.obj");
}

TEST(RunChain, TheThicknessOfADeckIsTakenUnlessOneIsGiven)
{
    const ScratchFolder folder;
    write_deck(folder / "sheet.k");
    const Session session = with_file(folder / "sheet.k");
    const auto solved_with = [&](std::optional<double> thickness) {
        ChainWishes wishes;
        wishes.thickness = thickness;
        return completed(run_chain(session, Stage::read, Stage::solve, wishes));
    };
    EXPECT_EQ(solved_with({}).options.flatten.thickness, 1.5);
    EXPECT_NEAR(solved_with({}).blank->face.thickness.maxCoeff(), 1.5, 1e-9) << "a flat sheet is not strained";
    EXPECT_EQ(solved_with(0.8).options.flatten.thickness, 0.8);
    EXPECT_NEAR(solved_with(0.8).blank->face.thickness.maxCoeff(), 0.8, 1e-9);
    EXPECT_EQ(solved_with({}).part->thickness_mm, 1.5) << "of the part, whatever is wanted";
}

TEST(RunChain, APartWithoutAThicknessHasThatOfTheOptions)
{
    Session session = dome();
    session.options.flatten.thickness = 0.7;
    EXPECT_EQ(completed(run_chain(session, Stage::read, Stage::read)).options.flatten.thickness, 0.7);
    ChainWishes none;
    none.thickness = 0;
    const ChainRun run = run_chain(session, Stage::read, Stage::solve, none);
    ASSERT_TRUE(run.failure);
    EXPECT_EQ(run.failure->stage, Stage::read);
    EXPECT_EQ(run.failure->message, "the thickness is 0 mm; it must be above 0");
    EXPECT_TRUE(run.session.part);
    EXPECT_FALSE(run.session.blank);
}

TEST(RunChain, ProcessConditionsAreAskedForOnceThereAreThePartAndItsThickness)
{
    const ScratchFolder folder;
    write_deck(folder / "sheet.k");
    ChainWishes wishes;
    double thickness = 0;
    wishes.process = [&](const PartFile& part, const FlattenOptions& sheet) {
        thickness = sheet.thickness;
        ProcessConditions process;
        process.rolling = Eigen::Vector3d(double(part.mesh.triangles()), 0, 0);
        return process;
    };
    Told told;
    ChainHooks hooks = told.hooks();
    hooks.part_is_ready = [&](const Session& session) {
        ASSERT_TRUE(session.options.flatten.process.rolling);
        EXPECT_EQ(session.options.flatten.process.rolling->x(), session.part->mesh.triangles());
        told.words.emplace_back("process is there");
    };
    run_chain(with_file(folder / "sheet.k"), Stage::read, Stage::read, wishes, hooks);
    EXPECT_EQ(thickness, 1.5);
    EXPECT_EQ(told.words, (std::vector<std::string>{"read begins", "read ended", "process is there"}));

    wishes.process = [](const PartFile&, const FlattenOptions&) -> ProcessConditions {
        throw InputError("the part has no face 99");
    };
    const ChainRun refused = run_chain(with_file(folder / "sheet.k"), Stage::read, Stage::solve, wishes);
    ASSERT_TRUE(refused.failure);
    EXPECT_EQ(refused.failure->message, "the part has no face 99");
    EXPECT_TRUE(refused.session.part);
    EXPECT_FALSE(refused.session.blank);
}

TEST(RunChain, ALatticeIsLaidAroundTheFinishedSurface)
{
    ChainWishes wishes;
    wishes.deformation.emplace();
    wishes.deformation->around = true;
    wishes.deformation->lattice.emplace();
    Lattice& lattice = *wishes.deformation->lattice;
    lattice.move = Eigen::Matrix3Xd::Zero(3, lattice.points());
    lattice.move.row(2).setConstant(3); // all points alike: the surface is moved as it is
    const Session session = completed(run_chain(dome(), Stage::read, Stage::fit, wishes));
    ASSERT_TRUE(session.deformed);
    EXPECT_NEAR(session.deformed->result.largest, 3, 1e-9);
    EXPECT_EQ(session.options.deformation->lattice->origin,
              lattice_around(fitted_patches(*session.surface), lattice.count, lattice.degree).origin);
}

TEST(RunChain, ADeformationThatCannotBeIsAFailureOfTheSurfaceAlone)
{
    ChainWishes wishes;
    wishes.deformation.emplace();
    // no such control point
    wishes.deformation->moves.push_back({0, 1000, 0, Eigen::Vector3d::UnitZ()});
    const ChainRun run = run_chain(dome(), Stage::read, Stage::fit, wishes);
    ASSERT_TRUE(run.failure);
    EXPECT_EQ(run.failure->stage, Stage::fit);
    EXPECT_TRUE(run.session.blank);
    EXPECT_TRUE(run.session.lifted);
    EXPECT_FALSE(run.session.surface) << "it would not be the one that was asked for";
    EXPECT_THROW(completed(run), InputError);
}

TEST(RunChain, PatchesPassThroughTheGridWithoutOne)
{
    Session session = dome();
    session.options.patches.emplace();
    Told told;
    const Session made = completed(run_chain(session, Stage::read, Stage::fit, {}, told.hooks()));
    EXPECT_EQ(told.words.size(), 11u) << "two of each stage, and the part";
    EXPECT_FALSE(made.grid);
    EXPECT_FALSE(made.lifted);
    ASSERT_TRUE(made.surface);
    EXPECT_TRUE(made.surface->patches);
}

TEST(RunChain, ACancelWithinAStageThrowsAndLeavesWhatWasGivenAsItWas)
{
    const Session before = completed(run_chain(dome()));
    const Session given = before;
    ChainHooks hooks;
    std::vector<Stage> begun;
    const auto cancel = std::make_shared<std::atomic<bool>>(false);
    hooks.begins = [&](Stage stage) {
        begun.push_back(stage);
        return stage == Stage::solve ? cancelled_when_heard(cancel) : Progress();
    };
    EXPECT_THROW(run_chain(given, Stage::read, Stage::fit, {}, hooks), Cancelled);
    EXPECT_EQ(begun, (std::vector<Stage>{Stage::read, Stage::solve}));
    EXPECT_EQ(given.part, before.part);
    EXPECT_EQ(given.blank, before.blank);
    EXPECT_EQ(given.surface, before.surface);
    EXPECT_EQ(given.seconds, before.seconds);
}

TEST(RunChain, ACancelBetweenTwoStagesIsHeardByTheNextOne)
{
    const auto cancel = std::make_shared<std::atomic<bool>>(false);
    Session so_far;
    ChainHooks hooks;
    hooks.begins = [&](Stage) { return Progress({}, cancel); };
    hooks.ended = [&](Stage, const Session& session) {
        so_far = session;
        *cancel = true;
    };
    EXPECT_THROW(run_chain(dome(), Stage::read, Stage::fit, {}, hooks), Cancelled);
    EXPECT_TRUE(so_far.part) << "what has ended was told";
    EXPECT_FALSE(so_far.blank);
}

TEST(FlatThickness, IsThatAskedForThenThatOfThePartThenTheUsualOne)
{
    PartFile part;
    EXPECT_EQ(flat_thickness({}, part), 1);
    EXPECT_EQ(flat_thickness({}, part, 0.6), 0.6);
    part.thickness_mm = 1.5;
    EXPECT_EQ(flat_thickness({}, part, 0.6), 1.5);
    EXPECT_EQ(flat_thickness(2, part, 0.6), 2);
    EXPECT_THROW(flat_thickness(std::nan(""), part), InputError);
    EXPECT_THROW(flat_thickness(-1, part), InputError);
}

} // namespace spia
