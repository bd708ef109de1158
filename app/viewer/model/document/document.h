#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/document/limits_choice.h"
#include "app/viewer/model/document/process_choice.h"
#include "app/viewer/model/document/scene.h"
#include "app/viewer/model/document/unfolding_steps.h"
#include "app/viewer/model/document/view.h"
#include "engine/pipeline/session.h"
#include "engine/report/figures/field.h"

namespace spia::viewer {

enum class RegionKind { fixed, binder, pad, punch, material, other };
std::string_view name(RegionKind kind);
RegionKind region_kind(std::string_view name); ///< @throws InputError
bool is_tool(RegionKind kind);                 ///< whether it presses on the sheet

/// Picked faces with a name.
struct FaceRegion {
    std::string name;
    RegionKind kind = RegionKind::other;
    Colour colour{0.9f, 0.7f, 0.1f, 1};
    std::vector<int> faces;                  ///< of the part, ascending
    std::optional<ToolContact> contact = {}; ///< of a binder, a pad, the punch
    std::optional<OwnSheet> sheet = {};

    friend bool operator==(const FaceRegion&, const FaceRegion&) = default;
};

/// A place on the part that is watched: pinned by the user.
struct Probe {
    int face = -1;
    Eigen::Vector3d barycentric{1. / 3, 1. / 3, 1. / 3};
};

/// What is measured, on the part as it is formed or in another picture.
enum class MeasureKind {
    distance, ///< between two places
    angle,    ///< at the second of three places
    faces,    ///< between two faces: how far the sheet turns from one to the other
    circle,   ///< through three places
    rounding  ///< the cylinder through the rounded piece of sheet around a place, else its
              ///< curvature there
};
std::string_view name(MeasureKind kind);
size_t places_of(MeasureKind kind); ///< how many are picked

struct Measured;
struct Measurement {
    MeasureKind kind = MeasureKind::distance;
    std::vector<Probe> at;
    View on = View::part;                       ///< whose faces `at` means, see measured_mesh() in
                                                ///< measuring.h
    std::shared_ptr<const Measured> found = {}; ///< never null in a document, see measuring.h
};

/// A line drawn in a view: the field is plotted along the cut of the plane through it and the
/// direction of sight.
struct SectionLine {
    Eigen::Vector3d from{0, 0, 0}, to{0, 0, 0}; ///< mm, at the depth of what was under the mouse
    Eigen::Vector3d depth{0, 0, -1};            ///< the direction of sight
    bool on_blank = false;                      ///< drawn on the flat blank, z = 0

    friend bool operator==(const SectionLine&, const SectionLine&) = default;
};

/// How the fields of the sheet are shown on the part and the blank.
struct FieldDisplay {
    Field field = Field::thinning;
    bool per_face = false;                      ///< as the user chose, see by_face()
    std::optional<std::array<double, 2>> range; ///< in the unit of the field; not given: its least
                                                ///< and greatest value
    std::optional<ColourMap> map;               ///< not given: diverging where zero matters, else
                                                ///< viridis
    int bands = 0;                              ///< 0: smooth
    bool isolines = false;
    bool extremes = true;    ///< mark least and greatest
    bool directions = false; ///< glyphs of the principal strains
    bool difference = false; ///< now minus reference; only where there is one, see comparison.h

    friend bool operator==(const FieldDisplay&, const FieldDisplay&) = default;
};
/// Of another field: the range was that of the former.
FieldDisplay with_field(FieldDisplay display, Field field, std::optional<ColourMap> map);
/// Whether each face has one colour: as chosen, and of zones, between two of which nothing lies.
bool by_face(const FieldDisplay& display);
/// Whether the colours of a field are means at the vertices, which peaks of single faces exceed.
bool is_smoothed(const FieldDisplay& display);

/// Who says what the sheet is.
enum class SheetSource {
    assumed,   ///< nobody: the program took something
    before,    ///< it was that of another part
    file,      ///< the file of the part
    chosen,    ///< the user
    preference ///< the user, for all parts whose file does not say it
};
/// Whether somebody says it.
inline bool is_given(SheetSource from) { return from != SheetSource::assumed && from != SheetSource::before; }

/// What the user made: everything that undo brings back and a project file keeps. A copy is cheap,
/// results are shared.
struct Document {
    Session session;                     ///< its options are what is wanted; results may be older,
                                         ///< see first_stale()
    SessionOptions made_with;            ///< the options that the results of the session were made
                                         ///< with
    std::string material = "mild_steel"; ///< a built-in grade, or the path of a material file
    SheetSource material_from = SheetSource::assumed, thickness_from = SheetSource::assumed;
    std::vector<int> selected;                 ///< faces of the part, ascending
    std::vector<int> vertices;                 ///< picked ones of the part, ascending
    std::vector<int> controls, lattice_points; ///< picked handles of the surface, ascending; see
                                               ///< handles.h
    std::vector<FaceRegion> regions;
    std::vector<ProcessLine> lines;
    double edge_restraint = 0;              ///< of the outer edge, as a share of the lock force
    std::optional<Eigen::Vector3d> rolling; ///< rolling direction; not given: the sheet is
                                            ///< isotropic in its plane
    std::vector<Probe> probes;
    std::vector<Measurement> measurements;
    std::optional<SectionLine> section;
    LimitsChoice limits;
    StepList steps;                            ///< of unfolding step by step
    std::shared_ptr<const Proposal> proposal;  ///< the last one, see still_proposed(); null: none
    std::shared_ptr<const PartBends> bends;    ///< found for the last proposal; null: none yet
    std::shared_ptr<const StepsRun> unfolding; ///< the last run of steps, see steps_done(); null:
                                               ///< none yet
    FieldDisplay display;
    bool unsaved = false; ///< work that a saved project does not hold; undo brings back what was so
};

/// The conditions for the solver, of the regions, the lines and the rest.
/// @param materials  folder of the built-in grades
/// @throws InputError if a material is not to be had, or a bead's shape is none
ProcessConditions process_of(const Document& document, const std::filesystem::path& materials);

/// The force of a drawbead per length, N/mm, as the solver will have it: as given, or of its shape
/// with the sheet in which it lies. None of a pilot, or if there are no conditions for the solver.
/// @param line  of document.lines
std::optional<double> bead_force(const Document& document, size_t line);

} // namespace spia::viewer
