#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/pick.h"
#include "engine/mesh/solid/border/askew_wall.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A place of the border of a middle surface; unit vectors.
struct BorderPlace {
    Eigen::Vector3d place, normal, outward;
};

/// A solid, as lines square to its sheet through half the thickness on both sides cut it.
class SheetSection {
public:
    /// Keeps a reference to the solid. @param thickness  mm
    SheetSection(const TriMesh& solid, double thickness);

    /// Whether the line through a place so far outwards meets matter. Beyond the border the faces
    /// of another leg that lies on this one do not count; before it a knife edge at a skin does.
    bool matter(const BorderPlace& at, double outwards) const;

    /// Whether matter begins within the tolerance inwards, if only that of a thin web, and none is
    /// beyond, if only across a slit.
    bool ends(const BorderPlace& at, double tolerance) const;

    /// Whether what is beyond the place is another leg that passes by at another height, as beside
    /// the root of a tongue that was sheared and bent out of the sheet without a gap: both skins
    /// step the same way, more steeply than sheet is bent within the tolerance.
    bool steps_to_another_leg(const BorderPlace& at, double tolerance) const;

    /// Where the solid ends from a place outwards, mm, < 0: before it; `most` at most.
    /// @param first  mm, the least that is looked at @param digits  of a binary fraction
    double to_the_end(const BorderPlace& at, double first, double most, int digits) const;

    /// How far the walls beside a place may be from the arcs that they stand for, mm: the height of
    /// an arc over the chord that is one facet. Those of roundings along the border do not count.
    double facets(const BorderPlace& at, double within) const;

    /// Whether the place is on a wall that crosses the whole sheet askew: the wall goes on most of
    /// the way to the skin, or less and less of the solid is left on the way to where it ends, and
    /// that at a skin. Of a chamfer or a sink the wall beyond it is left.
    /// @param end  mm outwards, where the solid ends
    bool halfway_along_a_wall(const BorderPlace& at, double end, double within) const;

    /// mm outwards, to where a wall that crosses the whole sheet askew crosses its middle; nothing
    /// if none faces outwards there.
    std::optional<double> to_askew_wall(const BorderPlace& at) const;

    /// Whether a wall square to the sheet, within half the thickness of a place, faces outwards and
    /// lies in a plane so near to it: that of a deep chamfer is above or below.
    bool square_wall(const BorderPlace& at, double within) const;

private:
    /// Whether the wall of a triangle crosses the sheet askew, or where it is square to that the
    /// one that it goes over into: of a hole drilled askew two strips are.
    bool crosses_askew(int face, const SheetPlane& sheet) const;
    /// @param half  mm, of the line
    bool matter(const Eigen::Vector3d& place, const Eigen::Vector3d& half) const;
    Eigen::Matrix3d corners(int face) const;
    Eigen::Vector3d normal(int face) const;
    std::vector<int> near(const Eigen::Vector3d& place, double within) const;

    const TriMesh& solid_;
    Eigen::Matrix3Xi neighbour_; ///< as face_neighbours() says
    RayPicker rays_;
    double half_;             ///< mm
    bool inside_out_ = false; ///< its normals lead inwards
};

} // namespace spia
