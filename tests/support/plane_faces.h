#pragma once
#include <array>
#include <functional>
#include <map>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia::shapes {

using Loop = std::vector<Eigen::Vector3d>; ///< corners, the last one joined to the first
using PlaneLoop = std::vector<Eigen::Vector2d>;

/// Triangles of a polygon with holes, few and long, as exporters of STL files make them: ear
/// clipping. The loops' corners in a row have the numbers of the triangles. @param outer
/// counter-clockwise; @param holes clockwise
std::vector<std::array<int, 3>> long_triangles(const PlaneLoop& outer, const std::vector<PlaneLoop>& holes);

/// A surface of plane faces. Corners at one place, to 1e-9 mm, are one vertex.
class PlaneFaces {
public:
    /// @param outer  counter-clockwise seen from outside; @param holes  clockwise
    void add(const Loop& outer, const std::vector<Loop>& holes = {});
    TriMesh mesh() const;

private:
    std::vector<Eigen::Vector3d> position_;
    std::vector<std::array<int, 3>> triangle_;
    std::map<std::array<long long, 3>, int> number_;

    int vertex(const Eigen::Vector3d& place);
};

/// Each triangle in four, so many times.
TriMesh divided(TriMesh mesh, int times);

/// A section and its holes in the xz plane, extruded from y = 0 to the length. @param outer
/// counter-clockwise with z up and x to the right
TriMesh extruded(const PlaneLoop& outer, const std::vector<PlaneLoop>& holes, double length);

/// The section of a profile that is thickened to its right; arcs have so many chords for each 90
/// degrees.
struct ProfilePiece {
    double length = 0;            ///< mm, of a straight piece
    double radius = 0, angle = 0; ///< of the inner side of a bend, mm; radians, positive to the
                                  ///< left
};
PlaneLoop sheet_section(const std::vector<ProfilePiece>& pieces, double thickness, int chords);

/// The section of flats of one width that are folded without a radius by one angle, which is theirs
/// on the middle line: mitred.
/// @param angle  radians, positive to the left
PlaneLoop folded_section(int flats, double width, double angle, double thickness);

PlaneLoop circle(const Eigen::Vector2d& middle, double radius, int corners, bool clockwise);

/// A meridian from pole to pole, (radius, height), turned around the z axis; its first and last
/// radius are 0.
TriMesh turned(const PlaneLoop& meridian, int around);

} // namespace spia::shapes
