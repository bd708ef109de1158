#include "engine/exchange/atomic_file.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/core.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "engine/core/error.h"

namespace fs = std::filesystem;

namespace spia {
namespace {

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
    if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) // a rename would replace the device
        throw ExchangeError(
            fmt::format("cannot write {}: it is not a regular file; choose another name", path.string()));
    return target;
}

} // namespace

void require_writable(const fs::path& path) { TemporaryFile{target_of(path)}; }

void write_atomically(const fs::path& path, std::string_view content)
{
    TemporaryFile file(target_of(path));
    file.write(content);
    file.take_target_name();
}

} // namespace spia
