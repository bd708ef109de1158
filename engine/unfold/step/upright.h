#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A blank as it lies straight on the sheet: turned in its plane, its box from (0, 0) on. Along x
/// lies
/// - the rolling direction, where one is given;
/// - else the direction of the longest straight edges (together a quarter of the outline or more;
///   those square to them count),
/// - else a side of the smallest box that has one along an edge of the outline;
/// the latter two with the longer side of the box along x. Of the two ways round (four where the
/// box is square or edges do not tell) that one is taken which has the larger second moment along
/// x, then the sheet's middle below that of the box, then left of it, then likewise by its third
/// moments: a rule of the shape alone, so that it does not depend on how the part lay or is
/// numbered. What is symmetric in all this is the same shape either way round, and lies as near as
/// it can to how it came.
/// @param flat    2 by #V, mm
/// @param rolling in the plane of `flat`, not zero
Eigen::Matrix2Xd upright(const TriMesh& part, const Eigen::Matrix2Xd& flat,
                         const std::optional<Eigen::Vector2d>& rolling = {});

/// The turn of it alone.
Eigen::Matrix2d upright_turn(const TriMesh& part, const Eigen::Matrix2Xd& flat,
                             const std::optional<Eigen::Vector2d>& rolling = {});

/// Shapes of a blank while it converges, each laid as it is to be seen: the first one straight, by
/// the rule of upright(), and the others as near to the one before as a turn brings them, so that
/// none jumps. The result by the rule itself may lie another way round where the shape is nearly
/// symmetric, or round.
class LiveUpright {
public:
    /// @param part  must outlive it
    /// @param seen  2 by #V, mm, in the axes of the shapes: where the result is brought before it
    /// is laid straight, which decides for a
    ///              symmetric one; the part seen along the stamping direction
    /// @param rolling  as for upright()
    LiveUpright(const TriMesh& part, const Eigen::Matrix2Xd& seen, const std::optional<Eigen::Vector2d>& rolling);

    Eigen::Matrix2Xd operator()(const Eigen::Matrix2Xd& flat);

private:
    void look_at(const Eigen::Matrix2Xd& shape);

    const TriMesh& part_;
    std::optional<Eigen::Vector2d> rolling_;
    std::vector<std::vector<int>> loops_; ///< of the part's boundary
    Eigen::VectorXd mass_;                ///< per vertex, its share of the area
    Eigen::Matrix2Xd seen_;               ///< the shape before about its middle, each vertex times
                                          ///< its mass
    bool any_ = false;                    ///< a shape was seen
};

} // namespace spia
