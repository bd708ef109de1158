#include "engine/core/small_dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace spia {

template <int N> EigenPairs<N> eigen_pairs_of(const Eigen::Matrix<double, N, N>& symmetric)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(symmetric);
    return {solver.eigenvalues(), solver.eigenvectors()};
}
template EigenPairs<2> eigen_pairs_of<2>(const Eigen::Matrix2d&);
template EigenPairs<3> eigen_pairs_of<3>(const Eigen::Matrix3d&);
template EigenPairs<4> eigen_pairs_of<4>(const Eigen::Matrix4d&);

namespace {

template <int N> Eigen::Matrix<double, N, N> raised(const Eigen::Matrix<double, N, N>& symmetric, double floor)
{
    const EigenPairs<N> pairs = eigen_pairs_of<N>(symmetric);
    return pairs.vector * pairs.value.cwiseMax(floor).asDiagonal() * pairs.vector.transpose();
}

} // namespace

Eigen::Matrix2d with_least_eigenvalue(const Eigen::Matrix2d& symmetric, double floor)
{
    return raised<2>(symmetric, floor);
}

Eigen::Matrix4d with_least_eigenvalue(const Eigen::Matrix4d& symmetric, double floor)
{
    return raised<4>(symmetric, floor);
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b)
{
    return a.colPivHouseholderQr().solve(b);
}

Eigen::Vector3d least_squares(const Eigen::MatrixX3d& a, const Eigen::VectorXd& b)
{
    return least_squares(Eigen::MatrixXd(a), b);
}

Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b)
{
    return a.completeOrthogonalDecomposition().solve(b);
}

Eigen::Matrix<double, 6, 1> shortest_least_squares(const Eigen::Matrix<double, Eigen::Dynamic, 6>& a,
                                                   const Eigen::VectorXd& b)
{
    return shortest_least_squares(Eigen::MatrixXd(a), b);
}

Eigen::Vector3d shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double least_share)
{
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(least_share);
    return svd.solve(b);
}

Eigen::Vector2d longest_axis(const Eigen::Matrix2Xd& columns)
{
    return Eigen::JacobiSVD<Eigen::MatrixXd>(columns, Eigen::ComputeThinU).matrixU().col(0);
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& covariance)
{
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0)
        u.col(2) = -u.col(2);
    return u * svd.matrixV().transpose();
}

} // namespace spia
