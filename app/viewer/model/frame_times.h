#pragma once
#include <vector>

#include "engine/core/json_file.h"

namespace spia::viewer {

/// How long the window was busy with each frame.
struct FrameTimes {
    std::vector<double> all, solving; ///< ms; `solving`: of those while a job was running

    /// `frames`: how many; `p50_ms`, `p99_ms`, `max_ms` if there are any.
    static Json figures(std::vector<double> times);
};

} // namespace spia::viewer
