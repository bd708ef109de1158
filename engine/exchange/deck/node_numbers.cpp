#include "engine/exchange/deck/node_numbers.h"

#include <algorithm>
#include <numeric>

namespace spia {

NodeNumbers::NodeNumbers(std::span<const std::int64_t> ids, int first)
{
    if (ids.empty())
        return;
    const auto [low, high] = std::minmax_element(ids.begin(), ids.end());
    least_ = *low;
    const std::uint64_t range = std::uint64_t(*high) - std::uint64_t(*low);
    if (range / 4 < ids.size()) {
        table_.assign(size_t(range) + 1, -1);
        for (size_t i = ids.size(); i-- > 0;)
            table_[size_t(ids[i] - least_)] = first + int(i);
        return;
    }
    number_.resize(ids.size());
    std::iota(number_.begin(), number_.end(), 0);
    std::stable_sort(number_.begin(), number_.end(), [&](int a, int b) { return ids[size_t(a)] < ids[size_t(b)]; });
    for (int& i : number_) {
        sorted_.push_back(ids[size_t(i)]);
        i += first;
    }
}

int NodeNumbers::operator[](std::int64_t id) const
{
    if (!table_.empty())
        return id >= least_ && std::uint64_t(id) - std::uint64_t(least_) < table_.size()
                   ? table_[size_t(std::uint64_t(id) - std::uint64_t(least_))]
                   : -1;
    const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), id);
    return found != sorted_.end() && *found == id ? number_[size_t(found - sorted_.begin())] : -1;
}

} // namespace spia
