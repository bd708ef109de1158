#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/core/progress.h"
#include "engine/forming/solver/membrane.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/sparse/block_matrix.h"
#include "engine/sparse/cholesky.h"

namespace spia {

/// Steps towards the map with the least sum of A |G - R|^2, R the rotation nearest to G: by turns
/// all R for the map held and the map for all R held. [as rigid as possible, Liu, Zhang, Xu,
/// Gotsman and Gortler 2008] All steps share one factor of a matrix with one unknown per vertex:
/// they are by far the cheapest way from a conformal map, whose areas are off by factors, to
/// strains of the size of the true ones. They may turn triangles over.
class RigidSteps {
public:
    /// @param matrix   for its pattern; @param cholesky for its order
    RigidSteps(const TriMesh& part, const std::vector<Element>& element, const BlockMatrix& matrix,
               const Cholesky& cholesky);

    /// False where triangles are too thin for the arithmetic: there are no steps then.
    bool possible() const { return possible_; }
    Eigen::Matrix2Xd step(const Eigen::Matrix2Xd& X) const;

private:
    const TriMesh& part_;
    const std::vector<Element>& element_;
    VertexCholesky laplacian_;
    bool possible_;
};

/// The start after a few such steps, fewer if one of them would no longer be
/// one_to_one_around_vertices().
/// @param start without a flipped triangle
Eigen::Matrix2Xd more_rigid(const TriMesh& part, const RigidSteps& rigid, Eigen::Matrix2Xd start,
                            const Progress& progress = {});

} // namespace spia
