#include "engine/core/error.h"
#include "tests/support/developable.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"
#include "tests/support/square_cup.h"
#include "tests/unit/unfold/step_fixture.h"

namespace spia {

using namespace steps;

TEST(UnfoldStep, AFlangeBentOverARadiusComesOutFlatWithItsLength)
{
    for (const double angle : {30., 90., 135., 180., 250.}) {
        const shapes::BentFlange shape{.angle_deg = angle, .triangles = 1500};
        const shapes::DevelopablePart part = shapes::bent_flange(shape);
        const auto on_base = [&](const Eigen::VectorXd& at) { return at[0] < shape.base; };
        const std::vector<int> fixed = faces_where(part.flat, part.mesh, on_base);
        const std::vector<int> freed =
            faces_where(part.flat, part.mesh, [&](const Eigen::VectorXd& at) { return !on_base(at); });
        const UnfoldStepResult result = unfold_step(part.mesh, part.mesh.position, {fixed, freed}, steel());
        EXPECT_TRUE(result.converged()) << angle;
        EXPECT_EQ(name(result.target.face), "plane");
        EXPECT_LT(largest_strain(result.face), 1e-8) << angle;
        EXPECT_LT(furthest(result.position, in_space(part.flat)), 1e-6) << angle; // mm
        EXPECT_EQ(result.freed, freed);
        EXPECT_EQ(result.piece.size(), 1u);
    }
}

TEST(UnfoldStep, TwoFlangesInOneStepOrInEitherOrderAreTheSame)
{
    const shapes::HatChannel shape{.triangles = 3000};
    const shapes::DevelopablePart hat = shapes::hat_channel(shape);
    const double middle = (hat.flat.row(0).minCoeff() + hat.flat.row(0).maxCoeff()) / 2, half = shape.top / 2;
    const auto where = [&](double from, double to) {
        return faces_where(hat.flat, hat.mesh,
                           [&](const Eigen::VectorXd& at) { return at[0] - middle > from && at[0] - middle < to; });
    };
    const std::vector<int> top = where(-half, half), left = where(-1e9, -half), right = where(half, 1e9);
    std::vector<int> both = left;
    both.insert(both.end(), right.begin(), right.end());
    const UnfoldStepResult once = unfold_step(hat.mesh, hat.mesh.position, {top, both}, steel());
    ASSERT_EQ(once.piece.size(), 2u);
    EXPECT_LT(largest_strain(once.face), 1e-8);
    const auto in_order = [&](const std::vector<int>& first, const std::vector<int>& then) {
        const UnfoldStepResult half_way = unfold_step(hat.mesh, hat.mesh.position, {top, first}, steel());
        for (const int f : then)
            for (const int v : hat.mesh.triangle.col(f))
                EXPECT_EQ(half_way.position.col(v), hat.mesh.position.col(v));
        return unfold_step(hat.mesh, half_way.position, {top, then}, steel()).position;
    };
    EXPECT_LT(furthest(in_order(left, right), once.position), 1e-9);
    EXPECT_LT(furthest(in_order(right, left), once.position), 1e-9);
    // Z sections: wall and flange of either side turn opposite ways.
    EXPECT_NEAR(once.position.row(2).maxCoeff(), once.position.row(2).minCoeff(), 1e-6);
    EXPECT_NEAR(once.position.row(0).maxCoeff() - once.position.row(0).minCoeff(),
                hat.flat.row(0).maxCoeff() - hat.flat.row(0).minCoeff(), 1e-6);
}

TEST(UnfoldStep, StepAfterStepIsTheSameAsAllAtOnceAndTheStrainIsThatOfThePart)
{
    const shapes::LippedChannel shape{.triangles = 3000};
    const shapes::DevelopablePart part = shapes::lipped_channel(shape);
    const double middle = (part.flat.row(0).minCoeff() + part.flat.row(0).maxCoeff()) / 2;
    const auto beyond = [&](double from) {
        return faces_where(part.flat, part.mesh,
                           [&](const Eigen::VectorXd& at) { return std::abs(at[0] - middle) > from; });
    };
    const auto within = [&](double from, double to) {
        return faces_where(part.flat, part.mesh, [&](const Eigen::VectorXd& at) {
            return std::abs(at[0] - middle) < to && std::abs(at[0] - middle) > from;
        });
    };
    const double chord =
        (part.flat.row(0).maxCoeff() - middle - shape.top / 2 - shape.wall - shape.flange - shape.lip) / 3;
    const double wall = shape.top / 2 + chord, wall_end = wall + shape.wall, flange = wall_end + chord,
                 flange_end = flange + shape.flange;
    const std::vector<int> top = within(-1, shape.top / 2);
    const UnfoldStepResult once = unfold_step(part.mesh, part.mesh.position, {top, beyond(shape.top / 2)}, steel());
    // Lips onto flanges, on either side a plane of its own; flanges onto walls; walls onto the top.
    Eigen::Matrix3Xd state = part.mesh.position;
    for (const bool right : {false, true}) {
        const auto side = [&](std::vector<int> faces) {
            std::erase_if(faces, [&](int f) { return (part.flat(0, part.mesh.triangle(0, f)) > middle) != right; });
            return faces;
        };
        state = unfold_step(part.mesh, state, {side(within(flange, flange_end)), side(beyond(flange_end))}, steel())
                    .position;
        state = unfold_step(part.mesh, state, {side(within(wall, wall_end)), side(beyond(wall_end))}, steel()).position;
    }
    const UnfoldStepResult last = unfold_step(part.mesh, state, {top, beyond(shape.top / 2)}, steel());
    EXPECT_LT(furthest(last.position, once.position), 1e-6);
    EXPECT_LT(largest_strain(last.face), 1e-8);
    EXPECT_LT(largest_strain(once.face), 1e-8);
    // A state that is strained does not count: the strain is that of the part.
    Eigen::Matrix3Xd strained = state;
    strained.row(1) *= 1.02;
    for (const int f : top)
        for (const int v : part.mesh.triangle.col(f))
            strained.col(v) = part.mesh.position.col(v);
    EXPECT_LT(furthest(unfold_step(part.mesh, strained, {top, beyond(shape.top / 2)}, steel()).position, once.position),
              1e-6);
}

TEST(UnfoldStep, AHemIsTurnedBackOntoItsWallAndThenDown)
{
    // A wall at 90 degrees whose lip is folded back flat onto it.
    const shapes::DevelopablePart part = shapes::hemmed_flange({.triangles = 3000});
    const shapes::HemmedFlange shape{};
    // any chord of the bend
    const double wall = shape.base + 2 * shape.radius * 8 * std::sin(pi / 32);
    const auto where = [&](const auto& is) { return faces_where(part.flat, part.mesh, is); };
    const std::vector<int> base = where([&](const Eigen::VectorXd&at) { return at[0] < shape.base; }),
                           rest = where([&](const Eigen::VectorXd&at) { return at[0] > shape.base; });
    std::vector<int> upright, lip; // upright: faces that look along x, before the hem
    for (const int f : rest) {
        const Eigen::Matrix3d x = part.mesh.position(Eigen::all, part.mesh.triangle.col(f));
        const Eigen::Vector3d n = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).normalized();
        const double s = part.flat(0, part.mesh.triangle(0, f));
        if (s > wall && n[0] < -1 + 1e-9)
            upright.push_back(f);
        else if (s > wall)
            lip.push_back(f);
    }
    ASSERT_FALSE(upright.empty());
    const UnfoldStepResult open = unfold_step(part.mesh, part.mesh.position, {upright, lip}, steel());
    EXPECT_LT(largest_strain(open.face), 1e-8);
    EXPECT_NEAR(open.position.row(2).maxCoeff(),
                shape.radius + shape.wall + part.flat.row(0).maxCoeff() -
                    (part.flat(Eigen::all, part.mesh.triangle(Eigen::all, upright).reshaped()).row(0).maxCoeff()),
                1e-6);
    const UnfoldStepResult flat = unfold_step(part.mesh, open.position, {base, rest}, steel());
    const UnfoldStepResult once = unfold_step(part.mesh, part.mesh.position, {base, rest}, steel());
    EXPECT_LT(furthest(flat.position, in_space(part.flat)), 1e-6);
    EXPECT_LT(furthest(once.position, flat.position), 1e-6);
}

TEST(UnfoldStep, TheResultMovesAndTurnsWithThePart)
{
    const shapes::SharpCup shape{.triangles = 1500};
    const shapes::AxisymmetricPart cup = shapes::sharp_cup(shape);
    const std::vector<int> bottom = faces_where(cup.arc_length.transpose(), cup.mesh,
                                                [&](const Eigen::VectorXd& s) { return s[0] < shape.radius; });
    const std::vector<int> wall = faces_where(cup.arc_length.transpose(), cup.mesh,
                                              [&](const Eigen::VectorXd& s) { return s[0] > shape.radius; });
    const UnfoldStepResult here = unfold_step(cup.mesh, cup.mesh.position, {bottom, wall}, steel());
    const Eigen::Matrix3d turn = shapes::random_rotation(8);
    const Eigen::Vector3d way(3000, -1200, 500);
    const TriMesh moved = shapes::transformed(cup.mesh, turn, way);
    const UnfoldStepResult there = unfold_step(moved, moved.position, {bottom, wall}, steel());
    EXPECT_LT(furthest(there.position, (turn * here.position).colwise() + way), 1e-5);
    EXPECT_LT((there.face.thickness - here.face.thickness).cwiseAbs().maxCoeff(), 1e-7);
    // The order of the pick is of no account: the same bits.
    std::vector<int> reversed(wall.rbegin(), wall.rend());
    reversed.push_back(wall[0]);
    const UnfoldStepResult again = unfold_step(cup.mesh, cup.mesh.position, {bottom, reversed}, steel());
    EXPECT_EQ(again.position, here.position);
    // Turned over, the part has the same blank.
    TriMesh over = cup.mesh;
    over.triangle.row(1).swap(over.triangle.row(2));
    EXPECT_LT(furthest(unfold_step(over, over.position, {bottom, wall}, steel()).position, here.position), 1e-5);
    // A target that looks the other way is the same plane.
    PlaneFace below{{5, 5, 0}, Eigen::Matrix<double, 3, 2>::Identity()};
    below.axes.col(0) *= -1;
    EXPECT_LT(
        furthest(unfold_step(cup.mesh, cup.mesh.position, {bottom, wall, below}, steel()).position, here.position),
        1e-5);
}

} // namespace spia
