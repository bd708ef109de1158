#include "engine/exchange/deck/abaqus_elements.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <span>

#include "engine/exchange/deck/abaqus_nodes.h"

namespace spia {

void AbaqusElements::add(int part, std::int64_t id, std::span<const std::int64_t> corners, std::string_view set)
{
    deck_.add_shell(part, id, corners);
    first_part_.push_back(part);
    if (!set.empty())
        sets_.add(set, id, id, 1);
}

const std::vector<std::pair<std::int64_t, int>>& AbaqusElements::by_id()
{
    const size_t known = ids_.size(), first = deck_.first_of_scope();
    for (size_t e = first + known; e < deck_.shells(); ++e)
        ids_.emplace_back(deck_.shell_id(e), int(e));
    const auto middle = ids_.begin() + std::ptrdiff_t(known);
    std::sort(middle, ids_.end());
    std::inplace_merge(ids_.begin(), middle, ids_.end());
    return ids_;
}

void AbaqusElements::close_scope()
{
    sets_.clear();
    ids_.clear();
    others_.clear();
    sorted_others_ = 0;
}

bool AbaqusElements::is_other(std::int64_t id)
{
    if (sorted_others_ != others_.size())
        std::sort(others_.begin(), others_.end());
    sorted_others_ = others_.size();
    return std::binary_search(others_.begin(), others_.end(), id);
}

/// How many there are, with the first; what is added to the nodes, and to the element, from one to
/// the next. Without the numbers there is one. The increments of a row in itself are 1 if they are
/// not given; those from row to row and from layer to layer have to be.
AbaqusElements::Row AbaqusElements::row(const DeckFields& fields, size_t first) const
{
    Row row;
    if (!fields[first].empty())
        row.count = std::max<std::int64_t>(abaqus_number(lines_, fields[first]), 0);
    if (row.count == 0)
        row.count = 1;
    const bool needed = row.count > 1 && first > 1;
    for (const auto& [value, field] : {std::pair(&row.nodes, first + 1), std::pair(&row.elements, first + 2)})
        if (needed || !fields[field].empty())
            *value = abaqus_number(lines_, fields[field]);
    return row;
}

void AbaqusElements::generate(const DeckFields& fields)
{
    const std::int64_t master = lines_.whole(fields[0]);
    const std::array<Row, 3> rows = {row(fields, 1), row(fields, 4), row(fields, 7)};
    if (!set_.empty())
        sets_.add(set_, master, master, 1);
    const auto shell = deck_.number_of_shell(master);
    if (!shell) {
        if (!is_other(master))
            lines_.fail(fmt::format("*ELGEN: element {} is not there", master));
        return deck_.count_other_elements("*ELGEN lines");
    }
    constexpr std::uint64_t enough = 1'000'000'000; // to be refused; a third factor would not fit
                                                    // into a number
    std::uint64_t count = std::uint64_t(rows[0].count) * std::uint64_t(rows[1].count);
    count = std::min(count, enough) * std::uint64_t(rows[2].count);
    deck_.require_room(lines_, "*ELGEN", count - 1);
    for (std::int64_t k = 0; k < rows[2].count; ++k)
        for (std::int64_t j = 0; j < rows[1].count; ++j)
            for (std::int64_t i = 0; i < rows[0].count; ++i)
                if (i + j + k > 0)
                    add_shifted(*shell, i * rows[0].elements + j * rows[1].elements + k * rows[2].elements,
                                i * rows[0].nodes + j * rows[1].nodes + k * rows[2].nodes, false, set_);
}

/// The same shell with these added to its number and to those of its nodes.
/// @param turned  its nodes in the other order
void AbaqusElements::add_shifted(size_t shell, std::int64_t element, std::int64_t nodes, bool turned,
                                 std::string_view set)
{
    std::array<std::int64_t, 4> corner = {};
    const auto old = deck_.corners(shell);
    const size_t count = old.size();
    for (size_t k = 0; k < count; ++k)
        corner[turned && k > 0 ? count - k : k] = shifted_number(lines_, old[k], nodes);
    add(first_part_[shell], shifted_number(lines_, deck_.shell_id(shell), element), std::span(corner).first(count),
        set);
}

void AbaqusElements::copy(const AbaqusKeyword& keyword)
{
    const std::string_view old = keyword["OLD SET"], made = keyword["NEW SET"];
    const std::int64_t element = abaqus_number(lines_, keyword["ELEMENT SHIFT"]);
    const std::int64_t nodes = abaqus_number(lines_, keyword["SHIFT NODES"]);
    if (!sets_.has(old))
        lines_.fail(fmt::format("*ELCOPY: there is no element set {}", old));
    steps_ -= std::int64_t(ids_.size()); // they are merged with new ones
    const std::vector<int> shells = members(old);
    if (shells.empty() && others_.empty())
        lines_.fail(fmt::format("*ELCOPY: there is no element of the element set {}", old));
    if (shells.empty())
        deck_.count_other_elements("*ELCOPY keywords");
    deck_.require_room(lines_, "*ELCOPY", shells.size());
    for (const int shell : shells)
        add_shifted(size_t(shell), element, nodes, keyword.has("REFLECT"), made);
}

} // namespace spia
