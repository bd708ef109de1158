#pragma once
#include <array>
#include <map>
#include <vector>

#include "engine/mesh/solid/holes/round_holes.h"
#include "engine/mesh/solid/holes/sunk_holes.h"

namespace spia {

/// Round holes that are sunk at a skin where there is not all of the circle: a bend, a border or
/// another hole is in it.
class CutOffHoles {
public:
    /// Keeps references.
    CutOffHoles(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const ThinSolid& sheet);

    /// What is sunk of one that has a circle on plane skin at one side, at that side and at the
    /// other one.
    std::vector<SunkHole> of(const RoundHole& hole) const;

    /// What is sunk of one that goes through a bend: its wall has a sharp edge inside, which is a
    /// circle, and is wider beyond that. None if it hangs together with a border.
    /// @param wall  triangles, ascending
    std::vector<SunkHole> over_bend(const std::vector<int>& wall) const;

private:
    /// Where a wall meets a skin.
    struct Meeting {
        std::multimap<int, int> way; ///< along its edges, from vertex to vertex, the skin to the
                                     ///< left
        std::vector<int> wall;       ///< triangles
    };

    const TriMesh& solid_;
    const Eigen::Matrix3Xd& normal_;
    const ThinSolid& sheet_;
    Eigen::Matrix3Xi neighbour_;

    /// at the outer, the inner skin
    std::array<Meeting, 2> meetings(const std::vector<int>& wall) const;
    std::vector<RoundEdge> sharp_circles(const std::vector<int>& wall) const;
    /// Whether a triangle is of a surface of revolution about the circle's axis: a border is not.
    bool around(const RoundEdge& circle, int f) const;
    bool square(const std::vector<int>& wall, const Eigen::Vector3d& axis) const;
    SunkHole cut_off(const Meeting& meeting, SheetSide skin, const Eigen::Vector3d& inwards) const;
};

} // namespace spia
