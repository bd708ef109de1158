#include "engine/sparse/lu.h"

#include <umfpack.h>

#include "engine/core/error.h"

namespace spia {

struct Lu::State {
    const BlockMatrix matrix; // UMFPACK needs it again for iterative refinement
    double control[UMFPACK_CONTROL];
    void* numeric = nullptr;
    bool singular = false;
    ~State() { umfpack_di_free_numeric(&numeric); }
};

Lu::Lu(const BlockMatrix& matrix) : state_(new State{matrix, {}, nullptr})
{
    State& s = *state_;
    umfpack_di_defaults(s.control);
    s.control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    s.control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    // By rows it is the transposed matrix by columns.
    const int* start = s.matrix.row_start().data();
    const int* row = s.matrix.column().data();
    const double* value = s.matrix.value().data();
    void* symbolic = nullptr;
    int status =
        umfpack_di_symbolic(s.matrix.size(), s.matrix.size(), start, row, value, &symbolic, s.control, nullptr);
    if (status == UMFPACK_OK)
        status = umfpack_di_numeric(start, row, value, symbolic, &s.numeric, s.control, nullptr);
    umfpack_di_free_symbolic(&symbolic);
    s.singular = status == UMFPACK_WARNING_singular_matrix;
    if (status != UMFPACK_OK && !s.singular)
        throw SolveError("the unsymmetric factorisation failed; there may not be enough memory for this mesh");
}

Lu::~Lu() = default;

bool Lu::singular() const { return state_->singular; }

Eigen::VectorXd Lu::solve(const Eigen::VectorXd& right) const
{
    const State& s = *state_;
    Eigen::VectorXd x(right.size());
    umfpack_di_solve(UMFPACK_At, s.matrix.row_start().data(), s.matrix.column().data(), s.matrix.value().data(),
                     x.data(), right.data(), s.numeric, s.control, nullptr);
    return x;
}

} // namespace spia
