#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/forming/flatten.h"
#include "engine/mesh/topology.h"
#include "tests/support/developable.h"
#include "tests/support/revolved.h"
#include "tests/support/shape_family.h"
#include "tests/support/square_cup.h"

namespace spia::process_test {
namespace {

FlattenOptions steel(double r0, double r45, double r90)
{
    FlattenOptions options;
    options.material = {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, r0, r45, r90, ""};
    options.thickness = 0.8;
    return options;
}

/// Strain along a strip that does not narrow (r = 0) under a force per length: h sigma = T.
double strip_strain(const StressCurve& curve, double thickness, double T)
{
    double low = 0, high = 0.2; // on the rising branch
    for (int k = 0; k < 100; ++k) {
        const double e = 0.5 * (low + high);
        (thickness * std::exp(-e) * curve(e).stress < T ? low : high) = e;
    }
    return 0.5 * (low + high);
}

double radius_at(const Eigen::VectorXd& radius, const Eigen::VectorXd& angle, double degrees)
{
    double best = 0, nearest = 1e9;
    for (Eigen::Index i = 0; i < radius.size(); ++i)
        if (const double off = std::abs(std::remainder(angle[i] - degrees * M_PI / 180, 2 * M_PI)); off < nearest) {
            nearest = off;
            best = radius[i];
        }
    return best;
}

} // namespace

TEST(Process, AStripOverABinderCarriesTheSumOfFrictionAndBead)
{
    // A hat; with r = 0 tension does not narrow it, so every generator is in plane strain. The
    // binder presses on both flanges, a bead runs along each: in the flange the force grows inwards
    // by the friction passed, behind the bead by its force, and stays so in wall and top.
    shapes::HatChannel shape;
    shape.length = 120;
    shape.angle_deg = 80;
    shape.triangles = 8000;
    const shapes::DevelopablePart part = shapes::hat_channel(shape);
    const double width = part.flat.row(0).maxCoeff() - part.flat.row(0).minCoeff();
    const int across = std::abs(width - shape.length) < 1e-6 ? 1 : 0; // where the section runs
    const Eigen::VectorXd s =
        (part.flat.row(across).array() - 0.5 * (part.flat.row(across).maxCoeff() + part.flat.row(across).minCoeff()))
            .matrix();
    const Eigen::VectorXd y = part.flat.row(1 - across);
    const double half = s.maxCoeff();
    // Both triangles of a cell feel the force at its middle.
    const auto middle = [&](int f) {
        const Eigen::Vector3d at = s(part.mesh.triangle.col(f));
        return 0.5 * std::abs(at.maxCoeff() + at.minCoeff());
    };

    FlattenOptions options = steel(1e-6, 1e-6, 1e-6);
    const double pressure = 14, friction = 0.12, bead = 90, bead_at = half - 12;
    ContactRegion binder{"binder", {}, pressure, {}, friction, 2};
    for (int f = 0; f < part.mesh.triangles(); ++f)
        if (middle(f) > half - shape.flange)
            binder.faces.push_back(f);
    options.process.contact = {binder};
    for (const double side : {-1.0, 1.0}) { // along the vertices nearest to the bead's line
        int first = 0, last = 0;
        const auto score = [&](int v, double end) { return std::abs(s[v] - side * bead_at) + std::abs(y[v] - end); };
        for (int v = 0; v < part.mesh.vertices(); ++v) {
            first = score(v, y.minCoeff()) < score(first, y.minCoeff()) ? v : first;
            last = score(v, y.maxCoeff()) < score(last, y.maxCoeff()) ? v : last;
        }
        options.process.drawbeads.push_back(
            {"bead", {part.mesh.position.col(first), part.mesh.position.col(last)}, bead});
    }
    const FlattenResult result = flatten(part.mesh, options);
    ASSERT_EQ(result.report.system, SolvedSystem::strict);

    const StressCurve curve(options.material.hardening, options.material.young_MPa, options.curve);
    int compared = 0;
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        const double at = middle(f);
        if (std::abs(at - bead_at) < 6 || at > half - 4)
            continue;
        const double T = 2 * friction * pressure * std::min(half - at, shape.flange) + (at < bead_at ? bead : 0);
        const double expected = strip_strain(curve, options.thickness, T);
        EXPECT_NEAR(result.face.strain_major[f], expected, 0.01 * expected + 2e-5) << at;
        EXPECT_NEAR(result.face.strain_minor[f], 0, 2e-3) << at;
        compared += at < half - shape.flange - 15;
    }
    EXPECT_GT(compared, 100);
    double largest = 0;
    for (int f = 0; f < part.mesh.triangles(); ++f)
        largest = std::max(largest, result.face.strain_major[f]);
    EXPECT_GT(largest, 0.005); // it is no trivial state
}

namespace {

/// A strip bent to a quarter of a cylinder; with r = 0 tension along it does not narrow it.
struct BentStrip {
    shapes::DevelopablePart part = shapes::quarter_cylinder({.radius = 50, .length = 60, .triangles = 6000});
    double half = 0;             ///< mm, from the middle to the ends
    Eigen::VectorXd from_middle; ///< mm along the strip, of each face, of both triangles of a cell
                                 ///< alike

    BentStrip()
    {
        const Eigen::Vector2d length = part.flat.rowwise().maxCoeff() - part.flat.rowwise().minCoeff();
        // the other one is the cylinder's length
        const int along = std::abs(length[0] - 60) < 1e-6 ? 1 : 0;
        const Eigen::VectorXd s = part.flat.row(along);
        const double middle = (s.maxCoeff() + s.minCoeff()) / 2;
        half = s.maxCoeff() - middle;
        from_middle.resize(part.mesh.triangles());
        for (int f = 0; f < part.mesh.triangles(); ++f) {
            const Eigen::Vector3d at = s(part.mesh.triangle.col(f)).array() - middle;
            from_middle[f] = 0.5 * std::abs(at.maxCoeff() + at.minCoeff());
        }
    }
    /// That the strain in the outer half is that of a force per length: in the mean within 1 %, of
    /// each face within a share.
    void expect(const FlattenOptions& options, const std::function<double(double)>& force, double each) const
    {
        const FlattenResult result = flatten(part.mesh, options);
        ASSERT_EQ(result.report.system, SolvedSystem::strict) << result.report.reason;
        const StressCurve curve(options.material.hardening, options.material.young_MPa, options.curve);
        double found = 0, wanted = 0;
        for (int f = 0; f < part.mesh.triangles(); ++f)
            if (from_middle[f] > half / 2 && from_middle[f] < 0.9 * half) {
                const double expected = strip_strain(curve, options.thickness, force(from_middle[f]));
                EXPECT_NEAR(result.face.strain_major[f], expected, each * expected + 3e-6) << from_middle[f];
                found += result.face.strain_major[f];
                wanted += expected;
            }
        EXPECT_NEAR(found, wanted, 0.01 * wanted);
    }
};

/// A cup drawn from a square blank with the binder on its flange.
struct DrawnCup {
    TriMesh mesh;
    FlattenOptions options = steel(1.5, 1.5, 1.5);
    std::vector<int> flange, inside, bottom; ///< faces

    explicit DrawnCup(int triangles = 3000) : mesh(shapes::square_cup({.triangles = triangles}))
    {
        const double rim = mesh.position(2, boundary_loops(mesh).front().front());
        for (int f = 0; f < mesh.triangles(); ++f) {
            const Eigen::Vector3d z = mesh.position.row(2)(mesh.triangle.col(f));
            ((z.array() - rim).abs().maxCoeff() < 1e-9 ? flange : inside).push_back(f);
            if (z.cwiseAbs().maxCoeff() < 1e-9)
                bottom.push_back(f);
        }
        options.process.contact = {{"binder", flange, {}, 50000, 0.12, 2}};
    }
    double strain_of_bottom(const FlattenResult& flat) const { return flat.face.strain_equivalent(bottom).mean(); }
};

} // namespace

TEST(Process, ABinderOverACylinderPullsTheSheetFromItsEndsInwards)
{
    // The stroke turns the flat strip down on either side; friction grows from the free ends: T = 2
    // mu p s.
    const BentStrip strip;
    FlattenOptions options = steel(1e-6, 1e-6, 1e-6);
    options.process.contact = {{"binder", {}, 4, {}, 0.12, 2}};
    for (int f = 0; f < strip.part.mesh.triangles(); ++f)
        options.process.contact[0].faces.push_back(f);
    strip.expect(
        options, [&](double at) { return 2 * 0.12 * 4 * (strip.half - at); }, 0.015);
}

TEST(Process, AHeldEdgePullsTheWholeCylinder)
{
    // The sides are edges as well; what holds them at the corners fades out inwards.
    const BentStrip strip;
    FlattenOptions options = steel(1e-6, 1e-6, 1e-6);
    options.process.edge_restraint = 0.25;
    strip.expect(
        options, [&](double) { return 0.25 * lock_force(options.material, options.thickness); }, 0.25);
}

TEST(Process, FrictionOnThePunchRelievesTheBottomOfACup)
{
    DrawnCup cup;
    const double free = cup.strain_of_bottom(flatten(cup.mesh, cup.options));
    cup.options.process.contact.push_back({"punch", cup.inside, 1.0, {}, 0.15, 1});
    const double some = cup.strain_of_bottom(flatten(cup.mesh, cup.options));
    cup.options.process.contact.back().pressure_MPa = 3;
    const double more = cup.strain_of_bottom(flatten(cup.mesh, cup.options));
    std::printf("strain of the bottom %.4f, with friction on the punch %.4f, %.4f\n", free, some, more);
    EXPECT_LT(some, 0.95 * free);
    EXPECT_LT(more, 0.95 * some);
}

TEST(Process, TheMoreTheEdgeIsHeldTheSmallerTheBlankUpToTheLock)
{
    // By a curve that does not let single rows of elements neck.
    DrawnCup cup(6000);
    cup.options.process = {};
    double last = std::numeric_limits<double>::infinity();
    for (const double share : {0., 0.6, 0.85, 1.}) {
        cup.options.process.edge_restraint = share;
        const FlattenResult flat = flatten(cup.mesh, cup.options);
        EXPECT_EQ(flat.report.process_share, 1) << share;
        EXPECT_NE(flat.report.system, SolvedSystem::energy) << share;
        const double width = flat.blank.position.row(0).maxCoeff() - flat.blank.position.row(0).minCoeff();
        std::printf("edge held by %.1f of the lock force: blank %.2f mm wide, %s\n", share, width,
                    std::string(name(flat.report.system)).c_str());
        EXPECT_LT(width, 0.998 * last) << share;
        last = width;
    }
}

TEST(Process, WhatTheSheetBearsDoesNotDependOnHowMuchIsAskedFor)
{
    // A rolled-up strip held at its edge: its slip is far longer than its pitch, and soon no
    // equilibrium is found.
    const auto family = shapes::shape_family();
    const auto spiral =
        std::find_if(family.begin(), family.end(), [](const auto& each) { return each.family == "spiral"; });
    ASSERT_NE(spiral, family.end());
    const TriMesh part = spiral->make();
    FlattenOptions options = steel(1, 1, 1);
    std::vector<double> borne;
    for (const double asked : {0.3, 1.}) {
        options.process.edge_restraint = asked;
        const FlattenResult flat = flatten(part, options);
        ASSERT_GT(flat.report.process_share, 0);
        ASSERT_LT(flat.report.process_share, 1);
        EXPECT_NE(flat.report.system, SolvedSystem::energy);
        ASSERT_EQ(flat.report.attempts.size(), 2u);
        EXPECT_FALSE(flat.report.attempts[0].won) << "all forces at once";
        EXPECT_TRUE(flat.report.attempts[1].won) << "in load steps";
        EXPECT_NE(flat.report.reason.find("too much force"), std::string::npos) << flat.report.reason;
        EXPECT_EQ(flat.report.trusted_strain, uniform_strain(options.material.hardening, options.curve.trusted_strain))
            << "forces in steps are applied with the continued curve";
        borne.push_back(asked * flat.report.process_share);
    }
    std::printf("spiral: %.4f and %.4f of the lock force\n", borne[0], borne[1]);
    EXPECT_NEAR(borne[0], borne[1], 0.03 * borne[0]);
    options.process.edge_restraint = 0.9 * borne[0];
    EXPECT_EQ(flatten(part, options).report.process_share, 1);
}

TEST(Process, ThinningGrowsSteadilyWithTheForceFromNoneOn)
{
    // With a curve that softens strain gathers in rows of elements at some forces and not at
    // others; with one curve for all forces and another for none the smallest force would change
    // the blank.
    const TriMesh cup = shapes::square_cup();
    FlattenOptions options = steel(1.79, 1.51, 2.27);
    const FlattenResult free = flatten(cup, options);
    EXPECT_EQ(free.report.trusted_strain, options.curve.trusted_strain);
    double last = 0, first = 0;
    for (const double share : {1e-4, 0.03, 0.06, 0.1, 0.2, 0.3, 0.33, 0.36, 0.4, 0.5, 0.7, 1.}) {
        options.process.edge_restraint = share;
        const FlattenResult flat = flatten(cup, options);
        EXPECT_EQ(flat.report.system, SolvedSystem::continued) << share;
        EXPECT_LT(flat.report.trusted_strain, options.curve.trusted_strain);
        EXPECT_GT(flat.necking_triangles, 0);
        const double thinning = flat.face.thinning.maxCoeff();
        EXPECT_GT(thinning, last) << share;
        last = thinning;
        first = first > 0 ? first : thinning;
    }
    EXPECT_NEAR(first, free.face.thinning.maxCoeff(), 1e-3);
}

TEST(Process, OnePilotOnlyMovesAFreeSheet)
{
    FlattenOptions options = steel(1.79, 1.51, 2.27);
    for (const TriMesh& part : {shapes::square_cup(), shapes::hat_channel({}).mesh}) {
        options.process.pilots.clear();
        const FlattenResult free = flatten(part, options);
        int lowest = 0; // far from the middle, on the rim
        part.position.row(2).minCoeff(&lowest);
        options.process.pilots = {{"pin", {part.position.col(lowest)}}};
        const FlattenResult held = flatten(part, options);
        EXPECT_EQ(held.report.system, SolvedSystem::strict) << held.report.reason;
        // The pin takes as a point load what the three multipliers spread: as little as it is, it
        // is seen.
        EXPECT_LT((held.face.thinning - free.face.thinning).cwiseAbs().maxCoeff(), 5e-4);
        const Eigen::Vector2d move = held.blank.position.col(lowest) - free.blank.position.col(lowest);
        EXPECT_GT(move.norm(), 1);
        EXPECT_LT(((held.blank.position - free.blank.position).colwise() - move).colwise().norm().maxCoeff(), 0.02);
    }
}

TEST(Process, EveryGradeIsTrustedToItsOwnUniformStrain)
{
    const TriMesh cup = shapes::square_cup();
    FlattenOptions options = steel(1, 1, 1);
    options.process.edge_restraint = 0.4;
    TailoredPiece soft{"soft", {}, options.material, options.thickness};
    soft.material.hardening = Swift{565.32, 0.007117, 0.12};
    for (int f = 0; f < cup.triangles(); ++f)
        if (cup.position(0, cup.triangle(0, f)) > 0)
            soft.faces.push_back(f);
    options.process.tailored = {soft};
    const FlattenResult flat = flatten(cup, options);
    std::vector<char> is_soft(size_t(cup.triangles()), 0);
    for (const int f : soft.faces)
        is_soft[size_t(f)] = 1;
    int beyond = 0;
    for (int f = 0; f < cup.triangles(); ++f) {
        const double limit =
            uniform_strain(is_soft[size_t(f)] ? soft.material.hardening : options.material.hardening, 0.5);
        constexpr double near = 0.01; // what is left of the curve as given under this force
        if (std::abs(flat.face.strain_equivalent[f] - limit) > near) {
            EXPECT_EQ(flat.face.necking[f] != 0, flat.face.strain_equivalent[f] > limit) << f;
        }
        beyond += flat.face.necking[f];
    }
    EXPECT_GT(beyond, 0);
    EXPECT_NEAR(flat.report.trusted_strain, uniform_strain(options.material.hardening, 0.5), 0.01);
}

TEST(Process, TheDirectionMayBeGivenEitherWay)
{
    DrawnCup cup;
    cup.options.direction = Eigen::Vector3d::UnitZ();
    const FlattenResult up = flatten(cup.mesh, cup.options);
    cup.options.direction = Eigen::Vector3d(0, 0, -3);
    const FlattenResult down = flatten(cup.mesh, cup.options);
    EXPECT_EQ(up.blank.position, down.blank.position);
    EXPECT_EQ(down.stamping.direction, up.stamping.direction);
}

TEST(Process, PilotsHoldTheSheetWhereThePartIsSeenAlsoFarFromTheOrigin)
{
    DrawnCup cup;
    cup.mesh.position.colwise() += Eigen::Vector3d(5000, -200, 700);
    cup.options.direction = Eigen::Vector3d::UnitZ();
    const std::vector<int> outline = boundary_loops(cup.mesh).front();
    const int a = outline[0], b = outline[outline.size() / 2];
    for (const int v : {a, b})
        cup.options.process.pilots.push_back({"pin", {cup.mesh.position.col(v)}});
    const FlattenResult flat = flatten(cup.mesh, cup.options);
    for (const int v : {a, b})
        EXPECT_LT((flat.blank.position.col(v) - cup.mesh.position.col(v).head<2>()).norm(), 1e-6);
}

TEST(Process, MessagesTellThePlaceThatWasGiven)
{
    DrawnCup cup;
    cup.mesh.position.colwise() += Eigen::Vector3d(5000, 0, 700);
    cup.options.process = {};
    cup.options.process.drawbeads = {{"b", {{5000, 0, 690}, {5001, 0, 690}}, 50}};
    try {
        flatten(cup.mesh, cup.options);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("(5000, 0, 690)"), std::string::npos) << error.what();
    }
}

TEST(PlanarAnisotropy, ARoundPartNeedsABlankWithFourWaves)
{
    // Drawn from a round blank, a cup has ears where r of the circumferential direction is high:
    // there the flange, pressed together around, gives way outwards more than in thickness [Hill
    // 1950, ch. XII]. Read backwards, the blank of a round part is small there: for r0 = r90 > r45
    // along and across the rolling direction, large at 45 degrees.
    shapes::SharpCup shape;
    shape.triangles = 6000;
    const shapes::AxisymmetricPart part = shapes::sharp_cup(shape);
    const auto radii = [&](const FlattenOptions& options, Eigen::VectorXd& angle) {
        const FlattenResult result = flatten(part.mesh, options);
        EXPECT_TRUE(result.report.converged) << result.report.reason;
        Eigen::VectorXd radius(Eigen::Index(part.rim.size()));
        angle.resize(radius.size());
        const Eigen::Vector2d pole = result.blank.position.col(0);
        for (size_t k = 0; k < part.rim.size(); ++k) {
            const Eigen::Vector2d arm = result.blank.position.col(part.rim[k]) - pole;
            radius[Eigen::Index(k)] = arm.norm();
            angle[Eigen::Index(k)] = std::atan2(arm[1], arm[0]);
        }
        return radius;
    };
    Eigen::VectorXd angle;
    FlattenOptions options = steel(1.9, 1.2, 1.9);
    const double rolling = 20;
    options.process.rolling = Eigen::Vector3d(std::cos(rolling * M_PI / 180), std::sin(rolling * M_PI / 180), 0);
    const Eigen::VectorXd radius = radii(options, angle);
    const double mean = radius.mean();
    // Fourier share of four waves against all others.
    const auto wave = [&](int k) {
        double c = 0, s = 0;
        for (Eigen::Index i = 0; i < radius.size(); ++i) {
            c += (radius[i] - mean) * std::cos(k * (angle[i] - rolling * M_PI / 180)) * 2 / double(radius.size());
            s += (radius[i] - mean) * std::sin(k * (angle[i] - rolling * M_PI / 180)) * 2 / double(radius.size());
        }
        return Eigen::Vector2d(c, s);
    };
    const Eigen::Vector2d four = wave(4);
    EXPECT_LT(four[0], -0.003 * mean); // small along and across the rolling direction
    EXPECT_LT(std::abs(four[1]), 0.02 * std::abs(four[0]));
    for (const int k : {1, 2, 3, 5, 6, 7})
        EXPECT_LT(wave(k).norm(), 0.05 * four.norm()) << k;
    for (const double quarter : {0., 90., 180., 270.})
        EXPECT_LT(radius_at(radius, angle, rolling + quarter), radius_at(radius, angle, rolling + quarter + 45))
            << quarter;

    // With r high across the rolling direction the sheet gives way there, around the flange at the
    // places along it.
    FlattenOptions two = steel(1.2, 1.5, 2.0);
    two.process.rolling = options.process.rolling;
    const Eigen::VectorXd oval = radii(two, angle);
    const double along = radius_at(oval, angle, rolling), beside = radius_at(oval, angle, rolling + 90);
    EXPECT_LT(along, beside - 0.002 * mean);
    EXPECT_NEAR(along, radius_at(oval, angle, rolling + 180), 1e-3 * mean);
    EXPECT_NEAR(beside, radius_at(oval, angle, rolling + 270), 1e-3 * mean);

    FlattenOptions same = steel(1.5, 1.5, 1.5), normal = same;
    same.process.rolling = Eigen::Vector3d(1, 0, 0);
    Eigen::VectorXd other_angle;
    EXPECT_LT((radii(same, angle) - radii(normal, other_angle)).cwiseAbs().maxCoeff(), 1e-6);
}

} // namespace spia::process_test
