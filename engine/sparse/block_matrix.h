#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <vector>

namespace spia {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A sparse matrix of 2 x 2 blocks on the graph of a triangle mesh, with a pattern that is fixed
/// once. Unknown 2 v + k is component k of vertex v. Stored by rows (CSR), full pattern, columns
/// sorted.
class BlockMatrix {
public:
    /// @param triangle 3 by #F vertex indices; every vertex must belong to a triangle
    BlockMatrix(const Eigen::Matrix3Xi& triangle, int vertices);

    /// Replaces the values by the sum of the element matrices; element row 2 a + k is component k
    /// of corner a. Summed in the order of the elements, so the bits do not depend on threads.
    void assemble(const std::vector<Matrix6d>& element);

    /// The same piece by piece: all values zero, then each element's matrix added.
    void clear() { std::fill(value_.begin(), value_.end(), 0.0); }
    void add(int element, const Matrix6d& matrix);

    /// Adds a value on the diagonal of one unknown.
    void add_to_diagonal(int unknown, double value);
    /// Adds a 2 x 2 block on the diagonal of one vertex.
    void add_to_diagonal(int vertex, const Eigen::Matrix2d& block);

    Eigen::VectorXd diagonal() const;
    /// y = A x
    void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

    int vertices() const { return vertices_; }
    int size() const { return 2 * vertices_; }
    const std::vector<int>& row_start() const { return start_; }
    const std::vector<int>& column() const { return column_; }
    const std::vector<double>& value() const { return value_; }

    /// The graph of the vertices (CSC pattern, diagonal included): what fill-reducing orderings
    /// work on.
    const std::vector<int>& graph_start() const { return graph_start_; }
    const std::vector<int>& graph_row() const { return graph_row_; }
    /// Where the entry of two neighbouring vertices stands in graph_row().
    int graph_entry(int row, int column) const;

private:
    int entry(int unknown_row, int unknown_column) const;

    int vertices_;
    std::vector<int> graph_start_, graph_row_;
    std::vector<int> start_, column_;
    std::vector<double> value_;
    /// Per element and block (a, b): where its two rows begin in value_.
    std::vector<std::array<int, 18>> destination_;
};

} // namespace spia
