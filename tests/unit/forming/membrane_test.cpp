#include "engine/forming/solver/membrane.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

#include "engine/core/small_dense.h"
#include "tests/support/shapes.h"

namespace spia::membrane_test {
namespace {

Material mild_steel() { return {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""}; }

/// G with given singular values, turned at random.
Eigen::Matrix2d turned(double s1, double s2, std::mt19937& random)
{
    std::uniform_real_distribution<double> angle(0, 6.28);
    return Eigen::Rotation2Dd(angle(random)).toRotationMatrix() * Eigen::Vector2d(s1, s2).asDiagonal() *
           Eigen::Rotation2Dd(angle(random)).toRotationMatrix();
}

/// States on every piece of the stress curve: elastic, at the knee, plastic, at and beyond the
/// trusted strain, and with equal principal stretches.
std::vector<Eigen::Matrix2d> states()
{
    std::mt19937 random(7);
    std::vector<Eigen::Matrix2d> result;
    for (auto [s1, s2] : {std::pair{1.0001, 0.9999},
                          {1.0009, 0.9995},
                          {1.0006, 1.0006},
                          {1.2, 0.9},
                          {0.8, 0.8},
                          {1.1, 1.1},
                          {1.4, 0.62},
                          {1.3, 0.55},
                          {2.5, 0.3},
                          {0.5, 0.4}})
        result.push_back(turned(s1, s2, random));
    return result;
}

} // namespace

TEST(Membrane, EnergyGradientIsTheDerivativeOfTheEnergy)
{
    const MembraneLaw law(mild_steel());
    for (const Eigen::Matrix2d& G : states())
        for (int k = 0; k < 4; ++k) {
            const double step = 1e-6;
            Eigen::Matrix2d up = G, down = G;
            up(k) += step;
            down(k) -= step;
            const double difference = (energy_density_value(law, up) - energy_density_value(law, down)) / (2 * step);
            const EnergyDensity density = energy_density(law, G);
            EXPECT_NEAR(density.gradient(k), difference, 1e-5 * (1 + density.gradient.norm())) << G;
            EXPECT_NEAR(density.value, energy_density_value(law, G), 1e-12 * (1 + density.value));
        }
}

namespace {

Eigen::Matrix4d hessian_by_differences(const MembraneLaw& law, const Eigen::Matrix2d& G)
{
    Eigen::Matrix4d result;
    for (int k = 0; k < 4; ++k) {
        const double step = 1e-7;
        Eigen::Matrix2d up = G, down = G;
        up(k) += step;
        down(k) -= step;
        result.col(k) = (energy_density(law, up).gradient - energy_density(law, down).gradient).reshaped() / (2 * step);
    }
    return result;
}

} // namespace

TEST(Membrane, StiffnessIsTheSecondDerivativeWhereTheCurveIsSteeperThanItsSecant)
{
    const MembraneLaw law(mild_steel());
    std::mt19937 random(3);
    // On Hooke's line every eigenvalue is positive in compression.
    const Eigen::Matrix2d elastic = turned(1.00005, 1.00003, random);
    const Eigen::Matrix4d stiffness = energy_density(law, elastic).stiffness;
    EXPECT_LT((hessian_by_differences(law, elastic) - stiffness).norm(), 1e-5 * stiffness.norm());
    // In the continuation some are not, but equal compression or stretching of both axes has a
    // positive one.
    for (const double s : {2.0, 0.4}) {
        const Eigen::Matrix2d G = turned(s, s, random);
        const Eigen::Vector4d scaling = G.reshaped();
        const double curvature = scaling.dot(energy_density(law, G).stiffness * scaling);
        EXPECT_NEAR(scaling.dot(hessian_by_differences(law, G) * scaling), curvature, 1e-5 * curvature) << G;
    }
}

TEST(Membrane, StiffnessExceedsTheSecondDerivativeAlongTheStrainBySecantMinusSlope)
{
    const MembraneLaw law(mild_steel());
    std::mt19937 random(4);
    for (auto [s1, s2] : {std::pair{1.05, 1.02}, {1.08, 1.08}, {1.1, 1.05}, {1.003, 1.002}}) {
        const Eigen::Matrix2d G = turned(s1, s2, random);
        const Eigen::Matrix4d stiffness = energy_density(law, G).stiffness;
        Eigen::Matrix4d excess = stiffness - hessian_by_differences(law, G);
        excess = 0.5 * (excess + excess.transpose()).eval();
        const Eigen::Vector4d value = eigen_pairs(excess).value;
        EXPECT_LT(value.head<3>().norm(), 1e-4 * value[3]) << G; // of rank one
        const PlaneStress p = law({-std::log(s1), -std::log(s2)});
        const FlowStress flow = law.curve()(p.equivalent_strain);
        const Eigen::Vector2d along = p.stress / p.equivalent_stress; // d eps_eq / d eps
        const double expected = (flow.stress / p.equivalent_strain - flow.slope) *
                                (std::pow(along[0] / s1, 2) + std::pow(along[1] / s2, 2));
        EXPECT_NEAR(value[3], expected, 1e-4 * expected) << G;
    }
}

TEST(Membrane, StiffnessIsPositiveDefiniteEverywhere)
{
    const MembraneLaw law(mild_steel());
    for (const Eigen::Matrix2d& G : states())
        EXPECT_GT(eigen_pairs(energy_density(law, G).stiffness).value[0], 0);
}

namespace {

void expect_exact_force_tangent(const MembraneLaw& law)
{
    for (const Eigen::Matrix2d& G : states()) {
        const MembraneForce force = membrane_force(law, 0.78, G);
        for (int k = 0; k < 4; ++k) {
            const double step = 1e-7;
            Eigen::Matrix2d up = G, down = G;
            up(k) += step;
            down(k) -= step;
            const Eigen::Vector4d difference =
                (membrane_force(law, 0.78, up).force - membrane_force(law, 0.78, down).force).reshaped() / (2 * step);
            EXPECT_LT((difference - force.derivative.col(k)).norm(), 2e-5 * force.derivative.norm()) << G;
        }
    }
}

} // namespace

TEST(Membrane, ForceTangentAgreesWithCentralDifferences) { expect_exact_force_tangent(MembraneLaw(mild_steel())); }

TEST(Membrane, UniaxialTensionGivesTheFlowCurveAndTheLankfordCoefficient)
{
    const Material material = mild_steel();
    const MembraneLaw law(material);
    const double r = 1.77, strain = 0.2;
    // In uniaxial tension eps_2 = -r/(1+r) eps_1 (width to thickness strain r), sigma_2 = 0,
    // sigma_1 = sigma_Y(eps_1).
    const PlaneStress p = law({strain, -r / (1 + r) * strain});
    EXPECT_NEAR(p.equivalent_strain, strain, 1e-14);
    EXPECT_NEAR(p.stress[0], 565.32 * std::pow(0.007117 + strain, 0.2589), 1e-10);
    EXPECT_NEAR(p.stress[1], 0, 1e-10);
}

TEST(Membrane, ShapeFunctionGradientsReproduceALinearField)
{
    const TriMesh part = shapes::rectangle(3, 2, 4, 3);
    for (const Element& e : elements(part))
        EXPECT_NEAR((e.gradient.rowwise().sum()).norm(), 0, 1e-14);
    const auto list = elements(part);
    Eigen::Matrix2d A;
    A << 1.2, 0.3, -0.1, 0.8;
    const Eigen::Matrix2Xd X = A * part.position.topRows<2>();
    for (int f = 0; f < part.triangles(); ++f) {
        const Element& e = list[size_t(f)];
        const Eigen::Matrix2d G = inverse_gradient(e, corners(X, part.triangle.col(f)));
        EXPECT_LT((G - A * e.frame.topRows<2>()).norm(), 1e-13);
    }
}

namespace {

Material anisotropic() { return {"planar", 70000, 0.33, 2700, Swift{570, 0.01, 0.24}, 0.7, 0.45, 1.3, ""}; }

} // namespace

TEST(PlanarAnisotropy, ForceTangentAgreesWithCentralDifferences)
{
    expect_exact_force_tangent(MembraneLaw(anisotropic(), {}, 0.4));
}

TEST(PlanarAnisotropy, WithEqualLankfordCoefficientsIsNormalAnisotropy)
{
    const MembraneLaw normal(mild_steel()), planar(mild_steel(), {}, 1.1);
    for (const Eigen::Matrix2d& G : states()) {
        const MembraneForce a = membrane_force(normal, 0.78, G), b = membrane_force(planar, 0.78, G);
        EXPECT_LT((a.force - b.force).norm(), 1e-11 * a.force.norm());
        EXPECT_LT((a.derivative - b.derivative).norm(), 1e-11 * a.derivative.norm());
    }
}

TEST(PlanarAnisotropy, TurningTheSheetWithItsRollingDirectionChangesNothing)
{
    const double turn = 0.9;
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(turn).toRotationMatrix();
    const MembraneLaw law(anisotropic(), {}, 0.4), turned_law(anisotropic(), {}, 0.4 + turn);
    double difference_of_laws = 0;
    for (const Eigen::Matrix2d& G : states()) {
        const Eigen::Matrix2d a = membrane_force(law, 1, G).force, b = membrane_force(turned_law, 1, R * G).force;
        EXPECT_LT((a - b).norm(), 1e-11 * a.norm());
        difference_of_laws =
            std::max(difference_of_laws, (a - membrane_force(turned_law, 1, G).force).norm() / a.norm());
    }
    EXPECT_GT(difference_of_laws, 0.05); // the direction does matter
}

TEST(PlanarAnisotropy, TensionAlongAcrossAndBetweenGivesTheLankfordCoefficients)
{
    // Pulled along a direction, the width strain is r times the thickness strain: eps_width =
    // -r/(1+r) eps. Then there is no stress but along it. Between the two the principal axes are
    // those of the pull only for r0 = r90.
    const auto pulled = [](const Material& material, double r, double angle) {
        const MembraneLaw law(material, {}, 0.0);
        const Eigen::Matrix2d axes = Eigen::Rotation2Dd(angle).toRotationMatrix();
        return law(axes, {0.2, -r / (1 + r) * 0.2});
    };
    const Material sheet = anisotropic();
    const AxisStress along = pulled(sheet, 0.7, 0), across = pulled(sheet, 1.3, std::acos(0.0));
    Material even = sheet;
    even.r90 = even.r0;
    const AxisStress between = pulled(even, 0.45, std::acos(0.0) / 2);
    for (const AxisStress& p : {along, across, between}) {
        EXPECT_GT(p.stress[0], 100);
        EXPECT_NEAR(p.stress[1], 0, 1e-10);
        EXPECT_NEAR(p.stress[2], 0, 1e-10);
    }
    // the curve is the one along the rolling direction
    EXPECT_NEAR(along.stress[0], 570 * std::pow(0.21, 0.24), 1e-9);
    // Across: sigma_eq^2 = (F + H) sigma^2, and the plastic work is that of the curve: sigma eps =
    // sigma_eq eps_eq.
    const double F = 0.7 / (1.3 * 1.7), H = 0.7 / 1.7;
    EXPECT_NEAR(across.equivalent_stress, std::sqrt(F + H) * across.stress[0], 1e-9);
    EXPECT_NEAR(across.equivalent_stress * across.equivalent_strain, across.stress[0] * 0.2, 1e-9);
    EXPECT_NEAR(between.equivalent_stress * between.equivalent_strain, between.stress[0] * 0.2, 1e-9);
}

} // namespace spia::membrane_test
