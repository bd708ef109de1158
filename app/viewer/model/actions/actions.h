#pragma once
#include <any>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/viewer/model/document/fit_choice.h"
#include "app/viewer/model/document/state.h"
#include "app/viewer/model/document/step_friction.h"
#include "app/viewer/model/document/step_target.h"
#include "app/viewer/model/reports/report_options.h"
#include "engine/forming/material/material_fit.h"
#include "engine/pipeline/outputs/outputs.h"

/// What a user can do. Buttons, shortcuts, scripts and tests put actions into a queue; apply()
/// carries them out between two frames. In a script an action is an object {"do": NAME, ...} with
/// the members of its struct; NAME is given here.
namespace spia::viewer {

enum class PickMode { replace, add, remove };

// --- the chain
/// How a part is read of its file. In scripts: weld (vertices at one place are joined or not; not
/// given: as the format needs), weld_gap_mm (with weld: gaps between open edges up to this are
/// closed, too; not given: only what is at one place), keep_largest (all but the largest piece of
/// sheet is left out), parts (of a solver deck by ids or names, of a CAD file bodies and faces;
/// none: all), skin (of a solid of sheet: "middle", the default, "outer" or "inner"), and of CAD
/// files sewing_mm (gaps up to this are closed; not given: found from the gaps), deflection_mm
/// (between triangles and faces; not given: 1/2000 of the diagonal), leave_out_bad_faces (those
/// that cannot be read or meshed) and keep_triangles (needles on drawn parts are not remeshed).
struct Reading {
    std::optional<bool> weld = {};
    bool keep_largest = false;
    std::vector<std::string> parts = {};
    std::optional<Skin> skin = {};
    std::optional<double> sewing_mm = {}, deflection_mm = {};
    bool leave_out_bad_faces = false, keep_triangles = false;
    std::optional<double> weld_gap_mm = {};

    friend bool operator==(const Reading&, const Reading&) = default;
};
Reading reading_of(const ReadOptions& options);
void set_reading(ReadOptions& options, const Reading& reading);

/// "list_file": what can be chosen of a file before it is read, in the background; the window shows
/// it. again: the file of the part, to be read otherwise with all that was done on it.
struct ListFile {
    std::filesystem::path file;
    bool again = false;
};
struct CloseList {}; ///< "close_list"
struct OpenPart {
    std::filesystem::path file;
    std::string unit;
    Reading reading = {};
}; ///< "open_part"; unit may be empty
struct SetUnit {
    std::string unit;
}; ///< "set_unit": reads the part again
struct SetReading {
    Reading reading;
}; ///< "set_reading": reads the part again otherwise; parts are as they are if not given
/// "read_again": as open_part reads the file, but of the part that is there, with what was done on
/// it; unit empty: as it is.
struct ReadAgain {
    std::string unit;
    Reading reading;
};
/// "set_seam": mode ("automatic", "none", "given", "corners": where a few cuts let it unroll), path
/// [[vertex of the file, ...], ...]; reads the part again, and with "corners" unfolds it with and
/// without the cuts, to tell what they are worth.
struct SetSeam {
    SeamOptions seam;
};
/// "set_remeshing": remesh {size, tolerance} in mm, each null: chosen from the part; null: the
/// triangles of the file, also where those of CAD faces are needles (reading.keep_triangles); reads
/// the part again.
struct SetRemeshing {
    std::optional<RemeshOptions> remesh = {};
};
struct RunTo {
    Stage stage = Stage::fit;
};                   ///< "run_to": what is missing up to this stage, in the background
struct CancelJob {}; ///< "cancel_job"
struct SetMaterial {
    std::string material;
}; ///< "set_material": a grade or a file
/// "fit_material": of a tensile test (table) the material file `out`, which becomes the material;
/// fit {law, name, test {kind, in_percent, young_MPa}, poisson, density_kg_m3, r0, r45, r90}.
struct FitMaterial {
    std::filesystem::path table, out;
    MaterialFitOptions fit;
};
/// "save_material": material (as in a material file) becomes a grade of the user's own, see
/// model/document/grades.h; replaces: the own grade that it was before, which goes if the name has
/// changed. Where the part is of that grade it gets the new values.
struct SaveMaterial {
    Material material;
    std::string replaces = {};
};
/// "remove_material": a grade of the user's own, by its stem or file
struct RemoveMaterial {
    std::string material;
};
struct SetThickness {
    double thickness = 1;
}; ///< "set_thickness", mm
struct SetSkins {
    bool skins = true;
}; ///< "set_skins": whether the blank also tells the strains of both skins
struct SetDirection {
    std::optional<Eigen::Vector3d> direction;
}; ///< "set_direction"; not given: automatic
/// "set_k_factor": where the neutral fibre of the bends lies, as `--k-factor` of the command line
/// has it: a number, "din6935" or the file of a table; empty: 0.5, and meshes of no solid keep
/// their triangles. A blank that is there is made anew at once.
struct SetKFactor {
    std::string k_factor = {};
};
struct SetCorner {
    int corner = 0;
    int vertex = 0;
    bool dragging = false;
};                        ///< "set_corner": number 0 to 3 to a vertex of the part; while dragging,
                          ///< coarse
struct ProposeCorners {}; ///< "propose_corners": automatic ones again
struct SetGrid {
    GridOptions grid;
}; ///< "set_grid": its options by their keys, as described<GridOptions> has them
/// "set_fit": those of the surface by their keys, as members_of<FitChoice> has them; tolerance
/// null: it runs through the nodes of the grid
struct SetFit {
    FitChoice fit;
};

/// "set_patches", of the surface: patches {cuts [[vertex of the file, ...], ...], corners [vertex
/// of the file, ...], edge_deg, smooth_joins}, patches around the holes; null: one patch, or with
/// `best` the program's choice of one or several.
struct SetPatches {
    std::optional<LayoutOptions> patches = {};
    bool best = false;
};
/// "add_cut": patches meet along the picked vertices, whose ends are on the border of the part;
/// with holes in the sheet or without.
struct AddCut {};
struct RemoveCut {
    int cut = 0;
}; ///< "remove_cut"

// --- the shape of the surface
/// "set_lattice": lattice {count [l, m, n], degree [p, q, r]} at rest around the surface; null:
/// none.
struct LatticeChoice {
    std::array<int, 3> count = {4, 4, 4}, degree = {3, 3, 3};
};
struct SetLattice {
    std::optional<LatticeChoice> lattice = {};
};
/// "pick_handle": of a kind ("control", "lattice") the one that the view of the surface shows
/// nearest to a pixel.
struct PickHandle {
    HandleKind kind = HandleKind::control;
    glm::dvec2 pixel{0};
    glm::dvec2 size{0};
    PickMode mode = PickMode::replace;
    double reach = 12; ///< pixels
};
struct SelectHandles {
    HandleKind kind = HandleKind::control;
    std::vector<int> handles = {};
    PickMode mode = PickMode::replace;
}; ///< "select_handles": kind, handles (numbers, see model/picking/handles.h), mode
/// "move_handles": the picked ones of a kind by [x, y, z], mm; while dragging it is not judged what
/// becomes of the surface
struct MoveHandles {
    HandleKind kind = HandleKind::control;
    Eigen::Vector3d by{0, 0, 0};
    bool dragging = false;
};
struct ResetHandles {
    HandleKind kind = HandleKind::control;
}; ///< "reset_handles": what was moved by this kind goes back
struct OpenDeformation {
    std::filesystem::path file;
}; ///< "open_deformation" of the command line's form (spia.deformation/1)
struct SaveDeformation {
    std::filesystem::path file;
}; ///< "save_deformation"

/// "set_limits": curve ("automatic", "keeler_brazier", "points" of a table, "none"), table, n,
/// margin, max_thinning, max_thickening, low_strain. A blank that is there is judged anew at once.
struct SetLimits {
    LimitsChoice limits;
};

// --- unfolding step by step
/// "propose_steps": replaces the list; keep: a face whose region stays where it is, not given: the
/// largest flat region. In the background.
struct ProposeSteps {
    std::optional<int> keep = {};
};
/// "run_steps": those that are missing or out of date, in the background. Where the list is a
/// proposal of which nothing was edited it is planned anew if a step does not work out, as by the
/// command line's --auto; the list then shows the steps that were done
struct RunSteps {};
/// "use_blank_of_steps": grid, surface, limits and files go on from it, in the background, until
/// the part is solved in one step again (run_to). polish: the one-step solve is started from it
/// first
struct UseBlankOfSteps {
    bool polish = false;
};
/// "open_steps": replaces the list by the steps of a file of the command line (schema
/// spia.unfold/1), in the background
struct OpenSteps {
    std::filesystem::path file;
};
struct SaveSteps {
    std::filesystem::path file;
}; ///< "save_steps" as such a file, in the background
/// "add_step": lays the faces of a region (freed; not given: the selected faces) on the face that
/// those of another one (fixed) lie on, or on the plane through those of a region (plane_of), or on
/// a target of its own: plane {origin, normal}, cylinder {origin, axis, radius} or cone {apex,
/// axis, half_angle_deg}; everything else stays. name may be empty
struct AddStep {
    int fixed = 0;
    std::optional<int> freed = {};
    std::string name = {};
    StepTarget target = {};
    std::optional<int> plane_of = {};
};
/// "change_step": step (from 0), name, offset_mm of the face to its outer side, within_mm (0:
/// automatic), extent_mm beyond what carries it (null: as far as the sheet goes), tolerance (null:
/// that of the solver), target (as of add_step; with none of the three it is fitted again; not
/// given: stays), friction of the target (force_N or pressure_MPa, friction, sides 1 or 2; null:
/// none)
struct ChangeStep {
    int step = 0;
    std::string name = {};
    double offset_mm = 0;
    double within_mm = 0;
    std::optional<double> extent_mm = {};
    std::optional<double> tolerance = {};
    std::optional<StepTarget> target = {};
    std::optional<StepFriction> friction = {};

    /// What leaves the step as it is.
    static ChangeStep unchanged(int number, const PlannedStep& step)
    {
        return {number,
                step.name,
                step.offset_mm,
                step.within_mm,
                step.extent_mm,
                step.tolerance,
                {},
                numbers_of(step.pick.friction)};
    }
};
/// "set_target_plane": the target of a step becomes the plane through the faces of a region (not
/// given: the selected faces), as they lie before it
struct SetTargetPlane {
    int step = 0;
    std::optional<int> region = {};
};
/// "set_carrying": the target of a step is fitted to the faces of a region (not given: the selected
/// faces), which stay
struct SetCarrying {
    int step = 0;
    std::optional<int> region = {};
};
struct RemoveStep {
    int step = 0;
}; ///< "remove_step"
struct MoveStep {
    int step = 0, to = 0;
}; ///< "move_step": to another place in the list
/// "show_step": step (from 0), whose faces are marked; position of the slider, 0: the part, k:
/// after step k. Where only one is given the other follows; where neither is, the part is shown.
struct ShowStep {
    std::optional<int> step = {};
    std::optional<double> position = {};
};

// --- picking
struct SelectFaces {
    std::vector<int> faces;
    PickMode mode = PickMode::replace;
}; ///< "select_faces"
/// "pick_at": what the view shows at a pixel: the face, with `flood` all around it up to an angle
/// (degrees), with `smooth` its whole smooth region.
struct PickAt {
    View view = View::part;
    glm::dvec2 pixel{0};
    glm::dvec2 size{0};
    PickMode mode = PickMode::replace;
    std::optional<double> flood = {};
    bool smooth = false;
};
/// "pick_area": all faces whose middle lies inside a polygon of pixels (a box has four). Hidden
/// ones only with `through`.
struct PickArea {
    View view = View::part;
    std::vector<glm::dvec2> polygon;
    glm::dvec2 size{0};
    PickMode mode = PickMode::replace;
    bool through = false;
};
/// "pick_brush": all faces that a brush of some pixels' radius touches at this pixel.
struct PickBrush {
    View view = View::part;
    glm::dvec2 pixel{0};
    double radius = 20;
    glm::dvec2 size{0};
    PickMode mode = PickMode::add;
    bool through = false;
};
struct SelectVertices {
    std::vector<int> vertices;
    PickMode mode = PickMode::replace;
}; ///< "select_vertices"
/// "pick_vertex": the vertex in sight that is nearest to a pixel; with `boundary` of the outline
/// and the holes only, where sharp turns go before the others.
struct PickVertex {
    View view = View::part;
    glm::dvec2 pixel{0};
    glm::dvec2 size{0};
    PickMode mode = PickMode::replace;
    bool boundary = false;
    double reach = 12; ///< pixels
};
struct UseVerticesAsCorners {}; ///< "use_vertices_as_corners": four picked ones of the outline
                                ///< become those of the grid
struct GrowSelection {};        ///< "grow_selection": by one ring of faces
struct ShrinkSelection {};      ///< "shrink_selection"
struct InvertSelection {};      ///< "invert_selection"
struct ClearSelection {};       ///< "clear_selection": faces and vertices
struct MakeRegion {
    std::string name;
    RegionKind kind = RegionKind::fixed;
}; ///< "make_region" of the selected faces; name may be empty
struct ChangeRegion {
    int region = 0;
    std::string name;
    RegionKind kind = RegionKind::fixed;
    Colour colour{};
}; ///< "change_region"
struct RemoveRegion {
    int region = 0;
}; ///< "remove_region"
/// "set_contact": what the tool on a region does: contact {force_N or pressure_MPa, friction};
/// null: nothing.
struct SetContact {
    int region = 0;
    std::optional<ToolContact> contact;
};
/// "set_own_sheet": sheet {material, thickness} of a region; null: that of the rest.
struct SetOwnSheet {
    int region = 0;
    std::optional<OwnSheet> sheet;
};
/// "add_line": kind ("drawbead", "pilot"), name (may be empty), point [[x, y, z], ...], force_N_mm
/// or shape {radius, shoulder_radius, depth, friction}
struct AddLine {
    ProcessLine line;
};
struct ChangeLine {
    int number = 0;
    ProcessLine line;
}; ///< "change_line": number, line
struct RemoveLine {
    int number = 0;
};                     ///< "remove_line"
struct PinVertices {}; ///< "pin_vertices": a pilot at each picked vertex
/// "set_process": edge_restraint (share of the lock force), rolling (direction; null: isotropic in
/// the plane)
struct SetProcess {
    double edge_restraint = 0;
    std::optional<Eigen::Vector3d> rolling;
};
struct SelectRegion {
    int region = 0;
    PickMode mode = PickMode::replace;
}; ///< "select_region"
struct AddProbe {
    Probe probe;
}; ///< "add_probe"
struct RemoveProbe {
    int probe = 0;
}; ///< "remove_probe"
/// "draw_section": a line between two pixels of a view; the field is plotted along the cut.
struct DrawSection {
    View view = View::part;
    glm::dvec2 from{0}, to{0}, size{0};
};
struct ClearSection {}; ///< "clear_section"
/// "add_measurement": kind ("distance", "angle", "faces", "circle", "rounding"), at [{face,
/// barycentric}, ...]: 2, 3, 2, 3 or 1 places, on: the view, whose faces they are on ("part" if not
/// given)
struct AddMeasurement {
    Measurement measurement;
};
struct RemoveMeasurement {
    int measurement = 0;
};                           ///< "remove_measurement"
struct ClearMeasurements {}; ///< "clear_measurements"
struct ClearProbes {};       ///< "clear_probes"

// --- looking
struct SetDisplay {
    FieldDisplay display;
}; ///< "set_display"
struct SetViewSettings {
    ViewSettings view;
}; ///< "set_view": no matter of undo
/// "set_preferences": dark, interface_percent (75 to 200), lengths ("mm", "inch"), material (empty:
/// none is chosen), thickness_mm, map and tolerance_mm (null: none is chosen), one_patch (else the
/// program chooses what a surface is made of); parts that are opened from then on begin with them.
/// No matter of undo.
struct SetPreferences {
    Preferences preferences;
};
struct FitView {
    std::optional<View> view;
}; ///< "fit_view"; not given: all
struct LookFrom {
    View view = View::part;
    StandardView from = StandardView::isometric;
}; ///< "look_from"
/// "look_from_side": side [x, y, z] of the view cube, each -1, 0 or 1: where the viewer stands
struct LookFromSide {
    View view = View::part;
    std::array<int, 3> side = {0, 0, 1};
};
/// "fly_to": every view shows this face in its middle, with a mark; what is picked stays
struct FlyTo {
    int face = 0;
    std::optional<Field> field = {}; ///< that shows what is there; not given: the one that is shown
};
/// "hide_spot": the mark of fly_to goes, the views that were not moved since go back, and so does
/// the field
struct HideSpot {};
struct FlyToVertex {
    int vertex = 0;
}; ///< "fly_to_vertex": likewise; what is picked stays

/// "show_fault": the views go to a place that the mesh doctor found; numbers as in DoctorReport.
struct ShowFault {
    int finding = 0, entry = 0;
};
struct HideFault {}; ///< "hide_fault": its mark goes, and the views that were not moved go back
/// "show_refused": the view of the part shows the mesh of the file that was refused while the part
/// was open.
struct ShowRefused {};
struct CloseRefused {}; ///< "close_refused": back to the part, and no more of the refused file

/// "keep_reference": the blank that there is, for later ones to be compared with; name may be
/// empty. Not kept in projects.
struct KeepReference {
    std::string name;
};
struct DropReference {}; ///< "drop_reference"

// --- the document and files
struct Undo {}; ///< "undo"
struct Redo {}; ///< "redo"
struct OpenProject {
    std::filesystem::path file;
}; ///< "open_project"
/// "take_opened": the file that is read and waits takes the place of the part, whose work is not
/// saved; without_saving: also where it still is not
struct TakeOpened {
    bool without_saving = false;
};
struct DropOpened {}; ///< "drop_opened": it is forgotten, the part stays
struct SaveProject {
    std::filesystem::path file;
}; ///< "save_project"; empty: the one it came from
struct ExportFiles {
    std::filesystem::path folder;
    std::vector<std::string> formats;
    OutputOptions options;
}; ///< "export", in the background; options: unit, name, glb {part, ...}, csv {fields, outline}
struct WriteReport {
    std::filesystem::path file;
    ViewerReportOptions options;
}; ///< "write_report": HTML; options: title, remarks, pictures, standard_look, tables
    ///< {key_figures, ...}
/// "screenshot" (PNG); no view: the window. Without a size it is as large as on the screen.
struct Screenshot {
    std::filesystem::path file;
    std::optional<View> view;
    int width = 0, height = 0;
    bool legend = true, labels = true; ///< of a view; the window shows what it shows
    bool transparent = false;          ///< ground of a view; else that of the theme
};
/// "animation", in the background: the unfolding from the part to the blank, as many pictures in as
/// many seconds, and back again if asked for. A GIF that repeats, or where the file is called .png,
/// numbered pictures beside each other.
struct SaveAnimation {
    std::filesystem::path file;
    int frames = 48; ///< from the part to the blank
    double seconds = 4;
    int width = 960, height = 640; ///< pixels
    bool legend = true;
    bool back = true; ///< then from the blank to the part, in as many seconds
};
struct DismissMessages {}; ///< "dismiss_messages"
struct Quit {};            ///< "quit"

/// The kinds of action.
template <class... T> struct ActionKinds {
    template <class Kind> static constexpr bool has = (std::is_same_v<Kind, T> || ...);
    static constexpr size_t count = sizeof...(T);
    /// Calls visit(std::type_identity<Kind>{}) for one kind after the other until it answers true.
    /// @returns whether it has
    template <class Visit> static constexpr bool any(const Visit& visit)
    {
        return (visit(std::type_identity<T>{}) || ...);
    }
};
using AllActions =
    ActionKinds<ListFile, CloseList, OpenPart, SetUnit, SetReading, ReadAgain, SetSeam, SetRemeshing, RunTo, CancelJob,
                SetMaterial, FitMaterial, SaveMaterial, RemoveMaterial, SetThickness, SetSkins, SetDirection,
                SetKFactor, SetCorner, ProposeCorners, SetGrid, SetFit, SetPatches, AddCut, RemoveCut, SetLattice,
                PickHandle, SelectHandles, MoveHandles, ResetHandles, OpenDeformation, SaveDeformation, SetLimits,
                ProposeSteps, RunSteps, UseBlankOfSteps, OpenSteps, SaveSteps, AddStep, ChangeStep, SetTargetPlane,
                SetCarrying, RemoveStep, MoveStep, ShowStep, SelectFaces, PickAt, PickArea, PickBrush, SelectVertices,
                PickVertex, UseVerticesAsCorners, GrowSelection, ShrinkSelection, InvertSelection, ClearSelection,
                MakeRegion, ChangeRegion, RemoveRegion, SetContact, SetOwnSheet, AddLine, ChangeLine, RemoveLine,
                PinVertices, SetProcess, SelectRegion, AddProbe, RemoveProbe, ClearProbes, DrawSection, ClearSection,
                AddMeasurement, RemoveMeasurement, ClearMeasurements, SetDisplay, SetViewSettings, SetPreferences,
                FitView, LookFrom, LookFromSide, FlyTo, HideSpot, FlyToVertex, ShowFault, HideFault, ShowRefused,
                CloseRefused, KeepReference, DropReference, Undo, Redo, OpenProject, TakeOpened, DropOpened,
                SaveProject, ExportFiles, WriteReport, Screenshot, SaveAnimation, DismissMessages, Quit>;

/// One action of any kind. Not a variant: every file that copies one of a hundred kinds takes 10 s
/// more to compile.
class Action {
public:
    template <class T>
    requires(AllActions::has<T>) Action(T action) : kept_(std::move(action)) {}
    /// @returns the action if it is of this kind, else nullptr
    template <class T> const T* as() const { return std::any_cast<T>(&kept_); }
    template <class T> T* as() { return std::any_cast<T>(&kept_); }
    template <class T> bool is() const { return as<T>() != nullptr; }
    bool same_kind(const Action& other) const { return kept_.type() == other.kept_.type(); }

private:
    std::any kept_;
};

/// Calls visit with the action as what it is.
template <class Visit> void visit_action(Visit&& visit, const Action& action)
{
    AllActions::any([&]<class T>(std::type_identity<T>) {
        const T* each = action.as<T>();
        if (each)
            visit(*each);
        return each != nullptr;
    });
}

/// Actions to come, in order.
class ActionQueue {
public:
    void push(Action action) { actions_.push_back(std::move(action)); }
    std::vector<Action> take() { return std::exchange(actions_, {}); }
    bool empty() const { return actions_.empty(); }

private:
    std::vector<Action> actions_;
};

} // namespace spia::viewer
