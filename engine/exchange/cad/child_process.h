#pragma once
#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "engine/core/progress.h"

namespace spia {

/// What the work in a child process can say to the log of its owner.
using ChildLog = std::function<void(std::string_view)>;

/// When a child is given up.
struct ChildLimits {
    std::chrono::seconds busy{600}; ///< of computing
    std::chrono::seconds idle{120}; ///< without any: it waits for what never comes
};

/// Does work in a copy of this process and gives the bytes that it returned. For libraries that
/// crash or hang on damaged files: nothing here is touched by that, and the job can be cancelled at
/// any time. Only the calling thread exists in the copy: the work must take no lock that another
/// thread may hold, start no threads and write no files. What it prints is lost; `log` gets here
/// what it gives its ChildLog there. It does not outlive the thread that called.
/// @throws InputError as the work throws, or if it crashed, needed more than 16 GiB or more time
/// than the limits
std::string in_child(const std::function<std::string(const Progress&, const ChildLog&)>& work, const ChildLog& log,
                     const Progress& progress, const ChildLimits& limits = {});

} // namespace spia
