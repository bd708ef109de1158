#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"
#include "tests/support/region.h"

/// Plain shapes, and shapes that a stage must refuse. Parts with a name of their own: revolved.h,
/// square_cup.h, developable.h, inner_panel.h, fender.h.
namespace spia::shapes {

/// A flat rectangle in the xy plane, columns x rows cells of two triangles.
TriMesh rectangle(double width, double height, int columns, int rows);

/// A flat rectangle with round holes, its lower left corner in the origin.
struct Plate {
    double width = 120, height = 80; ///< mm
    std::vector<Circle> holes = {{{35, 40}, 12}, {{85, 40}, 12}};
    int triangles = 4000;

    double area() const;
};
TriMesh plate(const Plate& shape = {});

/// z = (x^2 - y^2) / (2 radius) over a square around the origin: negative Gaussian curvature
/// everywhere.
struct Saddle {
    double side = 100;   ///< mm
    double radius = 120; ///< mm, of both curvatures in the middle
    int triangles = 4000;
};
TriMesh saddle(const Saddle& shape = {});

/// @name Not sheets
///@{
TriMesh closed_sphere(double radius, int triangles);             ///< no boundary
TriMesh torus(double radius, double tube_radius, int triangles); ///< no boundary, genus 1
/// its orientations clash somewhere
TriMesh moebius_strip(double radius, double width, int triangles);
TriMesh two_rectangles(); ///< two components
///@}

} // namespace spia::shapes
