#pragma once
#include <vector>

#include "engine/core/json_file.h"

namespace spia::viewer {

/// How long the window was busy with each frame.
struct FrameTimes {
    std::vector<double> all, solving,
        turning; ///< ms; of those while a job was running, while a view followed the mouse

    /// `frames`: how many; `p50_ms`, `p99_ms`, `max_ms` if there are any.
    static Json figures(std::vector<double> times);
};

} // namespace spia::viewer
