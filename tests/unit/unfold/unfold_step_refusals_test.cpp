#include "engine/core/error.h"
#include "engine/core/text.h"
#include "tests/support/developable.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"
#include "tests/support/square_cup.h"
#include "tests/unit/unfold/step_fixture.h"

namespace spia::unfold_step_refusals_test {

using namespace steps;

namespace {

/// The message of the InputError that a step ends with.
std::string refusal(const TriMesh& part, const UnfoldPick& pick, const FlattenOptions& options = steel())
{
    try {
        unfold_step(part, part.position, pick, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

std::vector<int> counted(int from, int to)
{
    std::vector<int> out;
    for (int f = from; f < to; ++f)
        out.push_back(f);
    return out;
}

} // namespace

TEST(UnfoldStep, WhatCannotBeUnfoldedIsRefusedWithItsFace)
{
    // Two rows of faces in the plane, then four upright ones: faces 0 to 19, 20 to 39, ... row by
    // row.
    const TriMesh part = shapes::grid_surface({10, 6}, [](double u, double v) {
        return Eigen::Vector3d(60 * u, std::min(60 * v, 20.), std::max(60 * v - 20, 0.));
    });
    const std::vector<int> flat = counted(0, 40), upright = counted(40, 120);
    EXPECT_EQ(refusal(part, {flat, upright}), "none");
    const auto expect = [&](const std::string& words, const std::string& message) {
        EXPECT_NE(message.find(words), std::string::npos) << message;
    };
    expect("no face is freed", refusal(part, {flat, {}}));
    expect("the freed faces name face 120; the part has faces 0 to 119", refusal(part, {flat, {120}}));
    expect("the fixed faces name face -1", refusal(part, {{-1}, upright}));
    expect("the carrying faces name face 500", refusal(part, {flat, upright, {}, {500}}));
    expect("face 40 shall carry the target but is not fixed", refusal(part, {flat, upright, {}, {0, 40}}));
    expect("face 39 is picked both to stay and to move", refusal(part, {flat, counted(39, 120)}));
    expect("nothing says where the freed faces shall lie", refusal(part, {{}, counted(0, 120)}));
    expect("the fixed faces around face 0 lie on no plane, cylinder or cone",
           refusal(part, {counted(0, 80), counted(80, 120)}));
    EXPECT_EQ(refusal(part, {counted(0, 80), counted(80, 120), {}, counted(40, 80)}), "none") << "some carry it";
    expect("is neither freed nor fixed and would be torn off", refusal(part, {flat, counted(40, 100)}));
    expect("the freed face 80 is joined to face 60",
           refusal(part, {counted(20, 40), counted(80, 120), fit_target(part, flat)->face}));
    expect("ends 20 mm off the target",
           refusal(part, {flat, upright, PlaneFace{{0, 0, 20}, Eigen::Matrix<double, 3, 2>::Identity()}}));
    expect("joined to no fixed face; then only a plane can be their target, not a cylinder",
           refusal(part, {{}, counted(0, 120), CylinderFace{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 50, true}}));
    FlattenOptions options = steel();
    options.thickness = 0;
    expect("the sheet thickness is 0 mm", refusal(part, {flat, upright}, options));
    options = steel();
    options.process.edge_restraint = 0.5;
    expect("act on the part as a whole", refusal(part, {flat, upright}, options));
    EXPECT_THROW(unfold_step(part, part.position.leftCols(5), {flat, upright}, steel()), InputError);
    TriMesh flawed = part; // a face of the flange without area
    flawed.position.col(flawed.triangle(0, 100)) = flawed.position.col(flawed.triangle(1, 100));
    expect("has no area in the part", refusal(flawed, {flat, upright}));
    const TriMesh corners = shapes::without_faces(shapes::rectangle(20, 20, 2, 2), [](const Eigen::Vector3d& middle) {
        return (middle[0] < 10) != (middle[1] < 10);
    });
    const PlaneFace ground{{0, 0, 0}, Eigen::Matrix<double, 3, 2>::Identity()};
    expect("the freed faces 1 and 2 touch in one vertex only", refusal(corners, {{}, counted(0, 4), ground}));
    expect("touch the fixed ones in single vertices only", refusal(corners, {{0, 1}, {2, 3}}));
    // What closes a tube has no place on it.
    const shapes::AxisymmetricPart cup = shapes::sharp_cup({.triangles = 1000});
    const auto bottom = [](const Eigen::VectorXd& at) { return at[2] > -1e-9; };
    expect("close the cylinder that they are joined to all the way around",
           refusal(cup.mesh,
                   {faces_where(cup.mesh.position, cup.mesh, [&](const Eigen::VectorXd& at) { return !bottom(at); }),
                    faces_where(cup.mesh.position, cup.mesh, bottom)}));
    const TriMesh ball = shapes::closed_sphere(20, 300), ring = shapes::torus(30, 10, 600);
    expect("are closed", refusal(ball, {{}, counted(0, ball.triangles()), ground}));
    expect("have a handle (genus 1)", refusal(ring, {{0, 1}, counted(2, ring.triangles()), ground, {}}));
}

TEST(UnfoldStep, ALoopBetweenFixedEdgesThatOverlapHasNoPlaceWithoutAFlip)
{
    // A strip that goes up into a loop and comes down before where it went up.
    const auto loop = [](double beyond) {
        return shapes::grid_surface({60, 6}, [beyond](double u, double v) {
            const double t = std::clamp((u - 1. / 3) * 3, 0., 1.);
            const double flat = 30 * (std::min(u, 1. / 3) + std::max(u - 2. / 3, 0.));
            return Eigen::Vector3d(flat + beyond * t + 8 * std::sin(2 * pi * t), 30 * v,
                                   8 * (1 - std::cos(2 * pi * t)));
        });
    };
    const auto pick = [](const TriMesh& part) {
        UnfoldPick out;
        for (int f = 0; f < part.triangles(); ++f)
            (f / 2 % 60 < 20 || f / 2 % 60 >= 40 ? out.fixed : out.freed).push_back(f);
        return out;
    };
    const TriMesh possible = loop(40), impossible = loop(-3);
    const UnfoldStepResult pressed = unfold_step(possible, possible.position, pick(possible), steel());
    EXPECT_TRUE(pressed.converged());
    EXPECT_LT(pressed.position.row(2).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_GT(pressed.face.strain_major.maxCoeff(), 0.1);
    try {
        unfold_step(impossible, impossible.position, pick(impossible), steel());
        FAIL() << "the edges have changed sides";
    } catch (const SolveError& error) {
        EXPECT_NE(std::string(error.what()).find("finds no place on the target"), std::string::npos) << error.what();
    }
}

} // namespace spia::unfold_step_refusals_test
