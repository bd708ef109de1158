#include "engine/unfold/target/target_reach.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/unfold/step/unfold_script.h"
#include "tests/support/developable.h"

namespace spia {
namespace {

class TargetReachOfAFlange : public testing::Test {
protected:
    TargetReachOfAFlange()
    {
        options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        step.name = "flange";
        // the nearest faces last
        part.mesh.triangle = Eigen::Matrix3Xi(part.mesh.triangle.rowwise().reverse());
        for (int f = 0; f < part.mesh.triangles(); ++f)
            (part.flat(0, Eigen::all)(part.mesh.triangle.col(f)).mean() < shape.base ? step.pick.fixed
                                                                                     : step.pick.freed)
                .push_back(f);
    }
    UnfoldRun run() const { return run_unfolding(part.mesh, {step}, options); }

    shapes::BentFlange shape{.angle_deg = 120, .triangles = 800};
    shapes::DevelopablePart part = shapes::bent_flange(shape);
    FlattenOptions options;
    PlannedStep step;
};

} // namespace

TEST_F(TargetReachOfAFlange, IsItsFlatLengthAndFacesBeyondTheExtentHaveNoRoom)
{
    // chords over the bend, and the flange
    const double whole = part.flat.row(0).maxCoeff() - shape.base;
    EXPECT_NEAR(run().states.at(0).reach.farthest_mm, whole, 1e-6);
    EXPECT_EQ(run().states[0].reach.without_room, 0) << "without an extent there is room for all";
    for (const double extent : {0.3, 0.7, 0.99, 1.01}) {
        step.extent_mm = extent * whole;
        int beyond = 0;
        for (int f = 0; f < part.mesh.triangles(); ++f)
            beyond += part.flat(0, Eigen::all)(part.mesh.triangle.col(f)).maxCoeff() > shape.base + *step.extent_mm;
        const UnfoldRun again = run();
        EXPECT_EQ(again.states.at(0).reach.without_room, beyond);
        EXPECT_NEAR(again.states[0].reach.farthest_mm, whole, 1e-6);
    }
}

TEST_F(TargetReachOfAFlange, AnExtentThatMeansNothingIsRefused)
{
    const auto refusal = [&] {
        try {
            run();
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    step.extent_mm = 0;
    EXPECT_THAT(refusal(), testing::HasSubstr("extent of its target is 0 mm"));
    step.extent_mm = std::nan("");
    EXPECT_THAT(refusal(), testing::HasSubstr("extent of its target is nan mm"));
    step.extent_mm = 5;
    step.kind = UnfoldKind::flatten;
    step.pick.fixed.clear();
    EXPECT_THAT(refusal(), testing::HasSubstr("nothing carries it"));
}

} // namespace spia
