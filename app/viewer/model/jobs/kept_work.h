#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/viewer/model/document/recent_files.h"
#include "app/viewer/model/jobs/viewer_model.h"
#include "engine/core/worker.h"

namespace spia::viewer {

/// What becomes of work that is not saved in a project: it is kept now and then, and before
/// something else is opened; it is forgotten once it is saved or another part has taken its place,
/// and offered to the user after a crash. Files are written on a thread of their own.
class KeptWork {
public:
    using Clock = std::chrono::steady_clock;

    /// @param wake  called on the writing thread when something is written
    explicit KeptWork(std::function<void()> wake = [] {}) : worker_(std::move(wake)) {}

    /// Work that is out of sight: why, and when it was kept; in words.
    struct Offer {
        std::string text, saved;
    };
    /// Looks for work of a program that ended without saving. @returns whether there is any
    bool look_for_left();
    /// What the user has to be asked about; null: nothing. One of the next three is the answer.
    const Offer* offer() const { return offer_ ? &*offer_ : nullptr; }
    OpenProject recover(); ///< give this to open()
    void discard();        ///< for good; there may be older work, which is offered next
    void later();          ///< at the next start

    /// Applies OpenPart or OpenProject. The work that is open and not saved is kept, for reading a
    /// file may end the program.
    void open(ViewerModel& model, const Action& action);
    /// Once a frame: forgets the work whose place another part has taken; keeps unsaved work once
    /// the hand rests after a change, and every 30 s.
    /// @param now_and_then  whether it does the latter
    void follow(ViewerModel& model, bool now_and_then, Clock::time_point now = Clock::now());
    /// Seconds until follow() has unsaved work to keep.
    double due_in(Clock::time_point now = Clock::now()) const;
    /// Waits until the work is kept. @throws ExchangeError if it cannot be written
    void keep(const ViewerState& state);
    /// The work is saved in a project, or it is thrown away on purpose: nothing of it need be kept.
    void forget();
    /// A clean end: the user was asked about what is not saved.
    void end();

private:
    /// What is being opened and is not there yet.
    struct Coming {
        int documents;                             ///< of the model, before
        bool takes_place;                          ///< of a part that is open
        std::optional<UnfinishedSession> recovers; ///< the kept work that it is, if it is
    };
    Eventually<bool> write(const Document& document, const ViewSettings& view, const std::filesystem::path& project);

    static constexpr std::chrono::seconds interval_{30}, rest_{3};
    Clock::time_point last_ = Clock::now(), changed_ = last_;
    int seen_ = 0, kept_ = 0; ///< states of the document in its history: the newest, and the one
                              ///< that was kept last
    std::shared_ptr<Autosave> autosave_ = std::make_shared<Autosave>(); ///< of what is open
    Eventually<bool> writing_;                                          ///< it
    /// open now, and not yet kept otherwise
    std::optional<UnfinishedSession> recovered_;
    std::optional<UnfinishedSession> recovering_; ///< being opened
    std::optional<UnfinishedSession> offered_;
    std::optional<Offer> offer_;
    std::optional<Coming> coming_;
    Worker worker_; ///< last: it ends first
};

} // namespace spia::viewer
