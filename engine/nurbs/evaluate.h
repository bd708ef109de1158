#pragma once
#include "engine/nurbs/surface.h"

namespace spia {

/// A surface and its derivatives at one place. Parameters have no unit: every vector is in mm.
struct SurfacePoint {
    Eigen::Vector3d position;
    Eigen::Vector3d S_u, S_v;
    Eigen::Vector3d S_uu, S_uv, S_vv;

    /// S_u x S_v as a unit vector; zero where the two are parallel or one is lost in the other's
    /// rounding (a collapsed side).
    Eigen::Vector3d normal() const;
};

/// Point and derivatives, weights included; (u, v) beyond the domain counts as the nearest place of
/// the domain. No allocation. [NURBS Book, eqs. 4.15, 4.20]
SurfacePoint evaluate(const NurbsSurface& surface, double u, double v);

} // namespace spia
