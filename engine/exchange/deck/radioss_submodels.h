#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/deck_fields.h"
#include "engine/exchange/deck/deck_lines.h"

namespace spia {

/// What is added to the ids of a submodel.
struct RadiossOffsets {
    std::int64_t other = 0, node = 0, element = 0, part = 0, material = 0, property = 0, submodel = 0;
};

/// The submodels of a Radioss deck, //SUBMODEL to //ENDSUB, one in another: their offsets, their
/// unit of length, and which nodes are theirs. [Altair Radioss Starter Reference Guide]
class RadiossSubmodels {
public:
    RadiossSubmodels(DeckLines& lines, DeckBuilder& deck) : lines_(lines), deck_(deck) {}

    void begin(std::int64_t id, bool other_unit); ///< @param other_unit  it names a unit system
    void card(std::string_view line, int number); ///< @param number  counted from 0, the title
    void end();                                   ///< @throws InputError if none is open
    void finish();                                ///< at the end of the deck

    void set_unit_of_deck(LengthUnit unit) { deck_unit_ = unit; }
    void set_unit(std::optional<LengthUnit> unit); ///< of the one that is open; nothing: it is not
                                                   ///< known

    bool is_inside() const { return !open_.empty(); }
    /// its number; -1: the deck itself
    int current() const { return open_.empty() ? -1 : open_.back(); }
    /// in the deck's unit
    double length() const { return open_.empty() ? 1 : all_[size_t(open_.back())].length; }
    /// 0 stays: there is none. @throws InputError if the sum fits into no number
    std::int64_t shifted(std::int64_t id, std::int64_t RadiossOffsets::*offset) const;

    int count() const { return int(all_.size()); }
    std::optional<int> find(std::int64_t id) const;
    /// a lower number; -1: the deck
    int father(int submodel) const { return all_[size_t(submodel)].father; }
    /// of a node by its number; -1: the deck
    int owner(size_t node) const;
    /// of all submodels, by ranges
    std::vector<std::pair<int, DeckRange>> nodes() const;

private:
    struct Submodel {
        int father;
        RadiossOffsets offset;
        double length;
        bool unit_unknown;
    };
    void change_owner() { owner_.emplace_back(deck_.nodes(), current()); }

    DeckLines& lines_;
    DeckBuilder& deck_;
    DeckFields fields_;
    std::optional<LengthUnit> deck_unit_;
    std::vector<Submodel> all_;
    std::vector<int> open_;
    std::map<std::int64_t, int> number_;
    std::vector<std::pair<size_t, int>> owner_; ///< from this node on; ascending
};

} // namespace spia
