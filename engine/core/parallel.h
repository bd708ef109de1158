#pragma once
#include <algorithm>
#include <oneapi/tbb/parallel_for.h>
#include <string_view>
#include <vector>

#include "engine/core/progress.h"

namespace spia {

/// Runs body(i) for 0 <= i < count on the available threads. Each call writes only its own results,
/// and sums are taken afterwards in a fixed order: the same input gives the same bits on any number
/// of threads.
template <class Body> void parallel_for(int count, const Body& body)
{
    constexpr int grain = 512; // below this, starting a task costs more than the loop
    tbb::parallel_for(tbb::blocked_range<int>(0, count, grain), [&](const tbb::blocked_range<int>& range) {
        for (int i = range.begin(); i < range.end(); ++i)
            body(i);
    });
}

/// The same in parts, with a checkpoint before each.
/// @param step  what is being done, e.g. "measuring"
template <class Body>
void for_each_in_parts(int count, const Progress& progress, std::string_view step, const Body& body)
{
    constexpr int at_a_time = 32768; // bodies of 10 us take 0.2 s then
    for (int from = 0; from < count; from += std::min(at_a_time, count - from)) {
        progress.checkpoint(double(from) / count, step);
        parallel_for(std::min(at_a_time, count - from), [&](int i) { body(from + i); });
    }
}

/// Computes compute(i, slot) on the available threads and hands each slot to take(i, slot) in the
/// order of i: a sum over elements without an array of all their contributions, and with the same
/// bits on any number of threads.
template <class Slot, class Compute, class Take>
void parallel_in_order(int count, const Compute& compute, const Take& take)
{
    constexpr int chunk = 4096; // a slot of a kilobyte still fits the cache
    std::vector<Slot> slot(size_t(std::min(count, chunk)));
    for (int first = 0; first < count; first += chunk) {
        const int size = std::min(chunk, count - first);
        parallel_for(size, [&](int i) { compute(first + i, slot[size_t(i)]); });
        for (int i = 0; i < size; ++i)
            take(first + i, slot[size_t(i)]);
    }
}

} // namespace spia
