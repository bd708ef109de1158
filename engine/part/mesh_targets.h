#pragma once
#include <optional>

namespace spia {

struct PartFile;
struct Remarks;

/// What the triangles of a part should be like.
struct MeshTargets {
    std::optional<double> least_angle = {}; ///< radians, of every triangle
    std::optional<double> edge_ratio = {};  ///< of the longest to the shortest edge of every
                                            ///< triangle, at most

    bool operator==(const MeshTargets&) const = default;
};

/// A doubt for each of them that triangles miss: how many do, and which is the worst.
/// @throws InputError  a target that no triangle, or every one, meets
Remarks on_targets(const MeshTargets& targets, const PartFile& part);

} // namespace spia
