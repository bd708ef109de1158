#include "engine/sparse/block_matrix.h"

#include <algorithm>
#include <array>

#include "engine/core/parallel.h"

namespace spia {

BlockMatrix::BlockMatrix(const Eigen::Matrix3Xi& triangle, int vertices) : vertices_(vertices)
{
    // Neighbours of each vertex, itself included, sorted.
    std::vector<std::vector<int>> neighbour(static_cast<size_t>(vertices));
    for (int v = 0; v < vertices; ++v)
        neighbour[size_t(v)].push_back(v);
    for (Eigen::Index f = 0; f < triangle.cols(); ++f)
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
                if (a != b)
                    neighbour[size_t(triangle(a, f))].push_back(triangle(b, f));
    graph_start_.assign(1, 0);
    for (auto& list : neighbour) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        graph_row_.insert(graph_row_.end(), list.begin(), list.end());
        graph_start_.push_back(int(graph_row_.size()));
    }
    start_.assign(1, 0);
    column_.reserve(4 * graph_row_.size());
    for (int v = 0; v < vertices; ++v)
        for (int k = 0; k < 2; ++k) {
            for (int w : neighbour[size_t(v)]) {
                column_.push_back(2 * w);
                column_.push_back(2 * w + 1);
            }
            start_.push_back(int(column_.size()));
        }
    value_.assign(column_.size(), 0);

    destination_.resize(size_t(triangle.cols()));
    for (Eigen::Index f = 0; f < triangle.cols(); ++f)
        for (int a = 0; a < 3; ++a)
            for (int k = 0; k < 2; ++k)
                for (int b = 0; b < 3; ++b)
                    destination_[size_t(f)][size_t((2 * a + k) * 3 + b)] =
                        entry(2 * triangle(a, f) + k, 2 * triangle(b, f));
}

int BlockMatrix::entry(int unknown_row, int unknown_column) const
{
    const auto begin = column_.begin() + start_[size_t(unknown_row)];
    const auto end = column_.begin() + start_[size_t(unknown_row) + 1];
    return int(std::lower_bound(begin, end, unknown_column) - column_.begin());
}

int BlockMatrix::graph_entry(int row, int column) const
{
    const auto begin = graph_row_.begin() + graph_start_[size_t(column)];
    const auto end = graph_row_.begin() + graph_start_[size_t(column) + 1];
    return int(std::lower_bound(begin, end, row) - graph_row_.begin());
}

void BlockMatrix::assemble(const std::vector<Matrix6d>& element)
{
    clear();
    for (size_t f = 0; f < element.size(); ++f)
        add(int(f), element[f]);
}

void BlockMatrix::add(int element, const Matrix6d& matrix)
{
    const std::array<int, 18>& to = destination_[size_t(element)];
    for (int row = 0; row < 6; ++row)
        for (int b = 0; b < 3; ++b) {
            double* value = &value_[size_t(to[size_t(row * 3 + b)])];
            value[0] += matrix(row, 2 * b);
            value[1] += matrix(row, 2 * b + 1);
        }
}

void BlockMatrix::add_to_diagonal(int unknown, double value) { value_[size_t(entry(unknown, unknown))] += value; }

void BlockMatrix::add_to_diagonal(int vertex, const Eigen::Matrix2d& block)
{
    for (int k = 0; k < 2; ++k) {
        double* to = &value_[size_t(entry(2 * vertex + k, 2 * vertex))];
        to[0] += block(k, 0);
        to[1] += block(k, 1);
    }
}

Eigen::VectorXd BlockMatrix::diagonal() const
{
    Eigen::VectorXd result(size());
    for (int i = 0; i < size(); ++i)
        result[i] = value_[size_t(entry(i, i))];
    return result;
}

void BlockMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const
{
    y.resize(size());
    parallel_for(vertices_, [&](int v) { // both rows have the same columns
        const int first = start_[size_t(2 * v)], count = start_[size_t(2 * v) + 1] - first;
        const double *upper = &value_[size_t(first)], *lower = upper + count;
        const int* column = &column_[size_t(first)];
        double sum_0 = 0, sum_1 = 0;
        for (int i = 0; i < count; ++i) {
            const double factor = x[column[i]];
            sum_0 += upper[i] * factor;
            sum_1 += lower[i] * factor;
        }
        y[2 * v] = sum_0;
        y[2 * v + 1] = sum_1;
    });
}

} // namespace spia
