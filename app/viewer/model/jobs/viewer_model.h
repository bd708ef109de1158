#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "app/viewer/model/actions/actions.h"
#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/project_file.h"
#include "app/viewer/model/picking/pickers.h"
#include "app/viewer/model/picking/view_fitter.h"
#include "app/viewer/model/reports/lights.h"
#include "engine/core/job.h"
#include "engine/core/mailbox.h"

namespace spia::viewer {

/// The state and all that changes it: actions, the news of jobs, the mouse over a view (hover) and
/// the size of the views. Knows no window, so that tests do all that users do.
class ViewerModel {
public:
    /// @param assets folder with materials/ and parts/
    /// @param wake   called on a job's thread when there is news for poll()
    explicit ViewerModel(
        std::filesystem::path assets, std::function<void()> wake = [] {});
    ~ViewerModel();

    const ViewerState& state() const { return state_; }
    const std::filesystem::path& assets() const { return assets_; }

    /// Carries out one action. What goes wrong becomes a message, never an exception. Screenshot,
    /// SaveAnimation, WriteReport and Quit are the window's.
    void apply(const Action& action);

    /// Takes over the news of the running job; call once per frame. @returns whether anything has
    /// changed
    bool poll();

    /// Says something to the user.
    void say(Severity severity, std::string text, Subject subject = {});
    void say(Message message);

    /// The mouse is free again and no text is being typed: the next change is one of its own for
    /// undo, whatever its name.
    void gesture_ended() { state_.history.close(); }

    /// What a view shows at a pixel: the face there becomes the hovered one, and with a tool for
    /// vertices the vertex that a click would pick.
    /// @param reach pixels
    void hover(View view, glm::dvec2 pixel, glm::dvec2 size, double reach = PickVertex{}.reach);
    void hover_nothing();
    /// The place of the part under the mouse.
    const std::optional<Probe>& under_mouse() const { return under_mouse_; }
    Pickers& pickers() { return pickers_; }
    /// Whether a job is running; closing the window then cancels it.
    bool exporting() const { return bool(export_job_); }
    bool busy() const { return chain_job_ || export_job_ || steps_job_ || list_job_; }
    /// How many times a part or project was begun to be opened: an action for that either counts
    /// here or leaves all as it was.
    int openings() const { return openings_; }
    /// How many times another document took the place of the one before: at once where no part was
    /// open, else when the new part is there.
    int documents() const { return documents_; }
    /// Whether a part or project is being read while the one before is still open.
    bool opening_beside() const { return opening_beside_.has_value(); }
    /// The size of a view on the screen: what "fit" fills. Pixels, and how many of them one of the
    /// design is. A view that has not been moved since it was fitted is so again.
    void resized(View view, glm::dvec2 size, double scale = 1, const Covered& covered = {})
    {
        fitter_.resized(state_, view, size, scale, covered);
    }
    /// While the views are on their way from place to place, each moment of it is no fit.
    void views_glide(bool glide) { fitter_.glides = glide; }
    /// Whether a file that is read waits for TakeOpened or DropOpened where work is not saved; else
    /// it takes the place at once.
    void ask_before_replacing(bool ask) { asks_ = ask; }

private:
    struct Live; ///< what the solver tells while it runs
    struct Apply;
    friend struct Apply;
    /// A part or project to be read.
    struct Opening {
        Document document;
        std::optional<Project> project = {};     ///< null: it is a part
        std::filesystem::path project_file = {}; ///< to be saved to; empty: none
        bool unsaved = false;
        std::optional<OpenPart> otherwise = {}; ///< a project whose part may be this file: how it
                                                ///< is opened if it is not
        std::string note = {};                  ///< said as soon as it is open; empty: nothing
    };

    void start_chain(Stage from, Stage to, std::string title, const Document& document);
    void replace_document(Opening opening);
    void take_result(ChainResult result, const std::string& title);
    bool take_opening(const ChainResult& result);
    void forget_waiting(); ///< the file that is read and waits for the user's word
    bool open_by_itself(const ChainResult& result);
    void report_not_opened(const Opening& opening, const ChainResult& result);
    void run_to(Stage to, const std::string& title);
    void take_chain_result();
    ChainResult leave_chain();
    StepsOutcome leave_steps();
    bool is_superseded() const;
    bool waited_long_for_cancel() const;
    std::vector<std::string> take_over(Document& document, const ChainResult& result) const;
    std::vector<std::string> restore(Document& document, const StoredPicks& picks,
                                     const std::shared_ptr<const ClosestPointSearch>& search) const;
    void keep_before(const ChainResult& result, const LaterResults& quads, const LaterResults& surface);
    bool forget_run_without_result(const ChainResult& result, const Session& before);
    void report_failed(const ChainResult& result);
    void take_export_result();
    void start_steps(std::string title, std::function<StepsOutcome(const Progress&, const StepsSoFar&)> work);
    /// What the chain of a project goes on with when its steps are done.
    struct BlankNext {
        bool polish;
        Stage to;
    };
    void take_blank_of_project(const BlankNext& next);
    void run_missing_steps(); ///< there must be some
    void take_steps_result();
    void follow_list();
    void follow_doubts();    ///< looks anew for what is poor where a result or the sheet is another
    void follow_messages();  ///< those whose subject is no more are gone
    void follow_reference(); ///< makes the differences anew where a result or the reference is
                             ///< another
    void show_step(std::optional<int> step, double position);
    void report_steps_run(const StepsOutcome& outcome);
    void part_opened(const SessionOptions& read_with);
    void project_opened(const std::shared_ptr<const ClosestPointSearch>& search);

    std::filesystem::path assets_;
    std::function<void()> wake_;
    ViewerState state_;
    ViewFitter fitter_;
    std::shared_ptr<Live> live_;
    std::unique_ptr<Job<ChainResult>> chain_job_;
    std::vector<std::unique_ptr<Job<ChainResult>>>
        ending_; ///< cancelled, nobody waits for them; they end by themselves
    using Files = std::vector<std::filesystem::path>;
    std::unique_ptr<Job<Files>> export_job_;
    /// as ending_; what they had not written they never will
    std::vector<std::unique_ptr<Job<Files>>> ending_exports_;
    std::shared_ptr<Mailbox<Files>> exported_so_far_;
    std::unique_ptr<Job<StepsOutcome>> steps_job_;
    std::shared_ptr<Mailbox<StepsOutcome>> steps_so_far_; ///< as if they had been cancelled then
    std::unique_ptr<Job<ListedFile>> list_job_;
    std::vector<std::unique_ptr<Job<ListedFile>>> ending_lists_; ///< as ending_
    StepList running_list_; ///< the one that it runs, or ran: may have been edited meanwhile
    std::vector<std::unique_ptr<Job<StepsOutcome>>> ending_steps_; ///< as ending_
    /// run them when the running job has ended
    bool steps_next_ = false;
    std::optional<BlankNext> blank_next_;
    bool keep_step_ = false;    ///< the one shown is that of a project
    bool keep_cameras_ = false; ///< those of a project
    bool dragging_ = false;     ///< a corner: the grid is coarse
    /// The running job of the chain.
    struct RunningChain {
        SessionOptions options; ///< that it was begun with
        Stage to = Stage::read;
        bool coarse = false;       ///< for a corner that is dragged
        size_t depth_at_start = 0; ///< of the history, when it began
        size_t depth_noted = 0;    ///< when it began or its options were last seen to change
        bool superseded = false;   ///< it was cancelled for one with newer options
    };
    RunningChain running_;
    /// What a cancel takes back, also of a run that took the place of one with older options.
    struct OnCancel {
        bool undo = false;                  ///< the change of options whose result is being made
        size_t changes = 1;                 ///< that are undone: it, and those made meanwhile
        std::optional<bool> unsaved_before; ///< not given: the run is no change, nothing goes back
    };
    OnCancel on_cancel_;
    std::optional<Stage> next_;                  ///< run this far when the running job has ended
    bool next_in_one_step_ = false;              ///< and not from the blank of the steps
    double progress_from_ = 0, progress_to_ = 1; ///< of what was asked for, that of the running job
    int messages_posted_ = 0;                    ///< messages so far
    DoubtsOf doubts_of_;                         ///< what the doubts of the state were found in
    int openings_ = 0, documents_ = 0;
    std::optional<std::chrono::steady_clock::time_point> cancelled_at_; ///< the running job
    /// the running job reads a new part
    bool opening_ = false;
    /// while the part before is still open
    std::optional<Opening> opening_beside_;
    std::optional<Opening> without_part_; ///< a project whose part is not where it was: the next
                                          ///< one that is opened may be it
    std::optional<ChainResult> waiting_;  ///< what was read for it, while the user is asked
    bool asks_ = false;                   ///< see ask_before_replacing()
    std::optional<Project> project_;      ///< waits for its part
    Pickers pickers_;
    std::optional<Probe> under_mouse_;
};

} // namespace spia::viewer
