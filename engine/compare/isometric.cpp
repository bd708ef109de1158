#include "engine/compare/isometric.h"

#include "engine/compare/flat_map.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/forming/solver/initial_guess.h"
#include "engine/forming/solver/stamping_direction.h"

namespace spia {
namespace {

const TriMesh& checked(const TriMesh& part, const Progress& progress)
{
    progress.checkpoint(0, "ordering the equations");
    require_sheet(part);
    return part;
}

} // namespace

IsometricSteps::IsometricSteps(const TriMesh& part, const Progress& progress)
    : part_(checked(part, progress)), element_(elements(part)), matrix_(part.triangle, part.vertices()),
      cholesky_(matrix_), local_(element_.size()), part_area_(0)
{
    for (const Element& e : element_)
        part_area_ += e.area;
}

Eigen::Matrix2Xd IsometricSteps::start(const Progress& progress)
{
    StampingDirection direction = stamping_direction(part_);
    direction.height_field = false; // so it is not projected
    return initial_guess(part_, element_, direction, matrix_, cholesky_, progress).position;
}

Eigen::Matrix2d IsometricSteps::gradient(const Eigen::Matrix2Xd& flat, int face) const
{
    return inverse_gradient(element_[size_t(face)], corners(flat, part_.triangle.col(face)));
}

void IsometricSteps::factor(const std::vector<Eigen::Matrix2d>& metric)
{
    parallel_for(int(element_.size()), [&](int f) {
        const Element& e = element_[size_t(f)];
        const Eigen::Matrix3d dot = e.area * e.gradient.transpose() * e.gradient;
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
                local_[size_t(f)].block<2, 2>(2 * a, 2 * b) = dot(a, b) * metric[size_t(f)];
    });
    matrix_.assemble(local_);
    // The map may be moved freely; a shift far below the stiffness holds it without being felt.
    const double shift = 1e-12 * matrix_.diagonal().mean();
    for (int i = 0; i < matrix_.size(); ++i)
        matrix_.add_to_diagonal(i, shift);
    if (!cholesky_.factor(matrix_))
        throw SolveError("the equations are not positive definite; there are triangles too thin for the arithmetic");
}

Eigen::Matrix2Xd IsometricSteps::step(const std::vector<Eigen::Matrix2d>& stress) const
{
    Eigen::Matrix2Xd force = Eigen::Matrix2Xd::Zero(2, part_.vertices());
    for (int f = 0; f < part_.triangles(); ++f) {
        const Element& e = element_[size_t(f)];
        const Eigen::Matrix<double, 2, 3> share = -e.area * stress[size_t(f)] * e.gradient;
        for (int a = 0; a < 3; ++a)
            force.col(part_.triangle(a, f)) += share.col(a);
    }
    const Eigen::VectorXd moved = cholesky_.solve(force.reshaped());
    return Eigen::Map<const Eigen::Matrix2Xd>(moved.data(), 2, part_.vertices());
}

} // namespace spia
