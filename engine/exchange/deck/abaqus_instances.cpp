#include "engine/exchange/deck/abaqus_instances.h"

#include "engine/core/text.h"
#include "engine/mesh/doctor/doctor.h"

#include <algorithm>
#include <fmt/core.h>

namespace spia {

void AbaqusInstances::begin_instance(const AbaqusKeyword& keyword)
{
    instance_ = Instance{std::string(keyword["NAME"])};
    if (keyword.has("LIBRARY") || keyword.has("INSTANCE")) {
        deck_.count_unread_geometry("*INSTANCE, LIBRARY");
        return;
    }
    instance_->part = upper_case(keyword["PART"]);
    const auto found = parts_.find(instance_->part);
    if (found == parts_.end()) {
        instance_->lost = true; // unless its mesh stands in it
        return;
    }
    if (!found->second.placed.empty())
        deck_.require_room(lines_, "*INSTANCE", found->second.range.nodes() + found->second.range.shells(),
                           DeckBuilder::most_copied);
}

void AbaqusInstances::end_scope(const DeckRange& scope, size_t first_set)
{
    if (part_)
        parts_.insert_or_assign(*part_, Part{scope, first_set, deck_.sets()});
    part_.reset();
    if (!instance_)
        return;
    const Eigen::Affine3d move = instance_->shift.move(lines_);
    deck_.move_range(scope, move);
    if (const auto found = parts_.find(instance_->part); found != parts_.end()) {
        found->second.placed.push_back({instance_->name, move});
        ++placed_;
    }
    lost_ += instance_->lost && scope.nodes() == 0;
    instance_.reset();
}

void AbaqusInstances::place_all()
{
    if (lost_ > 0)
        deck_.doubt(fmt::format("{} of parts that are not in the deck; their shells are missing",
                                counted(lost_, "instance is", "instances are")));
    std::vector<Part*> in_order; // of the deck, for the same numbers every time
    for (auto& [name, part] : parts_)
        in_order.push_back(&part);
    std::sort(in_order.begin(), in_order.end(),
              [](const Part* a, const Part* b) { return a->range.first_node < b->range.first_node; });
    int dropped = 0;
    for (const Part* part : in_order) {
        for (size_t k = 1; k < part->placed.size(); ++k)
            copy(*part, part->placed[k]);
        if (!part->placed.empty())
            deck_.move_range(part->range, part->placed[0].move);
        else if (placed_ > 0 && lost_ == 0 && part->range.shells() > 0) {
            deck_.drop_shells(part->range);
            for (size_t s = part->first_set; s < part->end_set; ++s)
                deck_.set(s).elements.clear();
            ++dropped;
        }
    }
    deck_.drop_empty_sets();
    if (dropped > 0)
        deck_.note(fmt::format("{} no instance in the assembly and {} left out",
                               counted(dropped, "part has", "parts have"), dropped == 1 ? "is" : "are"));
}

void AbaqusInstances::copy(const Part& part, const Placed& placed)
{
    const size_t first = deck_.shells();
    std::map<int, int> copies;
    deck_.copy(part.range, placed.move, [&](int original) {
        const auto [found, is_new] = copies.try_emplace(original, 0);
        if (is_new) {
            const DeckPart old = deck_.at(original);
            found->second = deck_.part_named(fmt::format("{}.{}", placed.name, old.name));
            deck_.at(found->second).thickness = old.thickness;
            deck_.at(found->second).material = old.material;
        }
        return found->second;
    });
    deck_.set_copies();
    for (size_t s = part.first_set; s < part.end_set; ++s) {
        std::vector<int> shells = deck_.set(s).elements;
        if (shells.size() > set_room_)
            return deck_.note(
                fmt::format("the element sets of the instance {} cannot be chosen; they are too many", placed.name));
        set_room_ -= shells.size();
        for (int& shell : shells)
            shell += int(std::int64_t(first) - std::int64_t(part.range.first_shell));
        deck_.add_set(fmt::format("{}.{}", placed.name, deck_.set(s).name), std::move(shells));
    }
}

} // namespace spia
