#pragma once
#include <array>
#include <complex>
#include <optional>

#include "engine/compare/flat_map.h"
#include "engine/core/progress.h"
#include "engine/sparse/block_matrix.h"
#include "engine/sparse/cholesky.h"

namespace spia {

struct LscmOptions {
    /// The two vertices that are held; chosen if not given: two vertices of the outer boundary
    /// about as far apart on the part as any.
    std::optional<std::array<int, 2>> pins = {};
};

/// Least squares conformal map [Levy, Petitjean, Ray, Maillot 2002]: the least sum over the
/// triangles of |W_1 u_1 + W_2 u_2 + W_3 u_3|^2 / (2 A), u the flat corners and W the sides of the
/// triangle in its own plane as complex numbers (their eq. 4), with two vertices held. Holes need
/// nothing special: their edges are free. The result depends on the two vertices and may have
/// flipped triangles.
/// @throws InputError  as require_sheet(), or if the pins are not two vertices of the part
/// @throws SolveError  if the system cannot be solved
FlatMap lscm(const TriMesh& part, const LscmOptions& options = {}, const Progress& progress = {});

/// The shapes of the triangles, each in its own plane: where corners 1 and 2 lie seen from corner
/// 0. mm, as complex numbers x + i y, counter-clockwise.
using FlatShapes = std::vector<std::array<std::complex<double>, 2>>;

/// The same least squares for triangles of any shape: with shapes that fit together, their layout.
/// Solved through the normal equations and refined with the residual of the factored form, which is
/// as exact as an orthogonal factorisation [Bjorck 1987].
/// @param matrix, cholesky  work space with the pattern of the mesh, and its analysis
Eigen::Matrix2Xd conformal_layout(const TriMesh& part, const FlatShapes& shapes, const std::array<int, 2>& pins,
                                  BlockMatrix& matrix, Cholesky& cholesky, const Progress& progress);

/// Two vertices of the outer boundary, far apart: the one farthest along edges from vertex 0 of the
/// loop, and the one farthest from it.
std::array<int, 2> far_pins(const TriMesh& part);

} // namespace spia
