// The steps as files of the command line.
#include <fstream>
#include <gmock/gmock.h>

#include "engine/mesh/region.h"
#include "engine/pipeline/files/unfold_file.h"
#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

using testing::HasSubstr;

struct StepsFile : UnfoldingSteps {
    void save()
    {
        model.apply(SaveSteps{folder / "steps.json"});
        wait();
        EXPECT_THAT(last(Severity::done), HasSubstr("Saved the steps to")) << last(Severity::error);
    }
    void open()
    {
        model.apply(OpenSteps{folder / "steps.json"});
        wait();
    }
    void write(const char* text) { std::ofstream(folder / "steps.json") << text; }
};

} // namespace

TEST_F(StepsFile, GoesOutAndComesBackWithTheSameStates)
{
    open_box();
    propose();
    ChangeStep change = change_of(2);
    change.name = "mine";
    change.tolerance = 1e-7;
    model.apply(change);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    const StepList before = document.steps;
    const Eigen::Matrix3Xd flat = after(4).position;
    save();
    // As the command line reads it.
    const ReadScript read = read_unfold_script(folder / "steps.json", *document.session.part, document.bends->map);
    EXPECT_TRUE(read.findings.empty());
    ASSERT_EQ(read.steps.size(), 5u);
    EXPECT_EQ(
        run_unfolding(document.session.part->mesh, read.steps, document.session.options.flatten).states[4].position,
        flat);
    for (int k = 0; k < 5; ++k)
        model.apply(RemoveStep{0});
    open();
    ASSERT_EQ(document.steps.size(), 5u) << last(Severity::error);
    EXPECT_EQ(state.history.undo_name(), "Open steps");
    for (size_t k = 0; k < 5; ++k) {
        EXPECT_EQ(document.steps[k]->name, before[k]->name);
        EXPECT_EQ(document.steps[k]->kind, before[k]->kind);
        EXPECT_EQ(document.steps[k]->pick.freed, before[k]->pick.freed);
        EXPECT_EQ(document.steps[k]->pick.fixed, before[k]->pick.fixed);
        EXPECT_EQ(carrying_faces(*document.steps[k]), carrying_faces(*before[k]));
        EXPECT_EQ(document.steps[k]->tolerance, before[k]->tolerance);
    }
    EXPECT_EQ(names()[2], "mine");
}

TEST_F(StepsFile, PickedFacesAndATargetOfOnesOwnAreInIt)
{
    open_channel();
    const TriMesh& part = document.session.part->mesh;
    const double top = part.position.row(2).maxCoeff();
    FaceSet leg = with_height(top - 1e-6, top);
    leg.resize(leg.size() / 2); // no region as a whole
    model.apply(SelectFaces{leg});
    model.apply(MakeRegion{"half a leg", RegionKind::fixed});
    model.apply(InvertSelection{});
    model.apply(AddStep{0, {}, "own", {.plane = TargetPlane{{0, 0, top}, {0, 0, 1}}}});
    ASSERT_EQ(document.steps.size(), 1u) << last(Severity::error);
    const auto before = document.steps[0];
    save();
    model.apply(RemoveStep{0});
    open();
    ASSERT_EQ(document.steps.size(), 1u) << last(Severity::error);
    EXPECT_EQ(document.steps[0]->pick.freed, before->pick.freed);
    EXPECT_EQ(document.steps[0]->pick.fixed, leg);
    EXPECT_EQ(numbers_of(*document.steps[0]), numbers_of(*before));
}

TEST_F(StepsFile, WhatMakesNoSenseOnThePartIsSaidAndTheRestIsTaken)
{
    open_box();
    propose();
    save();
    const size_t proposed = document.steps.size();
    write(R"({"regions": [{"name": "far away", "at": [900, 0, 0]}],
              "steps": [{"name": "gone", "freed": {"regions": ["far away"]}, "fixed": {"regions": ["region 1"]}},
                        {"name": "all at once", "kind": "flatten"}]})");
    open();
    EXPECT_EQ(names(), std::vector<std::string>{"all at once"});
    std::string warnings;
    for (const Message& message : state.messages)
        if (message.severity == Severity::warning && !message.dismissed)
            warnings += message.text;
    EXPECT_THAT(warnings, HasSubstr("the nearest is"));
    EXPECT_THAT(warnings, HasSubstr("Step \"gone\" is left out"));
    EXPECT_THAT(last(Severity::done), HasSubstr("some of them do not fit this part"));
    model.apply(Undo{});
    EXPECT_EQ(document.steps.size(), proposed);
    write(R"({"stepz": []})");
    open();
    EXPECT_THAT(last(Severity::error), HasSubstr("stepz"));
    EXPECT_EQ(document.steps.size(), proposed);
}

} // namespace spia::viewer
