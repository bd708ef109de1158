#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "engine/mesh/tri_mesh.h"

/// Surfaces of revolution around z. Seen from above (+z) the triangles around the pole are
/// counter-clockwise.
namespace spia::shapes {

struct AxisymmetricPart {
    TriMesh mesh;
    Eigen::VectorXd arc_length; ///< #V, mm along the meridian from its first point
    std::vector<int> rim;       ///< the outermost row of vertices, counter-clockwise from above
};

/// Rows of vertices on the meridian, about as far apart as the vertices within a row.
/// @param meridian   2 by #points (r, z), mm, from the axis outwards; r = 0 first gives a pole, r >
///         0 an inner edge. Between points it is straight; where it turns by more than 20 degrees
///         it keeps a row of vertices.
/// @param triangles  wanted number; the actual one is within 10 %, from 5,000 on within 3 %
AxisymmetricPart axisymmetric(const Eigen::Matrix2Xd& meridian, int triangles);

/// Reads the columns r_mm,z_mm of a CSV file. @throws InputError naming the line
Eigen::Matrix2Xd read_meridian(const std::filesystem::path& file);

/// A flat bottom, a vertical wall below it, a sharp edge between. Without friction no force acts
/// along the wall: the bottom stays as it is and the wall is compressed around only. For any
/// hardening curve the radius of the blank is rw (1 + (1 + m) H / rw)^(1 / (1 + m)) with m = r / (1
/// + r) and r the normal anisotropy.
struct SharpCup {
    double radius = 40; ///< mm, of the bottom and the wall
    double height = 30; ///< mm, of the wall
    int triangles = 10000;

    double area() const;
};
AxisymmetricPart sharp_cup(const SharpCup& shape = {});

/// A spherical cap that runs through a die radius into a flat flange. The pole is the highest
/// point, the flange z = 0.
struct Dome {
    double radius = 50;         ///< mm, of the sphere
    double die_radius = 10;     ///< mm
    double wall_angle_deg = 80; ///< slope where sphere and die radius meet; up to 90
    double flange_width = 25;   ///< mm, flat
    int triangles = 10000;

    double area() const;
};
AxisymmetricPart dome(const Dome& shape = {});

/// A cap of a sphere, cut by a plane; the pole is the highest point, z = 0 the plane of the cut.
struct SphereCap {
    double radius = 50;         ///< mm
    double half_angle_deg = 60; ///< between the axis and the rim, seen from the centre; 90 is a
                                ///< hemisphere
    int triangles = 5000;

    double area() const;
};
AxisymmetricPart sphere_cap(const SphereCap& shape = {});

} // namespace spia::shapes
