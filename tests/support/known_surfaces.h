#pragma once
#include <functional>

#include "engine/coons/quad_grid.h"
#include "engine/nurbs/surface.h"

/// Surfaces with a known answer.
namespace spia::surfaces {

/// A grid of columns x rows cells, its nodes on place(s, t), s and t even from 0 to 1.
QuadGrid grid(int columns, int rows, const std::function<Eigen::Vector3d(double s, double t)>& place);

/// A quarter of a cylinder about the y axis, exactly round by its weights; S_u x S_v points away
/// from the axis.
NurbsSurface quarter_cylinder(double radius, double length);

/// Exactly the cylinder about the z axis between two angles, less than pi apart, from z = 0 up; S_u
/// x S_v points away from the axis.
NurbsSurface cylinder(double radius, double height, double from, double to);

/// One span of each degree, control points 0, weights 1.
NurbsSurface one_span(int degree_u, int degree_v);

/// Between the corners (0, 0), (1, 0), (0, 1) and (1, 1) of its parameters.
NurbsSurface bilinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& d);

/// The part of a sphere about the origin between 45 degrees left and right of the x axis (u) and 45
/// degrees below and above it (v), exactly round; S_u x S_v points outwards.
NurbsSurface sphere_patch(double radius);

/// A rational surface of no particular shape: degrees 3 and 2, uneven knots with one repeated,
/// uneven weights.
NurbsSurface crooked();

} // namespace spia::surfaces
