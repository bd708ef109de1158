// Friction between the freed faces and the target of a step.
#include "engine/unfold/step/target_friction.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "engine/unfold/step/unfold_script.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"

namespace spia::target_friction_test {
namespace {

using std::numbers::pi;

FlattenOptions steel(double r)
{
    FlattenOptions options;
    options.material = {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, r, r, r, ""};
    options.thickness = 0.8;
    options.tolerance = 1e-11;
    return options;
}

ContactRegion rubbing(double pressure, int sides = 2) { return {"die", {}, pressure, {}, 0.12, sides}; }

double furthest(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).colwise().norm().maxCoeff(); }

/// Strain along a strip that does not narrow (r = 0) under a force per length: h sigma = T.
double strip_strain(const FlattenOptions& options, double T)
{
    const StressCurve curve(options.material.hardening, options.material.young_MPa, options.curve);
    double low = 0, high = 0.2; // on the rising branch
    for (int k = 0; k < 100; ++k) {
        const double e = 0.5 * (low + high);
        (options.thickness * std::exp(-e) * curve(e).stress < T ? low : high) = e;
    }
    return 0.5 * (low + high);
}

/// A quarter of a dish: a flat bottom, fixed, and a wall that leans outwards, freed.
struct QuarterDish {
    TriMesh part;
    UnfoldPick pick;

    QuarterDish()
    {
        Eigen::Matrix2Xd meridian(2, 3);
        meridian << 0, 40, 52, /**/ 0, 0, -25;
        part = shapes::without_faces(shapes::axisymmetric(meridian, 3000).mesh,
                                     [](const Eigen::Vector3d& at) { return at[0] < 0 || at[1] < 0; });
        for (int f = 0; f < part.triangles(); ++f)
            (part.position.row(2)(part.triangle.col(f)).cwiseAbs().maxCoeff() < 1e-9 ? pick.fixed : pick.freed)
                .push_back(f);
    }
};

/// A strip along `place`, from column to column: up to `bend` the columns are fixed, those beyond
/// freed.
struct Strip {
    static constexpr int columns = 40, rows = 4, bend = 10;
    TriMesh part;
    UnfoldPick pick;

    explicit Strip(const std::function<Eigen::Vector3d(double column, double v)>& place)
        : part(shapes::grid_surface({columns, rows},
                                    [&](double u, double v) { return place(std::round(u * columns), v); }))
    {
        for (int f = 0; f < part.triangles(); ++f)
            (column(f) < bend ? pick.fixed : pick.freed).push_back(f);
    }
    static int column(int f) { return f / 2 % columns; }
    int at(int column, int row) const { return row * (columns + 1) + column; }
};

constexpr double cell = 1.5; // mm

/// Flat, and from the bend on upright.
Strip upright()
{
    return Strip([](double k, double v) {
        const double wall = std::max(k - Strip::bend, 0.) * cell;
        return Eigen::Vector3d(std::min(k - Strip::bend, 0.) * cell, 20 * v, wall);
    });
}

} // namespace

TEST(TargetFriction, OnAPlaneItIsThatOfFlattenWithTheSameHeldVertices)
{
    QuarterDish dish;
    const FlattenOptions options = steel(1.77);
    const UnfoldStepResult free = unfold_step(dish.part, dish.part.position, dish.pick, options);
    const FreedPiece piece = freed_pieces(dish.part, dish.pick.fixed, dish.pick.freed).at(0);
    const std::vector<int> half(dish.pick.freed.begin(),
                                dish.pick.freed.begin() + Eigen::Index(dish.pick.freed.size() / 2));
    ContactRegion press{"die", {}, {}, 20000, 0.12, 2}, some = rubbing(9);
    some.faces = half;
    for (const ContactRegion& friction : {rubbing(6), press, some}) {
        dish.pick.friction = friction;
        const UnfoldStepResult step = unfold_step(dish.part, dish.part.position, dish.pick, options);
        ASSERT_TRUE(step.converged()) << step.piece[0].report.reason;
        EXPECT_EQ(step.piece[0].report.process_share, 1);
        EXPECT_GT(furthest(step.position, free.position), 0.05); // mm: it counts

        FlattenOptions whole = options;
        whole.direction = Eigen::Vector3d::UnitZ();
        ContactRegion& binder = whole.process.contact.emplace_back(friction);
        binder.faces.clear();
        for (size_t k = 0; k < piece.face.size(); ++k)
            if (friction.faces.empty() || std::binary_search(half.begin(), half.end(), piece.face[k]))
                binder.faces.push_back(int(k));
        for (const int v : piece.held)
            whole.process.pilots.push_back({"pin", {piece.mesh.position.col(v)}});
        const FlattenResult flat = flatten(piece.mesh, whole);
        ASSERT_TRUE(flat.report.whole()) << flat.report.reason;
        for (size_t v = 0; v < piece.vertex.size(); ++v)
            EXPECT_LT((step.position.col(piece.vertex[v]).head<2>() - flat.blank.position.col(Eigen::Index(v))).norm(),
                      1e-10);
    }
}

TEST(TargetFriction, FacesJoinedToNothingAreThoseOfFlatten)
{
    QuarterDish dish;
    FlattenOptions options = steel(1.77);
    UnfoldPick all{{}, dish.pick.freed, PlaneFace{{0, 0, 0}, Eigen::Matrix<double, 3, 2>::Identity()}};
    all.freed.insert(all.freed.end(), dish.pick.fixed.begin(), dish.pick.fixed.end());
    all.friction = rubbing(3);
    all.friction->faces = dish.pick.freed;
    const UnfoldStepResult step = unfold_step(dish.part, dish.part.position, all, options);
    options.direction = Eigen::Vector3d::UnitZ();
    const FlattenResult free = flatten(dish.part, options);
    options.process.contact = {*all.friction};
    const FlattenResult flat = flatten(dish.part, options);
    EXPECT_GT(furthest(free.blank.position, flat.blank.position), 0.05); // mm
    EXPECT_LT(furthest(step.position.topRows<2>(), flat.blank.position), 1e-10);
    // flatten() knows the part alone, not where a step has left it.
    EXPECT_THROW(unfold_step(dish.part, step.position, all, steel(1.77)), InputError);
}

TEST(TargetFriction, AWallLaidDownCarriesWhatRubsBeyondEachPlace)
{
    // The upright wall slips from the die towards the bend; with r = 0 it does not narrow: T =
    // sides mu p (L - s).
    Strip strip = upright();
    const FlattenOptions options = steel(1e-6);
    const double length = (Strip::columns - Strip::bend) * cell, p = 20;
    Eigen::Matrix3Xd two_sides;
    for (const int sides : {2, 1}) {
        strip.pick.friction = rubbing(sides == 2 ? p : 2 * p, sides);
        const UnfoldStepResult result = unfold_step(strip.part, strip.part.position, strip.pick, options);
        ASSERT_TRUE(result.converged()) << result.piece[0].report.reason;
        double longest = 0;
        // the two triangles of a cell
        for (Eigen::Index k = 0; k < Eigen::Index(result.freed.size()); k += 2) {
            const double s = (Strip::column(result.freed[size_t(k)]) - Strip::bend + 0.5) * cell;
            const double expected = strip_strain(options, 2 * 0.12 * p * (length - s));
            longest = std::max(longest, expected);
            if (s < 0.9 * length) {
                EXPECT_NEAR(result.face.strain_major.segment<2>(k).mean(), expected, 0.015 * expected) << s;
            }
        }
        EXPECT_GT(longest, 0.01); // it is no trivial state
        if (sides == 2)
            two_sides = result.position;
        else
            EXPECT_EQ(two_sides, result.position) << "half the sides, twice the pressure";
    }
}

TEST(TargetFriction, TheSlipIsThatOfTheStateHoweverThePartIsBent)
{
    // The wall's upper half is bent back in the part. A step before has laid it along the wall:
    // then the wall is one.
    const int lip = 25;
    Strip strip([&](double k, double v) {
        const double up = (std::clamp(k, double(Strip::bend), double(lip)) - Strip::bend) * cell, back = 100 * pi / 180,
                     beyond = std::max(k - lip, 0.) * cell;
        return Eigen::Vector3d(std::min(k - Strip::bend, 0.) * cell - beyond * std::sin(back), 20 * v,
                               up + beyond * std::cos(back));
    });
    const FlattenOptions options = steel(1e-6);
    UnfoldPick first;
    for (const int f : strip.pick.freed)
        (Strip::column(f) < lip ? first.fixed : first.freed).push_back(f);
    const Eigen::Matrix3Xd state = unfold_step(strip.part, strip.part.position, first, options).position;
    EXPECT_LT(furthest(state, upright().part.position), 1e-8);
    strip.pick.friction = rubbing(20);
    const UnfoldStepResult bent = unfold_step(strip.part, state, strip.pick, options),
                           straight = unfold_step(upright().part, state, strip.pick, options);
    EXPECT_TRUE(bent.converged());
    // Where the part has its sharp edge, forces are turned over half of its angle at a time.
    EXPECT_LT(furthest(bent.position, straight.position), 1e-3);
    EXPECT_GT(
        furthest(bent.position, unfold_step(strip.part, state, {strip.pick.fixed, strip.pick.freed}, options).position),
        0.1);
}

TEST(TargetFriction, OnACylinderOrAConeItIsThatOnThePlaneOfTheirDevelopment)
{
    // Walls square to the face along a generator: where their feet are they come from, on all three
    // faces alike.
    const FlattenOptions options = steel(1.77);
    Strip flat = upright();
    flat.pick.friction = rubbing(20);
    const UnfoldStepResult on_plane = unfold_step(flat.part, flat.part.position, flat.pick, options);
    ASSERT_TRUE(on_plane.converged()) << on_plane.piece[0].report.reason;
    const double radius = 60, slant = 80;
    for (const bool inside : {false, true})
        for (const double from : {0.4, 3.0}) { // also where the development of angles is cut
            Strip round([&](double k, double v) {
                const double wall = std::max(k - Strip::bend, 0.) * cell * (inside ? -1 : 1),
                             a = from + std::min(k - Strip::bend, 0.) * cell / radius;
                return Eigen::Vector3d((radius + wall) * std::cos(a), (radius + wall) * std::sin(a), 20 * v);
            });
            if (inside) // the strip runs the other way around: the inner side is the outer one
                for (int f = 0; f < round.part.triangles(); ++f)
                    round.part.triangle.col(f).tail<2>().reverseInPlace();
            round.pick.friction = rubbing(20);
            const UnfoldStepResult result = unfold_step(round.part, round.part.position, round.pick, options);
            ASSERT_EQ(name(result.target.face), "cylinder");
            ASSERT_TRUE(result.converged()) << result.piece[0].report.reason;
            for (const int f : round.pick.freed)
                for (const int v : round.part.triangle.col(f)) {
                    const Eigen::Vector3d x = result.position.col(v);
                    const Eigen::Vector2d at(radius * std::remainder(std::atan2(x[1], x[0]) - from, 2 * pi), x[2]);
                    EXPECT_LT((at - on_plane.position.col(v).head<2>()).norm(), 1e-8) << v;
                }
        }
    // Along a generator of a cone, from the slant on: x of the plane is what goes around the apex.
    const double half_angle = 0.5, c = std::cos(half_angle), s = std::sin(half_angle);
    Strip coned([&](double k, double v) {
        const double wall = std::max(k - Strip::bend, 0.) * cell, a = std::min(k - Strip::bend, 0.) * 0.03,
                     l = slant + 20 * v;
        const Eigen::Vector3d out(std::cos(a), std::sin(a), 0), up(0, 0, 1), normal = s * -up + c * out;
        return Eigen::Vector3d(l * (c * up + s * out) + wall * normal);
    });
    for (int f = 0; f < coned.part.triangles(); ++f) // away from the axis and around it is the
                                                     // apex' way
        coned.part.triangle.col(f).tail<2>().reverseInPlace();
    coned.pick.friction = rubbing(20);
    const UnfoldStepResult on_cone = unfold_step(coned.part, coned.part.position, coned.pick, options);
    ASSERT_EQ(name(on_cone.target.face), "cone");
    ASSERT_TRUE(on_cone.converged()) << on_cone.piece[0].report.reason;
    const ConeFace cone{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, half_angle, true};
    for (const int f : coned.pick.freed)
        for (const int v : coned.part.triangle.col(f)) {
            const Eigen::Vector2d at = developed(cone, on_cone.position.col(v));
            EXPECT_NEAR(std::abs(at[0]), on_plane.position(0, v), 1e-5) << v;
            EXPECT_NEAR(at[1] - slant, on_plane.position(1, v), 1e-5) << v;
        }
}

TEST(TargetFriction, SheetRolledOnItsTargetSlipsInTheAxesOfTheFlatPart)
{
    // In the part it is flat and lies anywhere; in the state it goes around a cylinder or a cone by
    // more than half a turn from its held edge on: each way of the development is the same way of
    // the flat part.
    const int columns = 200, rows = 6;
    const Eigen::Matrix3d turn = shapes::random_rotation(5);
    for (const bool bulges : {true, false})
        for (const bool conical : {false, true}) {
            const double angle = 4.5, radius = 30, half_angle = 0.4;
            const TargetSurface target =
                conical ? TargetSurface(ConeFace{{1, 2, 3}, {0, 0, 1}, {0, 1, 0}, half_angle, bulges})
                        : TargetSurface(CylinderFace{{1, 2, 3}, {0, 0, 1}, {0, 1, 0}, radius, bulges});
            const auto flat = [&](double u, double v) -> Eigen::Vector2d {
                if (!conical)
                    return {angle * radius * u, 20 * v};
                const double turned = -angle * std::sin(half_angle) * u, slant = 60 + 20 * v;
                return {-slant * std::sin(turned), slant * std::cos(turned)};
            };
            const shapes::GridPlan plan{columns, rows};
            const TriMesh part = shapes::grid_surface(plan, [&](double u, double v) {
                return Eigen::Vector3d(turn.leftCols<2>() * flat(u, v) + Eigen::Vector3d(7, 8, 9));
            });
            const Eigen::Matrix3Xd state =
                shapes::grid_surface(plan, [&](double u, double v) { return placed(target, flat(u, v)); }).position;
            std::vector<int> fixed, freed;
            for (int f = 0; f < part.triangles(); ++f)
                (f / 2 % columns == 0 ? fixed : freed).push_back(f);
            const FreedPiece piece = freed_pieces(part, fixed, freed).at(0);
            const Eigen::Vector2d origin(3, -4), first = flat(1. / columns, 0);
            const SlipOnFace slip = slip_on(piece, state(Eigen::all, piece.vertex), target, first, origin);
            for (size_t v = 0; v < piece.vertex.size(); ++v) {
                const int column = piece.vertex[v] % (columns + 1), row = piece.vertex[v] / (columns + 1);
                const Eigen::Vector2d place = flat(double(column) / columns, double(row) / rows);
                EXPECT_LT((slip.foot.col(Eigen::Index(v)) + origin - place).norm(), 1e-9) << column;
                EXPECT_LT((slip.into_sheet[v] - turn.leftCols<2>()).norm(), conical ? 1e-2 : 1e-9) << column;
            }
        }
}

TEST(TargetFriction, TangentsAreTheDerivativeOfPlaces)
{
    const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized(), towards = axis.unitOrthogonal();
    Eigen::Matrix<double, 3, 2> axes;
    axes << towards, axis.cross(towards);
    HeightFace height{{1, 0, 2}, axes, {-20, -20}, 10, Eigen::MatrixXd(7, 7)};
    for (int i = 0; i < 49; ++i)
        height.coefficient(i) = std::sin(3. * i);
    for (const bool bulges : {false, true})
        for (const TargetSurface& face : {TargetSurface(PlaneFace{{1, 2, 3}, axes}), TargetSurface(height),
                                          TargetSurface(CylinderFace{{1, 2, 3}, axis, towards, 30, bulges}),
                                          TargetSurface(ConeFace{{1, 2, 3}, axis, towards, 0.7, bulges})})
            for (const Eigen::Vector2d& place : {Eigen::Vector2d(3, 12), Eigen::Vector2d(-11, 5)}) {
                constexpr double h = 1e-4;
                Eigen::Matrix<double, 3, 2> difference;
                for (int k = 0; k < 2; ++k)
                    difference.col(k) = (placed(face, place + h * Eigen::Vector2d::Unit(k)) -
                                         placed(face, place - h * Eigen::Vector2d::Unit(k))) /
                                        (2 * h);
                EXPECT_LT((tangents(face, place) - difference).norm(), 1e-7) << name(face);
            }
}

TEST(TargetFriction, WhatTheSheetDoesNotBearIsReportedAsAShare)
{
    // A dish pulled by more than half of what tears it, and a solver that is soon tired: part of
    // the friction it does find.
    QuarterDish dish;
    PlannedStep step;
    step.name = "wall";
    step.pick = dish.pick;
    step.pick.friction = rubbing(100);
    step.most_newton_steps = 5;
    const UnfoldRun run = run_unfolding(dish.part, {step}, steel(1.77));
    ASSERT_EQ(run.states.size(), 1u) << run.failure;
    const UnfoldState& state = run.states[0];
    EXPECT_GT(state.friction_share, 0.2);
    EXPECT_LT(state.friction_share, 0.8);
    EXPECT_TRUE(state.converged);
    EXPECT_NE(state.reason.find("too much force"), std::string::npos) << state.reason;
    // The state has just that share: who asks for no more gets it at once, and as much.
    step.most_newton_steps.reset();
    step.pick.friction = rubbing(100 * state.friction_share);
    const UnfoldState same = run_unfolding(dish.part, {step}, steel(1.77)).states.at(0);
    EXPECT_EQ(same.friction_share, 1);
    step.pick.friction.reset();
    const UnfoldState free = run_unfolding(dish.part, {step}, steel(1.77)).states.at(0);
    EXPECT_TRUE(free.reason.empty());
    EXPECT_LT(furthest(same.position, state.position), 0.05 * furthest(free.position, state.position));
}

TEST(TargetFriction, ASmoothFaceWithoutHeightIsAPlane)
{
    QuarterDish dish;
    const HeightFace level{
        {0, 0, 0}, Eigen::Matrix<double, 3, 2>::Identity(), {-100, -100}, 20, Eigen::MatrixXd::Zero(13, 13)};
    const auto laid = [&](double pressure, const std::optional<TargetSurface>& target, int newton_steps) {
        dish.pick.friction = rubbing(pressure);
        dish.pick.target = target;
        FlattenOptions options = steel(1.77);
        options.most_newton_steps = newton_steps;
        return unfold_step(dish.part, dish.part.position, dish.pick, options);
    };
    EXPECT_LT(furthest(laid(6, {}, 60).position, laid(6, level, 60).position), 1e-8);
    // The rounds on a smooth face go on with the share of the friction that was found.
    const UnfoldStepResult tired = laid(60, level, 5);
    const double share = tired.piece[0].report.process_share;
    ASSERT_TRUE(tired.converged()) << tired.piece[0].report.reason;
    ASSERT_GT(share, 0.2);
    ASSERT_LT(share, 0.8);
    EXPECT_LT(furthest(tired.position, laid(60 * share, level, 60).position), 1e-8);
}

TEST(TargetFriction, BadValuesAreRefusedWithStepAndMember)
{
    Strip strip = upright();
    const auto refusal = [&](const std::optional<ContactRegion>& friction, UnfoldKind kind = UnfoldKind::lay) {
        PlannedStep step;
        step.kind = kind;
        step.name = "wall";
        step.pick = strip.pick;
        step.pick.friction = friction;
        try {
            const UnfoldRun run = run_unfolding(strip.part, {step}, steel(1));
            return run.failure.empty() ? std::string("none") : run.failure;
        } catch (const InputError& error) {
            return std::string(error.what());
        }
    };
    EXPECT_EQ(refusal(rubbing(1)), "none");
    EXPECT_EQ(refusal(ContactRegion{"", {}, 1, {}, -0.1, 2}),
              "step \"wall\": its friction: friction -0.1 on 2 sides; friction must not be negative, sides 1 or 2");
    EXPECT_EQ(refusal(rubbing(1, 3)),
              "step \"wall\": its friction: friction 0.12 on 3 sides; friction must not be negative, sides 1 or 2");
    EXPECT_EQ(refusal(rubbing(0)), "the pressure of step \"wall\": its friction is 0 MPa; it must be positive");
    EXPECT_EQ(refusal(ContactRegion{"", {}, {}, -5, 0.1, 2}),
              "the force of step \"wall\": its friction is -5 N; it must be positive");
    EXPECT_EQ(refusal(ContactRegion{"", {}, {}, {}, 0.1, 2}),
              "step \"wall\": its friction needs either a force or a pressure");
    EXPECT_EQ(refusal(ContactRegion{"", {strip.pick.fixed[0]}, 1, {}, 0.1, 2}),
              "step \"wall\": its friction: face 0 rubs but is not freed; free it, too, or leave it out");
    EXPECT_NE(refusal(rubbing(1), UnfoldKind::flatten).find("step \"wall\": its friction: only a step that lays"),
              std::string::npos);
    EXPECT_NE(refusal(ContactRegion{"", {}, {}, 500, 0.1, 2}).find("a force cannot press there; give a pressure"),
              std::string::npos)
        << "the wall is square to the plane";
    // The step itself refuses as well.
    strip.pick.friction = rubbing(1, 0);
    EXPECT_THROW(unfold_step(strip.part, strip.part.position, strip.pick, steel(1)), InputError);
}

} // namespace spia::target_friction_test
