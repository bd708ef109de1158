#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "engine/remesh/mesh_distance.h"

namespace spia {

/// Both ways between a part and a mesh that is to replace it, while that mesh changes here and
/// there: only what has changed, and what is near to that, is measured again.
class TwoWayDistance {
public:
    /// @param part       has to stay
    /// @param search     of the part
    /// @param tolerance  mm; bounds are as sharp as is needed to know whether it is kept
    TwoWayDistance(const TriMesh& part, const ClosestPointSearch& search, double tolerance);

    /// @param was  per face its number in the mesh measured before if it is still the same, else -1
    void measure(const TriMesh& mesh, const std::vector<int>& was, const Progress& progress = {});

    const MeshDistance& to_part() const { return to_part_; }
    const MeshDistance& from_part() const { return from_part_; }
    double bound() const { return std::max(to_part_.bound, from_part_.bound); } ///< mm
    double seen() const { return std::max(to_part_.seen, from_part_.seen); }    ///< mm
    /// Of the mesh measured last.
    const ClosestPointSearch& on_mesh() const { return *on_mesh_; }

private:
    const TriMesh& part_;
    const ClosestPointSearch& search_;
    double tolerance_;
    TriMesh mesh_;
    std::optional<ClosestPointSearch> on_mesh_;
    MeshDistance to_part_, from_part_;
};

} // namespace spia
