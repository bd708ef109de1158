#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

namespace spia {

/// A structured quad mesh of columns x rows cells; node (i, j) is column i + j * (columns + 1) of
/// position.
struct QuadGrid {
    int columns = 0;           ///< cells along u
    int rows = 0;              ///< cells along v
    Eigen::Matrix3Xd position; ///< mm; z = 0 while it lies in the plane of the blank

    int nodes() const { return (columns + 1) * (rows + 1); }
    int node(int i, int j) const { return i + j * (columns + 1); }
    /// Of cell i + j * columns.
    std::array<int, 2> column_and_row(int cell) const { return {cell % columns, cell / columns}; }
};

/// The outer boundary of the blank, cut at four corner vertices into the sides v = 0, u = 1, v = 1,
/// u = 0, each a row of vertex indices in counter-clockwise order, both corners included.
struct BlankBoundary {
    std::array<int, 4> corner;
    std::array<std::vector<int>, 4> side;
};

} // namespace spia
