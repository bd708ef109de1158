#pragma once
#include <Eigen/Core>

// Decompositions of small dense matrices: each of Eigen's that is instantiated costs seconds of
// compiling, so they are instantiated here, once.
namespace spia {

template <int N> struct EigenPairs {
    Eigen::Matrix<double, N, 1> value;  ///< ascending
    Eigen::Matrix<double, N, N> vector; ///< columns, of unit length
};

/// @tparam N  2, 3 or 4
/// @param symmetric  its lower triangle is read
template <int N> EigenPairs<N> eigen_pairs_of(const Eigen::Matrix<double, N, N>& symmetric);

/// Likewise, of an expression.
template <class Expression> auto eigen_pairs(const Eigen::MatrixBase<Expression>& symmetric)
{
    return eigen_pairs_of<int(Expression::RowsAtCompileTime)>(symmetric);
}

/// The nearest symmetric matrix whose eigenvalues are at least the floor.
Eigen::Matrix2d with_least_eigenvalue(const Eigen::Matrix2d& symmetric, double floor);
Eigen::Matrix4d with_least_eigenvalue(const Eigen::Matrix4d& symmetric, double floor);

/// x of least |a x - b|, by QR with pivots: of columns that depend on each other some have no
/// share.
Eigen::Vector3d least_squares(const Eigen::MatrixX3d& a, const Eigen::VectorXd& b);
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Likewise, of all such x the shortest.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::Matrix<double, 6, 1> shortest_least_squares(const Eigen::Matrix<double, Eigen::Dynamic, 6>& a,
                                                   const Eigen::VectorXd& b);

/// Likewise, where singular values below that share of the largest are 0.
Eigen::Vector3d shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double least_share);

/// The direction, of unit length, in which such columns are longest, in the least squares sense.
Eigen::Vector2d longest_axis(const Eigen::Matrix2Xd& columns);

/// The rotation R by which places y_i are nearest to R x_i, by least squares.
/// [W. Kabsch, A solution for the best rotation to relate two sets of vectors, 1976]
/// @param covariance  sum of y_i x_i^T, both about their middles
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& covariance);

} // namespace spia
