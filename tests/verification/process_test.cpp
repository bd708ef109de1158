#include <Eigen/Dense>
#include <cmath>
#include <gtest/gtest.h>

#include "engine/forming/flatten.h"
#include "tests/support/developable.h"
#include "tests/support/revolved.h"

namespace spia {
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
    // A hat; with r = 0 tension does not narrow it, so every generator is in plane strain. The binder presses on both
    // flanges, a bead runs along each: in the flange the force grows inwards by the friction passed, behind the bead by its
    // force, and stays so in wall and top.
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

TEST(PlanarAnisotropy, ARoundPartNeedsABlankWithFourWaves)
{
    // Drawn from a round blank, a cup has ears where r of the circumferential direction is high: there the flange, pressed
    // together around, gives way outwards more than in thickness [Hill 1950, ch. XII]. Read backwards, the blank of a round
    // part is small there: for r0 = r90 > r45 along and across the rolling direction, large at 45 degrees.
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

    FlattenOptions same = steel(1.5, 1.5, 1.5), normal = same;
    same.process.rolling = Eigen::Vector3d(1, 0, 0);
    Eigen::VectorXd other_angle;
    EXPECT_LT((radii(same, angle) - radii(normal, other_angle)).cwiseAbs().maxCoeff(), 1e-6);
}

} // namespace spia
