#pragma once
#include "engine/compare/flat_map.h"
#include "engine/compare/isometric.h"

namespace spia {

/// Its steps are dear and soon within a few percent of what there is to gain.
inline constexpr IsometricOptions slim_options{.most_steps = 200, .decrease = 3e-4};

/// Scalable locally injective map [Rabinovich, Poranne, Panozzo, Sorkine-Hornung 2017] for the
/// symmetric Dirichlet energy, the sum of A (|J|^2 + |J^-1|^2): in each step a quadratic |W (J -
/// R)|^2 per face with the energy's own derivative, a factor of its equations, and a line search
/// that lowers the energy and turns no triangle over. Its start has no flip, so neither has any
/// step.
/// @param start  2 by #V without flips; empty: the conformal or harmonic start
/// @throws InputError as require_sheet(), or if the start has flips; @throws SolveError if there is
/// no start
FlatMap slim(const TriMesh& part, const IsometricOptions& options = slim_options, const Progress& progress = {},
             const Eigen::Matrix2Xd& start = {});

/// |J|^2 + |J^-1|^2, 4 for a rotation; infinite for det J <= 0.
double symmetric_dirichlet_density(const Eigen::Matrix2d& J);

} // namespace spia
