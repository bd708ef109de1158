#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/deck_lines.h"

namespace spia {

/// Named sets of node ids of an Abaqus deck (*NSET, and NSET= of other keywords), which keep the
/// order of their members if they are unsorted.
class NodeSets {
public:
    explicit NodeSets(DeckLines& lines) : lines_(lines) {}

    /// To take the members that follow; a set that is there keeps what it has. @param unsorted of a
    /// new one
    void open(std::string_view name, bool unsorted = false);
    /// to the open set; step above 0
    void add(std::int64_t first, std::int64_t last, std::int64_t step);
    /// what it holds now, to the open set
    void add_set(std::string_view name);
    /// the open set holds what is not read
    void spoil() { open_->spoiled = true; }

    bool has(std::string_view name) const;
    bool is_unsorted(std::string_view name) const;
    bool is_spoiled(std::string_view name) const;

    struct Members {
        std::vector<std::int64_t> ids;         ///< of nodes that are there, each once where the set
                                               ///< is sorted
        std::optional<std::int64_t> missing{}; ///< a member for which there is no node
    };
    /// @param steps  work left; counted down
    /// @throws InputError with the line, if it would take more steps
    Members members(std::string_view name, DeckBuilder& deck, std::int64_t& steps) const;

    void clear();

private:
    struct Range {
        std::int64_t first, last, step;
    };
    struct Set {
        std::vector<Range> ranges = {};
        bool unsorted = false, spoiled = false;
    };
    void spend(std::int64_t& steps, std::uint64_t count, std::string_view name) const;
    const Set* find(std::string_view name) const;

    DeckLines& lines_;
    std::map<std::string, Set> set_; ///< by upper-case name
    Set* open_ = nullptr;
    size_t copied_ = 0; ///< ranges, from set to set
};

} // namespace spia
