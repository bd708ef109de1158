#pragma once
#include <atomic>
#include <memory>
#include <string>

#include "engine/core/progress.h"

namespace spia::cli {

/// Set by Ctrl-C (SIGINT) and SIGTERM: running jobs end with Cancelled at their next checkpoint. A second Ctrl-C ends the
/// program at once.
std::shared_ptr<const std::atomic<bool>> cancelled_by_user();

/// Shows a job on the standard error: a bar that redraws itself on a terminal, a line per job otherwise.
class JobDisplay {
public:
    explicit JobDisplay(std::string title);
    ~JobDisplay(); ///< clears the bar

    Progress progress() const;
    void done(double seconds); ///< leaves a line with the time

private:
    std::string title_;
    bool finished_ = false;
};

} // namespace spia::cli
