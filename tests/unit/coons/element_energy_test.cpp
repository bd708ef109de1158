#include "engine/coons/element_energy.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "engine/core/small_dense.h"

namespace spia {

TEST(ElementEnergy, IsLeastForARotationAndInfiniteForAFold)
{
    const ElementEnergy energy{0, 0.3};
    const Jacobian rotation(std::cos(0.7), std::sin(0.7), -std::sin(0.7), std::cos(0.7));
    EXPECT_NEAR(energy.value(rotation), 2 + 2 * 0.3, 1e-14);
    Eigen::Vector4d gradient;
    Eigen::Matrix4d hessian;
    energy.derivatives(rotation, gradient, hessian);
    EXPECT_LT(gradient.norm(), 1e-14);
    EXPECT_EQ(energy.value(Jacobian(1, 0, 0, -1)), std::numeric_limits<double>::infinity());
    EXPECT_EQ(energy.value(Jacobian::Zero()), std::numeric_limits<double>::infinity());
    EXPECT_LT((ElementEnergy{0.1, 0.3}.value(Jacobian(1, 0, 0, -1))), 1e4); // finite once eps > 0
}

TEST(ElementEnergy, DerivativesAreThoseOfTheValue)
{
    // Where the second derivative has no negative eigenvalue, it must be the difference of the
    // gradients too.
    for (const double eps : {0.0, 0.2})
        for (const Jacobian& J :
             {Jacobian(1.1, 0.2, -0.1, 0.9), Jacobian(0.5, 0.1, 0.3, 0.7), Jacobian(1, 0.1, 0.2, -0.8)}) {
            if (eps == 0 && J[0] * J[3] < J[1] * J[2])
                continue; // a folded element has an energy with eps only
            const ElementEnergy energy{eps, 0.5};
            Eigen::Vector4d gradient, ahead, behind;
            Eigen::Matrix4d hessian, ignored;
            energy.derivatives(J, gradient, hessian);
            constexpr double h = 1e-5; // differences are good to h^2
            Eigen::Matrix4d expected;
            for (int k = 0; k < 4; ++k) {
                const Jacobian step = h * Jacobian::Unit(k);
                EXPECT_NEAR(gradient[k], (energy.value(J + step) - energy.value(J - step)) / (2 * h),
                            1e-7 * std::max(1., energy.value(J)));
                energy.derivatives(J + step, ahead, ignored);
                energy.derivatives(J - step, behind, ignored);
                expected.col(k) = (ahead - behind) / (2 * h);
            }
            const EigenPairs<4> eigen = eigen_pairs(expected);
            const Eigen::Matrix4d clamped =
                eigen.vector * eigen.value.cwiseMax(0).asDiagonal() * eigen.vector.transpose();
            EXPECT_LT((hessian - clamped).cwiseAbs().maxCoeff(), 1e-6 * expected.norm());
        }
}

} // namespace spia
