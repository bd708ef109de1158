#include "engine/sparse/rounded_factor.h"

#include <algorithm>

namespace spia {
namespace {

/// One supernode: columns of `rows` entries, the first `columns` rows a triangle.
struct Block {
    int columns, rows;
    const float* value;
    const int* row; ///< below the triangle
    int below() const { return rows - columns; }
    const float* column(int j) const { return value + std::ptrdiff_t(j) * rows; }
};

Block block(const Supernodes& L, const std::vector<float>& value, int s)
{
    const int columns = L.column[s + 1] - L.column[s];
    return {columns, L.row_start[s + 1] - L.row_start[s], &value[size_t(L.value_start[s])],
            L.row + L.row_start[s] + columns};
}

/// sum += L_below x, four columns at a time: the sum is read and written once for all of them.
void add_product(const Block& b, const double* x, double* sum)
{
    const int n = b.below();
    int j = 0;
    for (; j + 4 <= b.columns; j += 4) {
        const float *a0 = b.column(j) + b.columns, *a1 = a0 + b.rows, *a2 = a1 + b.rows, *a3 = a2 + b.rows;
        const double x0 = x[j], x1 = x[j + 1], x2 = x[j + 2], x3 = x[j + 3];
#pragma omp simd
        for (int i = 0; i < n; ++i)
            sum[i] += (a0[i] * x0 + a1[i] * x1) + (a2[i] * x2 + a3[i] * x3);
    }
    for (; j < b.columns; ++j) {
        const float* a = b.column(j) + b.columns;
#pragma omp simd
        for (int i = 0; i < n; ++i)
            sum[i] += a[i] * x[j];
    }
}

double dot(const float* a, const double* b, int n)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (int i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

/// x -= L_below^T y, four columns at a time.
void subtract_transposed_product(const Block& b, const double* y, double* x)
{
    const int n = b.below();
    int j = 0;
    for (; j + 4 <= b.columns; j += 4) {
        const float *a0 = b.column(j) + b.columns, *a1 = a0 + b.rows, *a2 = a1 + b.rows, *a3 = a2 + b.rows;
        double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
#pragma omp simd reduction(+ : s0, s1, s2, s3)
        for (int i = 0; i < n; ++i) {
            s0 += a0[i] * y[i];
            s1 += a1[i] * y[i];
            s2 += a2[i] * y[i];
            s3 += a3[i] * y[i];
        }
        x[j] -= s0;
        x[j + 1] -= s1;
        x[j + 2] -= s2;
        x[j + 3] -= s3;
    }
    for (; j < b.columns; ++j)
        x[j] -= dot(b.column(j) + b.columns, y, n);
}

} // namespace

void RoundedFactor::assign(const Supernodes& factor)
{
    value_.resize(factor.values);
    std::copy(factor.value, factor.value + factor.values, value_.begin());
    x_.resize(factor.size);
    sum_.resize(factor.size);
}

Eigen::VectorXd RoundedFactor::solve(const Supernodes& L, const Eigen::VectorXd& b)
{
    double *x = x_.data(), *sum = sum_.data();
    for (int k = 0; k < L.size; ++k)
        x[k] = b[L.permutation[k]];
    for (int s = 0; s < L.count; ++s) {
        const Block at = block(L, value_, s);
        double* xs = x + L.column[s];
        for (int j = 0; j < at.columns; ++j) {
            const float* a = at.column(j);
            xs[j] /= a[j];
            for (int i = j + 1; i < at.columns; ++i)
                xs[i] -= a[i] * xs[j];
        }
        std::fill(sum, sum + at.below(), 0.0);
        add_product(at, xs, sum);
        for (int i = 0; i < at.below(); ++i)
            x[at.row[i]] -= sum[i];
    }
    for (int s = L.count - 1; s >= 0; --s) {
        const Block at = block(L, value_, s);
        double* xs = x + L.column[s];
        for (int i = 0; i < at.below(); ++i)
            sum[i] = x[at.row[i]];
        subtract_transposed_product(at, sum, xs);
        for (int j = at.columns - 1; j >= 0; --j) {
            const float* a = at.column(j);
            xs[j] = (xs[j] - dot(a + j + 1, xs + j + 1, at.columns - j - 1)) / a[j];
        }
    }
    Eigen::VectorXd result(L.size);
    for (int k = 0; k < L.size; ++k)
        result[L.permutation[k]] = x[k];
    return result;
}

} // namespace spia
