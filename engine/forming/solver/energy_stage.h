#pragma once
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/forming/process/external_forces.h"
#include "engine/forming/solver/flips.h"
#include "engine/forming/solver/membrane.h"
#include "engine/sparse/block_matrix.h"
#include "engine/sparse/cholesky.h"

namespace spia {

/// One step of a Newton iteration, as it is reported.
struct NewtonStep {
    double energy = 0;      ///< J, where the stage has one
    double residual = 0;    ///< |R| relative to the yield force (energy stage: relative Newton
                            ///< decrement)
    double step_length = 0; ///< share of the full Newton step taken
};

/// Sees the blank and the step that led to it, once per iteration; called on the solver's thread
/// and must be quick.
using StepWatch = std::function<void(const Eigen::Matrix2Xd& blank, const NewtonStep& step)>;

enum class Ended { converged, stalled, too_many_steps };

struct EnergyResult {
    Eigen::Matrix2Xd position;
    Ended ended = Ended::too_many_steps;
    std::vector<NewtonStep> steps = {};
};

struct EnergyOptions {
    int most_steps = 200;
    double decrement = 1e-5; ///< stop when a step promises less than this share of the energy
    StepWatch watch = {};
    std::vector<HeldVertex> held = {}; ///< each vertex once
    /// N/mm, by which each is drawn to its place; infinite: it is there from the start on, and
    /// stays
    double spring = std::numeric_limits<double>::infinity();
};

/// Minimises E(X) = sum over triangles of A h W(eps(X)) with the thickness h of each triangle held
/// as it was before forming, by projected Newton steps with the stabilized stiffness of
/// energy_density(), the first one majorising. W grows without bound as a triangle collapses and no
/// step may turn one over: from a flip-free start every iterate is flip-free. Springs of held
/// vertices add their energy.
/// @param matrix work space with the mesh's pattern; @param cholesky its analysis
EnergyResult minimise_energy(const Eigen::Matrix3Xi& triangle, const std::vector<Element>& element, const Sheet& sheet,
                             const Eigen::Matrix2Xd& start, BlockMatrix& matrix, Cholesky& cholesky,
                             const EnergyOptions& options, const Progress& progress);

/// The largest step along `direction` that turns no triangle over (its area passing through zero);
/// infinity if none.
double largest_step(const Eigen::Matrix3Xi& triangle, const Eigen::Matrix2Xd& X, const Eigen::Matrix2Xd& direction);

} // namespace spia
