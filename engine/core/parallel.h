#pragma once
#include <oneapi/tbb/parallel_for.h>

namespace spia {

/// Runs body(i) for 0 <= i < count on the available threads. Each call writes only its own results, and sums
/// are taken afterwards in a fixed order: the same input gives the same bits on any number of threads.
template <class Body> void parallel_for(int count, const Body& body)
{
    constexpr int grain = 512; // below this, starting a task costs more than the loop
    tbb::parallel_for(tbb::blocked_range<int>(0, count, grain), [&](const tbb::blocked_range<int>& range) {
        for (int i = range.begin(); i < range.end(); ++i)
            body(i);
    });
}

} // namespace spia
