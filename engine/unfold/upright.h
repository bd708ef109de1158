#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

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

/// Lays the shapes that a solve goes through straight, one after the other, so that the last one lies as upright() lays the result.
/// Where the rule hardly tells two ways round apart it stays with that of the shape before: a nearly symmetric blank does not
/// turn over and back while it converges.
class LiveUpright {
public:
    /// @param part  must outlive it
    /// @param seen  2 by #V, mm, in the axes of the shapes: where the result is brought before it is laid straight, which decides for a
    ///              symmetric one; the part seen along the stamping direction
    /// @param rolling  as for upright()
    LiveUpright(const TriMesh& part, Eigen::Matrix2Xd seen, const std::optional<Eigen::Vector2d>& rolling);

    Eigen::Matrix2Xd operator()(const Eigen::Matrix2Xd& flat);

private:
    const TriMesh& part_;
    Eigen::Matrix2Xd seen_; ///< about its middle, each vertex times its area
    std::optional<Eigen::Vector2d> rolling_;
    std::vector<std::vector<int>> loops_; ///< of the part's boundary
    std::optional<Eigen::Matrix2d> turn_; ///< of the shape before
};

} // namespace spia
