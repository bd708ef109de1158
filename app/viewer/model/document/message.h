#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace spia {
struct PartFile;
}

namespace spia::viewer {

struct ViewerState;

enum class Severity { hint, done, warning, error };

/// What a message speaks of. The message is shown as long as that is so, and comes back where redo
/// brings it back.
struct Subject {
    enum class Kind {
        none,    ///< nothing that could change: it stays until it is dismissed
        results, ///< objects that the document has, see results_of(); gone once one of them is
                 ///< another
        steps,   ///< likewise, the last run of the steps
        refused, ///< likewise, the part that was refused
        change,  ///< a change of the document: gone once that is undone
        refusal, ///< an action that was refused, or had nothing to do: gone with the next change,
                 ///< whichever
        busy     ///< an action that a running job was in the way of: gone with the job
    };
    Kind kind = Kind::none;
    std::vector<std::weak_ptr<const void>> object = {};
    int change = 0; ///< History::now()
};

/// The part alone, or with all that was made of it.
Subject about_part(const ViewerState& state);
Subject about_results(const ViewerState& state);
Subject about_steps(const ViewerState& state);
Subject about_refused_part(const ViewerState& state);
/// The change that made the document what it is now.
Subject about_change(const ViewerState& state);
Subject about_refusal(const ViewerState& state);
Subject about_job();
bool holds(const Subject& subject, const ViewerState& state);
bool same(const Subject& a, const Subject& b);

/// What the program says to the user, the newest last.
struct Message {
    Severity severity;
    std::string text;
    int number = 0;         ///< counts all that was ever said
    bool dismissed = false; ///< read; kept for the list of messages
    Subject subject = {};
    bool gone = false; ///< what it speaks of is so no longer

    bool shown() const { return !dismissed && !gone; }
};

/// What a run said that failed goes before the next one.
void dismiss_failed_run(std::vector<Message>& messages);

/// Before a run those go that are neither wrong nor about results, which go with what they are
/// about; so do errors of the run before.
void dismiss_before_run(std::vector<Message>& messages);

/// What was noted on reading a part: what was done for the user, what is said of the file.
/// Sentences. Those that make the light of the step amber are said there.
std::vector<std::string> notes_on_reading(const PartFile& part);

} // namespace spia::viewer
