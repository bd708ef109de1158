#include "engine/forming/solver/skin_strain.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace spia::skin_strain_test {
namespace {

constexpr double h = 1.2; // mm

Sheet steel(const TriMesh& part)
{
    const Material mild{"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1, 1, 1, ""};
    return uniform_sheet(MembraneLaw(mild), h, part.triangles());
}

/// A flat sheet with its middle moved about, so that no two triangles are alike.
TriMesh uneven(double width, double height, int columns, int rows)
{
    TriMesh flat = shapes::rectangle(width, height, columns, rows);
    for (int v = 0; v < flat.vertices(); ++v) {
        const double x = flat.position(0, v), y = flat.position(1, v);
        const double inside = x * (width - x) * y * (height - y) / std::pow(width * height / 4, 2);
        flat.position(0, v) += 0.2 * width / columns * inside * std::sin(3 * x + 5 * y);
        flat.position(1, v) += 0.2 * height / rows * inside * std::cos(7 * x - 2 * y);
    }
    return flat;
}

/// Rolled onto a cylinder about the y axis whose middle has this radius; outside is where z grows.
TriMesh rolled(TriMesh part, double radius)
{
    for (auto p : part.position.colwise()) {
        const double angle = p[0] / radius;
        p[0] = radius * std::sin(angle);
        p[2] = radius * std::cos(angle);
    }
    return part;
}

double largest_error(const Eigen::VectorXd& value, double truth) { return (value.array() - truth).abs().maxCoeff(); }

} // namespace

TEST(SkinStrain, OfARolledSheetIsTheLogarithmOfTheRadii)
{
    constexpr double radius = 8;
    const double outer = std::log(1 + h / (2 * radius)), inner = std::log(1 - h / (2 * radius));
    double last = 0;
    for (const int fine : {1, 2, 4}) {
        const TriMesh flat = uneven(12, 10, 12 * fine, 10 * fine), part = rolled(flat, radius);
        const SkinStrains skin = skin_strains(part, elements(part), {flat.position.topRows<2>()}, steel(part));
        const double error =
            std::max({largest_error(skin.outer.strain_major, outer), largest_error(skin.inner.strain_minor, inner),
                      largest_error(skin.outer.strain_minor, 0), largest_error(skin.inner.strain_major, 0)});
        EXPECT_LT(error, 0.03 * outer / fine) << fine;
        if (fine > 1) {
            EXPECT_LT(error, 0.7 * last) << "converges";
        }
        last = error;
        EXPECT_NEAR(skin.curvature.mean(), 1 / radius, 0.015 / (fine * fine) / radius) << "order 2";
        EXPECT_EQ(skin.sharp_faces, 0);
        // Bent in plane strain: eps_eq of an isotropic sheet is 2 / sqrt(3) of the strain across
        // the bend.
        EXPECT_NEAR(skin.outer.strain_equivalent.mean(), 2 / std::sqrt(3.0) * outer, 0.02 * outer);
    }
}

TEST(SkinStrain, TheSkinsChangePlacesWhenThePartIsTurnedOver)
{
    const TriMesh flat = uneven(12, 10, 12, 10), part = rolled(flat, 8);
    TriMesh turned = part;
    turned.position.row(2) *= -1;
    turned.triangle.row(0).swap(turned.triangle.row(1));
    turned.position.row(2) *= -1; // the same place, seen from the other side
    const Eigen::Matrix2Xd blank = flat.position.topRows<2>();
    Eigen::Matrix2Xd mirrored = blank;
    mirrored.row(1) *= -1;
    const SkinStrains a = skin_strains(part, elements(part), {blank}, steel(part)),
                      b = skin_strains(turned, elements(turned), {mirrored}, steel(part));
    EXPECT_LT((a.outer.strain_major - b.inner.strain_major).norm(), 1e-12);
    EXPECT_LT((a.inner.strain_minor - b.outer.strain_minor).norm(), 1e-12);
    EXPECT_LT((a.curvature + b.curvature).norm(), 1e-12);
}

TEST(SkinStrain, ComesOnTopOfTheStrainOfTheMiddleAndOfTheThicknessThatIsLeft)
{
    constexpr double radius = 8, stretch = 1.2; // along the bend
    TriMesh flat = uneven(12, 10, 48, 40);
    const TriMesh part = rolled(flat, radius);
    flat.position.row(0) /= stretch;
    const SkinStrains skin = skin_strains(part, elements(part), {flat.position.topRows<2>()}, steel(part));
    const double left = h / stretch; // the width stays
    EXPECT_LT(largest_error(skin.outer.strain_major, std::log(stretch) + std::log(1 + left / (2 * radius))), 1e-3);
    EXPECT_LT(largest_error(skin.inner.strain_major, std::log(stretch) + std::log(1 - left / (2 * radius))), 1e-3);
}

TEST(SkinStrain, OfASphereIsTheSameAllAround)
{
    constexpr double radius = 20;
    TriMesh part = uneven(16, 16, 32, 32);
    Eigen::Matrix2Xd blank = part.position.topRows<2>();
    for (auto p : part.position.colwise()) {
        p.head<2>().array() -= 8;
        p[2] = std::sqrt(radius * radius - p.head<2>().squaredNorm());
    }
    double worst = 0;
    for (const Eigen::Matrix2d& W : curvatures(part, elements(part)))
        worst = std::max(worst, (W - Eigen::Matrix2d::Identity() / radius).norm());
    EXPECT_LT(worst, 2e-2 / radius);
}

TEST(SkinStrain, AFoldIsTakenAsBentToARadiusOfOneThickness)
{
    TriMesh flat = shapes::rectangle(12, 10, 48, 40), part = flat;
    for (auto p : part.position.colwise())
        if (p[0] > 6) {
            p[2] = -(p[0] - 6);
            p[0] = 6;
        }
    const Eigen::Matrix2Xd blank = flat.position.topRows<2>();
    Sheet thick = steel(part);
    thick.thickness.setConstant(2);
    const SkinStrains skin = skin_strains(part, elements(part), {blank}, thick);
    EXPECT_GT(skin.sharp_faces, 0);
    EXPECT_LT(skin.sharp_faces, part.triangles() / 4);
    EXPECT_NEAR(skin.outer.strain_major.maxCoeff(), std::log(1.5), 1e-6);
    EXPECT_NEAR(skin.inner.strain_minor.minCoeff(), std::log(0.5), 1e-6);
}

} // namespace spia::skin_strain_test
