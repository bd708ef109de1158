#include "engine/exchange/deck/dyna_node_moves.h"

#include <algorithm>
#include <fmt/core.h>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "engine/core/read_number.h"
#include "engine/exchange/deck/abaqus_keyword.h"

namespace spia {

bool DynaNodeMoves::begin_set(const DynaKeyword& keyword)
{
    if (!keyword.is("SET_NODE"))
        return false;
    std::string_view kind = std::string_view(keyword.name).substr(8);
    for (const std::string_view plain : {"_TITLE", "_COLLECT", "_TITLE", "_LIST"})
        if (kind.ends_with(plain))
            kind.remove_suffix(plain.size());
    if (kind.starts_with("_LIST_"))
        kind.remove_prefix(5);
    form_ = kind.empty()                    ? Form::list
            : kind == "_GENERATE"           ? Form::generate
            : kind == "_GENERATE_INCREMENT" ? Form::increment
            : kind == "_ADD"                ? Form::add
            : kind == "_GENERAL"            ? Form::general
                                            : Form::unread;
    title_next_ = keyword.has("TITLE");
    set_ = nullptr;
    return true;
}

void DynaNodeMoves::set_card(std::string_view line)
{
    if (std::exchange(title_next_, false))
        return;
    values_.cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
    if (!set_) {
        set_ = &sets_[values_.id(0, &DynaPlacement::set)];
        set_->unread = set_->unread || form_ == Form::unread;
        return;
    }
    if (form_ == Form::general)
        return general(*set_);
    constexpr size_t fields = 8;
    const auto node = [&](size_t k) { return values_.id(k, &DynaPlacement::node); };
    for (size_t k = 0; k < fields; ++k) {
        if (form_ == Form::list && node(k) != 0)
            set_->in.push_back({node(k), node(k), 1});
        else if (form_ == Form::add && values_.id(k, &DynaPlacement::set) != 0)
            set_->sets.push_back(values_.id(k, &DynaPlacement::set));
        else if (form_ == Form::generate && k % 2 == 0 && node(k) != 0)
            set_->in.push_back({node(k), node(k + 1), 1});
    }
    if (form_ != Form::increment)
        return;
    const std::int64_t step = values_.whole_or_zero(2);
    if (step < 0)
        values_.lines().fail(fmt::format("the increment is {}; it must be above 0", step));
    set_->in.push_back({node(0), node(1), std::max<std::int64_t>(step, 1)});
}

void DynaNodeMoves::general(Set& set)
{
    const std::string option = upper_case(values_.fields()[0]);
    constexpr size_t fields = 8;
    if (option.empty())
        return;
    if (option == "ALL") {
        set.all = true;
        return;
    }
    const bool nodes = option == "NODE" || option == "DNODE", parts = option == "PART" || option == "DPART";
    set.unread = set.unread || !(nodes || parts);
    const bool out = option.front() == 'D';
    for (size_t k = 1; k < fields && (nodes || parts); ++k) {
        const std::int64_t id = values_.id(k, nodes ? &DynaPlacement::node : &DynaPlacement::part);
        if (id == 0)
            continue;
        if (nodes)
            (out ? set.out : set.in).push_back({id, id, 1});
        else
            (out ? set.parts_out : set.parts_in).push_back(id);
    }
}

/// The number of the transformation, that of the set, and whether it is moved at once or when the
/// deck is read.
void DynaNodeMoves::move_card(std::string_view line)
{
    if (trimmed(line).empty())
        return;
    values_.cut(line, {10, 10, 10});
    const Move move = {values_.whole(0), values_.id(1, &DynaPlacement::set), values_.lines().place()};
    if (!values_.placement.place.isApprox(Eigen::Affine3d::Identity(), 0))
        deck_.count_unread_geometry("*NODE_TRANSFORM in a file that is moved itself");
    else if (values_.whole_or_zero(2) != 0)
        make(move);
    else
        moves_.push_back(move);
}

void DynaNodeMoves::apply()
{
    for (const Move& move : moves_) {
        values_.lines().speak_of(move.place);
        make(move);
    }
    values_.lines().speak_of({});
}

void DynaNodeMoves::spend(std::uint64_t nodes)
{
    constexpr std::uint64_t most = 1'000'000'000; // about ten seconds
    work_ += nodes;
    if (work_ > most)
        values_.lines().fail("*NODE_TRANSFORM: the sets of this deck name too many nodes too often");
}

void DynaNodeMoves::make(const Move& move)
{
    const auto ids = deck_.scope_node_ids();
    constexpr std::uint64_t passes = 20; // sorting them
    spend(passes * ids.size());
    std::vector<std::int64_t> there(ids.begin(), ids.end());
    std::sort(there.begin(), there.end());
    there.erase(std::unique(there.begin(), there.end()), there.end());
    const auto nodes = nodes_of(move.set, there);
    const auto transform = transforms_.find(move.transform);
    if (nodes && transform)
        deck_.move_nodes(*nodes, *transform);
    else
        deck_.doubt(fmt::format(
            "line {}: *NODE_TRANSFORM is not read: the {} is not there or not read", move.place.line,
            nodes ? fmt::format("*DEFINE_TRANSFORMATION {}", move.transform) : fmt::format("*SET_NODE {}", move.set)));
}

/// Those of these ranges and parts that are there.
std::vector<std::int64_t> DynaNodeMoves::among(const std::vector<Range>& ranges, const std::vector<std::int64_t>& parts,
                                               const std::vector<std::int64_t>& there)
{
    std::vector<std::int64_t> nodes;
    for (const Range& range : ranges) {
        spend(1);
        for (auto each = std::lower_bound(there.begin(), there.end(), range.first);
             each != there.end() && *each <= range.last; ++each) {
            spend(1);
            if ((std::uint64_t(*each) - std::uint64_t(range.first)) % std::uint64_t(range.step) == 0)
                nodes.push_back(*each);
        }
    }
    for (const std::int64_t part : parts) {
        spend(deck_.shells());
        const auto of_part = deck_.nodes_of(deck_.part(part));
        nodes.insert(nodes.end(), of_part.begin(), of_part.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

/// Sorted. Nothing if the set, or one that it holds, is not known.
std::optional<std::vector<std::int64_t>> DynaNodeMoves::nodes_of(std::int64_t set,
                                                                 const std::vector<std::int64_t>& there)
{
    std::vector<std::int64_t> nodes, open = {set};
    std::set<std::int64_t> seen = {set};
    while (!open.empty()) {
        const auto found = sets_.find(open.back());
        open.pop_back();
        if (found == sets_.end() || found->second.unread)
            return std::nullopt;
        const Set& each = found->second;
        const std::vector<std::int64_t> in = each.all ? there : among(each.in, each.parts_in, there);
        const std::vector<std::int64_t> out = among(each.out, each.parts_out, there);
        spend(in.size());
        std::set_difference(in.begin(), in.end(), out.begin(), out.end(), std::back_inserter(nodes));
        for (const std::int64_t other : each.sets)
            if (seen.insert(other).second)
                open.push_back(other);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

} // namespace spia
