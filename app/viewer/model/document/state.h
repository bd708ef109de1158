#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/document/document.h"
#include "app/viewer/model/document/file_listing.h"
#include "app/viewer/model/document/history.h"
#include "app/viewer/model/document/message.h"
#include "app/viewer/model/document/preferences.h"
#include "app/viewer/model/document/view.h"
#include "app/viewer/model/picking/camera.h"
#include "app/viewer/model/picking/clip_plane.h"
#include "app/viewer/model/picking/mouse_style.h"

namespace spia::viewer {

enum class Tool {
    look,
    pick,
    box,
    lasso,
    brush,
    flood,
    smooth_region,
    probe,
    section,
    vertex,
    outline,
    corners,
    line,
    shape,
    measure
};
std::string_view name(Tool tool);

/// What is dragged of the surface with the tool shape.
enum class HandleKind { control, lattice };

/// What the colours of the NURBS surface say.
enum class SurfaceLook {
    plain,
    deviation,          ///< its distance from the part
    tolerance,          ///< likewise, in three bands: within the tolerance, below and above it
    patches,            ///< no two neighbours in the same colour
    zebra,              ///< stripes as lamps would throw them: a kink where they break, a jump in
                        ///< curvature where they bend
    mean_curvature,     ///< 1/mm
    gaussian_curvature, ///< 1/mm2
};
/// Whether it has a legend.
bool has_scale(SurfaceLook look);

/// How things are looked at: kept with the project, but no matter of undo.
struct ViewSettings {
    std::array<Camera, 4> camera; ///< by View
    bool linked = true;           ///< part, quads and surface turn together
    std::optional<View> maximised;
    float split_x = 0.5f, split_y = 0.5f; ///< of the four views, shares of the window
    Tool tool = Tool::look;
    MeasureKind measure = MeasureKind::distance; ///< of the tool for it
    MouseStyle mouse = MouseStyle::spia;         ///< not kept with the project: a habit of the user
    ClipPlane clip;                              ///< of the views in space
    double flood_angle = 20;                     ///< degrees
    double brush_radius = 20;                    ///< pixels
    bool through = false;                        ///< box, lasso and brush take hidden faces too
    bool dark = true;
    bool edges = false; ///< of the triangles
    bool features = true;
    bool control_net = true;
    bool part_under_quads = true;
    SurfaceLook surface_look = SurfaceLook::deviation;
    bool quad_quality = true;
    HandleKind handles = HandleKind::control;
    double unfolded = 0;         ///< 0: the part; k: after step k; between: on the way. See
                                 ///< step_position()
    std::optional<int> step;     ///< the chosen one, from 0: its faces are marked
    bool field_on_steps = false; ///< the field of the states instead of the marks
};

/// What a view does not cut away; nothing: all of it is there.
inline std::optional<HalfSpace> kept_in(const ViewSettings& settings, View view)
{
    return view == View::blank ? std::nullopt : kept_by(settings.clip);
}

/// Where the views were before they went to a place.
struct WayBack {
    std::array<Camera, 4> before = {}; ///< to go back to
    std::array<Camera, 4> since = {};  ///< there: a view that was moved on stays
};

/// A place where the mesh of the part is at fault, to which the views went.
struct ShownFault {
    int finding = 0, entry = 0;                      ///< of the doctor's report, of Finding::place
    Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< mm
    WayBack back = {};
};

/// A face that the views went to: it has a mark of its own, what is selected stays.
struct ShownSpot {
    int face = 0; ///< of the part
    WayBack back = {};
    FieldDisplay before = {}, since = {};    ///< as in WayBack
    std::shared_ptr<const PartFile> of = {}; ///< the part whose face it is
};

/// The running chain or export as the window sees it; ViewerModel::poll() keeps it up to date.
struct JobView {
    bool running = false;
    bool cancelling = false;
    std::string title, step;
    double fraction = 0;
    std::vector<double> residual;                  ///< of every step so far
    std::shared_ptr<const Eigen::Matrix2Xd> blank; ///< while it converges; null: nothing yet
};

/// What became of the last export.
struct ExportOutcome {
    std::vector<std::filesystem::path> files; ///< written
    std::string error;                        ///< why not all were written; empty: all were, or it
                                              ///< was cancelled
    bool cancelled = false;                   ///< before all were written
};

/// The later results of a blank: its grid, the quad mesh, the surface.
struct LaterResults {
    std::shared_ptr<const FlattenResult> blank;
    std::shared_ptr<const GridStage> grid;
    std::shared_ptr<const LiftResult> lifted;
    std::shared_ptr<const SurfaceStage> surface;
};

struct Doubt;
struct Grade;
struct Reference;
struct Differences;

/// A file that was refused while a part was open, which stays.
struct RefusedFile {
    std::filesystem::path file;
    ReadOptions read;                  ///< how it was read
    bool shown = false;                ///< in the view of the part, in its place
    std::array<Camera, 4> camera = {}; ///< of the views before it was shown
};

struct ViewerState;
/// What the mesh doctor's panel is about: the part that was refused, else the one that is there.
/// Null: none.
const PartFile* examined(const ViewerState& state);
/// Whether the view of the part shows a refused file in the place of the part that is open.
bool shows_refused(const ViewerState& state);

/// All the window shows. Only a ViewerModel changes it: by actions, with the news of its jobs, and
/// what follows the mouse and the size of the views.
struct ViewerState {
    Document document;
    History history;
    ViewSettings view;
    Preferences preferences;
    JobView job;
    std::vector<Message> messages;
    std::shared_ptr<const std::vector<Doubt>> doubts; ///< what the results are poorer for, see
                                                      ///< lights.h; null: nothing yet
    LaterResults before;                              ///< those that a grid being made (a corner
                                                      ///< being dragged) has put out of date
    std::filesystem::path project;                    ///< file it was saved to or opened from;
                                                      ///< empty: none yet
    std::optional<ExportOutcome> exported;            ///< none since the last export was begun
    /// handles of the surface follow the mouse
    bool shape_dragged = false;
    std::optional<int> hovered; ///< face under the mouse
    /// the part that could not be taken, to look at its faults; null: none
    std::shared_ptr<const PartFile> refused;
    /// whose mesh that is; null: the file of the document
    std::optional<RefusedFile> refused_file;
    std::optional<ShownFault> fault; ///< the one that is looked at
    std::optional<ShownSpot> spot;   ///< likewise a face
    /// a file that is read and would take the place of work that is not saved: the user is asked
    std::optional<std::filesystem::path> read_and_waits;
    /// which a click would pick, with a tool for vertices
    std::optional<int> hovered_vertex;
    std::optional<FileListing> listing; ///< the file that is looked into
    /// that can be chosen, see grades.h; never null
    std::shared_ptr<const std::vector<Grade>> grades;
    std::shared_ptr<const Reference> reference;     ///< an earlier result to be compared with;
                                                    ///< null: none
    std::shared_ptr<const Differences> differences; ///< from it, see comparison.h; null: none
};

/// How far the view of the part is unfolded: as chosen, as far as there are states that hold.
double step_position(const ViewerState& state);
/// The step that is looked at, if there is one.
const PlannedStep* step_shown(const ViewerState& state);

/// What the views of quads and surface show: the results of the session, and while newer ones of
/// the same blank are being made, those before. Null where there is nothing to show.
LaterResults quads_shown(const ViewerState& state);
LaterResults surface_shown(const ViewerState& state);
/// Whether a view shows results of other options than are wanted now.
bool is_old(const ViewerState& state, View view);

/// Of a view, for people.
const char* title(View view);

/// Of the project, else of the part that is there, never of a file that is being read or was
/// refused; with a star where something is not saved.
std::string window_title(const ViewerState& state);
/// The view settings as they are once no refused file is shown: what is kept.
ViewSettings kept_view(const ViewerState& state);

} // namespace spia::viewer
