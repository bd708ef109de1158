#pragma once
#include <Eigen/Core>
#include <optional>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A blank as it lies straight on the sheet: turned in its plane, its box from (0, 0) on. Along x lies
/// - the rolling direction, where one is given;
/// - else the direction of the longest straight edges (together a quarter of the outline or more; those square to them count),
/// - else a side of the smallest box that has one along an edge of the outline;
/// the latter two with the longer side of the box along x. Of the two ways round (four where the box is square or edges do not
/// tell) that one is taken which has the larger second moment along x, then the sheet's middle below that of the box, then left of
/// it, then likewise by its third moments: a rule of the shape alone, so that it does not depend on how the part lay or is
/// numbered. What is symmetric in all this is the same shape either way round, and lies as near as it can to how it came.
/// @param flat    2 by #V, mm
/// @param rolling in the plane of `flat`, not zero
Eigen::Matrix2Xd upright(const TriMesh& part, const Eigen::Matrix2Xd& flat,
                         const std::optional<Eigen::Vector2d>& rolling = {});

/// The turn of it alone.
Eigen::Matrix2d upright_turn(const TriMesh& part, const Eigen::Matrix2Xd& flat,
                             const std::optional<Eigen::Vector2d>& rolling = {});

} // namespace spia
