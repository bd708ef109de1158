#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

struct ThinSolid;

/// What a CAD file says of a face, where that is simple enough to hold exactly; or what was
/// measured on a mesh (measured_cylinders()).
struct StatedSurface {
    enum class Kind : int { other, plane, cylinder };
    Kind kind = Kind::other;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();     ///< mm, on the plane or the axis
    Eigen::Vector3d direction = Eigen::Vector3d::Zero(); ///< unit, of the normal or the axis;
                                                         ///< either way along it
    double radius = 0;                                   ///< mm, of the cylinder
    double off = 0; ///< mm, how far vertices of the mesh lie off it that it was measured on; 0: it
                    ///< is stated
};

/// The surface's normal at a place on the side of `towards`; `towards` itself, unit, of a surface
/// of another kind.
Eigen::Vector3d normal_at(const StatedSurface& surface, const Eigen::Vector3d& place, const Eigen::Vector3d& towards);

/// mm, of parallel planes or coaxial cylinders; 0 where they are neither. @param size mm, of the
/// part: axes are told to six digits of it
double distance_between(const StatedSurface& a, const StatedSurface& b, double size);

/// mm2, of a triangle on the cylinder unrolled, seen along its normals from outside: below 0 where
/// its corners go around the other way.
/// @param corner  mm, one a column, less than half a turn apart
double unrolled_area(const StatedSurface& cylinder, const Eigen::Matrix3d& corner);

/// Whether two cylinders have one axis and one radius.
bool same_cylinder(const StatedSurface& a, const StatedSurface& b);

/// The thickness that CAD faces state: between parallel planes and coaxial cylinders, one on each
/// skin, that are about the measured thickness apart. Of several the one that the most area has.
/// The measured one where none is stated.
/// @param surface  per triangle of the solid
double stated_thickness(const TriMesh& solid, const ThinSolid& sheet, const std::vector<StatedSurface>& surface);

} // namespace spia
