#pragma once
#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "engine/layout/layout.h"

namespace spia {

inline constexpr double same_place = 1e-9; ///< over the length of an arc: a place so near to one of
                                           ///< its points is this point

/// A line on which sides of patches have to stay: a piece of the border or of kept curves, from
/// one fixed vertex to the next, or a closed line without fixed vertices.
struct Arc {
    Eigen::Matrix2Xd plane;            ///< 2 by #points, mm, on the blank; of a closed arc the first
                                       ///< point comes last again
    Eigen::Matrix3Xd part;             ///< 3 by #points, mm, on the part: of the border; else empty
    std::vector<double> length;        ///< mm on the blank, from the start to each point
    std::array<int, 2> end = {-1, -1}; ///< fixed vertices of the layout where it begins and ends;
                                       ///< -1: it is closed without any
    std::vector<double> kink;          ///< mm, where it turns by more than the facet of a fine mesh
    int line = -1;                     ///< arcs of one closed line (a loop of the border, a closed
                                       ///< kept line) have the same; -1: of an open line

    bool border() const { return part.cols() > 0; }
    bool closed() const { return end[0] < 0; }
    double whole() const { return length.back(); }
    /// The place at a length, mm; of a closed arc up to once around more.
    Eigen::Vector2d at(double s) const;
    /// Between two lengths, the shorter way.
    double distance(double a, double b) const;
    /// The arc between two lengths, from < to (of a closed arc: to <= from + whole()), on the blank
    /// and, of the border, on the part. Its own points are kept to the last bit.
    std::pair<Eigen::Matrix2Xd, Eigen::Matrix3Xd> piece(double from, double to) const;
};

/// Where a vertex of a layout is on the arcs: nowhere, within one, or at the ends of some.
struct OnArcs {
    bool fixed = false;
    int arc = -1;                                       ///< that it lies within
    double s = 0;                                       ///< mm, from the start of that arc
    Eigen::Vector2d position = Eigen::Vector2d::Zero(); ///< mm; the layout's, but of one that comes
                                                        ///< to a corner
};

/// The lines of a layout along which vertices may slide, and those that may not move.
struct Arcs {
    std::vector<Arc> arc;
    std::vector<OnArcs> vertex; ///< per vertex of the layout
    int lines = 0;              ///< closed ones
};

/// Which places of the border are corners of patches.
struct CornerOptions {
    double angle = 0.87;  ///< radians by which the border turns there at least
    double radius = 1e30; ///< mm: corners rounded by more are arcs, on which vertices may slide
};

/// Vertices of the part at the corners of its border: the sharpest places of stretches that turn
/// so much on the blank.
std::vector<int> border_corners(const TriMesh& part, const Blank& blank, const CornerOptions& options);

/// Chains the border and the kept curves of a layout to arcs. Fixed are corners of the border, to
/// which the next vertex is moved if there is none, ends and junctions of kept curves, and places
/// where these turn as much.
Arcs arcs_of(const Layout& layout, const CornerOptions& options);

} // namespace spia
