#include "engine/unfold/step/stepped_blank.h"

#include <Eigen/Geometry>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/forming/flatten.h"
#include "engine/forming/material/material_library.h"
#include "tests/support/developable.h"

namespace spia {
namespace {

using testing::HasSubstr;

class SteppedBlank : public testing::Test {
protected:
    SteppedBlank()
    {
        options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        steps = propose_sequence(part, find_bends(part)).steps;
        run = run_unfolding(part, steps, options);
    }
    SolveReport report() const { return stepped_blank(part, run, options).report; }

    TriMesh part = shapes::lipped_channel({.triangles = 800}).mesh;
    FlattenOptions options;
    UnfoldScript steps;
    UnfoldRun run;
};

} // namespace

TEST_F(SteppedBlank, ReportsThePoorestOfItsSteps)
{
    ASSERT_GE(run.states.size(), 4u);
    EXPECT_TRUE(report().whole());
    EXPECT_TRUE(report().converged);
    EXPECT_EQ(report().trusted_strain, options.curve.trusted_strain);
    EXPECT_THAT(report().reason, HasSubstr("each of which converged"));
    run.states[2].friction_share = 0.4;
    run.states[2].reason = "too much of it";
    EXPECT_EQ(report().process_share, 0.4);
    EXPECT_FALSE(report().whole());
    EXPECT_THAT(report().reason, HasSubstr("step 3 \"" + run.states[2].name + "\": too much of it"));
    run.states[1].system = SolvedSystem::relaxed;
    run.states[1].trusted_strain = 0.3;
    run.states[3].trusted_strain = 0.25;
    EXPECT_EQ(report().system, SolvedSystem::relaxed);
    EXPECT_EQ(report().trusted_strain, 0.25);
    EXPECT_TRUE(report().converged);
    run.states[0].converged = false;
    EXPECT_FALSE(report().converged);
    EXPECT_EQ(report().system, SolvedSystem::energy);
    EXPECT_THAT(report().reason, Not(HasSubstr("converged")));
}

TEST_F(SteppedBlank, LiesTheSameWayRoundAsThatOfOneStepHoweverThePartLies)
{
    const TriMesh as_made = part;
    for (int k = 0; k < 8; ++k) {
        part = as_made;
        const Eigen::AngleAxisd turn(k * M_PI / 4 + 0.1, Eigen::Vector3d(0.3, -0.2, 1).normalized());
        part.position = turn.toRotationMatrix() * as_made.position;
        run = run_unfolding(part, propose_sequence(part, find_bends(part)).steps, options);
        const Eigen::Matrix2Xd one = flatten(part, options).blank.position;
        const Eigen::Matrix2Xd stepped = stepped_blank(part, run, options).blank.position;
        const Eigen::Matrix2Xd a = one.colwise() - one.rowwise().mean(),
                               b = stepped.colwise() - stepped.rowwise().mean();
        EXPECT_GT(a.cwiseProduct(b).sum(), 0) << "turned by 45 degrees " << k << " times";
    }
}

TEST_F(SteppedBlank, OfAnotherPartIsRefused)
{
    part.position.conservativeResize(3, part.vertices() + 1);
    part.position.rightCols<1>().setZero();
    EXPECT_THROW(report(), InputError);
}

TEST_F(SteppedBlank, AStepDoesTheSameUnlessSomethingButItsNameIsAnother)
{
    const PlannedStep& step = steps[0];
    PlannedStep other = step;
    other.name = "called otherwise";
    EXPECT_TRUE(same_work(step, other));
    Eigen::Matrix<double, 3, 2> axes = Eigen::Matrix3d::Identity().leftCols<2>();
    const HeightFace height{{0, 0, 0}, axes, {0, 0}, 1, Eigen::MatrixXd::Zero(4, 5)};
    PlannedStep smooth = step;
    smooth.pick.target = height;
    for (const std::function<void(PlannedStep&)>& change : std::vector<std::function<void(PlannedStep&)>>{
             [](PlannedStep& s) { s.kind = UnfoldKind::flatten; }, [](PlannedStep& s) { s.pick.freed.pop_back(); },
             [](PlannedStep& s) { s.pick.fixed.pop_back(); }, [](PlannedStep& s) { s.pick.carrying = {1}; },
             [](PlannedStep& s) { s.pick.friction = ContactRegion{}; }, [](PlannedStep& s) { s.pick.target.reset(); },
             [](PlannedStep& s) { std::get<HeightFace>(*s.pick.target).coefficient(1, 2) = 1e-15; },
             [](PlannedStep& s) { std::get<HeightFace>(*s.pick.target).coefficient.resize(5, 4); },
             [](PlannedStep& s) { s.within_mm = 0.1; }, [](PlannedStep& s) { s.offset_mm = 0.1; },
             [](PlannedStep& s) { s.extent_mm = 3; }, [](PlannedStep& s) { s.tolerance = 1e-3; },
             [](PlannedStep& s) { s.most_energy_steps = 3; }, [](PlannedStep& s) { s.most_newton_steps = 3; }}) {
        PlannedStep changed = smooth;
        EXPECT_TRUE(same_work(smooth, changed));
        change(changed);
        EXPECT_FALSE(same_work(smooth, changed));
    }
}

} // namespace spia
