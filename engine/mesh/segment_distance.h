#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

namespace spia {

struct BoxTree;

/// Distances of many places of the plane from the same segments; the search structure is built
/// once.
class SegmentDistance {
public:
    /// @param position 2 by #points, finite, mm
    /// @param segments numbers of their ends
    SegmentDistance(const Eigen::Matrix2Xd& position, const std::vector<std::array<int, 2>>& segments);
    ~SegmentDistance();

    /// mm, to the nearest segment; infinite if there is none. The least of what is computed for
    /// each segment, to the last bit.
    double operator()(const Eigen::Vector2d& place) const;

private:
    std::unique_ptr<const BoxTree> tree_; ///< over triangles that are segments; null: none
    double rounding_ = 0;                 ///< mm: what a distance to a box may be wrong by
};

} // namespace spia
