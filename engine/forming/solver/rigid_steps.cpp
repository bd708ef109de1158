#include "engine/forming/solver/rigid_steps.h"

#include "engine/core/parallel.h"
#include "engine/forming/solver/flips.h"
#include "engine/forming/solver/nearest_rotation.h"

namespace spia {
namespace {

constexpr int most_steps = 6; // more gain little: what is left is the difference between the two
                              // energies

} // namespace

RigidSteps::RigidSteps(const TriMesh& part, const std::vector<Element>& element, const BlockMatrix& matrix,
                       const Cholesky& cholesky)
    : part_(part), element_(element), laplacian_(matrix, cholesky)
{
    std::vector<double> value(matrix.graph_row().size(), 0);
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Matrix3d dot =
            element[size_t(f)].area * element[size_t(f)].gradient.transpose() * element[size_t(f)].gradient;
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
                if (part.triangle(a, f) >= part.triangle(b, f)) // the lower triangle is enough
                    value[size_t(matrix.graph_entry(part.triangle(a, f), part.triangle(b, f)))] += dot(a, b);
    }
    double trace = 0;
    for (int v = 0; v < part.vertices(); ++v)
        trace += value[size_t(matrix.graph_entry(v, v))];
    for (int v = 0; v < part.vertices(); ++v) // holds the translation without being felt
        value[size_t(matrix.graph_entry(v, v))] += 1e-12 * trace / part.vertices();
    possible_ = laplacian_.factor(value);
}

Eigen::Matrix2Xd RigidSteps::step(const Eigen::Matrix2Xd& X) const
{
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(X.cols(), 2);
    parallel_in_order<Eigen::Matrix<double, 2, 3>>(
        part_.triangles(),
        [&](int f, Eigen::Matrix<double, 2, 3>& share) {
            const Element& e = element_[size_t(f)];
            const Eigen::Matrix2d G = inverse_gradient(e, corners(X, part_.triangle.col(f)));
            // for the change: that of the translation is zero
            share = e.area * (nearest_rotation(G) - G) * e.gradient;
        },
        [&](int f, const Eigen::Matrix<double, 2, 3>& share) {
            for (int a = 0; a < 3; ++a)
                right.row(part_.triangle(a, f)) += share.col(a).transpose();
        });
    return X + laplacian_.solve(right).transpose();
}

Eigen::Matrix2Xd more_rigid(const TriMesh& part, const RigidSteps& rigid, Eigen::Matrix2Xd start,
                            const Progress& progress)
{
    for (int step = 0; step < most_steps && rigid.possible(); ++step) {
        progress.checkpoint(double(step) / most_steps, "first guess: as rigid as possible");
        Eigen::Matrix2Xd next = rigid.step(start);
        if (!one_to_one_around_vertices(part, next))
            break;
        start = std::move(next);
    }
    return start;
}

} // namespace spia
