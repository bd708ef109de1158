#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <imgui.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/actions/actions.h"
#include "app/viewer/model/jobs/viewer_model.h"
#include "app/viewer/model/picking/view_cube.h"
#include "app/viewer/panels/charts.h"
#include "app/viewer/panels/comparison_section.h"
#include "app/viewer/panels/dialogs/animation_dialog.h"
#include "app/viewer/panels/dialogs/dialog_queue.h"
#include "app/viewer/panels/dialogs/export_dialog.h"
#include "app/viewer/panels/dialogs/file_dialog.h"
#include "app/viewer/panels/dialogs/import_dialog.h"
#include "app/viewer/panels/dialogs/manual_window.h"
#include "app/viewer/panels/dialogs/material_dialog.h"
#include "app/viewer/panels/dialogs/material_editor.h"
#include "app/viewer/panels/dialogs/picture_dialog.h"
#include "app/viewer/panels/dialogs/preferences_dialog.h"
#include "app/viewer/panels/dialogs/report_dialog.h"
#include "app/viewer/panels/labels.h"
#include "app/viewer/panels/side_panels.h"
#include "app/viewer/panels/steps/edited_region.h"
#include "app/viewer/panels/theme.h"
#include "app/viewer/panels/view_events.h"
#include "app/viewer/views/scene_cache.h"
#include "app/viewer/views/step_scene.h"
#include "engine/report/text/lengths.h"

namespace spia::viewer {

/// A key of GLFW with GLFW_MOD_ bits.
struct KeyPress {
    int key, modifiers;
};

/// Work that is not saved and out of sight, after a crash or an opening that failed, and the user's
/// word on it; without one it stays.
struct LeftWork {
    enum class Answer { none, recover, discard, later };
    std::string text;  ///< what became of it
    std::string saved; ///< when, in words
    Answer answer = Answer::none;
};

/// What a line becomes that is drawn on the part.
enum class DrawnLine { drawbead, pilot, seam };

/// What is being typed into a field, until typing ends.
struct Typed {
    ImGuiID id = 0;
    std::array<std::string, 3> number{}; ///< of a field of numbers
    std::array<bool, 3> edited{};        ///< which of them were typed
    std::string text = {};               ///< of a field of text
};

/// Handles of the surface on their way with the mouse.
struct HandleDrag {
    HandleKind kind;
    glm::dvec2 from, at;   ///< pixels of the view: where the button went down, and where the mouse
                           ///< was last
    Eigen::Vector3d place; ///< mm, of the handle under the mouse
    bool moved = false;
};

/// The view cube under a pressed button.
struct CubeDrag {
    CubeSide side;
    glm::dvec2 from; ///< pixels of the view
    bool moved = false;
};

/// The item of a panel that was clicked last, see keep_in_place().
struct PanelAnchor {
    ImGuiID item = 0;
    float y = 0;          ///< pixels from where the content of the panel begins to its upper edge
    float scroll = 0;     ///< of the panel
    ImVec2 mouse{-1, -1}; ///< of the screen
};

/// What the panels remember from frame to frame and nobody else needs to know.
struct Ui {
    Fonts fonts;
    float scale = 1; ///< of the screen, 1 for 96 dots per inch, times the size of the interface
                     ///< that is preferred
    float left_width = 300, right_width = 320;
    SidePanels panels;
    bool show_shortcuts = false, show_messages = false;
    bool show_export = false, show_picture = false, show_report = false, show_material = false,
         /// dialogs that open in the next frame
        show_preferences = false, show_about = false, show_animation = false;
    /// seconds; by number
    std::map<int, double> message_since;
    double wake_at = 0; ///< seconds of ImGui's clock: the window changes then without an event; 0:
                        ///< no
    FileDialog files;
    DialogQueue dialogs;
    std::optional<View> focus;        ///< the view that single letters act in: the one that was
                                      ///< clicked last; none: a panel has them
    bool by_keys = false;             ///< it was reached by a key, not by a click
    int keyed_corner = 0;             ///< of the grid, which the arrows move with the tool for
                                      ///< corners
    std::vector<KeyPress> keys;       ///< pressed since the last frame
    std::vector<KeyPress> keys_later; ///< for the next frame, when what was being typed has been
                                      ///< taken
    std::optional<Typed> typed;
    bool number_refused = false; ///< what was typed last into a field of numbers was none
    Memo<std::string, std::shared_ptr<const PartFile>, std::shared_ptr<const FlattenResult>, std::vector<int>>
        no_cut;            ///< why the picked vertices make no cut; empty: they do
    int listed_place = -1; ///< of the fault that is shown: the list of its places was scrolled to
                           ///< it

    // the view the mouse is busy in
    std::optional<View> busy;
    Navigator navigator;
    std::optional<CubeDrag> cube_drag;
    std::vector<Probe> measuring;     ///< places of a measurement to be, those clicked so far
    View measuring_in = View::part;   ///< the view that they were clicked in
    std::array<Covered, 4> covered{}; ///< of the views, in the last frame
    PanelAnchor panel_anchor;
    std::optional<int> dragged_corner;
    bool aside = false;            ///< drawn for a picture: the views of the window keep their
                                   ///< sizes and cameras
    glm::dvec2 corner_taken_at{0}; ///< pixels of the view
    bool corner_moved = false;     ///< since it was taken
    std::optional<HandleDrag> handle_drag;
    std::vector<glm::dvec2> trail;     ///< of box and lasso, pixels of the view
    std::vector<glm::dvec2> path;      ///< where the mouse went since the last frame, a button
                                       ///< down, pixels of the window
    std::vector<Eigen::Vector3d> line; ///< being drawn: places on the part, mm
    DrawnLine drawn_line = DrawnLine::drawbead;
    std::array<ImVec2, 4> view_from{}, view_size{};
    std::array<LabelPlaces, 4> labels;

    ExportChoices exporting;
    PictureChoices picturing;
    ReportChoices reporting;
    MaterialChoices fitting;
    MaterialEditor materials;
    ComparisonTable compared;
    ImportChoices importing;
    PreferenceChoices preferring;
    AnimationChoices animating;
    std::optional<AnimationRun> animation; ///< the one that is being made; null: none
    ManualWindow manual;
    /// of the program and the libraries that it runs with
    std::vector<std::pair<std::string, std::string>> versions;

    Charts charts;
    std::optional<SectionMark> section_mark;

    std::string region_name;
    RegionKind region_kind = RegionKind::fixed;
    std::optional<EditedRegion> edited_region;
    int step_fixed = 0, step_freed = -1;                ///< regions of the step to be added; -1:
                                                        ///< the selection
    int step_onto = -1;                                 ///< region whose plane is its target; -1:
                                                        ///< fitted to what stays
    bool polish_steps = false;                          ///< their blank, when it is taken for the
                                                        ///< chain
    std::map<std::string, std::array<ImVec2, 2>> items; ///< of steps and import, from and to: where
                                                        ///< a mouse finds them
    std::vector<StepPicture> step_pictures;
    bool steps_listed = false;          ///< in the last frame
    std::optional<float> playing;       ///< the unfolding, at this position
    std::optional<ImVec2> diagram_from; ///< where a click or drag in the strain diagram began

    // what would lose unsaved work: asked about, and the answer "go on" for the next action
    std::optional<Action> held;
    bool confirmed = false;
    std::optional<Action> after_save; ///< waits for the name of the project
    std::optional<LeftWork> left_work;

    // the sample part that a start without a file opens
    bool sample = false, sample_exported = false;
    std::string first_steps_shown;
    double first_steps_since = 0; ///< seconds of ImGui's clock

    std::vector<std::filesystem::path> recent;
};

/// A picture of a file as ImGui shows it.
struct PictureOnScreen {
    ImTextureID texture = {};  ///< null: there is none
    int width = 0, height = 0; ///< pixels of the file
};

/// The picture of a view.
struct DrawnView {
    ImTextureID texture;
    bool old = false; ///< it shows another scene yet, say the field before: nothing may be read
                      ///< from it
};

/// Everything a panel may look at and act through.
struct Frame {
    const ViewerModel& model;
    ViewEvents events;
    Pickers& pickers;
    const ViewerState& state;
    ActionQueue& actions;
    Ui& ui;
    SceneCache& cache;
    /// Draws a view of this size (pixels), or leaves it for a later frame.
    std::function<DrawnView(const Scene& scene, View view, int width, int height)> draw;
    /// A picture beside the four views; null where it comes a frame later.
    std::function<ImTextureID(const Scene& scene, const Camera& camera, int width, int height)> draw_small;
    /// The same for the small picture of a step; null where it comes a frame later.
    std::function<ImTextureID(const StepPicture& picture, size_t step, int width, int height)> draw_step;
    bool drawing = false; ///< some view had to wait for this frame
    /// A picture (PNG) of the manual.
    std::function<PictureOnScreen(const std::filesystem::path& file)> picture = {};

    LengthUnit lengths() const { return state.preferences.lengths; } ///< of the screen
};

void menu_bar(Frame& frame);
void steps_panel(Frame& frame);
/// Drawbeads, pilots, the held edge, the rolling direction.
void process_section(Frame& frame);
/// Makes a drawbead, a pilot or a seam of the line that was drawn.
void end_line(Frame& frame);
void regions_section(Frame& frame);
/// Makes a region of the picked faces; a tool presses at once, and is asked what with. The name may
/// be empty.
void make_region(Frame& frame, const std::string& called, RegionKind kind);
/// Unfolding step by step.
void unfolding_section(Frame& frame);
/// Notes where the last item is, so that a test finds it with the mouse.
void note_place(Frame& frame, const std::string& name);
/// What the mesh doctor found, where, and what can be done about it.
void doctor_panel(Frame& frame);
/// A file that was refused while a part was open, with the way to its faults and back.
void refused_notice(Frame& frame);
/// Residual of the running job over its steps, logarithmic; nothing before there are two.
void residual_plot(Frame& frame);
float residual_plot_height(const Frame& frame); ///< pixels
void inspect_panel(Frame& frame);
void view_area(Frame& frame);
void tool_bar(Frame& frame);
float tool_bar_height(const Frame& frame, float width); ///< pixels; narrow windows need two rows
/// The clipping plane, while there is one: a row above the views.
void clip_bar(Frame& frame);
float clip_bar_height(const Frame& frame); ///< pixels; 0: there is none
/// Turns clipping on, through the middle of the part, or off.
void toggle_clip(Frame& frame);
void dialogs(Frame& frame);
/// The result beside the reference that was kept.
void comparison_section(Frame& frame);
/// The newest messages below the views, which end where they begin; what only confirms goes by
/// itself.
struct MessageStrip {
    std::vector<Message> shown; ///< the newest first
    size_t more = 0;            ///< that have no room
    bool cut = false;           ///< nor has the end of the newest
    float height = 0;           ///< pixels; 0: there are none
};
MessageStrip message_strip(Frame& frame, float width);
void draw_messages(Frame& frame, const MessageStrip& strip);
/// All that was said, if asked for.
void messages_window(Frame& frame);
/// Version, licence and libraries.
void about_dialog(Frame& frame);
/// Keyboard shortcuts, unless a text is being typed.
void shortcuts(Frame& frame);

/// The whole window.
void workbench(Frame& frame);

} // namespace spia::viewer
