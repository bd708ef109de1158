#include "engine/core/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <fmt/core.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "engine/core/error.h"

namespace fs = std::filesystem;

namespace spia {
namespace {

thread_local WritingJob* job = nullptr; // a dozen writers and the libraries in them would have to
                                        // hand it on

std::string advice(int error)
{
    switch (error) {
    case ENOENT:
    case ENOTDIR: return "create the folder or choose another one";
    case EACCES:
    case EPERM:
    case EROFS: return "choose a folder in which you may write";
    case ENOSPC:
    case EDQUOT:
    case EFBIG: return "free some space or choose another disk";
    case EISDIR: return "give the name of a file";
    case ENAMETOOLONG: return "choose a shorter name";
    default: return "choose another place";
    }
}

[[noreturn]] void fail(const fs::path& path, int error)
{
    throw ExchangeError(
        fmt::format("cannot write {}: {}; {}", path.string(), std::generic_category().message(error), advice(error)));
}

/// A new file beside the target; it vanishes unless it is renamed.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target) : target_(target)
    {
        for (int attempt = 0; attempt < 100; ++attempt) {
            path_ = target.parent_path() /
                    fmt::format(".{}.{}-{}.tmp", target.filename().string().substr(0, 200), ::getpid(), attempt);
            descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (descriptor_ >= 0 || errno != EEXIST)
                break;
        }
        if (descriptor_ < 0)
            fail(target_, errno);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile()
    {
        if (descriptor_ >= 0)
            ::close(descriptor_);
        if (!path_.empty())
            ::unlink(path_.c_str());
    }

    void write(std::string_view content)
    {
        while (!content.empty()) {
            const ssize_t written = ::write(descriptor_, content.data(), content.size());
            if (written < 0 && errno == EINTR)
                continue;
            if (written < 0)
                fail(target_, errno);
            content.remove_prefix(size_t(written));
        }
    }

    void take_target_name()
    {
        struct stat old;
        if (::stat(target_.c_str(), &old) == 0 && ::fchmod(descriptor_, old.st_mode & 07777) != 0)
            fail(target_, errno);
        if (::fsync(descriptor_) != 0)
            fail(target_, errno);
        // Some network file systems report a full disk only here.
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0 || ::rename(path_.c_str(), target_.c_str()) != 0)
            fail(target_, errno);
        path_.clear();
    }

private:
    fs::path target_, path_;
    int descriptor_ = -1;
};

/// The file that a path stands for: links are followed.
fs::path target_of(const fs::path& path)
{
    std::error_code ignored;
    const fs::path target = fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
    if (target.filename().empty() || fs::is_directory(target, ignored))
        fail(path, EISDIR);
    // a rename would replace the device
    if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored))
        throw ExchangeError(
            fmt::format("cannot write {}: it is not a regular file; choose another name", path.string()));
    return target;
}

} // namespace

WritingJob::WritingJob(Progress progress, size_t files, Written written)
    : progress_(std::move(progress)), files_(files), written_(std::move(written)), outer_(std::exchange(job, this))
{
}

WritingJob::~WritingJob() { job = outer_; }

void WritingJob::checkpoint(const fs::path& path, double share) const
{
    progress_.checkpoint((double(done_) + share) / double(std::max(files_, done_ + 1)),
                         "writing " + path.filename().string());
}

void require_writable(const fs::path& path) { TemporaryFile{target_of(path)}; }

void write_atomically(const fs::path& path, std::string_view content)
{
    const auto checkpoint = [&](double share) {
        if (job)
            job->checkpoint(path, share);
    };
    constexpr size_t at_a_time = 4 << 20; // bytes: some milliseconds
    checkpoint(0.5);
    TemporaryFile file(target_of(path));
    for (size_t from = 0; from < content.size(); from += at_a_time) {
        file.write(content.substr(from, at_a_time));
        checkpoint(0.5 + 0.5 * double(std::min(from + at_a_time, content.size())) / double(content.size()));
    }
    checkpoint(1);
    file.take_target_name();
    if (!job)
        return;
    ++job->done_;
    if (job->written_)
        job->written_(path);
}

} // namespace spia
