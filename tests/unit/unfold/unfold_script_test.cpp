#include "engine/unfold/step/unfold_script.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "tests/support/bent_parts.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"

namespace spia::unfold_script_test {
namespace {

using shapes::Profile;
using std::numbers::pi;

FlattenOptions steel()
{
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return options;
}

UnfoldRun automatic(const TriMesh& part, const SequenceOptions& options = {})
{
    return run_unfolding(part, propose_sequence(part, find_bends(part), options).steps, steel());
}

/// Greatest difference of a length between two corners of a face, as a share of it.
double most_stretch(const TriMesh& part, const Eigen::Matrix2Xd& flat)
{
    double most = 0;
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 0; a < 3; ++a) {
            const int i = part.triangle(a, f), k = part.triangle((a + 1) % 3, f);
            const double length = (part.position.col(i) - part.position.col(k)).norm();
            most = std::max(most, std::abs((flat.col(i) - flat.col(k)).norm() / length - 1));
        }
    return most;
}

/// The longest and the shortest side of a box around a flat shape along its own axes: a
/// rectangle's.
Eigen::Vector2d sides(const Eigen::Matrix2Xd& flat)
{
    const Eigen::Vector2d corner = flat.col(0);
    Eigen::Index far = 0;
    // a rectangle's diagonal, from a corner
    (flat.colwise() - corner).colwise().norm().maxCoeff(&far);
    const double diagonal = (flat.col(far) - corner).norm();
    double off = 0;
    const Eigen::Vector2d along = (flat.col(far) - corner) / diagonal;
    for (const auto& p : flat.colwise())
        off = std::max(off, std::abs(along.x() * (p - corner).y() - along.y() * (p - corner).x()));
    const double area = diagonal * off, sum = std::sqrt(diagonal * diagonal + 2 * area),
                 difference = std::sqrt(std::max(0.0, diagonal * diagonal - 2 * area));
    return {(sum + difference) / 2, (sum - difference) / 2};
}

} // namespace

TEST(UnfoldScript, BentSheetComesOutAsItsRectangleWithoutStrain)
{
    struct Case {
        Profile profile;
        double length;
        int triangles;
    };
    for (const Case& shape :
         {Case{Profile({0, 0}, 0).straight(40).bend(5, pi / 2).straight(30).bend(5, -pi / 2).straight(40), 120, 2000},
          Case{Profile({0, 0}, 0).straight(60).bend(3, pi).straight(15), 120, 4000},
          Case{Profile({0, 0}, 0).straight(60).bend(6, 1.5 * pi).straight(8), 120, 4000},
          Case{Profile({0, 0}, -pi / 2)
                   .straight(8)
                   .bend(6, -pi / 2)
                   .straight(12)
                   .bend(6, -pi / 2)
                   .straight(40)
                   .bend(6, -pi / 2)
                   .straight(60)
                   .bend(6, -pi / 2)
                   .straight(40)
                   .bend(6, -pi / 2)
                   .straight(12)
                   .bend(6, -pi / 2)
                   .straight(8),
               200, 3000}}) {
        const shapes::DevelopablePart part = shapes::extruded(shape.profile, shape.length, shape.triangles);
        const UnfoldRun run = automatic(part.mesh);
        ASSERT_EQ(run.failure, "");
        ASSERT_TRUE(run.blank);
        EXPECT_EQ(run.flipped, 0);
        EXPECT_LT(most_stretch(part.mesh, run.blank->position), 1e-6);
        const Eigen::Vector2d wanted = sides(part.flat), found = sides(run.blank->position);
        EXPECT_NEAR(found[0], wanted[0], 1e-4);
        EXPECT_NEAR(found[1], wanted[1], 1e-4);
        EXPECT_LT(run.states.back().face.strain_equivalent.maxCoeff(), 1e-6);
        EXPECT_EQ(run.states.back().face.strain_equivalent.size(), part.mesh.triangles());
    }
}

TEST(UnfoldScript, AFlangedCylinderPanelIsLaidOnItsCylinderAndUnrolled)
{
    const shapes::DevelopablePart part =
        shapes::extruded(Profile({0, 0}, 0).bend(150, pi / 3).bend(5, pi / 2).straight(20), 150, 4000);
    const UnfoldRun run = automatic(part.mesh);
    ASSERT_EQ(run.failure, "");
    ASSERT_EQ(run.states.size(), 2u);
    const auto* cylinder = std::get_if<CylinderFace>(&run.states[0].on->face);
    ASSERT_NE(cylinder, nullptr);
    for (const auto& x : run.states[0].position.colwise()) // all of it lies on the cylinder
        EXPECT_NEAR((x - cylinder->origin).cross(cylinder->axis).norm(), 150, 1e-3);
    ASSERT_TRUE(run.blank);
    EXPECT_EQ(run.flipped, 0);
    const Eigen::Vector2d found = sides(run.blank->position);
    const double around = 150 * pi / 3 + 5 * pi / 2 + 20;
    EXPECT_NEAR(found[0], around, 0.005 * around) << "chords of the bend";
    EXPECT_NEAR(found[1], 150, 0.01);
}

TEST(UnfoldScript, ABoxWithLipsEndsFlatAndWithoutAFlip)
{
    for (const bool joined : {false, true}) {
        const TriMesh part = shapes::lipped_box({.joined = joined});
        const UnfoldRun run = automatic(part);
        ASSERT_EQ(run.failure, "");
        ASSERT_EQ(run.states.size(), 5u);
        ASSERT_TRUE(run.blank);
        EXPECT_EQ(run.flipped, 0);
        if (!joined) { // only bent: nothing is strained
            EXPECT_LT(most_stretch(part, run.blank->position), 1e-6);
        }
        EXPECT_EQ((run.states[0].step.array() == 1).count(), 64) << "faces of the first lip";
        EXPECT_EQ((run.states[3].step.array() == 4).count(), 40) << "faces of the last lip";
        EXPECT_EQ((run.states[4].step.array() == 5).count() + (run.states[4].step.array() == 0).count(),
                  part.triangles());
        EXPECT_EQ(run.states[4].face.strain_equivalent.maxCoeff() > 0.05, joined) << "corners are drawn";
    }
}

TEST(UnfoldScript, OnAMeshAcrossItsBendLinesTheFlatsAreStillLaidOneByOne)
{
    shapes::PerforatedChannel shape;
    shape.channel.triangles = 3000;
    const TriMesh part = shapes::perforated_channel(shape).mesh;
    const UnfoldRun run = automatic(part);
    ASSERT_EQ(run.failure, "");
    ASSERT_EQ(run.states.size(), 4u) << "two flanges, the walls, and what stands out of the top's plane by a chord";
    ASSERT_TRUE(run.blank);
    EXPECT_EQ(run.flipped, 0);
    EXPECT_LT(run.states.back().face.strain_equivalent.maxCoeff(), 0.02) << "only chords over the radii";
    const shapes::HatChannel& hat = shape.channel;
    const double across = 2 * (hat.flange + hat.wall) + hat.top + 4 * hat.radius * pi / 2;
    const Eigen::Vector2d size = run.blank->position.rowwise().maxCoeff() - run.blank->position.rowwise().minCoeff();
    EXPECT_NEAR(size[0], across, 0.01 * across);
    EXPECT_NEAR(size[1], hat.length, 0.005 * hat.length) << "the blank lies along its longer side";
}

TEST(UnfoldScript, TheOrderOfIndependentStepsDoesNotMatter)
{
    const TriMesh part = shapes::lipped_channel({.triangles = 2000}).mesh;
    UnfoldScript script = propose_sequence(part, find_bends(part), {.unite = false}).steps;
    const UnfoldRun one = run_unfolding(part, script, steel());
    std::swap(script[0], script[1]);
    std::swap(script[4], script[5]);
    const UnfoldRun other = run_unfolding(part, script, steel());
    ASSERT_TRUE(one.blank && other.blank);
    EXPECT_LT((one.states.back().position - other.states.back().position).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(UnfoldScript, FromAnyStepItIsDoneAgainWithTheSameBits)
{
    const TriMesh part = shapes::lipped_box();
    const UnfoldScript script = propose_sequence(part, find_bends(part)).steps;
    const UnfoldRun whole = run_unfolding(part, script, steel());
    for (const size_t keep : {size_t(1), size_t(3), script.size()}) {
        const UnfoldRun again = run_unfolding(part, script, steel(), {}, &whole, keep);
        ASSERT_EQ(again.states.size(), whole.states.size());
        EXPECT_EQ(again.states.back().position, whole.states.back().position);
        EXPECT_EQ(again.states.back().face.thinning, whole.states.back().face.thinning);
        ASSERT_TRUE(again.blank);
        EXPECT_EQ(again.blank->position, whole.blank->position);
    }
    EXPECT_THROW(run_unfolding(part, script, steel(), {}, &whole, script.size() + 1), InputError);
    EXPECT_THROW(run_unfolding(part, script, steel(), {}, nullptr, 1), InputError);
    EXPECT_THROW(run_unfolding(part, {}, steel()), InputError);
}

TEST(UnfoldScript, AStepWithoutAResultLeavesTheStatesBeforeIt)
{
    const TriMesh part = shapes::lipped_box();
    UnfoldScript script = propose_sequence(part, find_bends(part)).steps;
    script[2].pick.carrying = script[2].pick.freed; // not fixed
    const UnfoldRun run = run_unfolding(part, script, steel());
    EXPECT_EQ(run.states.size(), 2u);
    EXPECT_NE(run.failure, "");
    EXPECT_FALSE(run.blank);
}

TEST(UnfoldScript, ATargetIsMovedToItsOuterSide)
{
    const CylinderFace cylinder{{1, 2, 3}, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), 10, true};
    const ConeFace cone{{1, 2, 3}, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), 0.4, false};
    const PlaneFace plane{{1, 2, 3}, Eigen::Matrix<double, 3, 2>::Identity()};
    CylinderFace hollow = cylinder;
    hollow.bulges = false;
    for (const TargetSurface& face :
         {TargetSurface(cylinder), TargetSurface(hollow), TargetSurface(cone), TargetSurface(plane)})
        for (const double mm : {2.0, -1.5}) {
            const Eigen::Vector3d on = placed(face, developed(face, {9, 3, 20}));
            const TargetSurface moved = moved_out(face, mm);
            const Eigen::Vector3d there = placed(moved, developed(moved, on));
            EXPECT_NEAR((there - on - mm * outer_normal(face, on)).norm(), 0, 1e-9) << name(face);
        }
    EXPECT_THROW(moved_out(cylinder, -10), InputError);
}

TEST(UnfoldScript, TheTangentPlaneTouchesInTheMiddleOfThePlaces)
{
    const CylinderFace cylinder{{1, 2, 3}, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), 10, true};
    const Eigen::Matrix2Xd places = (Eigen::Matrix2Xd(2, 2) << 4, 10, -3, 5).finished();
    const PlaneFace plane = tangent_plane(cylinder, places);
    const Eigen::Vector2d middle(7, 1);
    EXPECT_LT((placed(TargetSurface(plane), middle) - placed(TargetSurface(cylinder), middle)).norm(), 1e-9);
    EXPECT_LT((outer_normal(TargetSurface(plane), {0, 0, 0}) -
               outer_normal(TargetSurface(cylinder), placed(TargetSurface(cylinder), middle)))
                  .norm(),
              1e-6);
}

TEST(UnfoldScript, ACylinderIsUnrolledOntoThePlaneThatTouchesItInTheMiddle)
{
    const TriMesh part = shapes::quarter_cylinder({.radius = 50, .length = 80, .triangles = 1000}).mesh;
    const UnfoldRun run = automatic(part);
    ASSERT_EQ(run.states.size(), 1u);
    ASSERT_TRUE(run.blank);
    const Eigen::Vector2d found = sides(run.blank->position);
    EXPECT_NEAR(found[0], 80, 1e-6);
    EXPECT_NEAR(found[1], 50 * pi / 2, 1e-6);
    // In the middle of the panel it stays where it was.
    double least = 1e9;
    for (int v = 0; v < part.vertices(); ++v)
        least = std::min(least, (run.states[0].position.col(v) - part.position.col(v)).norm());
    EXPECT_LT(least, 1e-2);
    EXPECT_EQ(run.flipped, 0);
}

TEST(UnfoldScript, UnrollsSheetThatGoesAroundMoreThanOnceButNoTube)
{
    for (const double taper : {0.0, 0.3}) // a cylinder, a cone
        for (const double angle : {1.5 * pi, 2 * pi, 3 * pi, 5 * pi}) {
            const auto round = [&](double u, double v) {
                const double r = 50 + 30 * taper * v;
                return Eigen::Vector3d(r * std::cos(angle * u), r * std::sin(angle * u), 30 * v);
            };
            const TriMesh part = shapes::grid_surface({300, 4}, round);
            PlannedStep step;
            step.kind = UnfoldKind::unroll;
            step.pick.freed.resize(size_t(part.triangles()));
            std::iota(step.pick.freed.begin(), step.pick.freed.end(), 0);
            step.pick.carrying = step.pick.freed;
            const UnfoldRun run = run_unfolding(part, {step}, steel());
            ASSERT_TRUE(run.blank) << taper << ", " << angle << ": " << run.failure;
            EXPECT_EQ(run.flipped, 0);
            if (taper == 0) { // the arc over each facet becomes its chord when it is formed
                const double half = angle / 300 / 2, shortened = std::log(std::sin(half) / half);
                for (int f = 0; f < part.triangles(); ++f) {
                    EXPECT_NEAR(run.states[0].face.strain_minor[f], shortened, 1e-9);
                    EXPECT_NEAR(run.states[0].face.strain_major[f], 0, 1e-9);
                }
            }
            double area = 0; // of the face, not of its facets
            for (const auto& t : part.triangle.colwise()) {
                const Eigen::Vector2d a = run.blank->position.col(t[0]), p = run.blank->position.col(t[1]) - a,
                                      q = run.blank->position.col(t[2]) - a;
                area += (p.x() * q.y() - p.y() * q.x()) / 2;
            }
            EXPECT_NEAR(area / (angle * (50 + 15 * taper) * 30 * std::hypot(1, taper)), 1, 2e-3) << angle;
        }
    const TriMesh tube = shapes::grid_surface({60, 4, true}, [](double u, double v) {
        return Eigen::Vector3d(50 * std::cos(2 * pi * u), 50 * std::sin(2 * pi * u), 30 * v);
    });
    PlannedStep step;
    step.kind = UnfoldKind::unroll;
    step.pick.freed.resize(size_t(tube.triangles()));
    std::iota(step.pick.freed.begin(), step.pick.freed.end(), 0);
    step.pick.carrying = step.pick.freed;
    EXPECT_NE(run_unfolding(tube, {step}, steel()).failure.find("goes all around"), std::string::npos);
}

} // namespace spia::unfold_script_test
