#include "engine/exchange/deck/element_sets.h"

#include <algorithm>
#include <fmt/core.h>
#include <limits>
#include <set>

#include "engine/core/error.h"
#include "engine/exchange/deck/abaqus_keyword.h"

namespace spia {

ElementSets::Set& ElementSets::at(std::string_view name)
{
    Set& set = set_[upper_case(name)];
    if (set.name.empty())
        set.name = std::string(name);
    return set;
}

bool ElementSets::has(std::string_view name) const { return set_.contains(upper_case(name)); }

void ElementSets::add(std::string_view name, std::int64_t first, std::int64_t last, std::int64_t step)
{
    std::vector<Range>& ranges = at(name).ranges;
    const bool follows = !ranges.empty() && ranges.back().step == 1 && ranges.back().last < first &&
                         std::uint64_t(first) - std::uint64_t(ranges.back().last) == 1;
    if (follows && first == last)
        ranges.back().last = first; // elements of a block mostly follow each other
    else
        ranges.push_back({first, last, step});
}

void ElementSets::add_set(std::string_view name, std::string_view other)
{
    at(name).others.push_back(upper_case(other));
}

std::vector<int> ElementSets::members(std::string_view name, const std::vector<std::pair<std::int64_t, int>>& by_id,
                                      std::int64_t& steps) const
{
    std::vector<int> result;
    std::vector<std::string> open = {upper_case(name)};
    std::set<std::string> seen(open.begin(), open.end());
    const auto work = [&] {
        if (--steps < 0)
            throw InputError(fmt::format("the element set {} and others name too many elements", name));
    };
    while (!open.empty()) {
        const auto found = set_.find(open.back());
        open.pop_back();
        if (found == set_.end())
            continue;
        for (const std::string& other : found->second.others) {
            work();
            if (seen.insert(other).second)
                open.push_back(other);
        }
        for (const Range& range : found->second.ranges) {
            work();
            const auto from = std::pair(range.first, std::numeric_limits<int>::min());
            for (auto each = std::lower_bound(by_id.begin(), by_id.end(), from);
                 each != by_id.end() && each->first <= range.last; ++each) {
                work();
                if (range.step == 1 ||
                    (std::uint64_t(each->first) - std::uint64_t(range.first)) % std::uint64_t(range.step) == 0)
                    result.push_back(each->second);
            }
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

std::vector<std::string> ElementSets::names() const
{
    std::vector<std::string> result;
    for (const auto& [key, set] : set_)
        result.push_back(set.name);
    return result;
}

} // namespace spia
