#pragma once
#include <algorithm>
#include <vector>

namespace spia {

/// Sorts part by part, then merges: what takes a second for millions can be cancelled meanwhile.
/// @param less   so that no two are equal: then the order is that of std::sort()
/// @param pause  called between the parts
template <class T, class Less, class Pause>
void sort_in_parts(std::vector<T>& items, const Less& less, const Pause& pause)
{
    constexpr size_t part = 1 << 17; // some 20 ms
    const auto at = [&](size_t k) { return items.begin() + std::ptrdiff_t(std::min(k, items.size())); };
    for (size_t from = 0; from < items.size(); from += part) {
        pause();
        std::sort(at(from), at(from + part), less);
    }
    for (size_t sorted = part; sorted < items.size(); sorted *= 2)
        for (size_t from = 0; from + sorted < items.size(); from += 2 * sorted) {
            pause();
            std::inplace_merge(at(from), at(from + sorted), at(from + 2 * sorted), less);
        }
}

} // namespace spia
