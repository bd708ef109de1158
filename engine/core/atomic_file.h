#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

#include "engine/core/progress.h"

namespace spia {

/// Writes the whole file or nothing: the content goes to a new file beside it, reaches the disk,
/// and takes the name in one step. Until then an older file of that name stays as it was; a link is
/// followed and stays a link.
/// @throws ExchangeError with the path, the reason (folder missing, no permission, disk full, ...)
/// and what to do;
///         nothing of the attempt is left behind
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// While it lives, what its thread writes with write_atomically() is part of a job: it reports to
/// the job's progress, and until a file takes its name it can be cancelled, with nothing left of
/// it. For writers, which know of nothing but their file. Of several that live the last one counts.
class WritingJob {
public:
    using Written = std::function<void(const std::filesystem::path&)>;

    /// @param files    as many are written, most likely; each is half done when its content is
    ///         there
    /// @param written  called with each file that is there
    explicit WritingJob(Progress progress, size_t files = 1, Written written = {});
    ~WritingJob();
    WritingJob(const WritingJob&) = delete;
    WritingJob& operator=(const WritingJob&) = delete;

private:
    friend void write_atomically(const std::filesystem::path& path, std::string_view content);
    void checkpoint(const std::filesystem::path& path, double share) const;

    Progress progress_;
    size_t files_, done_ = 0;
    Written written_;
    WritingJob* outer_;
};

/// Whether a file could be written there, found out before the work that fills it. Leaves nothing
/// behind.
/// @throws ExchangeError as write_atomically()
void require_writable(const std::filesystem::path& path);

} // namespace spia
