#pragma once
#include <string>

#include "engine/forming/flatten.h"
#include "engine/forming/solver/membrane.h"
#include "engine/sparse/block_matrix.h"
#include "engine/sparse/cholesky.h"

namespace spia {

/// How the hardening curves go on.
enum class Curve {
    given,    ///< from FlattenOptions::curve on; the harder the tools pull, the earlier: see
              ///< trusted_strain()
    continued ///< each grade's from its own uniform strain on, so that the sheet never softens: its
              ///< energy is convex enough to find the minimum from far away
};

/// What every stage of one solution needs.
struct SolveContext {
    const TriMesh& part;
    const std::vector<Element>& element;
    const FlattenOptions& options;
    ExternalForces external;           ///< what sticks to travelling tools is found on the way
    Eigen::Matrix<double, 3, 2> plane; ///< axes of the blank in space
    BlockMatrix matrix;
    Cholesky cholesky;
    bool anchored = false; ///< the start has the held vertices of `external` at their places: from
                           ///< the energy stage on they stay
    double pull = 0;       ///< see pull_of()
    StepWatch watch = {};  ///< sees every step
};

/// How hard the tools can pull, as a share of what tears the sheet: all their forces over the lock
/// force around the outer edge.
double pull_of(const ExternalForces& external, const TriMesh& part, const FlattenOptions& options);

/// @param growth share of the rate at which the curves go on: below 1 they are gentler
Sheet sheet_with(const SolveContext& context, Curve curve, double growth = 1);

/// The strain from which on a grade's curve is continued. Pulled hard, a sheet that softens has
/// solutions in which strain gathers in a few rows of elements, and which one is found depends on
/// the mesh and on the way there. So with the pull the strain goes from that of the options down to
/// the uniform strain: smoothly, since no force is so small that it should change the curve.
double trusted_strain(const SolveContext& context, Curve curve, const Hardening& grade);

/// The blank of the energy stage may lie anywhere: it is put under the part, and with its held
/// vertices near their places.
void place(const SolveContext& context, Eigen::Matrix2Xd& X);

/// The sheet with the curves that the solution was found with.
Sheet solved_sheet(const SolveContext& context, const SolveReport& report);

/// @param obstacle why the law as given was not kept
std::string describe_convergence(const SolveReport& report, const std::string& obstacle, double wanted_strain,
                                 int vertices);

/// From a flip-free start X to the blank, with all forces of the tools at once: energy, then
/// equilibrium; each way tried where the one before did not get there. SolvedSystem::strict stands
/// for the equations with Curve::given.
Eigen::Matrix2Xd solve_at_once(SolveContext& context, Eigen::Matrix2Xd X, SolveReport& report,
                               const Progress& progress);

} // namespace spia
