#include "engine/sparse/cholesky.h"

#include <cholmod.h>
#include <omp.h>

#include <new>
#include <numeric>

#include "engine/core/error.h"
#include "engine/sparse/rounded_factor.h"

extern "C" void openblas_set_num_threads(int);

namespace spia {
namespace {

/// Debian's CHOLMOD opens a team of four OpenMP threads for each supernode, which costs a factor of
/// two on small fronts; and a BLAS with threads of its own would sum in another order on another
/// machine.
void one_thread_only()
{
    omp_set_max_active_levels(0);
    openblas_set_num_threads(1);
}

/// A view of our arrays as CHOLMOD wants them; it does not write into them.
cholmod_sparse view(int size, const std::vector<int>& start, const std::vector<int>& row, const double* value)
{
    cholmod_sparse a{};
    a.nrow = a.ncol = size_t(size);
    a.nzmax = row.size();
    a.p = const_cast<int*>(start.data());
    a.i = const_cast<int*>(row.data());
    a.x = const_cast<double*>(value);
    a.stype = -1; // symmetric, lower triangle
    a.itype = CHOLMOD_INT;
    a.xtype = value ? CHOLMOD_REAL : CHOLMOD_PATTERN;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = a.packed = 1;
    return a;
}

} // namespace

struct Cholesky::State {
    cholmod_common common;
    cholmod_factor* factor = nullptr;
    // The matrix in the order of the factor, and where each of its values stands in ours:
    // cholmod_factorize() would sort the whole pattern into that order anew each time.
    cholmod_sparse* ordered = nullptr;
    std::vector<int> source;
    std::vector<int> vertex_order;
    RoundedFactor rounded;
    bool rounded_is_new = false;
    // Work space of cholmod_solve2, kept so that a solve allocates nothing.
    cholmod_dense *solution = nullptr, *work_y = nullptr, *work_e = nullptr;

    State()
    {
        one_thread_only();
        cholmod_start(&common);
        common.print = 0;
        common.error_handler = nullptr;
    }
    ~State()
    {
        cholmod_free_dense(&solution, &common);
        cholmod_free_dense(&work_y, &common);
        cholmod_free_dense(&work_e, &common);
        cholmod_free_sparse(&ordered, &common);
        cholmod_free_factor(&factor, &common);
        cholmod_finish(&common);
    }

    void analyse(cholmod_sparse a, std::vector<int> order)
    {
        common.nmethods = 1;
        common.method[0].ordering = CHOLMOD_GIVEN;
        common.postorder = 1;
        common.supernodal = CHOLMOD_SUPERNODAL;
        common.final_ll = 1;
        factor = cholmod_analyze_p(&a, order.data(), nullptr, 0, &common);
        std::vector<double> number(a.nzmax); // as values, to see where they go
        std::iota(number.begin(), number.end(), 0.0);
        a.x = number.data();
        a.xtype = CHOLMOD_REAL;
        cholmod_sparse* upper =
            factor ? cholmod_ptranspose(&a, 1, static_cast<int*>(factor->Perm), nullptr, 0, &common) : nullptr;
        ordered = upper ? cholmod_transpose(upper, 1, &common) : nullptr;
        cholmod_free_sparse(&upper, &common);
        if (!ordered)
            throw SolveError("the sparse analysis failed; there may not be enough memory for this mesh");
        const auto* gone = static_cast<const double*>(ordered->x);
        source.assign(gone, gone + cholmod_nnz(ordered, &common));
    }

    bool factorise(const std::vector<double>& value)
    {
        one_thread_only();
        rounded_is_new = false;
        auto* to = static_cast<double*>(ordered->x);
        for (size_t i = 0; i < source.size(); ++i)
            to[i] = value[size_t(source[i])];
        double nothing[2] = {0, 0};
        common.status = CHOLMOD_OK;
        cholmod_super_numeric(ordered, nullptr, nothing, factor, &common);
        if (common.status == CHOLMOD_OUT_OF_MEMORY)
            throw SolveError("there is not enough memory for the factor of this mesh");
        return common.status == CHOLMOD_OK && factor->minor == factor->n;
    }

    Supernodes supernodes() const
    {
        return {int(factor->nsuper),
                int(factor->n),
                static_cast<const int*>(factor->super),
                static_cast<const int*>(factor->pi),
                static_cast<const int*>(factor->s),
                static_cast<const int*>(factor->px),
                static_cast<const double*>(factor->x),
                factor->xsize,
                static_cast<const int*>(factor->Perm)};
    }

    const double* solve(const double* right, Eigen::Index rows, Eigen::Index columns)
    {
        one_thread_only();
        cholmod_dense b{};
        b.nrow = b.d = size_t(rows);
        b.ncol = size_t(columns);
        b.nzmax = size_t(rows * columns);
        b.x = const_cast<double*>(right);
        b.xtype = CHOLMOD_REAL;
        b.dtype = CHOLMOD_DOUBLE;
        if (!cholmod_solve2(CHOLMOD_A, factor, &b, nullptr, &solution, nullptr, &work_y, &work_e, &common))
            throw std::bad_alloc(); // of a factor that is there nothing else can fail
        return static_cast<const double*>(solution->x);
    }
};

Cholesky::Cholesky(const BlockMatrix& pattern) : state_(std::make_unique<State>())
{
    // Order the vertices, then give both unknowns of a vertex neighbouring places: half the graph,
    // better supernodes.
    cholmod_sparse graph = view(pattern.vertices(), pattern.graph_start(), pattern.graph_row(), nullptr);
    state_->vertex_order.resize(size_t(pattern.vertices()));
    if (!cholmod_metis(&graph, nullptr, 0, 1, state_->vertex_order.data(), &state_->common))
        throw SolveError("the sparse ordering failed; there may not be enough memory for this mesh");
    std::vector<int> order;
    order.reserve(size_t(pattern.size()));
    for (int v : state_->vertex_order) {
        order.push_back(2 * v);
        order.push_back(2 * v + 1);
    }
    state_->analyse(view(pattern.size(), pattern.row_start(), pattern.column(), pattern.value().data()),
                    std::move(order));
}

Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

bool Cholesky::factor(const BlockMatrix& matrix) { return state_->factorise(matrix.value()); }

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& right) const
{
    return Eigen::Map<const Eigen::VectorXd>(state_->solve(right.data(), right.size(), 1), right.size());
}

Eigen::VectorXd Cholesky::precondition(const Eigen::VectorXd& right) const
{
    State& s = *state_;
    if (!s.rounded_is_new) {
        s.rounded.assign(s.supernodes());
        s.rounded_is_new = true;
    }
    return s.rounded.solve(s.supernodes(), right);
}

VertexCholesky::VertexCholesky(const BlockMatrix& pattern, const Cholesky& ordered)
    : state_(std::make_unique<Cholesky::State>())
{
    state_->analyse(view(pattern.vertices(), pattern.graph_start(), pattern.graph_row(), nullptr),
                    ordered.state_->vertex_order);
}

VertexCholesky::~VertexCholesky() = default;

bool VertexCholesky::factor(const std::vector<double>& value) { return state_->factorise(value); }

Eigen::MatrixX2d VertexCholesky::solve(const Eigen::MatrixX2d& right) const
{
    return Eigen::Map<const Eigen::MatrixX2d>(state_->solve(right.data(), right.rows(), 2), right.rows(), 2);
}

} // namespace spia
