#pragma once
#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace spia {

/// Splits one polygon into n - 2 triangles without new points; the triangles have its orientation.
/// A quad takes its shorter diagonal unless that one folds it over or makes a triangle with less
/// than 1 degree. Of a longer polygon the least angle is as large as can be; one of more than 32
/// corners loses, one after the other, the ear with the largest least angle. Non-planar polygons
/// are judged in the plane of their Newell normal.
/// @param corners  at least three points in order around the polygon
/// @returns indices into corners; empty if the polygon crosses itself. A polygon without area gives
/// a fan.
std::vector<std::array<int, 3>> split_polygon(std::span<const Eigen::Vector3d> corners);

} // namespace spia
