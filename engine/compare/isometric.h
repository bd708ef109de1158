#pragma once
#include <vector>

#include "engine/core/progress.h"
#include "engine/forming/solver/membrane.h"
#include "engine/sparse/block_matrix.h"
#include "engine/sparse/cholesky.h"

namespace spia {

/// What the local/global methods share, which bring a flat start as near to an isometry as it gets:
/// the triangles, and linear equations on the graph of the mesh that are analysed once.
class IsometricSteps {
public:
    /// @throws InputError as require_sheet()
    IsometricSteps(const TriMesh& part, const Progress& progress);

    /// The conformal start of the forming solver (harmonic where that has flips). No projection: it
    /// starts steep walls from slivers.
    /// @throws SolveError if there is none without flipped triangles
    Eigen::Matrix2Xd start(const Progress& progress);

    /// The derivative of a map on a face, from the plane of the face to the flat one.
    Eigen::Matrix2d gradient(const Eigen::Matrix2Xd& flat, int face) const;

    /// The sum over the faces of A density(J), mm2.
    template <class Density> double energy(const Eigen::Matrix2Xd& flat, const Density& density) const;

    /// Factors K = sum over the faces of A (g_a . g_b) metric, a 2 x 2 block per pair of corners.
    /// @param metric per face, symmetric positive definite
    /// @throws SolveError if K is not positive definite to rounding
    void factor(const std::vector<Eigen::Matrix2d>& metric);

    /// -K^-1 times the sum over the faces of A stress g_a: the step that the metric makes of a
    /// derivative of the energy.
    Eigen::Matrix2Xd step(const std::vector<Eigen::Matrix2d>& stress) const;

    double part_area() const { return part_area_; }

private:
    const TriMesh& part_;
    std::vector<Element> element_;
    BlockMatrix matrix_;
    Cholesky cholesky_;
    std::vector<Matrix6d> local_;
    double part_area_;
};

/// Where an iteration ends: when a step lowers the energy by less than `decrease` of what it still
/// is above its least thinkable value, or when that is below `nothing` of the part's area.
struct IsometricOptions {
    int most_steps = 500;
    double decrease = 1e-5;
    double nothing = 1e-14;
};

template <class Density> double IsometricSteps::energy(const Eigen::Matrix2Xd& flat, const Density& density) const
{
    double sum = 0;
    for (size_t f = 0; f < element_.size(); ++f)
        sum += element_[f].area * density(gradient(flat, int(f)));
    return sum;
}

} // namespace spia
