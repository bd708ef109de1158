#pragma once
#include <optional>
#include <string_view>

#include "engine/core/attempts.h"
#include "engine/core/progress.h"
#include "engine/forming/blank.h"
#include "engine/forming/material/material.h"
#include "engine/forming/process/process.h"
#include "engine/forming/solver/energy_stage.h"
#include "engine/forming/solver/initial_guess.h"
#include "engine/forming/solver/skin_strain.h"
#include "engine/forming/solver/stamping_direction.h"
#include "engine/mesh/flat/overlap.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

struct FlattenOptions {
    Material material;
    double thickness = 1;                     ///< mm, of the flat sheet
    std::optional<Eigen::Vector3d> direction; ///< stamping direction, either way along it; chosen
                                              ///< automatically if not given
    ProcessConditions process;                ///< what the tools do; none: the sheet is free
    StressCurve::Options curve;               ///< where the hardening curve is trusted and how it
                                              ///< goes on
    bool skins = false;                       ///< also the strains of both skins, with bending
    int most_energy_steps = 200;
    int most_newton_steps = 60;
    double tolerance = 1e-8; ///< on |R| relative to the nodal forces at the yield stress

    friend bool operator==(const FlattenOptions&, const FlattenOptions&) = default;
};

/// Whether the same blank comes of both: their grades may differ in name, source and forming
/// limits.
bool formed_alike(const FlattenOptions& a, const FlattenOptions& b);

/// Which equations the blank fulfils.
enum class SolvedSystem {
    strict,    ///< virtual work with the material as given
    continued, ///< virtual work, the hardening curve continued from the uniform strain on
    relaxed,   ///< likewise, relaxed at some vertices: see VirtualWork::relax()
    energy     ///< none: the least energy with the thickness held, or virtual work relaxed
               ///< everywhere
};
std::string_view name(SolvedSystem system);

/// How the solution came about.
struct SolveReport {
    bool converged = false; ///< `system` holds to the tolerance, and is not SolvedSystem::energy
    SolvedSystem system = SolvedSystem::energy;
    double trusted_strain = 0;                  ///< the hardening curve is continued beyond it: the
                                                ///< option's, or the uniform strain
    int relaxed_vertices = 0;                   ///< whose equations were relaxed, see
                                                ///< VirtualWork::relax()
    std::string reason;                         ///< why the iteration ended, in words
    StartMethod start = StartMethod::conformal; ///< of a blank that steps gave, which has none,
                                                ///< nothing
    std::vector<NewtonStep> energy;             ///< steps of the energy stage (all its passes in a
                                                ///< row)
    std::vector<NewtonStep> newton;             ///< steps of the virtual-work stage
    double process_share = 1;                   ///< of the forces of the tools that are in the
                                                ///< blank: below 1 the sheet does not bear them
    double residual = 0;                        ///< |R| relative to the nodal forces at the yield
                                                ///< stress
    Eigen::Vector3d resultant =
        Eigen::Vector3d::Zero(); ///< that holds the rigid motion: N, N, N mm; zero where pins hold
                                 ///< it
    double seconds = 0;
    std::vector<AttemptReport> attempts = {}; ///< how it was found; of a blank that steps gave,
                                              ///< none

    /// Whether it is the solution of all that was asked for.
    bool whole() const { return system == SolvedSystem::strict && process_share == 1; }
};

struct FlattenResult {
    Blank blank;
    SheetFields face;                 ///< one entry per face
    SheetFields node;                 ///< one entry per vertex
    std::optional<SkinStrains> skins; ///< where asked for
    StampingDirection stamping;
    SolveReport report;
    int necking_triangles = 0; ///< faces beyond the trusted strain: extrapolated, where the part
                               ///< tears
    int flipped_triangles = 0; ///< always 0; counted anew from the result, by an exact test
    Overlap overlap;           ///< where the blank lies on itself
    double volume_error = 0;   ///< largest |h A - h0 A0| / (h0 A0) over the faces
};

/// Finds the flat blank that one forming step turns into the part.
/// @param part      mm; one component, at least one boundary loop, no handles (cut_open() sees to
///         it), no face without area
/// @param progress  one checkpoint per iteration; cancelling takes effect at the next one
/// @param watch     sees the blank while it converges
/// @throws InputError  if the part or an option is not as described; names the first offending face
/// @throws SolveError if there is no flip-free state at all, or none that can be told in the part's
///         coordinates
/// If the virtual-work system does not converge, the hardening curve is continued from the uniform
/// strain on and equations that the mesh cannot bear are relaxed; if that fails too, the blank of
/// the energy stage (thickness held) is given. The report says so. The result does not depend on
/// the number of threads. [Zhu et al. 2013, eqs. 4-23]
FlattenResult flatten(const TriMesh& part, const FlattenOptions& options, const Progress& progress = {},
                      const StepWatch& watch = {});

} // namespace spia
