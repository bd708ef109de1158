#pragma once
#include <string>
#include <vector>

#include "engine/nurbs/multi_patch.h"

/// Patches that meet in every way in which four-sided patches can.
namespace spia::patches {

/// The same points at (1 - u, v).
NurbsSurface mirrored_u(const NurbsSurface& surface);
/// The same points at (v, u).
NurbsSurface exchanged(const NurbsSurface& surface);

/// A doubly curved patch, bicubic along u and of another degree along v, uneven knots, size in mm.
/// @param rational  uneven weights
NurbsSurface curved(double size, bool rational);

/// A second patch that goes on beyond u = 1 of the first; its side u = 0 is that side to the last
/// bit.
NurbsSurface beyond(const NurbsSurface& first);

struct Sample {
    std::string name;
    MultiPatch patches;
};

/// One patch; two, whose parameters run the same way, against each other, u along v, u against v; a
/// rational one beside a polynomial one; five around a corner; each polynomial and rational.
std::vector<Sample> samples();

/// Radians, between the normals of two patches at their common sides, as the certificate measures
/// it.
double greatest_angle(const MultiPatch& patches);

} // namespace spia::patches
