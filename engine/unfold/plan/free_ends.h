#pragma once
#include <Eigen/Core>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/unfold/plan/bend_zones.h"

namespace spia {

// A press brake bends sheet along straight lines, all of them parallel, and from one edge of the
// sheet to another: beyond the end of a line there is nothing, or a hole, that would hold the sheet
// back. The radius of a drawn part, also where it is straight, ends in sheet that was drawn. What
// interrupts a bend on its way, a hole, a notch, a bead, is no matter.

/// Tells bends that a press brake makes from the radii of drawn sheet, in a part that outlives it.
class FreeEnds {
public:
    explicit FreeEnds(const TriMesh& part);

    /// Whether a zone ends at the edge of the part, or of a hole, at both its ends: over most of
    /// its breadth the outermost edge is one, or one is near, for beside the edge narrow triangles
    /// may be no part of the zone.
    bool of(const BendZone& zone) const;

    /// Whether a bend of the map runs between two regions along a straight line, parallel to
    /// itself, and ends so.
    /// @param flat  2 by #V, mm: the blank
    bool of(const BendMap& map, size_t bend, const Eigen::Matrix2Xd& flat) const;

private:
    /// Faces between the two lines where a bend begins and ends.
    struct Strip {
        std::vector<int> face;
        std::vector<Eigen::Vector3d> across; ///< per face, of its corners: 0 where the bend begins,
                                             ///< 1 where it ends
        std::vector<Eigen::Vector3d> along;  ///< mm, of its corners, along the bend
        double breadth = 0;                  ///< mm, across the bend
    };
    struct End;

    Strip band(const BendMap& map, size_t bend, const Eigen::Vector3d& axis, const Eigen::Matrix2Xd& flat) const;
    std::array<std::vector<End>, 2> ends(const Strip& strip) const;
    bool free(const Strip& strip) const;
    bool of_fold(const BendMap& map, const Bend& bend) const;

    const TriMesh& part_;
    Eigen::Matrix3Xd normal_;           ///< area_vectors()
    std::vector<EdgeUse> use_;          ///< of all edges
    std::set<std::pair<int, int>> rim_; ///< edges of one face
    std::set<int> on_rim_;              ///< their vertices
};

} // namespace spia
