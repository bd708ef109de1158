#pragma once
#include <optional>

#include "engine/forming/process/process.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// The rolling direction seen in the plane of the blank; none: none is given.
/// @param plane axes of the blank in space @throws InputError if it is no direction across the
/// normal of the plane
std::optional<Eigen::Vector2d> rolling_in(const ProcessConditions& process, const Eigen::Matrix<double, 3, 2>& plane);

/// Where a direction of space that the sheet has in its faces lies on the blank: what each face
/// makes of its share of it, without sense, averaged over the faces. Of sheet that is only bent it
/// is exact, however the blank is turned.
/// @param flat  2 by #V, the blank @returns unit, as near to `seen` as to its opposite; `seen`
/// where no face has it
Eigen::Vector2d carried_to_blank(const TriMesh& part, const Eigen::Matrix2Xd& flat, const Eigen::Vector3d& direction,
                                 const Eigen::Vector2d& seen);

} // namespace spia
