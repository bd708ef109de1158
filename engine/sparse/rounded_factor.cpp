#include "engine/sparse/rounded_factor.h"

#include <algorithm>
#include <array>
#include <oneapi/tbb/parallel_for.h>

// The processor's widest registers, chosen when the program starts: before the thread sanitizer is
// there, whose calls within the choice would end it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define SPIA_WIDE __attribute__((target_clones("arch=haswell", "default")))
#else
#define SPIA_WIDE
#endif

namespace spia {
namespace {

/// One supernode: columns of `rows` entries, the first `columns` rows a triangle.
struct Block {
    int columns, rows;
    const float* value; ///< on the diagonal inverted
    const int* row;     ///< below the triangle
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
SPIA_WIDE void add_product(const Block& b, const double* x, double* sum)
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
SPIA_WIDE void subtract_transposed_product(const Block& b, const double* y, double* x)
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

/// Calls visit(k) for the columns of some supernodes.
template <class Visit> void each_column(const Supernodes& L, const std::vector<int>& supernodes, const Visit& visit)
{
    for (const int s : supernodes)
        for (int k = L.column[s]; k < L.column[s + 1]; ++k)
            visit(k);
}

/// The supernode in which the first row below a supernode is a column; -1: it is a root.
std::vector<int> parents(const Supernodes& L)
{
    std::vector<int> of_column(size_t(L.size)), parent(size_t(L.count), -1);
    for (int s = 0; s < L.count; ++s)
        std::fill(&of_column[size_t(L.column[s])], &of_column[size_t(L.column[s])] + L.column[s + 1] - L.column[s], s);
    for (int s = 0; s < L.count; ++s)
        if (const int columns = L.column[s + 1] - L.column[s], first = L.row_start[s] + columns;
            first < L.row_start[s + 1])
            parent[size_t(s)] = of_column[size_t(L.row[first])];
    return parent;
}

} // namespace

/// Splits the elimination tree from its top until what hangs below can be shared out evenly.
void RoundedFactor::divide(const Supernodes& L)
{
    constexpr int parts = 4;
    const std::vector<int> parent = parents(L);
    const auto count = size_t(L.count);
    std::vector<double> work(count, 0); // of the subtree
    std::vector<std::vector<int>> children(count);
    std::vector<int> root;
    for (int s = 0; s < L.count; ++s) {
        work[size_t(s)] += double(L.column[s + 1] - L.column[s]) * (L.row_start[s + 1] - L.row_start[s]);
        if (const int p = parent[size_t(s)]; p >= 0) {
            work[size_t(p)] += work[size_t(s)];
            children[size_t(p)].push_back(s);
        } else
            root.push_back(s);
    }
    double whole = 0;
    for (const int s : root)
        whole += work[size_t(s)];
    const auto lighter = [&](int a, int b) { return std::pair(work[size_t(a)], a) < std::pair(work[size_t(b)], b); };
    std::vector<int> part_of(count, -2); // -1: the top, -2: that of the parent
    std::make_heap(root.begin(), root.end(), lighter);
    while (!root.empty() && work[size_t(root.front())] > whole / (2 * parts)) {
        std::pop_heap(root.begin(), root.end(), lighter);
        const int split = root.back();
        root.pop_back();
        part_of[size_t(split)] = -1;
        for (const int child : children[size_t(split)]) {
            root.push_back(child);
            std::push_heap(root.begin(), root.end(), lighter);
        }
    }
    std::sort_heap(root.begin(), root.end(), lighter);
    std::array<double, parts> load{};
    for (auto s = root.rbegin(); s != root.rend(); ++s) { // the heaviest first
        const auto least = std::min_element(load.begin(), load.end());
        *least += work[size_t(*s)];
        part_of[size_t(*s)] = int(least - load.begin());
    }
    part_.assign(parts, {});
    top_ = {};
    for (int s = L.count - 1; s >= 0; --s)
        if (part_of[size_t(s)] == -2)
            part_of[size_t(s)] = part_of[size_t(parent[size_t(s)])];
    for (int s = 0; s < L.count; ++s)
        (part_of[size_t(s)] < 0 ? top_ : part_[size_t(part_of[size_t(s)])]).supernode.push_back(s);
    for (Part* part : {&top_, &part_[0], &part_[1], &part_[2], &part_[3]}) {
        part->x.setZero(L.size);
        part->sum.setZero(L.size);
    }
}

void RoundedFactor::assign(const Supernodes& factor)
{
    if (value_.size() != factor.values || part_.empty())
        divide(factor);
    value_.resize(factor.values);
    std::copy(factor.value, factor.value + factor.values, value_.begin());
    for (int s = 0; s < factor.count; ++s) { // the diagonal inverted: a product is cheaper than a
                                             // division
        const int rows = factor.row_start[s + 1] - factor.row_start[s];
        for (int j = 0; j < factor.column[s + 1] - factor.column[s]; ++j) {
            float& diagonal = value_[size_t(factor.value_start[s] + j * rows + j)];
            diagonal = 1 / diagonal;
        }
    }
}

void RoundedFactor::forward(const Supernodes& L, Part& part)
{
    double *x = part.x.data(), *sum = part.sum.data();
    for (const int s : part.supernode) {
        const Block at = block(L, value_, s);
        double* xs = x + L.column[s];
        for (int j = 0; j < at.columns; ++j) {
            const float* a = at.column(j);
            xs[j] *= a[j];
            for (int i = j + 1; i < at.columns; ++i)
                xs[i] -= a[i] * xs[j];
        }
        std::fill(sum, sum + at.below(), 0.0);
        add_product(at, xs, sum);
        for (int i = 0; i < at.below(); ++i)
            x[at.row[i]] -= sum[i];
    }
}

void RoundedFactor::backward(const Supernodes& L, Part& part)
{
    double *x = part.x.data(), *sum = part.sum.data();
    for (auto s = part.supernode.rbegin(); s != part.supernode.rend(); ++s) {
        const Block at = block(L, value_, *s);
        double* xs = x + L.column[*s];
        for (int i = 0; i < at.below(); ++i)
            sum[i] = x[at.row[i]];
        subtract_transposed_product(at, sum, xs);
        for (int j = at.columns - 1; j >= 0; --j) {
            const float* a = at.column(j);
            xs[j] = (xs[j] - dot(a + j + 1, xs + j + 1, at.columns - j - 1)) * a[j];
        }
    }
}

Eigen::VectorXd RoundedFactor::solve(const Supernodes& L, const Eigen::VectorXd& b)
{
    Eigen::VectorXd result(L.size);
    const auto take = [&](Part& part) {
        each_column(L, part.supernode, [&](int k) { part.x[k] = b[L.permutation[k]]; });
    };
    const auto give = [&](const Part& part) {
        each_column(L, part.supernode, [&](int k) { result[L.permutation[k]] = part.x[k]; });
    };
    tbb::parallel_for(size_t(0), part_.size(), [&](size_t p) {
        Part& part = part_[p];
        each_column(L, top_.supernode, [&](int k) { part.x[k] = 0; });
        take(part);
        forward(L, part);
    });
    take(top_);
    each_column(L, top_.supernode, [&](int k) {
        for (const Part& part : part_)
            top_.x[k] += part.x[k];
    });
    forward(L, top_);
    backward(L, top_);
    give(top_);
    tbb::parallel_for(size_t(0), part_.size(), [&](size_t p) {
        Part& part = part_[p];
        each_column(L, top_.supernode, [&](int k) { part.x[k] = top_.x[k]; });
        backward(L, part);
        give(part);
    });
    return result;
}

} // namespace spia
