#pragma once
#include <functional>
#include <limits>

#include "app/viewer/model/jobs/viewer_model.h"
#include "engine/core/error.h"

namespace spia::viewer {

/// Names of the changes that are nothing but runs.
inline constexpr const char* run_names[] = {"Unfold", "Update all"};

/// A running job is in the way of an action.
struct Busy : InputError {
    using InputError::InputError;
};

/// One call per kind of action. What throws is told to the user by apply().
struct ViewerModel::Apply {
    ViewerModel& model;
    ViewerState& state = model.state_;
    Document& document = state.document;
    Session& session = document.session;

    /// Before every change that undo brings back. @throws InputError while another file is being
    /// read, which takes the place of what would be changed
    void change(std::string name, bool merge = false);
    /// Runs what a change of options has just asked for: cancelled before it has brought anything,
    /// the change is taken back, so that options and results agree.
    /// @param unsaved  whether there was unsaved work before the change
    void run_of_change(Stage to, const std::string& title, bool unsaved);
    const PartFile& part() const
    {
        if (!session.part)
            throw InputError(
                state.refused
                    ? "The part was refused: choose what to read of it or repair its faults in the step Part first."
                    : "Open a part first.");
        return *session.part;
    }

    // --- the chain
    /// Ends what runs, whatever it is about.
    void end_runs();
    /// Begins to read another part. One that is open stays until that is there.
    void begin_with(Opening opening);
    void require_no_export() const;
    void operator()(const ListFile& action);
    void operator()(const CloseList&);
    void operator()(const OpenPart& action);
    /// By itself, whatever project waits for its part. @param note  see Opening
    void open_part(const OpenPart& action, std::string note = {});
    /// Reads the part anew with other options, and runs the chain from there up to a stage; undo
    /// brings the old ones back.
    template <class Edit> void read_again(std::string name, const Edit& edit, Stage to = Stage::read);
    void operator()(const SetUnit& action);
    void operator()(const SetReading& action);
    void operator()(const ReadAgain& action);
    void operator()(const SetSeam& action);
    void operator()(const SetRemeshing& action);
    void operator()(const RunTo& action);
    void operator()(const CancelJob&);
    void operator()(const SetMaterial& action);
    void operator()(const FitMaterial& action);
    void operator()(const SaveMaterial& action);
    void operator()(const RemoveMaterial& action);
    void operator()(const SetThickness& action);
    void operator()(const SetSkins& action);
    void operator()(const SetDirection& action);
    void operator()(const SetKFactor& action);
    /// Numbers in the file, chosen or proposed.
    std::array<int, 4> corners_now() const;
    void take_one_patch();          ///< in the place of the program's choice
    void require_one_patch() const; ///< @throws InputError if there are patches
    void operator()(const SetCorner& action);
    void operator()(const ProposeCorners&);
    void operator()(const SetGrid& action);
    void operator()(const SetFit& action);
    void change_patches(std::string name, std::optional<LayoutOptions> patches, bool best = false);
    void operator()(const SetPatches& action) { change_patches("Change the patches", action.patches, action.best); }
    void operator()(const AddCut&);
    void operator()(const RemoveCut& action);
    void operator()(const SetLimits& action);

    // --- the shape of the surface
    void deform(std::string name, std::optional<Deformation> deformation, bool dragging = false);
    std::vector<int>& picked_handles(HandleKind kind);
    void pick_handles(HandleKind kind, std::vector<int> handles, PickMode mode);
    void operator()(const SetLattice& action);
    void operator()(const PickHandle& action);
    void operator()(const SelectHandles& action);
    void operator()(const MoveHandles& action);
    void operator()(const ResetHandles& action);
    void operator()(const OpenDeformation& action);
    void operator()(const SaveDeformation& action);

    // --- unfolding step by step
    void require_idle() const;
    size_t step(int number) const;
    void change_steps(std::string name, StepList steps, bool merge = false);
    void operator()(const ProposeSteps& action);
    void operator()(const RunSteps&);
    void operator()(const UseBlankOfSteps& action);
    void operator()(const OpenSteps& action);
    void operator()(const SaveSteps& action);
    void operator()(const AddStep& action);
    void operator()(const ChangeStep& action);
    /// Faces of a region, or the selected ones.
    const std::vector<int>& faces_or_selected(std::optional<int> number, const char* what_for) const;
    /// A step that lays faces on a target. @throws InputError if it does not
    const PlannedStep& laying_step(int number) const;
    void replace_step(std::string name, size_t number, PlannedStep changed, bool merge = false);
    /// The plane through faces as they lie before a step; says how well it goes through them.
    TargetPlane plane_before(size_t step, const std::vector<int>& faces);
    void operator()(const SetTargetPlane& action);
    void operator()(const SetCarrying& action);
    void operator()(const RemoveStep& action);
    void operator()(const MoveStep& action);
    void operator()(const ShowStep& action);

    // --- picking
    void select(std::vector<int> faces, PickMode mode, const char* name);
    void operator()(const SelectFaces& action) { select(action.faces, action.mode, "Select faces"); }
    /// What a picking tool needs of the view it is used in.
    const RayPicker& picker(View view);
    const Camera& camera(View view) const { return state.view.camera[size_t(view)]; }
    std::optional<HalfSpace> kept(View view) const { return kept_in(state.view, view); }
    void operator()(const PickAt& action);
    void operator()(const PickArea& action);
    void operator()(const PickBrush& action);
    void operator()(const GrowSelection&);
    void operator()(const ShrinkSelection&);
    void operator()(const InvertSelection&);
    void operator()(const ClearSelection&);
    void select_vertices(std::vector<int> vertices, PickMode mode, const char* name);
    /// @param vertices ascending
    void require_vertices(const std::vector<int>& vertices) const;
    void operator()(const SelectVertices& action) { select_vertices(action.vertices, action.mode, "Select vertices"); }
    void operator()(const PickVertex& action);
    void operator()(const UseVerticesAsCorners&);

    size_t region(int number) const;
    /// @throws InputError if nothing would be left to be unfolded
    void require_some_free(RegionKind kind, const std::vector<int>& faces) const;
    void operator()(const MakeRegion& action);
    void operator()(const ChangeRegion& action);
    void operator()(const RemoveRegion& action);
    void operator()(const SelectRegion& action);
    /// Changes what the process is made of, and with it the solver's conditions; all or nothing.
    /// @param edit  gets a copy of the document
    template <class Edit> void change_process(std::string name, bool merge, const Edit& edit);
    /// The same for the grade of the part or of a region.
    void change_material(std::string name, const std::function<void(Document&)>& edit);
    size_t line(int number) const;
    void operator()(const SetContact& action);
    void operator()(const SetOwnSheet& action);
    void operator()(const AddLine& action);
    void operator()(const ChangeLine& action);
    void operator()(const RemoveLine& action);
    void operator()(const PinVertices&);
    void operator()(const SetProcess& action);
    void operator()(const AddProbe& action);
    void operator()(const RemoveProbe& action);
    void operator()(const ClearProbes&);

    void operator()(const DrawSection& action);
    void operator()(const ClearSection&);
    void operator()(const AddMeasurement& action);
    void operator()(const RemoveMeasurement& action);
    void operator()(const ClearMeasurements&);

    // --- looking
    void operator()(const SetDisplay& action);
    void operator()(const SetViewSettings& action);
    void operator()(const SetPreferences& action);
    /// What the preferences have chosen, where no file of a part says otherwise.
    void begin_as_preferred(Document& fresh) const;
    void operator()(const FitView& action) { model.fitter_.fit(state, action.view); }
    void operator()(const LookFrom& action);
    void operator()(const LookFromSide& action);
    void operator()(const FlyTo& action);
    void operator()(const HideSpot&);
    /// @param before  of a place that the views went to
    /// @param since   there; a view that was moved on stays
    std::array<Camera, 4> left_at(const WayBack* way) const;
    void go_back(const WayBack& way);
    void operator()(const FlyToVertex& action);
    /// Every view shows the middle of some vertices of the part.
    /// @param at_least  mm, what the views show
    /// @param usual  mm, of the height of the views, if a share of the part is not less
    void look_at(const std::vector<int>& vertices, double at_least = 0,
                 double usual = std::numeric_limits<double>::infinity());
    void operator()(const ShowFault& action);
    void operator()(const HideFault&);
    void operator()(const ShowRefused&);
    void operator()(const CloseRefused&);
    void operator()(const KeepReference& action);
    void operator()(const DropReference&) { state.reference = nullptr; }

    // --- the document and files
    void operator()(const Undo&) { go(&History::undo); }
    void operator()(const Redo&) { go(&History::redo); }
    void go(void (History::*way)(Document&));
    void operator()(const OpenProject& action);
    void operator()(const TakeOpened& action);
    void operator()(const DropOpened&);
    void operator()(const SaveProject& action);
    void operator()(const ExportFiles& action);
    void operator()(const DismissMessages&);
    void operator()(const Screenshot&) {}
    void operator()(const WriteReport&) {}
    void operator()(const SaveAnimation&) {}
    void operator()(const Quit&) {}
};

} // namespace spia::viewer
