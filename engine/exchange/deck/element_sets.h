#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spia {

/// Named sets of element ids, which may hold other sets (Abaqus: *ELSET).
class ElementSets {
public:
    /// step above 0
    void add(std::string_view name, std::int64_t first, std::int64_t last, std::int64_t step);
    void add_set(std::string_view name, std::string_view other);
    bool has(std::string_view name) const;

    /// Which elements a set holds, with the sets that it holds.
    /// @param by_id  ids and numbers of all elements, in order of their ids
    /// @param steps  work left; counted down
    /// @returns their numbers, ascending, each once
    /// @throws InputError if it would take more steps
    std::vector<int> members(std::string_view name, const std::vector<std::pair<std::int64_t, int>>& by_id,
                             std::int64_t& steps) const;

    std::vector<std::string> names() const; ///< as first written, in the order of the alphabet
    void clear() { set_.clear(); }

private:
    struct Range {
        std::int64_t first, last, step;
    };
    struct Set {
        std::string name;
        std::vector<Range> ranges;
        std::vector<std::string> others; ///< upper case
    };
    Set& at(std::string_view name);
    std::map<std::string, Set> set_; ///< by upper-case name
};

} // namespace spia
