#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace spia {

/// A straight piece of a line in the plane of the blank, mm.
struct BlankSegment {
    Eigen::Vector2d from, to;
};

/// One bend of a part: a zone of its sheet that lies on a cylinder, and the strip of the blank that
/// it is bent from; or a sharp fold, where two planes meet without a radius.
struct SheetBend {
    double inner_radius = 0; ///< mm, on the hollow side of the sheet
    double angle = 0;        ///< radians, above 0: by how much the sheet turns; 0 is flat, pi a hem
    /// Which fibre has the length of the blank's strip: it lies K x thickness from the inner side.
    /// 0.5: the middle surface; where a skin was asked for 0 or 1, as that skin lies.
    double k = 0.5;
    /// mm, angle x (inner radius + K x thickness): the breadth of the strip in the blank. Of a
    /// sharp fold what the blank has of both legs beyond where they part on the inner side, 2 K
    /// thickness tan(angle / 2).
    double allowance = 0;
    /// mm, what the sum of both legs is longer by than the blank: 2 (inner radius + thickness)
    /// tan(angle / 2) - allowance, the legs measured to where their outer sides meet; beyond 90
    /// degrees 2 (inner radius + thickness) - allowance, the legs measured to the tangents (DIN
    /// 6935).
    double deduction = 0;
    double length = 0;   ///< mm, along the bend: all of `line`
    bool up = false;     ///< seen on the blank as it is drawn (faces counter-clockwise) the legs
                         ///< come towards the eye
    bool stated = false; ///< the radius is that of the CAD file's cylinder; else of a circle
                         ///< through the vertices
    bool laid = false;   ///< the strip of the blank is `allowance` broad; else it is as the mesh
                         ///< has it, and `why_not` says why
    std::string why_not;
    std::string way_out; ///< of what is not laid: what one can do
    bool sharp = false;  ///< no radius: its inner radius is 0, and K tells which surface of the
                         ///< sheet was laid flat
    Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< mm, on the part, in the middle of the bend
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< unit, along the bend
    /// In the middle of the strip, along it: where a press brake bends. Several pieces where a hole
    /// or a notch parts it.
    std::vector<BlankSegment> line;
    std::vector<int> faces; ///< of the part's mesh, and of the blank: its zone, ascending; of a
                            ///< sharp fold those along it
};

/// All bends of a part, in the order of their first faces, the sharp ones last, and what the
/// lengths of its blank are lengths of.
struct BendTable {
    double thickness = 0;  ///< mm
    bool of_middle = true; ///< the part's mesh is the middle surface; else one of the skins
    std::string surface;   ///< "neutral fibre, K 0.44", "middle surface, K 0.5", "outer skin" ...
    std::vector<SheetBend> bends;
    std::vector<std::string> kept;        ///< bends that are not laid, in words: they keep the lengths of
                                          ///< the triangles
    std::vector<std::string> notes;       ///< where else the K factor has no effect
    std::vector<std::string> doubts = {}; ///< where bends may have no row
};

} // namespace spia
