#include "engine/unfold/unfold_step.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "tests/support/developable.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"
#include "tests/support/square_cup.h"

namespace spia {
namespace {

using std::numbers::pi;

FlattenOptions steel(double r = 1.77)
{
    FlattenOptions options;
    options.material = {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, r, r, r, ""};
    options.thickness = 0.8;
    return options;
}

/// Faces whose middles fulfil a condition.
template <class Is> std::vector<int> faces_where(const Eigen::MatrixXd& position, const TriMesh& part, const Is& is)
{
    std::vector<int> out;
    for (int f = 0; f < part.triangles(); ++f)
        if (is(Eigen::VectorXd(position(Eigen::all, part.triangle.col(f)).rowwise().mean())))
            out.push_back(f);
    return out;
}

double largest_strain(const SheetFields& face)
{
    return std::max(face.strain_major.cwiseAbs().maxCoeff(), face.strain_minor.cwiseAbs().maxCoeff());
}

Eigen::Matrix3Xd in_space(const Eigen::Matrix2Xd& flat)
{
    Eigen::Matrix3Xd out = Eigen::Matrix3Xd::Zero(3, flat.cols());
    out.topRows<2>() = flat;
    return out;
}

double furthest(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) { return (a - b).colwise().norm().maxCoeff(); }

} // namespace

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
        EXPECT_EQ(name(result.binder.face), "plane");
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

TEST(UnfoldStep, AllFacesFreedOntoAPlaneAreTheBlankOfFlatten)
{
    const TriMesh dome =
        shapes::transformed(shapes::dome({.triangles = 2000}).mesh, shapes::random_rotation(3), {40, 5, -9});
    std::vector<int> all(size_t(dome.triangles()));
    for (size_t f = 0; f < all.size(); ++f)
        all[f] = int(f);
    const Eigen::Matrix3d axes = shapes::random_rotation(3); // its axis is the dome's
    for (const double side : {1., -1.}) {                    // either side of the plane up
        PlaneFace plane{{1, 2, 3}, axes.leftCols<2>()};
        plane.axes.col(1) *= side;
        FlattenOptions options = steel();
        options.direction = plane.axes.col(0).cross(plane.axes.col(1));
        const FlattenResult flat = flatten(dome, options);
        const UnfoldStepResult step = unfold_step(dome, dome.position, {{}, all, plane}, steel());
        EXPECT_TRUE(step.converged());
        EXPECT_EQ(step.face.thickness, flat.face.thickness); // bit by bit
        EXPECT_EQ(step.face.strain_major, flat.face.strain_major);
        for (int v = 0; v < dome.vertices(); v += 7) {
            EXPECT_NEAR(axes.col(2).dot(step.position.col(v)), axes.col(2).dot(Eigen::Vector3d(1, 2, 3)), 1e-10);
            EXPECT_NEAR((step.position.col(v) - step.position.col(0)).norm(),
                        (flat.blank.position.col(v) - flat.blank.position.col(0)).norm(), 1e-10);
        }
    }
}

TEST(UnfoldStep, AFlangeOnACylinderLandsOnTheCylindersOwnExtension)
{
    // A strip over most of a cylinder, then a bend towards the axis; its continuation is known: the arc goes on.
    const double radius = 40, length = 60;
    const int columns = 60, rows = 10;
    const double step = 0.05, chord = 2 * radius * std::sin(step / 2); // radians, mm
    for (const double start : {0., 2.0, 3.1})                          // wherever the development would have been cut
        for (const bool inside : {false, true}) {
            const auto on_arc = [&](double k) {
                return Eigen::Vector2d(radius * std::cos(start + k * step), radius * std::sin(start + k * step));
            };
            const int bend = 40; // columns from here on leave the cylinder along the tangent turned by 70 degrees
            TriMesh part = shapes::grid_surface({columns, rows}, [&](double u, double v) {
                const double k = std::round(u * columns);
                Eigen::Vector2d at = on_arc(std::min(k, double(bend)));
                if (k > bend) {
                    const double heading = start + bend * step + pi / 2 + 70 * pi / 180;
                    at += (k - bend) * chord * Eigen::Vector2d(std::cos(heading), std::sin(heading));
                }
                return Eigen::Vector3d(at[0], at[1], length * v);
            });
            if (inside)
                part.triangle.row(1).swap(part.triangle.row(2));
            std::vector<int> fixed, freed;
            for (int f = 0; f < part.triangles(); ++f)
                (f / 2 % columns < bend ? fixed : freed).push_back(f);
            const UnfoldStepResult result = unfold_step(part, part.position, {fixed, freed}, steel());
            ASSERT_EQ(name(result.binder.face), "cylinder");
            EXPECT_EQ(std::get<CylinderFace>(result.binder.face).bulges, !inside);
            EXPECT_LT(largest_strain(result.face), 1e-6);
            EXPECT_LT(result.binder.distance_mm, 1e-6);
            EXPECT_LT(result.binder.angle, 1e-3); // a chord against its arc is no crease
            // Flat lengths along the flange become arcs: a chord is shorter by step^2 / 24.
            for (int v = 0; v < part.vertices(); ++v) {
                const int k = v % (columns + 1);
                const double arc = k <= bend ? k * step : bend * step + (k - bend) * chord / radius;
                const Eigen::Vector3d expected(radius * std::cos(start + arc), radius * std::sin(start + arc),
                                               part.position(2, v));
                EXPECT_LT((result.position.col(v) - expected).norm(), 1e-4) << k;
            }
        }
}

TEST(UnfoldStep, ACupsWallIsLaidAroundItsBottomByTheClosedForm)
{
    const double r = 1.77, m = r / (1 + r);
    const shapes::SharpCup shape{.radius = 40, .height = 30, .triangles = 6000};
    const shapes::AxisymmetricPart cup = shapes::sharp_cup(shape);
    const std::vector<int> bottom = faces_where(cup.arc_length.transpose(), cup.mesh,
                                                [&](const Eigen::VectorXd& s) { return s[0] < shape.radius; });
    const std::vector<int> wall = faces_where(cup.arc_length.transpose(), cup.mesh,
                                              [&](const Eigen::VectorXd& s) { return s[0] > shape.radius; });
    const UnfoldStepResult result = unfold_step(cup.mesh, cup.mesh.position, {bottom, wall}, steel(r));
    EXPECT_TRUE(result.converged());
    EXPECT_LT(result.position.row(2).cwiseAbs().maxCoeff(), 1e-9);
    for (int v = 0; v < cup.mesh.vertices(); ++v) {
        const double beyond = std::max(0., cup.arc_length[v] - shape.radius);
        const double R = cup.arc_length[v] <= shape.radius
                             ? cup.arc_length[v]
                             : shape.radius * std::pow(1 + (1 + m) * beyond / shape.radius, 1 / (1 + m));
        EXPECT_NEAR(result.position.col(v).head<2>().norm(), R, 1e-3 * R) << beyond;
    }
    // Its fields are those of uniaxial compression around.
    for (size_t k = 0; k < wall.size(); ++k) {
        const double around = result.face.strain_minor[Eigen::Index(k)];
        EXPECT_NEAR(result.face.strain_major[Eigen::Index(k)], -m * around, 0.03); // rows of 1.6 mm
    }
}

TEST(UnfoldStep, TheCollarOfAHoleIsLaidIntoTheHoleByTheClosedForm)
{
    // No force acts along the upright wall, so its rings are stretched around only: the cup's formula with the height negative.
    const double r = 1.77, m = r / (1 + r), radius = 40, height = 10;
    Eigen::Matrix2Xd meridian(2, 3);
    meridian << radius, radius, 70, /**/ -height, 0, 0;
    const shapes::AxisymmetricPart part = shapes::axisymmetric(meridian, 6000);
    const auto is_plate = [&](const Eigen::VectorXd& s) { return s[0] > height; };
    const std::vector<int> plate = faces_where(part.arc_length.transpose(), part.mesh, is_plate),
                           collar = faces_where(part.arc_length.transpose(), part.mesh,
                                                [&](const Eigen::VectorXd&s) { return !is_plate(s); });
    const UnfoldStepResult result = unfold_step(part.mesh, part.mesh.position, {plate, collar}, steel(r));
    EXPECT_TRUE(result.converged());
    for (int v = 0; v < part.mesh.vertices(); ++v)
        if (const double down = height - part.arc_length[v]; down >= 0) {
            const double R = radius * std::pow(1 - (1 + m) * down / radius, 1 / (1 + m));
            EXPECT_NEAR(result.position.col(v).head<2>().norm(), R, 3e-3 * R) << down;
        }
}

TEST(UnfoldStep, AHemIsTurnedBackOntoItsWallAndThenDown)
{
    // A wall at 90 degrees whose lip is folded back flat onto it.
    const shapes::DevelopablePart part = shapes::hemmed_flange({.triangles = 3000});
    const shapes::HemmedFlange shape{};
    const double wall = shape.base + 2 * shape.radius * 8 * std::sin(pi / 32); // any chord of the bend
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

TEST(UnfoldStep, ADomeInsideAPlateIsLaidFlatBetweenItsFixedEdge)
{
    // Held all around: the sheet has no choice but to be stretched into it.
    const shapes::AxisymmetricPart dome =
        shapes::dome({.radius = 80, .die_radius = 20, .wall_angle_deg = 25, .flange_width = 30, .triangles = 4000});
    const double flat = dome.arc_length.maxCoeff() - 30;
    const auto on_flange = [&](const Eigen::VectorXd& s) { return s[0] > flat; };
    const std::vector<int> flange = faces_where(dome.arc_length.transpose(), dome.mesh, on_flange),
                           inside = faces_where(dome.arc_length.transpose(), dome.mesh,
                                                [&](const Eigen::VectorXd&s) { return !on_flange(s); });
    const UnfoldStepResult result = unfold_step(dome.mesh, dome.mesh.position, {flange, inside}, steel());
    EXPECT_TRUE(result.converged());
    EXPECT_LT(result.position.row(2).cwiseAbs().maxCoeff(), 1e-9);
    double formed = 0, laid = 0;
    for (const int f : inside)
        for (const bool after : {false, true}) {
            const Eigen::Matrix3d x =
                (after ? result.position : dome.mesh.position)(Eigen::all, dome.mesh.triangle.col(f));
            (after ? laid : formed) += (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() / 2;
        }
    const double h0 = steel().thickness;
    double volume = 0;
    for (size_t k = 0; k < inside.size(); ++k) {
        const Eigen::Matrix3d x = dome.mesh.position(Eigen::all, dome.mesh.triangle.col(inside[k]));
        volume += result.face.thickness[Eigen::Index(k)] * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() / 2;
    }
    EXPECT_LT(laid, 0.97 * formed);
    EXPECT_NEAR(volume, h0 * laid, 1e-9 * volume);
    EXPECT_LT(result.face.thickness.maxCoeff(), h0);
}

TEST(UnfoldStep, AStripOnAConeGoesOnAroundItAndNotOverItsApex)
{
    // A sector of a cone, of which a part is bent off along a generator: a flat strip there.
    const shapes::ConeSector shape{.near = 60, .far = 140, .half_angle_deg = 30, .sector_deg = 120, .triangles = 3000};
    const shapes::DevelopablePart cone = shapes::cone_sector(shape);
    TriMesh part = cone.mesh;
    // Its faces beyond the 80th degree are turned about that generator.
    const auto azimuth = [&](const Eigen::Vector3d& x) { return std::atan2(x[1], x[0]) * 180 / pi; };
    double hinge = 0;
    for (int v = 0; v < part.vertices(); ++v)
        if (const double a = azimuth(cone.mesh.position.col(v)); a < 80)
            hinge = std::max(hinge, a);
    const double at = hinge * pi / 180, half = pi / 6;
    const Eigen::Vector3d generator(std::sin(half) * std::cos(at), std::sin(half) * std::sin(at), -std::cos(half));
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, generator).toRotationMatrix();
    std::vector<int> fixed, freed;
    for (int f = 0; f < part.triangles(); ++f)
        (azimuth(cone.mesh.position(Eigen::all, part.triangle.col(f)).rowwise().mean()) < hinge ? fixed : freed)
            .push_back(f);
    for (int v = 0; v < part.vertices(); ++v)
        if (azimuth(cone.mesh.position.col(v)) > hinge + 1e-6)
            part.position.col(v) = turn * part.position.col(v);
    for (const Eigen::Matrix3d& moved : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), shapes::random_rotation(4)}) {
        const TriMesh there = shapes::transformed(part, moved, {10, 20, 30});
        const UnfoldStepResult result = unfold_step(there, there.position, {fixed, freed}, steel());
        ASSERT_EQ(name(result.binder.face), "cone");
        EXPECT_TRUE(result.converged());
        // A chord over its arc, of which there are some 40: second order.
        EXPECT_LT(furthest(result.position, shapes::transformed(cone.mesh, moved, {10, 20, 30}).position), 0.05);
        EXPECT_LT(largest_strain(result.face), 1e-3);
    }
    // A strip that hangs from the small end is too long for what is left of the cone.
    const double chord = 60 * std::sin(half) * 0.2;
    TriMesh strip = shapes::grid_surface({10, 30}, [&](double u, double v) {
        const double a = 0.2 * u, s = 130 - 200 * v; // on the cone up to 70, then straight down inside
        const double along = std::max(s, 70.);
        Eigen::Vector3d x =
            along * Eigen::Vector3d(std::sin(half) * std::cos(a), std::sin(half) * std::sin(a), -std::cos(half));
        if (s < 70)
            x[2] -= 70 - s;
        return x;
    });
    UnfoldPick pick;
    for (int f = 0; f < strip.triangles(); ++f)
        (f / 20 < 9 ? pick.fixed : pick.freed).push_back(f);
    ASSERT_GT(chord, 0);
    try {
        unfold_step(strip, strip.position, pick, steel());
        FAIL() << "there is no cone beyond its apex";
    } catch (const SolveError& error) {
        EXPECT_NE(std::string(error.what()).find("across the apex"), std::string::npos) << error.what();
    }
}

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
    // Two rows of faces in the plane, then four upright ones: faces 0 to 19, 20 to 39, ... row by row.
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
           refusal(part, {counted(20, 40), counted(80, 120), fit_binder(part, flat)->face}));
    expect("ends 20 mm beside the target",
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

TEST(UnfoldStep, TailoredPiecesKeepTheirGaugeAndTheRollingDirectionItsWay)
{
    const shapes::HatChannel shape{.triangles = 2000};
    const shapes::DevelopablePart hat = shapes::hat_channel(shape);
    const double middle = (hat.flat.row(0).minCoeff() + hat.flat.row(0).maxCoeff()) / 2;
    const auto is_top = [&](const Eigen::VectorXd& at) { return std::abs(at[0] - middle) < shape.top / 2; };
    const std::vector<int> top = faces_where(hat.flat, hat.mesh, is_top),
                           rest =
                               faces_where(hat.flat, hat.mesh, [&](const Eigen::VectorXd&at) { return !is_top(at); }),
                           thick =
                               faces_where(hat.flat, hat.mesh, [&](const Eigen::VectorXd&at) { return at[1] < 90; });
    FlattenOptions options = steel();
    options.process.tailored.push_back({"thick", thick, options.material, 1.5});
    const UnfoldStepResult tailored = unfold_step(hat.mesh, hat.mesh.position, {top, rest}, options);
    ASSERT_EQ(tailored.piece.size(), 2u);
    for (size_t k = 0; k < rest.size(); ++k) {
        const bool in = std::binary_search(thick.begin(), thick.end(), rest[k]);
        EXPECT_NEAR(tailored.face.thickness[Eigen::Index(k)], in ? 1.5 : 0.8, 1e-6);
    }
    // Planar anisotropy: the rim of a cup's wall has its waves along and across the rolling direction, wherever the cup stands.
    const shapes::SharpCup form{.triangles = 3000};
    const shapes::AxisymmetricPart cup = shapes::sharp_cup(form);
    const auto mean_along = [&](const Eigen::Vector3d& way, const Eigen::MatrixXd& laid) {
        double sum = 0, count = 0;
        for (const int v : cup.rim)
            if (std::abs(cup.mesh.position.col(v).head<2>().normalized().dot(way.head<2>())) > 0.97) {
                sum += (laid.col(v) - laid.col(0)).norm();
                ++count;
            }
        return sum / count;
    };
    FlattenOptions ears = steel();
    ears.material.r0 = 1;
    ears.material.r45 = 1.6;
    ears.material.r90 = 2.9;
    const auto radius_along = [&](const Eigen::Vector3d& rolling, const Eigen::Vector3d& way) {
        const Eigen::Matrix3d turn = shapes::random_rotation(6);
        ears.process.rolling = turn * rolling;
        const TriMesh there = shapes::transformed(cup.mesh, turn, {1, 2, 3});
        UnfoldPick pick{faces_where(cup.arc_length.transpose(), cup.mesh,
                                    [&](const Eigen::VectorXd& s) { return s[0] < form.radius; }),
                        faces_where(cup.arc_length.transpose(), cup.mesh,
                                    [&](const Eigen::VectorXd& s) { return s[0] > form.radius; })};
        const Eigen::Matrix3d askew = turn * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        pick.target = PlaneFace{there.position.col(0), askew.leftCols<2>()};
        const UnfoldStepResult result = unfold_step(there, there.position, pick, ears);
        return mean_along(way, result.position);
    };
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
    const double along = radius_along(x, x), across = radius_along(x, y);
    // The whole cup in one hit has the same waves.
    ears.process.rolling = x;
    ears.direction = Eigen::Vector3d::UnitZ();
    const Eigen::Matrix2Xd blank = flatten(cup.mesh, ears).blank.position;
    EXPECT_NEAR(mean_along(x, blank) - mean_along(y, blank), along - across, 0.1 * std::abs(along - across));
    EXPECT_GT(std::abs(along - across), 0.2);                                 // mm
    EXPECT_NEAR(radius_along(y, y), along, 0.25 * std::abs(along - across));  // the mesh is no quarter
    EXPECT_NEAR(radius_along(y, x), across, 0.25 * std::abs(along - across)); // the mesh is no quarter
}

TEST(UnfoldStep, ASquareCupIsLaidAroundItsBottomOrIntoItsFlange)
{
    const TriMesh cup = shapes::square_cup({.depth = 20, .triangles = 4000});
    for (const double level : {cup.position.row(2).minCoeff(), cup.position.row(2).maxCoeff()}) {
        UnfoldPick pick;
        for (int f = 0; f < cup.triangles(); ++f)
            ((cup.position.row(2)(cup.triangle.col(f)).array() - level).abs().maxCoeff() < 1e-9 ? pick.fixed
                                                                                                : pick.freed)
                .push_back(f);
        const UnfoldStepResult result = unfold_step(cup, cup.position, pick, steel());
        EXPECT_TRUE(result.converged()) << result.piece[0].report.reason;
        EXPECT_LT((result.position.row(2).array() - level).abs().maxCoeff(), 1e-9);
        double volume = 0, laid = 0;
        for (size_t k = 0; k < pick.freed.size(); ++k)
            for (const bool after : {false, true}) {
                const Eigen::Matrix3d c =
                    (after ? result.position : cup.position)(Eigen::all, cup.triangle.col(pick.freed[k]));
                const double area = (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0)).norm() / 2;
                (after ? laid : volume) += area * (after ? steel().thickness : result.face.thickness[Eigen::Index(k)]);
            }
        EXPECT_NEAR(volume, laid, 1e-9 * laid);
    }
}

} // namespace spia
