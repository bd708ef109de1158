#pragma once
#include <array>
#include <vector>

#include "engine/forming/process/external_forces.h"
#include "engine/forming/solver/membrane.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/sparse/block_matrix.h"

namespace spia {

/// The principle of virtual work on the formed part (eqs. 16-23): two equations per vertex. The
/// membrane forces h sigma of the triangles around it, turned into its tangent plane by the
/// smallest rotation between the two normals, are in balance with the external forces. Of a held
/// vertex the equations say that it stays where it is held. Keeps references to its arguments.
class VirtualWork {
public:
    VirtualWork(const TriMesh& part, const std::vector<Element>& element, const Sheet& sheet,
                const ExternalForces& external);

    /// Writes the equations in axes that follow the blank's x and y through the deformation X: the
    /// residual is then close to the gradient of an energy and its derivative close to symmetric.
    /// The solution does not depend on X.
    void set_axes(const Eigen::Matrix2Xd& X);

    /// Relaxes the equations of some vertices: the virtual displacement of a triangle's corner is
    /// then carried from the blank by the triangle's own F, not by one tangent vector of the vertex
    /// for all triangles around it. The stresses and the thickness are the same; the change of F
    /// across the vertex is neglected. For vertices where the mesh does not resolve that change, or
    /// has no tangent plane: one vector for all is then no approximation either, and the system has
    /// no solution.
    void relax(std::vector<char> vertex) { relaxed_ = std::move(vertex); } ///< one entry per vertex
    const std::vector<char>& relaxed() const { return relaxed_; }

    /// Per vertex, how far the one tangent vector is from what the triangles around it do: the
    /// largest factor, at least 1, by which a principal stretch between the two differs from 1;
    /// infinite where the vertex has no tangent plane (a normal around it is more than 60 degrees
    /// off).
    Eigen::VectorXd mismatch() const;

    /// Minus internal plus external forces, N: 2 per vertex. Its derivative is nearly positive
    /// definite.
    Eigen::VectorXd residual(const Eigen::Matrix2Xd& X) const;

    /// From here on the tangents are stabilized (expected_stress.h), the first one being the exact
    /// one at X.
    void stabilize(const Eigen::Matrix2Xd& X);
    /// The stresses that a step from X expects go into the next tangents. Without stabilize()
    /// before nothing happens.
    void expect(const Eigen::Matrix2Xd& X, const Eigen::Matrix2Xd& step);

    /// The derivative of the residual with the axes held, exact but for the steadying.
    void tangent(const Eigen::Matrix2Xd& X, BlockMatrix& matrix) const;

    /// The tangent and a positive definite neighbour of it to precondition with: per triangle the
    /// symmetric part of the tangent in the space of G with its own push-forward of the axes, the
    /// eigenvalues by their magnitude (they are negative where the sheet softens), without the
    /// coupling of stretch and shear by planar anisotropy.
    void tangents(const Eigen::Matrix2Xd& X, BlockMatrix& tangent, BlockMatrix& definite) const;

    const ExternalForces& external() const { return external_; }

    /// Norm of the nodal forces of a sheet at its yield stress all over: what |R| is measured
    /// against. N
    double yield_force() const;

private:
    using Axes = Eigen::Matrix<double, 3, 2>;
    struct Formed {
        MembraneForce m;           ///< h sigma of the triangle and its derivative
        Eigen::Matrix2d pull_back; ///< F^T
    };
    /// @param stabilized the derivative is, if stabilize() was called
    Formed formed(int f, const Eigen::Matrix2Xd& X, bool stabilized) const;
    AxisStress stress(int f, const Svd2& d) const { return sheet_.law_of(f)(d.U, -d.s.array().log().matrix()); }
    /// How corner a of face f sees its vertex's equations: M in M (h sigma) g_a.
    Eigen::Matrix2d to_vertex(int f, int a, const Eigen::Matrix2d& pull_back) const;
    Matrix6d element_tangent(int f, const Formed& formed) const;
    Matrix6d definite_element(int f, const Formed& formed) const;
    void add_external_tangent(const Eigen::Matrix2Xd& X, BlockMatrix& matrix) const;

    const TriMesh& part_;
    const std::vector<Element>& element_;
    const Sheet& sheet_;
    const ExternalForces& external_;
    Eigen::Matrix3Xd normal_;
    NodalForces nodal_;
    std::vector<int> held_;                   ///< per vertex, index into external_.held or -1
    double hold_ = 0;                         ///< N/mm, weight of the equations of a held vertex
    std::vector<std::array<Axes, 3>> turned_; ///< Q_ea J_e: a triangle's axes in the tangent planes
                                              ///< of its corners
    std::vector<Eigen::Matrix2d> F_;          ///< at the X of set_axes()
    std::vector<Axes> axes_;                  ///< T_a: push-forward of the blank's x and y,
                                              ///< tangential
    std::vector<char> relaxed_;
    std::vector<ElementStress> expected_; ///< by the last step; empty: the tangents are exact
};

} // namespace spia
