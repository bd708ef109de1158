#pragma once
#include <filesystem>

namespace spia {

/// What lies between two squares of 20 mm in a row along x, in the plane z = 0, as face 1.
enum class ThirdFace {
    none,
    torn,  ///< its border is far from its surface
    sliver ///< between both, widest at 20, 10, 0
};
constexpr double sliver_width = 1e-9; // mm

/// Writes them as BREP.
void write_two_squares(const std::filesystem::path& brep, ThirdFace third);

/// mm2, as OpenCASCADE makes the faces of an IGES file when it is told to use curves of one kind
/// only.
/// @param mode  -2: those in the parameters of surfaces, -3: those in space
double area_by_curves(const std::filesystem::path& iges, int mode);

/// Between the halves of a plate of 200 x 100 mm, at x = 100.
enum class Between {
    gap, ///< all along
    slit ///< from the middle, y = 50, to the rim: one edge is common
};

/// Writes two faces with that many holes each, 30 at most, as BREP; the gap or slit is `width` mm
/// wide.
void write_perforated_halves(const std::filesystem::path& brep, int holes, Between between, double width);

/// How a face of a cylinder about z, radius 10, comes to be.
enum class Swept { line_up, line_down, circle_up, circle_down };

/// Writes it as BREP, from -1 to 1 rad about z and from z = 0 to 30.
void write_swept_cylinder(const std::filesystem::path& brep, Swept swept);

/// Writes a whole cylinder about z as BREP, of one face with a seam: radius 10, from z = 0 to 30.
/// @param version  1, 2 or 3 of the format
/// @param triangles  written, too
void write_tube(const std::filesystem::path& brep, int version, bool triangles);

/// Writes a square of 20 mm with an edge in it that bounds nothing (its orientation is INTERNAL) as
/// BREP.
void write_square_with_inner_edge(const std::filesystem::path& brep);

/// Writes a quarter of a cup as BREP: its flat bottom from radius 20 to 96, a round of radius 4 and
/// a wall of 60 mm, revolved about z.
void write_cup_quarter(const std::filesystem::path& brep);

} // namespace spia
