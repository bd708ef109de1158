#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "engine/core/small_dense.h"
#include "engine/core/small_sparse.h"

namespace spia {

TEST(SmallDense, NearestRotationIsThatOfTheTurnedPlaces)
{
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    const Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Random(3, 12);
    const Eigen::Matrix3d same = nearest_rotation(turn * x * x.transpose());
    EXPECT_LT((same - turn).norm(), 1e-13);
    // of a mirrored set it is a rotation all the same
    const Eigen::Matrix3d mirrored = nearest_rotation(-turn * x * x.transpose());
    EXPECT_NEAR(mirrored.determinant(), 1, 1e-13);
    // flat places, as those of a blank, leave one axis to be found
    Eigen::Matrix3Xd flat = x;
    flat.row(2).setZero();
    EXPECT_LT((nearest_rotation(turn * flat * flat.transpose()) - turn).norm(), 1e-13);
}

TEST(SmallSparse, FactorsSolveAndSayWhereThereIsNone)
{
    Eigen::SparseMatrix<double> matrix(3, 3);
    const std::vector<Eigen::Triplet<double>> entries{{0, 0, 4}, {1, 1, 3},  {2, 2, 5}, {1, 0, 1},
                                                      {0, 1, 1}, {2, 1, -2}, {1, 2, -2}};
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::MatrixXd x = Eigen::MatrixXd::Random(3, 2), right = matrix * x;
    const SparseLdlt ldlt(matrix);
    ASSERT_TRUE(ldlt.ok());
    EXPECT_LT((ldlt.solve(right) - x).norm(), 1e-14);
    const SparseLu lu(matrix);
    ASSERT_TRUE(lu.ok());
    EXPECT_LT((lu.solve(right) - x).norm(), 1e-14);
    matrix.coeffRef(0, 0) = 0;
    matrix.coeffRef(0, 1) = matrix.coeffRef(1, 0) = 0;
    EXPECT_FALSE(SparseLdlt(matrix).ok());
    EXPECT_FALSE(SparseLu(matrix).ok());
}

} // namespace spia
