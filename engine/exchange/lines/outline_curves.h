#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/exchange/lines/blank_outline.h"

namespace spia {

/// A piece of an outline, from one of its points on.
struct OutlinePiece {
    enum class Kind {
        line,   ///< straight to the last point
        arc,    ///< of a circle, to the last point
        points, ///< neither: the points themselves
    };
    Kind kind;
    int first;        ///< point of the loop
    int edges;        ///< to the last point, which is the first of the next piece
    double bulge = 0; ///< of an arc: tangent of a quarter of its angle, positive counter-clockwise,
                      ///< as DXF counts
};

/// What a CAD file says of a run of edges of an outline.
struct StatedPiece {
    OutlinePiece::Kind kind;                          ///< line or arc
    int first;                                        ///< point of the loop
    int edges;                                        ///< all of the loop: a circle
    Eigen::Vector2d centre = Eigen::Vector2d::Zero(); ///< mm, of an arc; both ends are as far from
                                                      ///< it as the radius
    double radius = 0;
};

/// What a closed polygon stands for.
struct OutlineCurves {
    bool circle = false; ///< all of it is one; there are no pieces then
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    double radius = 0;
    std::vector<OutlinePiece> pieces; ///< each edge in one, in order; one of points alone goes all
                                      ///< around
};

/// Finds circles, arcs and lines in an outline: runs of its points that lie on one. First within
/// `exact`, in which the points of a CAD file's edges lie on their circle, so that it is found as
/// it was; then, among what is left, within the tolerance. A chord spans 35 degrees of its circle
/// at most (20 where it is not exact): a polygon with eight corners is one, a circle of STL files
/// has twelve chords or more. An arc has three chords or more (five where it is not exact), all of
/// which turn the same way. The ends of pieces are points of the outline, so that the pieces join.
/// What is stated comes first and is taken as it is, however many chords it has; lines are joined
/// to those that go on from them.
/// @param exact, tolerance  mm, largest distance of a point from its curve
/// @param stated  no edge in two of them
OutlineCurves find_curves(const OutlineLoop& loop, double exact, double tolerance,
                          std::span<const StatedPiece> stated = {});

/// Centre of the arc from a to b; its radius is the distance from either. @param bulge not 0
Eigen::Vector2d arc_centre(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double bulge);

} // namespace spia
