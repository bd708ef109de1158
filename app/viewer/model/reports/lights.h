#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/document/document.h"
#include "engine/pipeline/usual_tolerance.h"

/// What stands between a result and a green light.
namespace spia::viewer {

struct ViewerState;

/// The numbered steps of the panel.
enum class ChainStep { part, sheet, unfold, grid, surface };

/// The click that answers a doubt.
enum class Remedy {
    none,
    read_in_other_unit,
    cut_corners,   ///< that keep a bent part from unrolling
    confirm_sheet, ///< what is assumed is right
    propose_steps,
    harmonic_grid,
    finer_grid,
    fit_within_tolerance,
    looser_tolerance, ///< as large as the deviation that is left
    more_control_points,
    several_patches
};

/// Something that is poorer than it should be: why, and the next click.
struct Doubt {
    ChainStep step;
    std::string text;        ///< a sentence
    std::string next = {};   ///< what to do about it, a sentence; empty: the text says it, or the
                             ///< button
    std::string button = {}; ///< what the remedy is called; empty: there is none
    Remedy remedy = Remedy::none;
    std::optional<Eigen::Vector3d> place = {}; ///< mm, where it is on the part, if no face is known
    std::optional<Field> field = {};           ///< that shows it there; not given: any
    std::optional<int> face = {};              ///< of the part, where it is
};

/// The face of the part that a doubt is about, else the nearest to its place; nothing: no one
/// place.
std::optional<int> face_of(const Doubt& doubt, const TriMesh& part);

/// What the doubts are found in: as long as all of it stays, they do.
struct DoubtsOf {
    std::shared_ptr<const void> part, blank, limits, grid, surface, deformed, steps;
    std::string material;
    double thickness = 0;
    SheetSource material_from = SheetSource::assumed, thickness_from = SheetSource::assumed;
    std::optional<Stage> stale;
    LengthUnit lengths = LengthUnit::mm; ///< in which they are told
    bool k_factor = false;

    friend bool operator==(const DoubtsOf&, const DoubtsOf&) = default;
};
DoubtsOf doubts_of(const Document& document, LengthUnit lengths);

/// Of the results that there are, in the order of the steps. Those of a stage that is out of date
/// are left out: its light says so. The engine's shortcomings() are all among them; besides, what
/// only judges: an assumed sheet, a surface out of tolerance or with a fold, a sheet that cracks.
/// @param lengths  in which they are told; the engine tells its own in mm
std::vector<Doubt> find_doubts(const Document& document, LengthUnit lengths = LengthUnit::mm);

/// The tolerance that was asked for, else the usual one; mm.
double wanted_tolerance(const SessionOptions& options);
/// What a fit that has not reached its tolerance does reach, rounded up to two digits; mm.
double reached_tolerance(const SurfaceStage& surface);
/// How many the next try may have.
int more_control_points(int most);
/// A sheet is at least so many times as large as it is thick: the bound of thin plate theory
/// [Timoshenko and Woinowsky-Krieger 1959], below it a body is no sheet whose thickness could be
/// left out of its shape. It is the same in every unit.
inline constexpr double least_size_in_thicknesses = 10;

/// Cells of the next finer grid, see Remedy::finer_grid.
int finer_cells(const GridOptions& grid);

/// Of a cell that isogeometric analysis can still live with; below it the map is nearly singular.
inline constexpr double least_scaled_jacobian = 0.1;

/// The unit that would make a sheet part of it; nothing if its size is a likely one already, also
/// beside its thickness (mm).
std::optional<LengthUnit> likelier_unit(const PartFile& part, double diagonal, double thickness);

/// What the light at the foot of the window says.
struct Readiness {
    bool fine = true;
    std::string text;          ///< "Ready", or in a few words why not
    bool lists_doubts = false; ///< it says how many doubts there are
};
Readiness readiness(const ViewerState& state);

} // namespace spia::viewer
