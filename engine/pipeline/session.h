#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/coons/grid.h"
#include "engine/coons/lift.h"
#include "engine/deform/deform.h"
#include "engine/forming/flatten.h"
#include "engine/layout/fit_patches.h"
#include "engine/limits/limits.h"
#include "engine/nurbs/certificate.h"
#include "engine/nurbs/deviation.h"
#include "engine/nurbs/fit.h"
#include "engine/nurbs/interpolate.h"
#include "engine/nurbs/trim.h"
#include "engine/part/part_file.h"
#include "engine/part/read_options.h"
#include "engine/pipeline/corner_cut.h"
#include "engine/pipeline/surface_source.h"
#include "engine/unfold/plan/bend_table.h"
#include "engine/unfold/plan/k_factor.h"
#include "engine/unfold/step/unfold_script.h"

namespace spia {

/// The steps of the chain, in their order.
enum class Stage { read, solve, grid, lift, fit };
inline constexpr Stage chain[] = {Stage::read, Stage::solve, Stage::grid, Stage::lift, Stage::fit};
std::string_view name(Stage stage);

/// Steps whose blank takes the place of the one-step solve's.
struct BlankOfSteps {
    std::shared_ptr<const UnfoldRun> run; ///< of the session's part in its sheet, with a blank
                                          ///< without flips
    bool polish = false;                  ///< the one-step solve is started from their blank: all
                                          ///< material may move once more

    friend bool operator==(const BlankOfSteps&, const BlankOfSteps&) = default;
};

struct SessionOptions {
    ReadOptions read;
    FlattenOptions flatten;
    std::optional<KFactor> k_factor;   ///< of bends over cylinders, on the middle surface; not
                                       ///< given: 0.5
    std::optional<BlankOfSteps> steps; ///< not given: the blank is solved in one step
    LimitsOptions limits;
    std::optional<std::array<int, 4>> corners; ///< vertices of the file; chosen automatically if
                                               ///< not given
    GridOptions grid;
    InterpolateOptions interpolate; ///< its degrees and ends hold for a fit, too
    /// mm, two-sided, of the surface. Not given: it runs through the nodes of the grid, and is as
    /// far from the part between them as it is.
    std::optional<double> tolerance;
    /// Not given: one patch over the filled blank. Else a layout of patches around the holes,
    /// within the tolerance or 1/1000 of the part's diagonal; cuts and corners are vertices of the
    /// file. The session then has neither grid nor lifted one.
    std::optional<LayoutOptions> patches;
    /// The program chooses between one patch and a layout, see make_surface(), and holds either
    /// within the tolerance or 1/1000 of the part's diagonal. `patches` is not given then.
    bool best_surface = false;
    FitParameters fit_parameters = FitParameters::blank; ///< where a tolerance is given
    int max_control_points = FitOptions{}.max_control_points;
    std::optional<Deformation> deformation; ///< of the finished surface; not given: it stays as it
                                            ///< was fitted
    bool fill_holes = false;                ///< the surface covers the holes of the part; else CAD
                                            ///< files have it trimmed by them
};

/// A planar grid and the sides it was made from.
struct GridStage {
    BlankBoundary boundary;
    GridResult result;
};

/// Where the blank comes from: "one step", "steps" or "steps, polished".
std::string_view name(const std::optional<BlankOfSteps>& steps);

struct SurfaceStage {
    InterpolateResult result;                  ///< empty where there are patches
    std::shared_ptr<const PatchesFit> patches; ///< of a layout; null: one patch
    /// What it was fitted to and is judged by. Null: it runs through the nodes of the grid and is
    /// judged by the facets of the mesh.
    std::shared_ptr<const SurfaceSource> source;
    Deviation deviation;
    std::optional<FitReport> fit; ///< where a tolerance was given
    TrimResult trim;              ///< by the holes of the part; empty if they are to be filled
    Certificate certificate;      ///< what analysis asks of it, patch by patch
    std::string choice;           ///< what the program chose and why, in words; empty: it was asked for
};

/// The surface as patches, as it was fitted: those of the layout, or the one.
MultiPatch fitted_patches(const SurfaceStage& stage);

/// The surface after its deformation.
struct DeformedSurface {
    DeformResult result;
    Certificate certificate; ///< of no patch if it was left out
};

/// All there is to know about one part: what was asked for and the results so far. Results are
/// finished and const; a copy is cheap, and an old copy is how one goes back.
struct Session {
    std::filesystem::path file;
    SessionOptions options;

    std::shared_ptr<const PartFile> part;
    std::shared_ptr<const FlattenResult> blank;
    std::shared_ptr<const BendTable> bends;      ///< of the part and on the blank; made together
                                                 ///< with it
    std::shared_ptr<const CornerCut> corner_cut; ///< what cutting the corners is worth; null: they
                                                 ///< were not cut
    std::shared_ptr<const LimitsResult> limits;  ///< of the blank; made together with it
    std::shared_ptr<const GridStage> grid;
    std::shared_ptr<const LiftResult> lifted;
    std::string no_grid; ///< why there is none, where the surface may be of patches instead
    std::shared_ptr<const SurfaceStage> surface;
    std::shared_ptr<const DeformedSurface> deformed; ///< the same, where a deformation is asked for

    std::map<Stage, double> seconds; ///< of each stage that has run
};

/// Whether the surface is to be of a layout: asked for, or chosen by the program.
bool made_of_patches(const Session& session);

/// Finds out what would end a later stage, as soon as the part is read.
/// @throws InputError if there is no part, or a corner that was asked for is no vertex of its
/// boundary
void require_possible(const Session& session);

/// Judges the solved sheet anew by the options' limits, on a copy of the session: quick, no other
/// result changes.
/// @throws InputError if the part is not solved; else what forming_limits() throws
Session judge_limits(Session session);

/// Applies the options' deformation to the fitted surface, on a copy of the session: quick, no
/// other result changes.
/// @param measure  false leaves out the certificate and DeformResult::off_lattice: for a drag
/// @throws InputError if there is no surface; else what deform() throws
Session deform_surface(Session session, bool measure = true, const Progress& progress = {});

/// The surface that leaves the program: deformed, if that is asked for. @pre session.surface
MultiPatch surface_patches(const Session& session);
const Certificate& surface_certificate(const Session& session);

} // namespace spia
