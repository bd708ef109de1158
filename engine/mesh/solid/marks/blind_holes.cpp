#include "engine/mesh/solid/marks/blind_holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Faces across the thickness that hang together, and what of the skins is around them.
struct RimGroup {
    bool touches[2] = {false, false};
    Eigen::Vector3d place = Eigen::Vector3d::Zero(), out = Eigen::Vector3d::Zero(); ///< of the skin, there
};

} // namespace

std::vector<BlindHole> blind_holes(const TriMesh& solid, const ThinSolid& sheet)
{
    const auto is_rim = [&](int f) { return sheet.side[size_t(f)] == SheetSide::rim; };
    const std::vector<EdgeUse> uses = edge_uses(solid.triangle);
    DisjointSets together(size_t(solid.triangles()));
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end == begin + 2 && is_rim(uses[begin].face) && is_rim(uses[begin + 1].face))
            together.join(uses[begin].face, uses[begin + 1].face);
    });
    const Eigen::Matrix3Xd area = sheet.flipped * area_vectors(solid);
    std::map<int, RimGroup> groups;
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end != begin + 2)
            return;
        for (const auto& [rim, skin] : {std::pair(begin, begin + 1), std::pair(begin + 1, begin)}) {
            if (!is_rim(uses[rim].face) || is_rim(uses[skin].face))
                continue;
            RimGroup& group = groups[together.root(uses[rim].face)];
            group.touches[sheet.side[size_t(uses[skin].face)] == SheetSide::outer ? 0 : 1] = true;
            if (group.out.isZero()) {
                group.place = solid.position.col(uses[rim].low);
                group.out = area.col(uses[skin].face).normalized();
            }
        }
    });
    std::vector<BlindHole> result;
    for (const auto& [root, group] : groups) {
        if (group.touches[0] == group.touches[1])
            continue;
        double depth = 0;
        for (int f = 0; f < solid.triangles(); ++f)
            if (is_rim(f) && together.root(f) == root)
                for (const int v : solid.triangle.col(f))
                    depth = std::max(depth, group.out.dot(group.place - solid.position.col(v)));
        result.push_back({group.place, depth});
    }
    return result;
}

} // namespace spia
