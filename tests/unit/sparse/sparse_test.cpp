#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <random>

#include "engine/core/error.h"
#include "engine/sparse/block_matrix.h"
#include "engine/sparse/cholesky.h"
#include "engine/sparse/gmres.h"
#include "engine/sparse/lu.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

struct Assembled {
    BlockMatrix sparse;
    Eigen::MatrixXd dense;
};

/// Random element matrices on a small mesh; with `definite` their sum is symmetric positive
/// definite.
Assembled random_matrix(bool definite)
{
    const TriMesh mesh = shapes::rectangle(4, 3, 4, 3);
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    Assembled result{BlockMatrix(mesh.triangle, mesh.vertices()),
                     Eigen::MatrixXd::Zero(2 * mesh.vertices(), 2 * mesh.vertices())};
    std::vector<Matrix6d> element;
    for (int f = 0; f < mesh.triangles(); ++f) {
        Matrix6d A = Matrix6d::NullaryExpr([&] { return normal(random); });
        if (definite)
            A = (A * A.transpose() + Matrix6d::Identity()).eval();
        else
            A += 6 * Matrix6d::Identity();
        element.push_back(A);
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j)
                result.dense(2 * mesh.triangle(i / 2, f) + i % 2, 2 * mesh.triangle(j / 2, f) + j % 2) += A(i, j);
    }
    result.sparse.assemble(element);
    return result;
}

Eigen::VectorXd some_vector(Eigen::Index size) { return Eigen::VectorXd::LinSpaced(size, -1, 2).array().sin(); }

} // namespace

TEST(BlockMatrix, MultipliesAsTheDenseSumOfItsElements)
{
    Assembled A = random_matrix(false);
    const Eigen::VectorXd x = some_vector(A.dense.cols());
    Eigen::VectorXd y;
    A.sparse.multiply(x, y);
    EXPECT_LT((y - A.dense * x).norm(), 1e-12 * y.norm());
    EXPECT_LT((A.sparse.diagonal() - A.dense.diagonal()).norm(), 1e-12);

    Eigen::Matrix2d block;
    block << 1, 2, 3, 4;
    A.sparse.add_to_diagonal(5, block);
    A.sparse.add_to_diagonal(7, 0.5);
    A.dense.block<2, 2>(10, 10) += block;
    A.dense(7, 7) += 0.5;
    A.sparse.multiply(x, y);
    EXPECT_LT((y - A.dense * x).norm(), 1e-12 * y.norm());
}

TEST(Cholesky, SolvesAndServesASecondMatrixOfThePattern)
{
    Assembled A = random_matrix(true);
    Cholesky cholesky(A.sparse);
    const Eigen::VectorXd b = some_vector(A.dense.cols());
    ASSERT_TRUE(cholesky.factor(A.sparse));
    EXPECT_LT((A.dense * cholesky.solve(b) - b).norm(), 1e-10 * b.norm());
    for (int i = 0; i < A.sparse.size(); ++i) {
        A.sparse.add_to_diagonal(i, 3);
        A.dense(i, i) += 3;
    }
    ASSERT_TRUE(cholesky.factor(A.sparse));
    EXPECT_LT((A.dense * cholesky.solve(b) - b).norm(), 1e-10 * b.norm());
}

TEST(Cholesky, SaysWhenAMatrixIsNotDefiniteAndRecovers)
{
    Assembled A = random_matrix(true);
    Cholesky cholesky(A.sparse);
    BlockMatrix indefinite = A.sparse;
    indefinite.add_to_diagonal(4, -1e4);
    EXPECT_FALSE(cholesky.factor(indefinite));
    EXPECT_TRUE(cholesky.factor(A.sparse));
}

TEST(Cholesky, PreconditionsAboutAsItSolvesWithTheSameBitsOnAnyNumberOfThreads)
{
    const TriMesh mesh = shapes::rectangle(90, 40, 90, 40);
    BlockMatrix A(mesh.triangle, mesh.vertices());
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const auto fill = [&] {
        std::vector<Matrix6d> element;
        for (int f = 0; f < mesh.triangles(); ++f) {
            const Matrix6d K = Matrix6d::NullaryExpr([&] { return normal(random); });
            element.push_back(K * K.transpose() + 0.1 * Matrix6d::Identity());
        }
        A.assemble(element);
    };
    fill();
    Cholesky cholesky(A);
    const Eigen::VectorXd b = some_vector(A.size());
    for (int factor = 0; factor < 2; ++factor, fill()) {
        ASSERT_TRUE(cholesky.factor(A));
        const Eigen::VectorXd exact = cholesky.solve(b);
        EXPECT_LT((cholesky.precondition(b) - exact).norm(), 1e-4 * exact.norm());
        std::vector<Eigen::VectorXd> on_threads;
        for (const size_t threads : {1, 2}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            on_threads.push_back(cholesky.precondition(b));
        }
        EXPECT_EQ(on_threads[0], on_threads[1]);
    }
}

TEST(Lu, SolvesAnUnsymmetricMatrix)
{
    const Assembled A = random_matrix(false);
    const Eigen::VectorXd b = some_vector(A.dense.cols());
    EXPECT_LT((A.dense * Lu(A.sparse).solve(b) - b).norm(), 1e-10 * b.norm());
}

TEST(Lu, RecognisesASingularMatrix)
{
    Assembled A = random_matrix(false);
    A.sparse.assemble(std::vector<Matrix6d>(24, Matrix6d::Zero()));
    EXPECT_TRUE(Lu(A.sparse).singular());
    EXPECT_FALSE(Lu(random_matrix(false).sparse).singular());
}

TEST(Gmres, ReachesTheToleranceItReports)
{
    const Assembled A = random_matrix(false);
    const Eigen::VectorXd b = some_vector(A.dense.cols());
    const auto apply = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(A.dense * x); };
    const auto jacobi = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(x.cwiseQuotient(A.dense.diagonal())); };
    for (double tolerance : {1e-2, 1e-6, 1e-10}) {
        const GmresResult solved = gmres(apply, jacobi, b, tolerance, 40);
        const double true_residual = (A.dense * solved.x - b).norm() / b.norm();
        EXPECT_LE(true_residual, 1.01 * tolerance);
        EXPECT_NEAR(true_residual, solved.relative_residual, 1e-12);
    }
}

TEST(Gmres, AnExactPreconditionerNeedsOneStep)
{
    const Assembled A = random_matrix(false);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(A.dense);
    const GmresResult solved = gmres([&](const Eigen::VectorXd& x) { return Eigen::VectorXd(A.dense * x); },
                                     [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(lu.solve(x)); },
                                     some_vector(A.dense.cols()), 1e-8, 10);
    EXPECT_EQ(solved.iterations, 1);
}

} // namespace spia
