#include "app/viewer/model/document/recent_files.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/core.h>
#include <pwd.h>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "app/viewer/model/actions/json_members.h"
#include "app/viewer/model/document/project_file.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

namespace fs = std::filesystem;

namespace spia::viewer {
namespace {

constexpr const char* recent_schema = "spia-recent/1";
constexpr size_t most_recent = 10;
constexpr std::string_view autosave_start = "autosave-";
constexpr const char* lock_ending = ".lock";

fs::path home()
{
    if (const char* folder = std::getenv("HOME"); folder && *folder)
        return folder;
    if (const passwd* user = ::getpwuid(::getuid()); user && user->pw_dir && *user->pw_dir)
        return user->pw_dir;
    throw ExchangeError("there is no home folder for settings; set the environment variable HOME");
}

/// As the XDG Base Directory Specification has it: a relative path does not count.
fs::path base_folder(const char* variable, const char* standard)
{
    if (const char* folder = std::getenv(variable); folder && fs::path(folder).is_absolute())
        return fs::path(folder) / "spia";
    return home() / standard / "spia";
}

void make_folder(const fs::path& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw ExchangeError(
            fmt::format("cannot make the folder {}: {}; check who may write there", folder.string(), error.message()));
}

std::vector<fs::path> listed_files()
{
    std::vector<fs::path> files;
    try {
        const fs::path list = config_folder() / "recent.json";
        const std::string name = list.string();
        const Json json = read_json(list);
        if (json.is_object() && json.value("schema", Json()) == recent_schema && json.contains("files"))
            read(json["files"], files, Place(name));
    } catch (const Error&) {
        files.clear();
    }
    return files;
}

/// A lock of its own, or -1 if another program has it. The file may be new.
int try_lock(const fs::path& file)
{
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        ::close(descriptor);
        return -1;
    }
    return descriptor;
}

fs::path lock_of(const fs::path& autosave) { return fs::path(autosave).replace_extension(lock_ending); }

/// The work first, then its lock: with the lock gone but the work there, it would count as left
/// behind.
void remove_both(fs::path& file, int& lock) noexcept
{
    std::error_code ignored;
    if (!file.empty()) {
        fs::remove(file, ignored);
        fs::remove(lock_of(file), ignored);
    }
    if (lock >= 0)
        ::close(lock);
    file.clear();
    lock = -1;
}

} // namespace

fs::path config_folder() { return base_folder("XDG_CONFIG_HOME", ".config"); }
fs::path state_folder() { return base_folder("XDG_STATE_HOME", ".local/state"); }

std::vector<fs::path> recent_files()
{
    std::vector<fs::path> files = listed_files();
    std::error_code ignored;
    std::erase_if(files, [&](const fs::path& file) { return !fs::is_regular_file(file, ignored); });
    if (files.size() > most_recent)
        files.resize(most_recent);
    return files;
}

void remember_recent(const fs::path& file)
{
    const fs::path whole = fs::weakly_canonical(fs::absolute(file));
    std::vector<fs::path> files = recent_files();
    std::erase(files, whole);
    files.insert(files.begin(), whole);
    if (files.size() > most_recent)
        files.resize(most_recent);
    make_folder(config_folder());
    const fs::path list = config_folder() / "recent.json";
    write_atomically(list, lines_of({{"schema", recent_schema}, {"files", written(files)}}, list.string()));
}

Autosave::~Autosave()
{
    if (lock_ >= 0)
        ::close(lock_);
}

void Autosave::clear() noexcept { remove_both(file_, lock_); }

void Autosave::save(const Document& document, const ViewSettings& view, const fs::path& project)
{
    if (lock_ < 0) {
        const fs::path folder = state_folder();
        make_folder(folder);
        // a number may be that of a crashed program
        for (int attempt = 0; lock_ < 0 && attempt < 1000; ++attempt) {
            file_ = folder / fmt::format("{}{}-{}{}", autosave_start, ::getpid(), attempt, project_ending);
            std::error_code ignored;
            if (!fs::exists(file_, ignored))
                lock_ = try_lock(lock_of(file_));
        }
        if (lock_ < 0) {
            file_.clear();
            throw ExchangeError(
                fmt::format("cannot save the work in {}: {}; check who may write there and whether the disk is full",
                            folder.string(), std::generic_category().message(errno)));
        }
    }
    save_project(file_, document, view, project.empty() ? project : fs::absolute(project));
}

UnfinishedSession::UnfinishedSession(UnfinishedSession&& other) noexcept
    : file_(std::exchange(other.file_, {})), lock_(std::exchange(other.lock_, -1))
{
}

UnfinishedSession& UnfinishedSession::operator=(UnfinishedSession&& other) noexcept
{
    std::swap(file_, other.file_);
    std::swap(lock_, other.lock_);
    return *this;
}

UnfinishedSession::~UnfinishedSession()
{
    if (lock_ >= 0)
        ::close(lock_);
}

fs::file_time_type UnfinishedSession::time() const
{
    std::error_code error;
    const auto time = fs::last_write_time(file_, error);
    return error ? fs::file_time_type::min() : time;
}

std::string UnfinishedSession::name() const
{
    try {
        const Json json = read_json(file_);
        const fs::path project = json.value("recovers", ""),
                       part = json.at("part").at("path").at("file").get<std::string>();
        return (project.empty() ? part : project).filename().string();
    } catch (const std::exception&) { // damaged; opening it will say how
        return {};
    }
}

void UnfinishedSession::discard() noexcept { remove_both(file_, lock_); }

bool is_autosave(const fs::path& file)
{
    std::error_code ignored;
    return file.filename().string().starts_with(autosave_start) &&
           fs::equivalent(fs::absolute(file, ignored).parent_path(), state_folder(), ignored);
}

std::string ago(std::chrono::seconds time)
{
    constexpr std::pair<long, const char*> units[] = {{86400, "day"}, {3600, "hour"}, {60, "minute"}};
    for (const auto& [seconds, unit] : units)
        if (const long count = time.count() / seconds; count > 0)
            return fmt::format("{} {}{} ago", count, unit, count == 1 ? "" : "s");
    return "just now";
}

std::optional<UnfinishedSession> unfinished_session()
{
    std::optional<UnfinishedSession> newest;
    std::error_code error;
    for (fs::directory_iterator entry(state_folder(), error), end; !error && entry != end; entry.increment(error)) {
        const fs::path file = entry->path();
        if (!file.filename().string().starts_with(autosave_start) || file.extension() != project_ending)
            continue;
        const int lock = try_lock(lock_of(file));
        if (lock < 0)
            continue;
        UnfinishedSession found(file, lock);
        std::error_code ignored;
        if (!fs::exists(file, ignored)) // its program ended in between
            found.discard();
        else if (!newest || found.time() > newest->time())
            newest = std::move(found);
    }
    return newest;
}

} // namespace spia::viewer
