#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

namespace spia {

/// Two edges of an outline that have a point in common; each by its two vertices, in the direction
/// of its loop.
struct OutlineCrossing {
    std::array<int, 2> edge, other;

    friend bool operator==(const OutlineCrossing&, const OutlineCrossing&) = default;
};

/// Pairs of edges of closed polygons in the plane that cross: none if the sheet nowhere lies on
/// itself at its edge. To touch is not to cross: a vertex may lie on another one of the same
/// coordinates, or on an edge, as long as the way through it stays on one side, and the lips of a
/// slit may lie on each other vertex by vertex. Edges in one line that overlap otherwise count.
/// Exact (orient2d.h).
/// @param loops vertex indices; @param position 2 by #V
std::vector<OutlineCrossing> outline_crossings(const std::vector<std::vector<int>>& loops,
                                               const Eigen::Matrix2Xd& position);

/// How many there are.
int crossings(const std::vector<std::vector<int>>& loops, const Eigen::Matrix2Xd& position);

/// mm, of one closed polygon
double length(const std::vector<int>& loop, const Eigen::Matrix2Xd& position);

/// A closed polygon measured by its length.
class Outline {
public:
    /// @param loop vertex indices; @param position 2 by #V, mm
    Outline(const std::vector<int>& loop, const Eigen::Matrix2Xd& position);

    int size() const { return int(point_.size()); }
    double perimeter() const { return start_.back(); }
    /// from the start of the loop to its vertex i, mm
    double length_at(int i) const { return start_[size_t(i)]; }

    /// How much the outline turns to the left at vertex i, -pi to pi, between the chords of the
    /// given lengths (mm) of outline.
    double turning(int i, double before, double after) const;

private:
    Eigen::Vector2d at(double length) const;

    std::vector<Eigen::Vector2d> point_;
    std::vector<double> start_; // length up to each vertex; one more than vertices
};

} // namespace spia
