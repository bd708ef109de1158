#include "engine/exchange/deck/deck_choice.h"

#include <algorithm>
#include <fmt/core.h>
#include <functional>
#include <set>

#include "engine/core/error.h"
#include "engine/core/read_number.h"
#include "engine/core/text.h"
#include "engine/mesh/doctor/doctor.h"
#include "engine/options/part_options.h"

namespace spia {
namespace {

/// The one that is called so, first as written, then in any case; -1: none.
/// @throws InputError if it may be either of several
int named(std::string_view name, size_t count, const std::function<std::string_view(size_t)>& name_of)
{
    name = trimmed(name);
    for (const bool any_case : {false, true}) {
        int found = -1;
        for (size_t i = 0; i < count; ++i)
            if (any_case ? same_letters(name_of(i), name) : name_of(i) == name) {
                if (found >= 0)
                    throw InputError(
                        fmt::format("several parts or sets of the deck are called {}; choose by id", name));
                found = int(i);
            }
        if (found >= 0)
            return found;
    }
    return -1;
}

/// -1 if there is none
int find_part(const Deck& deck, std::string_view wanted)
{
    if (const auto id = read_whole_number(wanted))
        for (size_t p = 0; p < deck.parts.size(); ++p)
            if (deck.parts[p].id == id)
                return int(p);
    std::vector<int> with_shells; // parts without are not in the list
    for (size_t p = 0; p < deck.parts.size(); ++p)
        if (deck.parts[p].elements + deck.parts[p].broken > 0)
            with_shells.push_back(int(p));
    const int found = named(wanted, with_shells.size(),
                            [&](size_t i) { return std::string_view(deck.parts[size_t(with_shells[i])].name); });
    return found < 0 ? -1 : with_shells[size_t(found)];
}

void require_whole(const Deck& deck, const DeckPart& part)
{
    if (part.broken > 0)
        throw InputError(fmt::format("part {}: {} nodes that are not in the deck (first: element {}, node {}); "
                                     "add the file that holds them, or choose other parts by id or name ({}):\n{}",
                                     title(part), counted(part.broken, "shell names", "shells name"),
                                     part.broken_element, part.missing_node, mention(option::part),
                                     part_list(deck.parts)));
    if (part.elements == 0)
        throw InputError(fmt::format("part {} has no shell elements; choose one that has ({}):\n{}", title(part),
                                     mention(option::part), part_list(deck.parts)));
}

std::vector<char> chosen_elements(const Deck& deck, std::span<const std::string> wanted)
{
    std::vector<char> chosen(size_t(deck.elements()), wanted.empty());
    std::vector<char> part_chosen(deck.parts.size(), 0);
    for (const std::string& each : wanted) {
        if (const int p = find_part(deck, each); p >= 0) {
            require_whole(deck, deck.parts[size_t(p)]);
            part_chosen[size_t(p)] = 1;
            continue;
        }
        const int s = named(each, deck.sets.size(), [&](size_t i) { return std::string_view(deck.sets[i].name); });
        if (s < 0)
            throw InputError(fmt::format("there is no part '{}' in the deck; choose by id or name ({}):\n{}", each,
                                         mention(option::part), part_list(deck.parts)));
        const DeckSet& set = deck.sets[size_t(s)];
        if (set.broken > 0)
            throw InputError(fmt::format("element set {}: {} nodes that are not in the deck; add the file that holds "
                                         "them, or choose other parts by id or name ({}):\n{}",
                                         set.name, counted(set.broken, "shell names", "shells name"),
                                         mention(option::part), part_list(deck.parts)));
        for (const int e : set.elements)
            chosen[size_t(e)] = 1;
    }
    for (size_t e = 0; e < chosen.size(); ++e)
        chosen[e] |= part_chosen[size_t(deck.part_of[e])];
    return chosen;
}

/// What the chosen parts agree on.
void take_over_properties(const Deck& deck, const std::vector<char>& part_used, DeckChoice& choice)
{
    std::set<double> thicknesses;
    std::set<std::string> materials;
    for (size_t p = 0; p < deck.parts.size(); ++p)
        if (part_used[p]) {
            thicknesses.insert(deck.parts[p].thickness.value_or(0));
            materials.insert(deck.parts[p].material);
        }
    if (thicknesses.size() == 1 && *thicknesses.begin() > 0)
        choice.thickness = *thicknesses.begin();
    if (materials.size() == 1)
        choice.material = *materials.begin();
    if (thicknesses.size() > 1) {
        const double low = *thicknesses.begin(), high = *thicknesses.rbegin();
        choice.notes.push_back(
            low > 0
                ? fmt::format("the parts have thicknesses from {:.4g} to {:.4g} in the deck; none is used", low, high)
                : std::string("only some of the parts have a thickness in the deck; none is used"));
    }
}

} // namespace

std::string title(const DeckPart& part)
{
    if (!part.id)
        return part.name;
    return part.name.empty() ? fmt::format("{}", *part.id) : fmt::format("{} {}", *part.id, part.name);
}

std::string describe(const DeckPart& part)
{
    std::string text = fmt::format("{:<28} {:>8} shell{}", title(part), part.elements + part.broken,
                                   part.elements + part.broken == 1 ? "" : "s");
    if (part.thickness)
        text += fmt::format(", thickness {:.4g}", *part.thickness);
    if (!part.material.empty())
        text += fmt::format(", {}", part.material);
    if (part.broken > 0)
        text += fmt::format(", {} without their nodes", part.broken);
    return text;
}

std::string part_list(std::span<const DeckPart> parts)
{
    constexpr int most = 40;
    std::string text;
    int shown = 0;
    for (const DeckPart& part : parts) {
        if (part.elements + part.broken == 0 || shown++ >= most)
            continue;
        text += "  " + describe(part) + '\n';
    }
    if (shown > most)
        text += fmt::format("  and {} more (`spia info` lists them all)\n", shown - most);
    if (text.ends_with('\n'))
        text.pop_back();
    return text;
}

DeckChoice choose_parts(const Deck& deck, std::span<const std::string> wanted)
{
    const std::vector<char> chosen = chosen_elements(deck, wanted);
    std::vector<char> part_used(deck.parts.size(), 0), node_used(size_t(deck.nodes()), 0);
    DeckChoice choice;
    for (int e = 0; e < deck.elements(); ++e)
        if (chosen[size_t(e)]) {
            choice.element.push_back(e);
            part_used[size_t(deck.part_of[size_t(e)])] = 1;
            for (const int v : deck.corner[size_t(e)])
                if (v >= 0)
                    node_used[size_t(v)] = 1;
        }
    for (size_t p = 0; p < part_used.size() && wanted.empty(); ++p)
        if (deck.parts[p].broken > 0)
            require_whole(deck, deck.parts[p]);
    std::vector<int> number(node_used.size(), -1);
    for (int v = 0; v < deck.nodes(); ++v)
        if (node_used[size_t(v)]) {
            number[size_t(v)] = choice.soup.vertices();
            choice.node.push_back(v);
            choice.soup.position.push_back(deck.position[size_t(v)]);
        }
    for (const int e : choice.element) {
        std::array<int, 4> corners = deck.corner[size_t(e)];
        const size_t count = corners[3] < 0 ? 3 : 4;
        for (size_t k = 0; k < count; ++k)
            corners[k] = number[size_t(corners[k])];
        choice.soup.add_polygon(std::span(corners).first(count));
    }
    take_over_properties(deck, part_used, choice);
    return choice;
}

} // namespace spia
