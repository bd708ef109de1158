#include "engine/exchange/deck/radioss_submodels.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <limits>

namespace spia {

void RadiossSubmodels::begin(std::int64_t id, bool other_unit)
{
    constexpr size_t deepest = 100; // far beyond the levels of any assembly
    if (open_.size() >= deepest)
        lines_.fail(fmt::format("submodels are nested {} deep", deepest));
    const int father = current();
    Submodel made{father, {}, 1, other_unit};
    if (father >= 0) {
        made.offset = all_[size_t(father)].offset;
        made.length = all_[size_t(father)].length;
    }
    number_.try_emplace(shifted(id, &RadiossOffsets::submodel), count());
    all_.push_back(made);
    open_.push_back(count() - 1);
    change_owner();
}

/// Offsets add to those of the submodel around it; one that is not given is that of all.
void RadiossSubmodels::card(std::string_view line, int number)
{
    if (number != 1 || open_.empty())
        return;
    fields_.cut_columns(line, std::array{10, 10, 10, 10, 10, 10, 10});
    RadiossOffsets& offset = all_[size_t(open_.back())].offset;
    const std::int64_t usual = lines_.whole_or_zero(fields_[0]);
    size_t field = 0;
    for (std::int64_t* each : {&offset.other, &offset.node, &offset.element, &offset.part, &offset.material,
                               &offset.property, &offset.submodel}) {
        const std::int64_t own = lines_.whole_or_zero(fields_[field++]);
        if (__builtin_add_overflow(*each, own != 0 ? own : usual, each))
            lines_.fail("the offset is too great");
    }
}

void RadiossSubmodels::end()
{
    if (open_.empty())
        lines_.fail("//ENDSUB stands without //SUBMODEL");
    if (all_[size_t(open_.back())].unit_unknown)
        deck_.count_unread_geometry("//SUBMODEL in a unit system of its own");
    open_.pop_back();
    change_owner();
}

void RadiossSubmodels::finish()
{
    if (!open_.empty())
        deck_.doubt(
            fmt::format("{} //SUBMODEL have no //ENDSUB: if the deck was cut off, shells are missing", open_.size()));
    while (!open_.empty())
        end();
}

void RadiossSubmodels::set_unit(std::optional<LengthUnit> unit)
{
    Submodel& submodel = all_[size_t(open_.back())];
    submodel.unit_unknown = !unit || !deck_unit_;
    if (!submodel.unit_unknown && *unit != *deck_unit_)
        submodel.length = millimetres(*unit) / millimetres(*deck_unit_);
    else
        submodel.length = 1;
}

std::int64_t RadiossSubmodels::shifted(std::int64_t id, std::int64_t RadiossOffsets::*offset) const
{
    if (id == 0 || open_.empty())
        return id;
    std::int64_t sum = 0;
    if (__builtin_add_overflow(id, all_[size_t(open_.back())].offset.*offset, &sum))
        lines_.fail(fmt::format("the id {} with the offset of its submodel is too great", id));
    return sum;
}

std::optional<int> RadiossSubmodels::find(std::int64_t id) const
{
    const auto found = number_.find(id);
    return found == number_.end() ? std::nullopt : std::optional(found->second);
}

int RadiossSubmodels::owner(size_t node) const
{
    const auto behind =
        std::upper_bound(owner_.begin(), owner_.end(), std::pair(node, std::numeric_limits<int>::max()));
    return behind == owner_.begin() ? -1 : std::prev(behind)->second;
}

std::vector<std::pair<int, DeckRange>> RadiossSubmodels::nodes() const
{
    std::vector<std::pair<int, DeckRange>> ranges;
    for (size_t k = 0; k < owner_.size(); ++k) {
        const size_t end = k + 1 < owner_.size() ? owner_[k + 1].first : deck_.nodes();
        if (owner_[k].second >= 0 && end > owner_[k].first)
            ranges.emplace_back(owner_[k].second, DeckRange{owner_[k].first, end, 0, 0});
    }
    return ranges;
}

} // namespace spia
