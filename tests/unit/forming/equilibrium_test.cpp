#include "engine/forming/equilibrium.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <random>

#include "tests/support/shapes.h"

namespace spia {
namespace {

Material mild_steel() { return {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""}; }

/// A wavy patch and a blank that strains it by some ten percent everywhere.
TriMesh wavy()
{
    TriMesh part = shapes::rectangle(30, 20, 6, 5);
    for (int v = 0; v < part.vertices(); ++v)
        part.position(2, v) = 3 * std::sin(0.2 * part.position(0, v)) * std::cos(0.25 * part.position(1, v));
    return part;
}
Eigen::Matrix2Xd strained(const TriMesh& part)
{
    Eigen::Matrix2Xd X = part.position.topRows<2>();
    for (int v = 0; v < part.vertices(); ++v) {
        X(0, v) *= 1.08 + 0.002 * X(1, v);
        X(1, v) += 0.01 * X(0, v) + 0.3 * std::sin(0.3 * X(0, v));
    }
    return X;
}

} // namespace

TEST(Equilibrium, TangentAgreesWithCentralDifferencesWithFriction)
{
    const TriMesh part = wavy();
    const MembraneLaw law(mild_steel());
    const Eigen::Matrix2Xd X = strained(part);
    Friction friction;
    friction.traction = Eigen::VectorXd::Constant(part.triangles(), 0.8);
    friction.plane << 1, 0, 0, 1, 0, 0;
    friction.origin << 0.3, -0.2, 5;
    const EquilibriumSystem at_X = equilibrium_system(part, law, 0.8, friction, X, X);
    Eigen::MatrixXd difference(X.size(), X.size());
    const double step = 1e-6;
    for (Eigen::Index i = 0; i < X.size(); ++i) {
        Eigen::Matrix2Xd up = X, down = X;
        up(i) += step;
        down(i) -= step;
        difference.col(i) = (equilibrium_system(part, law, 0.8, friction, X, up).residual -
                             equilibrium_system(part, law, 0.8, friction, X, down).residual) /
                            (2 * step);
    }
    for (Eigen::Index i = 0; i < X.size(); ++i) {
        Eigen::VectorXd column;
        at_X.tangent.multiply(Eigen::VectorXd::Unit(X.size(), i), column);
        EXPECT_LT((column - difference.col(i)).norm(), 1e-6 * difference.norm());
    }
}

TEST(Equilibrium, MovingTheBlankChangesNothing)
{
    const TriMesh part = wavy();
    const MembraneLaw law(mild_steel());
    const Eigen::Matrix2Xd X = strained(part);
    const Eigen::Matrix2Xd moved = (Eigen::Rotation2Dd(0.7).toRotationMatrix() * X).colwise() + Eigen::Vector2d(11, -4);
    const Eigen::VectorXd a = equilibrium_system(part, law, 0.8, {}, X, X).residual;
    const Eigen::VectorXd b = equilibrium_system(part, law, 0.8, {}, X, moved).residual;
    EXPECT_LT((a - b).norm(), 1e-10 * a.norm());
}

} // namespace spia
