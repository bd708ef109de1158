#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/exchange/deck/abaqus_keyword.h"
#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/deck_fields.h"
#include "engine/exchange/deck/deck_lines.h"
#include "engine/exchange/deck/element_sets.h"

namespace spia {

/// The shells of an Abaqus deck by their numbers and sets, and those that *ELGEN and *ELCOPY make
/// of others. [Abaqus Keywords Reference; Abaqus Analysis User's Guide, "Element definition"]
class AbaqusElements {
public:
    AbaqusElements(DeckLines& lines, DeckBuilder& deck) : lines_(lines), deck_(deck) {}

    void add(int part, std::int64_t id, std::span<const std::int64_t> corners, std::string_view set);
    void add_other(std::int64_t id) { others_.push_back(id); } ///< an element that is no shell

    void begin_generation(const AbaqusKeyword& keyword) { set_ = keyword["ELSET"]; } ///< *ELGEN
    void generate(const DeckFields& fields);
    void copy(const AbaqusKeyword& keyword); ///< *ELCOPY, which has no lines

    /// Ids and numbers of the shells of the scope that is open, in order of their ids.
    const std::vector<std::pair<std::int64_t, int>>& by_id();
    int first_part(size_t shell) const { return first_part_[shell]; } ///< before sections took it
    ElementSets& sets() { return sets_; }
    std::vector<int> members(std::string_view set) { return sets_.members(set, by_id(), steps_); }
    void close_scope();

private:
    /// One of the three directions in which *ELGEN repeats elements.
    struct Row {
        std::int64_t count = 1, nodes = 1, elements = 1; ///< and the increments from one to the
                                                         ///< next
    };
    Row row(const DeckFields& fields, size_t first) const;
    void add_shifted(size_t shell, std::int64_t element, std::int64_t nodes, bool turned, std::string_view set);
    bool is_other(std::int64_t id);

    DeckLines& lines_;
    DeckBuilder& deck_;
    ElementSets sets_;
    std::string set_;
    std::vector<int> first_part_;                   ///< per shell
    std::vector<std::pair<std::int64_t, int>> ids_; ///< of by_id()
    std::vector<std::int64_t> others_;              ///< of this scope
    size_t sorted_others_ = 0;
    std::int64_t steps_ = 300'000'000; ///< a few seconds
};

} // namespace spia
