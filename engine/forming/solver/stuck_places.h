#pragma once
#include "engine/forming/process/external_forces.h"
#include "engine/forming/solver/membrane.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Where the material under tools that travel would lie on the blank had it stuck to them from the
/// first touch on: at the place where the tool's middle is seen, and from there outwards as far as
/// the part is long, whatever the sheet was stretched. On a cup's punch the slip against it is then
/// s - R, s along the meridian [relative velocity at the punch of theories of deep drawing]. The
/// middle of a connected piece is the place of its vertex nearest to the mean of the faces,
/// weighted by the area that faces the stamping direction. The way outwards, s, is the
/// least-squares solution of e_r . grad s = |F e_r| on the blank, with a little smoothing across.
/// @param X the blank, where it lies under the part, near the solution: only its directions and the
/// strain on the way count
/// @return 2 by #V, mm; X where nothing travels
Eigen::Matrix2Xd stuck_places(const TriMesh& part, const std::vector<Element>& element, const ExternalForces& external,
                              const Eigen::Matrix2Xd& X);

} // namespace spia
