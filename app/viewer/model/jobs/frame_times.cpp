#include "app/viewer/model/jobs/frame_times.h"

#include <algorithm>

namespace spia::viewer {

Json FrameTimes::figures(std::vector<double> times)
{
    if (times.empty())
        return {{"frames", 0}};
    std::sort(times.begin(), times.end());
    const auto at = [&](double share) {
        return times[std::min(times.size() - 1, size_t(share * double(times.size())))];
    };
    return {{"frames", times.size()}, {"p50_ms", at(0.5)}, {"p99_ms", at(0.99)}, {"max_ms", times.back()}};
}

} // namespace spia::viewer
