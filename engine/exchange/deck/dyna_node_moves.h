#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/dyna_card.h"
#include "engine/exchange/deck/dyna_transforms.h"
#include "engine/exchange/deck/dyna_values.h"

namespace spia {

/// *NODE_TRANSFORM of an LS-DYNA deck, and the sets of nodes that it moves: *SET_NODE, _LIST,
/// _LIST_GENERATE, _LIST_GENERATE_INCREMENT, _ADD, and _GENERAL by nodes and parts. [LS-DYNA
/// Keyword User's Manual, volume I]
class DynaNodeMoves {
public:
    DynaNodeMoves(DynaValues& values, DeckBuilder& deck, const DynaTransforms& transforms)
        : values_(values), deck_(deck), transforms_(transforms)
    {
    }

    bool begin_set(const DynaKeyword& keyword); ///< false: it is no set of nodes
    void set_card(std::string_view line);
    void move_card(std::string_view line); ///< of *NODE_TRANSFORM
    void apply();                          ///< when all of the deck is read

private:
    enum class Form { list, generate, increment, add, general, unread };
    struct Range {
        std::int64_t first, last, step;
    };
    struct Set {
        bool all = false, unread = false;
        std::vector<Range> in = {}, out = {};
        std::vector<std::int64_t> parts_in = {}, parts_out = {}, sets = {};
    };
    struct Move {
        std::int64_t transform = 0, set = 0;
        DeckLines::Place place = {};
    };
    void general(Set& set);
    void make(const Move& move);
    std::optional<std::vector<std::int64_t>> nodes_of(std::int64_t set, const std::vector<std::int64_t>& there);
    std::vector<std::int64_t> among(const std::vector<Range>& ranges, const std::vector<std::int64_t>& parts,
                                    const std::vector<std::int64_t>& there);
    void spend(std::uint64_t nodes);

    DynaValues& values_;
    DeckBuilder& deck_;
    const DynaTransforms& transforms_;
    std::map<std::int64_t, Set> sets_;
    std::vector<Move> moves_;
    Form form_ = Form::list;
    Set* set_ = nullptr; ///< that is read; null: its first card comes
    bool title_next_ = false;
    std::uint64_t work_ = 0; ///< nodes looked at
};

} // namespace spia
