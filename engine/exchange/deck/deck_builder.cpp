#include "engine/exchange/deck/deck_builder.h"

#include <algorithm>
#include <fmt/core.h>
#include <set>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/exchange/deck/node_numbers.h"
#include "engine/exchange/mesh/checked_file.h"
#include "engine/exchange/text/text_encoding.h"
#include "engine/exchange/text/text_lines.h"
#include "engine/mesh/doctor/doctor.h"

namespace spia {
namespace {

/// "*CONTACT (3), *END"; the first dozen.
std::string listed(const std::map<std::string, int, std::less<>>& counts)
{
    constexpr int most = 12;
    std::string text;
    int shown = 0;
    for (const auto& [name, count] : counts)
        if (shown++ < most)
            text += fmt::format("{}{}{}", shown > 1 ? ", " : "", name.substr(0, 60),
                                count > 1 ? fmt::format(" ({})", count) : "");
    return shown > most ? text + fmt::format(" and {} more", shown - most) : text;
}

/// @throws InputError if a node comes twice, at different places
void require_one_place(std::span<const std::int64_t> id, const Eigen::Vector3d* place, const NodeNumbers& number,
                       int first)
{
    for (size_t i = 0; i < id.size(); ++i)
        if (const int other = number[id[i]] - first; other != int(i) && place[other] != place[i])
            throw InputError(fmt::format("node {} is given twice: at {}, {}, {} and at {}, {}, {}", id[i],
                                         place[other].x(), place[other].y(), place[other].z(), place[i].x(),
                                         place[i].y(), place[i].z()));
}

/// Moves can carry places that were read beyond what a coordinate may be. @throws InputError
void require_usable(std::span<const std::int64_t> id, std::span<const Eigen::Vector3d> place)
{
    for (size_t v = 0; v < id.size(); ++v)
        if (!(place[v].cwiseAbs().maxCoeff() <= largest_coordinate))
            throw InputError(fmt::format("node {} is moved to {}, {}, {}, which are no usable numbers", id[v],
                                         place[v].x(), place[v].y(), place[v].z()));
}

/// Ids beyond what any solver takes would leave no room for those of what is added to the deck.
std::int64_t usable_id(std::int64_t id, const char* what)
{
    constexpr std::int64_t greatest = 1'000'000'000'000'000'000;
    if (id > greatest || id < -greatest)
        throw InputError(fmt::format("the {} id {} is greater than {}", what, id, greatest));
    return id;
}

} // namespace

void DeckBuilder::add_node(std::int64_t id, const Eigen::Vector3d& position)
{
    if (deck_.node.size() >= size_t(most_elements))
        throw InputError(fmt::format("there are more than {} nodes", most_elements));
    deck_.node.push_back(usable_id(id, "node"));
    deck_.position.push_back(position);
}

void DeckBuilder::move_nodes(std::span<const std::int64_t> ids, const Eigen::Affine3d& move)
{
    for (size_t v = 0; v < deck_.node.size(); ++v)
        if (std::binary_search(ids.begin(), ids.end(), deck_.node[v]))
            deck_.position[v] = move * deck_.position[v];
}

void DeckBuilder::move_all_nodes(const Eigen::Affine3d& move)
{
    for (Eigen::Vector3d& x : deck_.position)
        x = move * x;
}

void DeckBuilder::move_range(const DeckRange& range, const Eigen::Affine3d& move)
{
    for (size_t v = range.first_node; v < range.end_node; ++v)
        deck_.position[v] = move * deck_.position[v];
}

std::optional<size_t> DeckBuilder::number_of_node(std::int64_t id)
{
    return node_index_.find(id, nodes(), [&](size_t v) { return deck_.node[v]; });
}

std::optional<Eigen::Vector3d> DeckBuilder::node(std::int64_t id)
{
    const auto found = number_of_node(id);
    return found ? std::optional(deck_.position[*found]) : std::nullopt;
}

void DeckBuilder::put_node(std::int64_t id, const Eigen::Vector3d& position)
{
    if (const auto found = number_of_node(id))
        deck_.position[*found] = position;
    else
        add_node(id, position);
}

void DeckBuilder::require_room(const DeckLines& lines, std::string_view keyword, std::uint64_t count,
                               std::uint64_t most)
{
    if (count > most || made_ + count > most)
        lines.fail(fmt::format("{} makes {} nodes or shells; the keywords of a deck may make {} in all", keyword, count,
                               most));
    made_ += count;
}

std::optional<size_t> DeckBuilder::number_of_shell(std::int64_t id)
{
    return shell_index_.find(id, shells(), [&](size_t e) { return shell_[e].id; });
}

void DeckBuilder::copy(const DeckRange& range, const Eigen::Affine3d& move, const std::function<int(int)>& part_of)
{
    const std::int64_t shift = std::int64_t(nodes()) - std::int64_t(range.first_node);
    for (size_t v = range.first_node; v < range.end_node; ++v)
        add_node(deck_.node[v], move * deck_.position[v]);
    for (size_t e = range.first_shell; e < range.end_shell; ++e) {
        Shell shell = shell_[e];
        const DeckPart& original = at(shell.part);
        const std::int64_t element = original.broken_element, node = original.missing_node;
        shell.part = part_of(shell.part);
        if (shell.corner[0] >= 0)
            for (size_t k = 0; k < (shell.triangle ? 3 : 4); ++k)
                shell.corner[k] += shift;
        else if (DeckPart& part = at(shell.part); part.broken++ == 0) {
            part.broken_element = element;
            part.missing_node = node;
        }
        if (shell_.size() >= size_t(most_elements))
            throw InputError(fmt::format("there are more than {} shell elements", most_elements));
        shell_.push_back(shell);
        if (!thickness_.empty())
            thickness_.push_back(thickness_[e]);
    }
    begin_scope();
}

void DeckBuilder::drop_shells(const DeckRange& range)
{
    for (size_t e = range.first_shell; e < range.end_shell; ++e) {
        if (shell_[e].corner[0] < 0)
            --at(shell_[e].part).broken;
        shell_[e].corner[0] = -1;
    }
}

void DeckBuilder::begin_scope()
{
    first_node_ = deck_.node.size();
    first_shell_ = shell_.size();
    node_index_.start_at(first_node_);
    shell_index_.start_at(first_shell_);
}

std::vector<std::int64_t> DeckBuilder::nodes_of(int part) const
{
    std::set<std::int64_t> ids;
    for (size_t e = first_shell_; e < shell_.size(); ++e)
        if (shell_[e].part == part)
            ids.insert(shell_[e].corner.begin(), shell_[e].corner.begin() + (shell_[e].triangle ? 3 : 4));
    return {ids.begin(), ids.end()};
}

void DeckBuilder::add_shell(int part, std::int64_t id, std::span<const std::int64_t> corners, double thickness)
{
    if (shell_.size() >= size_t(most_elements))
        throw InputError(fmt::format("there are more than {} shell elements", most_elements));
    const bool triangle = corners.size() < 4 || corners[3] == 0 || corners[3] == corners[2];
    shell_.push_back(
        {usable_id(id, "element"), {corners[0], corners[1], corners[2], triangle ? 0 : corners[3]}, part, triangle});
    if (!thickness_.empty())
        thickness_.push_back(0);
    if (thickness != 0)
        set_thickness(shell_.size() - 1, thickness);
}

void DeckBuilder::set_thickness(size_t shell, double thickness)
{
    thickness_.resize(shell_.size(), 0);
    thickness_[shell] = thickness;
}

int DeckBuilder::part(std::int64_t id)
{
    const auto [found, is_new] = part_of_id_.try_emplace(id, int(deck_.parts.size()));
    if (is_new)
        deck_.parts.push_back({.id = usable_id(id, "part")});
    return found->second;
}

int DeckBuilder::part_named(std::string_view name)
{
    if (const auto found = part_of_name_.find(name); found != part_of_name_.end())
        return found->second;
    part_of_name_.emplace(name, int(deck_.parts.size()));
    deck_.parts.push_back({.name = std::string(name)});
    return int(deck_.parts.size()) - 1;
}

void DeckBuilder::close_scope()
{
    const std::span<const std::int64_t> ids = std::span(deck_.node).subspan(first_node_);
    const NodeNumbers number(ids, int(first_node_));
    require_one_place(ids, deck_.position.data() + first_node_, number, int(first_node_));
    for (size_t e = first_shell_; e < shell_.size(); ++e) {
        Shell& shell = shell_[e];
        std::int64_t missing = 0;
        bool broken = false;
        for (size_t k = 0; k < (shell.triangle ? 3 : 4); ++k) {
            const int v = number[shell.corner[k]];
            if (v < 0 && !broken) {
                missing = shell.corner[k];
                broken = true;
            }
            shell.corner[k] = v;
        }
        if (!broken)
            continue;
        DeckPart& part = at(shell.part);
        if (part.broken++ == 0) {
            part.broken_element = shell.id;
            part.missing_node = missing;
        }
        shell.corner[0] = -1;
    }
    begin_scope();
}

void DeckBuilder::add_set(std::string name, std::vector<int> shells)
{
    deck_.sets.push_back({std::move(name), std::move(shells)});
}

void DeckBuilder::drop_empty_sets()
{
    std::erase_if(deck_.sets, [](const DeckSet& set) { return set.elements.empty(); });
}

/// Names beyond any real deck's are counted together.
void DeckBuilder::count(std::map<std::string, int, std::less<>>& counts, std::string_view name)
{
    constexpr size_t most = 1000;
    if (const auto found = counts.find(name); found != counts.end())
        ++found->second;
    else
        ++counts[counts.size() < most ? std::string(name) : "others"];
}

void DeckBuilder::drop_absurd_thicknesses()
{
    constexpr double thickest = 1e5; // in any unit; beyond it a cube or a mean of it is no number
                                     // any more
    const auto makes_sense = [](double t) { return t == 0 || (t > 0 && t <= thickest); };
    int reported = 0;
    for (DeckPart& part : deck_.parts) {
        if (!part.thickness || makes_sense(*part.thickness))
            continue;
        if (reported++ < 20)
            note(fmt::format("part {} {}: its thickness of {:.4g} is invalid and ignored", part.id.value_or(0),
                             part.name, *part.thickness));
        part.thickness.reset();
    }
    int dropped = 0;
    size_t first = 0;
    for (size_t e = 0; e < thickness_.size(); ++e)
        if (!makes_sense(thickness_[e])) {
            first = dropped++ == 0 ? e : first;
            thickness_[e] = 0;
        }
    if (dropped > 0)
        note(fmt::format("{} an own thickness that is invalid and ignored (first: element {})",
                         counted(dropped, "shell has", "shells have"), shell_[first].id));
}

void DeckBuilder::thickness_from_elements()
{
    if (thickness_.empty())
        return;
    struct Range {
        double low = 1e300, high = 0, sum = 0;
        int shells = 0;
    };
    std::vector<Range> range(deck_.parts.size());
    int reported = 0;
    for (size_t e = 0; e < shell_.size(); ++e) {
        Range& of_part = range[size_t(shell_[e].part)];
        const double t = thickness_[e] > 0 ? thickness_[e] : at(shell_[e].part).thickness.value_or(0);
        of_part = {std::min(of_part.low, t), std::max(of_part.high, t), of_part.sum + t, of_part.shells + 1};
    }
    for (size_t p = 0; p < range.size(); ++p) {
        DeckPart& part = deck_.parts[p];
        const auto [low, high, sum, shells] = range[p];
        if (!(high > 0))
            continue;
        if (low == high)
            part.thickness = low;
        else if (low > 0) { // the sheet that is solved has one; a card of an element goes before
                            // that of its section
            part.thickness = sum / shells;
            if (reported++ < 20)
                note(fmt::format(
                    "part {} {}: its elements have their own thicknesses, from {:.4g} to {:.4g}; their mean, {:.4g}, is used",
                    part.id.value_or(0), part.name, low, high, *part.thickness));
        } else if (reported++ < 20)
            note(fmt::format(
                "part {} {}: some of its elements have their own thicknesses, up to {:.4g}, others none; {} is used",
                part.id.value_or(0), part.name, high, part.thickness ? "that of its section" : "none"));
    }
}

void DeckBuilder::write_notes()
{
    int broken = 0;
    const DeckPart* first = nullptr;
    for (const DeckPart& part : deck_.parts) {
        broken += part.broken;
        first = !first && part.broken ? &part : first;
    }
    if (first)
        note(fmt::format("{} nodes that are not in the deck and {} left out (first: element {}, node {})",
                         counted(broken, "shell element names", "shell elements name"), broken == 1 ? "is" : "are",
                         first->broken_element, first->missing_node));
    if (!others_.empty())
        note("elements that are no shells are left out: " + listed(others_));
    if (!unread_geometry_.empty())
        doubt("keywords that move, copy or make geometry are not read: " + listed(unread_geometry_) +
              "; apply them in the program that wrote the deck and write it again");
    if (!skipped_.empty())
        note("keywords that are not read: " + listed(skipped_));
    std::vector<std::int64_t> ids = deck_.element;
    std::sort(ids.begin(), ids.end());
    if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
        note(fmt::format("element ids are used more than once (first: {})", *twice));
}

Deck DeckBuilder::finish(std::string format, const DeckLines& lines)
{
    deck_.notes.insert(deck_.notes.begin(), lines.notes.begin(), lines.notes.end());
    deck_.doubts.insert(deck_.doubts.begin(), lines.doubts.begin(), lines.doubts.end());
    close_scope();
    require_usable(deck_.node, deck_.position);
    deck_.format = std::move(format);
    drop_absurd_thicknesses();
    thickness_from_elements();
    std::vector<int> number(shell_.size(), -1);
    for (size_t e = 0; e < shell_.size(); ++e) {
        const Shell& shell = shell_[e];
        if (shell.corner[0] < 0)
            continue;
        number[e] = deck_.elements();
        deck_.corner.push_back({int(shell.corner[0]), int(shell.corner[1]), int(shell.corner[2]),
                                shell.triangle ? -1 : int(shell.corner[3])});
        deck_.element.push_back(shell.id);
        deck_.part_of.push_back(shell.part);
        if (!thickness_.empty())
            deck_.thickness.push_back(thickness_[e]);
        ++at(shell.part).elements;
    }
    for (DeckSet& set : deck_.sets) {
        std::vector<int> kept;
        for (const int e : set.elements)
            if (number[size_t(e)] >= 0)
                kept.push_back(number[size_t(e)]);
            else
                ++set.broken;
        set.elements = std::move(kept);
    }
    write_notes();
    for (DeckPart& part : deck_.parts) {
        part.name = readable(part.name);
        part.material = readable(part.material);
    }
    for (DeckSet& set : deck_.sets)
        set.name = readable(set.name);
    for (std::vector<std::string>* list : {&deck_.notes, &deck_.doubts})
        for (std::string& text : *list)
            text = readable(text);
    if (deck_.corner.empty()) {
        std::string message = "there is no shell element with all its nodes in this deck";
        constexpr size_t most = 5;
        for (size_t k = 0; k < std::min(most, deck_.notes.size()); ++k)
            message += "; " + deck_.notes[k];
        throw InputError(message);
    }
    return std::move(deck_);
}

} // namespace spia
