#include "engine/exchange/deck/node_sets.h"

#include <algorithm>
#include <fmt/core.h>

#include "engine/exchange/deck/abaqus_keyword.h"

namespace spia {

void NodeSets::open(std::string_view name, bool unsorted)
{
    const auto [found, is_new] = set_.try_emplace(upper_case(name));
    open_ = &found->second;
    if (is_new)
        open_->unsorted = unsorted;
}

void NodeSets::add(std::int64_t first, std::int64_t last, std::int64_t step)
{
    std::vector<Range>& ranges = open_->ranges;
    const bool follows = first == last && !ranges.empty() && ranges.back().step == 1 && ranges.back().last < first &&
                         std::uint64_t(first) - std::uint64_t(ranges.back().last) == 1;
    if (follows) // nodes of a block mostly follow each other
        ranges.back().last = first;
    else
        ranges.push_back({first, last, step});
}

void NodeSets::add_set(std::string_view name)
{
    const Set* other = find(name);
    if (!other)
        return spoil();                // Abaqus wants it before
    constexpr size_t most = 5'000'000; // 120 MB; sets that hold others twice double what is in them
    copied_ += other->ranges.size();
    if (copied_ > most)
        lines_.fail(fmt::format("the node set {} and others name too many nodes", name));
    const std::vector<Range> taken = other->ranges; // it may be the open one
    open_->spoiled = open_->spoiled || other->spoiled;
    open_->ranges.insert(open_->ranges.end(), taken.begin(), taken.end());
}

const NodeSets::Set* NodeSets::find(std::string_view name) const
{
    const auto found = set_.find(upper_case(name));
    return found == set_.end() ? nullptr : &found->second;
}

bool NodeSets::has(std::string_view name) const { return find(name) != nullptr; }

bool NodeSets::is_unsorted(std::string_view name) const
{
    const Set* set = find(name);
    return set && set->unsorted;
}

bool NodeSets::is_spoiled(std::string_view name) const
{
    const Set* set = find(name);
    return set && set->spoiled;
}

void NodeSets::spend(std::int64_t& steps, std::uint64_t count, std::string_view name) const
{
    if (count > std::uint64_t(std::max<std::int64_t>(steps, 0)))
        lines_.fail(fmt::format("the node set {} and others name too many nodes", name));
    steps -= std::int64_t(count);
}

NodeSets::Members NodeSets::members(std::string_view name, DeckBuilder& deck, std::int64_t& steps) const
{
    Members members;
    const Set* set = find(name);
    if (!set)
        return members;
    const auto there = deck.scope_node_ids();
    for (const Range& range : set->ranges) {
        if (range.last < range.first)
            continue;
        const std::uint64_t more =
            // than one
            (std::uint64_t(range.last) - std::uint64_t(range.first)) / std::uint64_t(range.step);
        spend(steps, 1 + std::min<std::uint64_t>(more, there.size()), name);
        if (more < there.size()) {
            std::int64_t id = range.first;
            for (std::uint64_t k = 0;; ++k, id += range.step) {
                if (deck.number_of_node(id))
                    members.ids.push_back(id);
                else if (!members.missing)
                    members.missing = id;
                if (k == more)
                    break;
            }
            continue;
        }
        std::vector<std::int64_t> found; // fewer nodes are there than the range has numbers
        for (const std::int64_t id : there)
            if (id >= range.first && id <= range.last &&
                (std::uint64_t(id) - std::uint64_t(range.first)) % std::uint64_t(range.step) == 0)
                found.push_back(id);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        members.missing = members.missing.value_or(range.last);
        members.ids.insert(members.ids.end(), found.begin(), found.end());
    }
    if (!set->unsorted) {
        std::sort(members.ids.begin(), members.ids.end());
        members.ids.erase(std::unique(members.ids.begin(), members.ids.end()), members.ids.end());
    }
    return members;
}

void NodeSets::clear()
{
    set_.clear();
    open_ = nullptr;
    copied_ = 0;
}

} // namespace spia
