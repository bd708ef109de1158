#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/document/state.h"

/// What the program remembers from one start to the next: the files opened last, in
/// config_folder()/recent.json, and the work of a program that ended without saying so, in
/// state_folder().
namespace spia::viewer {

/// $XDG_CONFIG_HOME/spia, by default ~/.config/spia; $XDG_STATE_HOME/spia, by default
/// ~/.local/state/spia. They need not be there.
/// @throws ExchangeError if there is no home folder either
std::filesystem::path config_folder();
std::filesystem::path state_folder();

/// Parts and projects opened last, the newest first, at most ten; files that are gone are left out.
/// A list that cannot be read counts as empty: no reason to stop anybody.
std::vector<std::filesystem::path> recent_files();

/// Puts a file in front. @throws ExchangeError if the list cannot be written
void remember_recent(const std::filesystem::path& file);

/// The work of this program, saved beside what the user saves. The kernel holds a lock for it as
/// long as this lives, however the program ends; only clear() removes the work, not the destructor:
/// that runs after an error, too.
class Autosave {
public:
    Autosave() = default;
    ~Autosave();
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    /// @param project the file that the document came from; empty: none yet
    /// @throws InputError if no part is open; ExchangeError if it cannot be written
    void save(const Document& document, const ViewSettings& view, const std::filesystem::path& project);
    /// A clean end: all is saved, or thrown away on purpose, and there is nothing to recover.
    void clear() noexcept;

private:
    std::filesystem::path file_; ///< empty until the first save
    int lock_ = -1;              ///< descriptor
};

/// Work that a program left behind. While this lives no other program finds it; nothing is removed
/// but by discard().
class UnfinishedSession {
public:
    UnfinishedSession(std::filesystem::path file, int lock) : file_(std::move(file)), lock_(lock) {}
    UnfinishedSession(UnfinishedSession&& other) noexcept;
    UnfinishedSession& operator=(UnfinishedSession&& other) noexcept;
    ~UnfinishedSession();

    /// For open_project(); its `recovers` is the user's own project.
    const std::filesystem::path& file() const { return file_; }
    std::filesystem::file_time_type time() const;
    /// File name of the user's own project, or else of the part; empty if the work cannot be read.
    std::string name() const;
    void discard() noexcept;

private:
    std::filesystem::path file_;
    int lock_;
};

/// Whether a file is such work: not a project of the user's, so it is not to be saved to.
bool is_autosave(const std::filesystem::path& file);

/// "just now", "12 minutes ago", "3 days ago".
std::string ago(std::chrono::seconds time);

/// The newest work that no living program holds, if there is any.
std::optional<UnfinishedSession> unfinished_session();

} // namespace spia::viewer
