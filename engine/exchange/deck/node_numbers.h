#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace spia {

/// Finds the number of a node by its id; a table where ids are dense, else by bisection.
class NodeNumbers {
public:
    /// @param ids  of the nodes first, first + 1, ...; of equal ids the first one counts
    NodeNumbers(std::span<const std::int64_t> ids, int first);

    int operator[](std::int64_t id) const; ///< -1 if there is no such node

private:
    std::vector<std::int64_t> sorted_; ///< either these two, or the table
    std::vector<int> number_;
    std::vector<int> table_;
    std::int64_t least_ = 0;
};

} // namespace spia
