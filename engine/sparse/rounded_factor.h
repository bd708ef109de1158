#pragma once
#include <Eigen/Core>
#include <vector>

namespace spia {

/// A supernodal Cholesky factor L L^T of a permuted matrix, as CHOLMOD stores it: the columns of a
/// supernode lie side by side as one dense block, whose first rows are those columns. [Chen, Davis,
/// Hager and Rajamanickam 2008]
struct Supernodes {
    int count, size;
    const int *column, *row_start, *row; ///< first column of each supernode; its rows are
                                         ///< row[row_start[s]] on
    const int* value_start;
    const double* value;
    size_t values;
    const int* permutation; ///< unknown of each column
};

/// The factor rounded to single precision. A solve does little more than read the factor, so half
/// of the bytes take little more than half of the time; its error (6e-5 of the right side at
/// 105,000 triangles) is nothing to a preconditioner. Subtrees of the elimination tree that have
/// nothing to do with each other are solved on the available threads; which ones these are does not
/// depend on the threads, nor do the bits.
class RoundedFactor {
public:
    void assign(const Supernodes& factor);
    /// About (L L^T)^-1 b, by the supernodes of the factor that was assigned, which must still be
    /// there.
    Eigen::VectorXd solve(const Supernodes& factor, const Eigen::VectorXd& b);

private:
    /// Supernodes, ascending, with the work space for them.
    struct Part {
        std::vector<int> supernode;
        Eigen::VectorXd x, sum;
    };
    void divide(const Supernodes& factor);
    void forward(const Supernodes& factor, Part& part);
    void backward(const Supernodes& factor, Part& part);

    std::vector<float> value_;
    std::vector<Part> part_;
    Part top_; ///< the supernodes above the parts
};

} // namespace spia
