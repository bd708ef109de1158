#pragma once
#include <fmt/core.h>

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/progress.h"

namespace spia::cli {

/// Set by Ctrl-C (SIGINT) and SIGTERM: running jobs end with Cancelled at their next checkpoint. A
/// second Ctrl-C ends the program at once.
std::shared_ptr<const std::atomic<bool>> cancelled_by_user();

/// A text for the terminal: options are mentioned as they are given there; control characters
/// become \x1b and the like, so that no name in a file moves the cursor, clears the screen or
/// changes the window's title; lines stay lines. Bytes that are no UTF-8 likewise.
std::string shown(std::string_view text);

/// Prints results on the standard output, as shown().
template <class... Argument> void say(fmt::format_string<Argument...> format, Argument&&... arguments)
{
    fmt::print("{}", shown(fmt::format(format, std::forward<Argument>(arguments)...)));
}

/// Shows a job on the standard error: a bar that redraws itself on a terminal, a line per job
/// otherwise.
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
