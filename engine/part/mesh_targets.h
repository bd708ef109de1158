#pragma once
#include <optional>

namespace spia {

struct PartFile;

/// What the triangles of a part should be like.
struct MeshTargets {
    std::optional<double> least_angle = {}; ///< radians, of every triangle
    std::optional<double> edge_ratio = {};  ///< of the longest to the shortest edge of every
                                            ///< triangle, at most

    bool operator==(const MeshTargets&) const = default;
};

/// Counts the triangles that miss them: adds a note and a doubt that names the worst of them.
/// @throws InputError  a target that no triangle, or every one, meets
void check_targets(const MeshTargets& targets, PartFile& part);

} // namespace spia
