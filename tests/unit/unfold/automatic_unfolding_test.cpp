#include "engine/unfold/automatic_unfolding.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>
#include <stdexcept>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/region.h"
#include "engine/mesh/topology.h"
#include "engine/unfold/plan/carriers.h"
#include "tests/support/bent_parts.h"
#include "tests/support/fender.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shape_family.h"
#include "tests/support/shapes.h"

namespace spia::automatic_unfolding_test {
namespace {

using shapes::Profile;
using std::numbers::pi;

FlattenOptions steel()
{
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return options;
}

TriMesh plate_with_a_hole()
{
    const TriMesh whole = shapes::plate();
    const Eigen::Vector3d middle = (whole.position.rowwise().minCoeff() + whole.position.rowwise().maxCoeff()) / 2;
    const double hole = 0.1 * bounding_diagonal(whole);
    return shapes::without_faces(whole, [&](const Eigen::Vector3d& at) { return (at - middle).norm() < hole; });
}

TriMesh fender() { return shapes::fender({.triangles = 2500}).mesh; }

/// Gently curved in its middle, not by one radius; flanges on two sides, one of a length.
shapes::DevelopablePart crowned_panel(double flange = 20)
{
    return shapes::extruded(Profile({0, 0}, pi / 2)
                                .straight(flange)
                                .bend(4, -pi / 2)
                                .bend(900, -0.1)
                                .bend(500, -0.15)
                                .bend(4, -pi / 2)
                                .straight(20),
                            120, 3000);
}

double greatest_edge_difference(const TriMesh& part, const Blank& a, const Blank& b)
{
    double most = 0;
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = part.triangle(k, f), w = part.triangle((k + 1) % 3, f);
            most = std::max(most, std::abs((a.position.col(v) - a.position.col(w)).norm() -
                                           (b.position.col(v) - b.position.col(w)).norm()));
        }
    return most;
}

} // namespace

TEST(AutomaticUnfolding, FlangesOfACurvedPanelAreLaidOnTheSmoothFaceThroughIt)
{
    const shapes::DevelopablePart panel = crowned_panel();
    const TriMesh& part = panel.mesh;
    const BendMap map = find_bends(part);
    const AutomaticUnfolding unfolded = automatic_unfolding(part, map, {}, steel());
    ASSERT_EQ(unfolded.run.failure, "");
    ASSERT_EQ(unfolded.sequence.steps.size(), 2u);
    EXPECT_TRUE(unfolded.sequence.notes.empty());
    EXPECT_EQ(unfolded.run.states[0].plain, "smooth");
    EXPECT_TRUE(unfolded.run.states[0].converged);
    EXPECT_LT(unfolded.run.states[0].face.strain_equivalent.maxCoeff(), 2e-3) << "a developable sheet on another one";
    EXPECT_EQ(unfolded.sequence.steps[1].kind, UnfoldKind::flatten);
    ASSERT_TRUE(unfolded.run.blank);
    EXPECT_EQ(unfolded.run.flipped, 0);
    const Eigen::Vector2d size =
        unfolded.run.blank->position.rowwise().maxCoeff() - unfolded.run.blank->position.rowwise().minCoeff();
    EXPECT_NEAR(size[0], panel.flat.row(0).maxCoeff() - panel.flat.row(0).minCoeff(), 1e-3);
    EXPECT_NEAR(size[1], 120, 1e-3);
}

TEST(AutomaticUnfolding, FlatteningAfterTheStepsEndsInTheBlankOfFlatteningAtOnce)
{
    const TriMesh part = fender();
    const AutomaticUnfolding unfolded = automatic_unfolding(part, find_bends(part), {}, steel());
    ASSERT_TRUE(unfolded.run.blank) << unfolded.run.failure;
    ASSERT_GT(unfolded.run.states.size(), 1u);
    const FlattenResult at_once = flatten(part, steel());
    EXPECT_LT(greatest_edge_difference(part, *unfolded.run.blank, at_once.blank), 1e-3);
}

TEST(AutomaticUnfolding, AStepThatStrainsTheSheetMoreThanTheEndDoesIsLeftOut)
{
    const TriMesh part = shapes::fender({.triangles = 5000}).mesh;
    const BendMap map = find_bends(part);
    const UnfoldScript first = propose_sequence(part, map).steps;
    const UnfoldRun whole = run_unfolding(part, first, steel());
    const auto strain = [](const UnfoldState& state) { return state.face.strain_equivalent.maxCoeff(); };
    ASSERT_GT(strain(whole.states.at(1)), 0.1) << "else there is nothing to leave out";
    ASSERT_LT(strain(whole.states.back()), 0.03);
    const AutomaticUnfolding unfolded = automatic_unfolding(part, map, {}, steel());
    ASSERT_EQ(unfolded.run.states.size(), first.size() - 1);
    EXPECT_EQ(unfolded.sequence.steps[0].name, first[0].name) << "which strains it by less than 1 %";
    EXPECT_LT(strain(unfolded.run.states[0]), 0.01);
    EXPECT_NE(unfolded.sequence.notes.back().find("it strains the sheet by 0.18"), std::string::npos)
        << unfolded.sequence.notes.back();
    ASSERT_TRUE(unfolded.run.blank);
    EXPECT_LT(greatest_edge_difference(part, *unfolded.run.blank, *whole.blank), 1e-3);
}

TEST(AutomaticUnfolding, FlatteningStartsFromHowStepsHaveLeftThePart)
{
    const TriMesh part = fender();
    const FlattenResult at_once = flatten(part, steel());
    Eigen::Matrix3Xd state = Eigen::Matrix3Xd::Zero(3, part.vertices()); // nothing is left to do
    state.topRows<2>() = at_once.blank.position;
    UnfoldPick pick;
    pick.freed = inverted({}, part.triangles());
    pick.target = PlaneFace{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity().leftCols<2>()};
    const UnfoldStepResult result = unfold_step(part, state, pick, steel());
    const auto steps = [](const SolveReport& report) { return report.energy.size() + report.newton.size(); };
    EXPECT_TRUE(result.converged());
    EXPECT_LT(2 * steps(result.piece[0].report), steps(at_once.report));
    EXPECT_LT(greatest_edge_difference(part, {result.position.topRows<2>()}, at_once.blank),
              1e-3); // of 880 mm, solved to 1e-8 of the forces
}

TEST(AutomaticUnfolding, ASmoothFaceThatIsNotNearOrTurnsTooFarCarriesNothing)
{
    const TriMesh part = fender();
    const BendMap map = find_bends(part);
    Carriers near(part, map, 1), far(part, map, 1e-6);
    const auto carrying = [&](Carriers& carriers) {
        int count = 0;
        for (int r = 0; r < int(map.regions.size()); ++r)
            if (const TargetFit* fit = carriers.of(r); fit && !carriers.plain(r)) {
                EXPECT_TRUE(std::holds_alternative<HeightFace>(fit->face));
                EXPECT_LE(fit->distance_mm, 1);
                EXPECT_LE(fit->angle, 0.2);
                EXPECT_FALSE(carriers.loose(r));
                ++count;
            }
        return count;
    };
    EXPECT_GT(carrying(near), 0);
    EXPECT_EQ(carrying(far), 0);
    const UnfoldSequence sequence = propose_sequence(part, map, {.distance = 1e-9});
    ASSERT_EQ(sequence.steps.size(), 1u);
    EXPECT_EQ(sequence.steps[0].kind, UnfoldKind::flatten);
    ASSERT_FALSE(sequence.notes.empty());
    EXPECT_NE(sequence.notes[0].find("the smooth face through it is"), std::string::npos) << sequence.notes[0];
}

TEST(AutomaticUnfolding, AStepThatDoesNotConvergeIsPlannedAnewOnlyIfThatConverges)
{
    const auto unfolded = [](const std::string& family, int number) {
        for (const shapes::FamilyShape& shape : shapes::shape_family(600, 1))
            if (shape.family == family && shape.number == number) {
                const TriMesh part = shape.make();
                return automatic_unfolding(part, find_bends(part), {}, steel());
            }
        throw std::runtime_error("there is no such shape");
    };
    const AutomaticUnfolding better = unfolded("whiskers", 2);
    ASSERT_EQ(better.run.states.size(), 1u);
    EXPECT_EQ(better.sequence.steps[0].kind, UnfoldKind::flatten);
    EXPECT_TRUE(better.run.states[0].converged);
    ASSERT_FALSE(better.sequence.notes.empty());
    EXPECT_NE(better.sequence.notes.back().find("did not converge"), std::string::npos);
    // on this mesh nothing converges to the tolerance
    const AutomaticUnfolding no_better = unfolded("needles", 4);
    EXPECT_EQ(no_better.sequence.steps.size(), 3u);
    EXPECT_EQ(no_better.run.states.size(), 3u);
    EXPECT_TRUE(no_better.run.blank);
    EXPECT_FALSE(no_better.run.states[0].converged);
    for (const std::string& note : no_better.sequence.notes)
        EXPECT_EQ(note.find("replanned"), std::string::npos) << note;
}

TEST(AutomaticUnfolding, AStepWithoutAResultIsPlannedAnew)
{
    // Allowed to be far beside its plane, the flat-ish middle carries the flanges; the step itself
    // refuses that. The long flange could be the root, too: it must not become it.
    const TriMesh part = crowned_panel(70).mesh;
    const BendMap map = find_bends(part);
    const SequenceOptions loose{.distance = 0.08};
    const UnfoldSequence first = propose_sequence(part, map, loose);
    ASSERT_EQ(first.steps[0].kind, UnfoldKind::lay);
    ASSERT_NE(run_unfolding(part, first.steps, steel()).failure, "") << "or this test shows nothing";
    const AutomaticUnfolding unfolded = automatic_unfolding(part, map, loose, steel());
    EXPECT_EQ(unfolded.run.failure, "");
    ASSERT_TRUE(unfolded.run.blank);
    EXPECT_EQ(unfolded.run.flipped, 0);
    EXPECT_EQ(unfolded.sequence.root, first.root);
    ASSERT_FALSE(unfolded.sequence.notes.empty());
    EXPECT_NE(unfolded.sequence.notes.back().find("failed ("), std::string::npos);
    EXPECT_EQ(unfolded.run.states.size(), unfolded.sequence.steps.size());
}

TEST(AutomaticUnfolding, WhatGoesAllAroundAConeIsFlattenedNotUnrolled)
{
    const Eigen::Matrix2Xd meridian = (Eigen::Matrix2Xd(2, 2) << 30, 60, 80, 0).finished();
    const TriMesh ring = shapes::axisymmetric(meridian, 3000).mesh;
    const AutomaticUnfolding unfolded = automatic_unfolding(ring, find_bends(ring), {}, steel());
    EXPECT_EQ(unfolded.run.failure, "");
    EXPECT_TRUE(unfolded.sequence.notes.empty()) << "planned so at once: " << unfolded.sequence.notes[0];
    ASSERT_EQ(unfolded.sequence.steps.size(), 1u);
    EXPECT_EQ(unfolded.sequence.steps[0].kind, UnfoldKind::flatten);
    EXPECT_EQ(unfolded.run.flipped, 0);
}

TEST(AutomaticUnfolding, AFlatPartIsTakenAsItIs)
{
    for (const double turn : {0., 0.4, 2.}) {
        const TriMesh plate = shapes::transformed(
            plate_with_a_hole(), Eigen::AngleAxisd(turn, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix(),
            {0, 0, 0});
        const AutomaticUnfolding unfolded = automatic_unfolding(plate, find_bends(plate), {}, steel());
        ASSERT_EQ(unfolded.sequence.steps.size(), 1u);
        EXPECT_EQ(unfolded.sequence.steps[0].kind, UnfoldKind::unroll);
        EXPECT_EQ(unfolded.run.failure, "");
        ASSERT_TRUE(unfolded.run.blank);
        EXPECT_EQ(unfolded.run.flipped, 0);
        const Eigen::Matrix2Xd& flat = unfolded.run.blank->position;
        for (int f = 0; f < plate.triangles(); ++f) // no length changes
            for (int k = 0; k < 3; ++k) {
                const int a = plate.triangle(k, f), b = plate.triangle((k + 1) % 3, f);
                EXPECT_NEAR((flat.col(a) - flat.col(b)).norm(), (plate.position.col(a) - plate.position.col(b)).norm(),
                            1e-9);
            }
    }
}

} // namespace spia::automatic_unfolding_test
