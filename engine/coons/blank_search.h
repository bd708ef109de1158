#pragma once
#include <array>
#include <vector>

#include "engine/mesh/fill_holes.h"
#include "engine/mesh/locate.h"

namespace spia {

/// Finds places on a filled blank that may lie on top of itself, like the flattened wall of a
/// nearly closed tube.
class BlankSearch {
public:
    /// @param filled must outlive the search
    explicit BlankSearch(const FilledMesh& filled);

    /// True if the outline lies on other faces of the blank somewhere, or faces are turned over.
    bool overlaps_itself() const { return overlaps_; }

    /// The place of a point of the plane. Face -1 if no face covers it, or faces of different
    /// layers do.
    MeshPoint unique_place(const Eigen::Vector2d& point) const;

    /// The place of a point on the layer of one of its neighbours: the straight line from there
    /// does not leave the blank. Face -1 if there is none.
    MeshPoint place_next_to(const Eigen::Vector2d& point, const std::vector<MeshPoint>& neighbours) const;

    /// The nearest place, on any layer.
    MeshPoint nearest(const Eigen::Vector2d& point) const { return locator_.nearest(point); }

    Eigen::Vector2d position(const MeshPoint& place) const; ///< in the plane

private:
    bool line_stays_inside(const MeshPoint& from, const MeshPoint& to) const;

    const FilledMesh& filled_;
    PlanarLocator locator_;
    std::vector<std::array<int, 3>> across_; // per face and edge k, k + 1: the other face or -1
    bool overlaps_ = false;
};

} // namespace spia
