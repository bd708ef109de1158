#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

namespace spia {

/// What a CAD file says of an edge, where that is simple enough to hold exactly.
struct StatedCurve {
    enum class Kind : int { other, line, circle };
    Kind kind = Kind::other;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();     ///< mm, on the line, or the centre
    Eigen::Vector3d direction = Eigen::Vector3d::Zero(); ///< unit, of the line, or of the axis;
                                                         ///< either way along it
    double radius = 0;                                   ///< mm, of the circle
};

/// Lines and circles of a CAD file, and which edges of its triangles are chords of them.
struct StatedCurves {
    std::vector<StatedCurve> curve;
    std::vector<std::array<int, 3>>
        chord; ///< two vertices of the file, the lower one first, and the index of the curve;
               ///< ascending

    /// The curve that an edge of the triangles is a chord of; -1: none. @param a, b vertices of the
    /// file
    int of(int a, int b) const;

    /// Numbers the vertices anew. @param number  per vertex
    void renumber(const std::vector<int>& number);
};

} // namespace spia
