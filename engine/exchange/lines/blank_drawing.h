#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/exchange/lines/blank_outline.h"
#include "engine/exchange/lines/outline_curves.h"
#include "engine/mesh/solid/marks/mark_line.h"

namespace spia {

/// A bend as a press brake needs it, mm in the plane of the blank.
struct DrawnBend {
    std::string name;        ///< e.g. "bend 1"
    double angle = 0;        ///< radians, above 0: by how much the sheet turns
    double inner_radius = 0; ///< mm, on the hollow side; 0: sharp
    /// Which fibre has the length of the blank: K x thickness from the hollow side. None: a sharp
    /// fold, which has no arc.
    std::optional<double> k = 0.5;
    bool up = false;                      ///< seen on the blank as it is drawn the legs come
                                          ///< towards the eye
    std::vector<Eigen::Matrix2Xd> middle; ///< along the bend, where it is bent: lines of two points
                                          ///< or more
    std::vector<Eigen::Matrix2Xd> zone;   ///< where the bend begins and ends
    double allowance = 0;                 ///< mm, of the blank that the bend takes; 0: not known
    double deduction = 0;                 ///< mm, see SheetBend; told with the allowance
};

/// What is scribed or sunk and not cut, mm in the plane of the blank, whose face is the outer skin
/// of the sheet.
struct DrawnMark {
    Eigen::Matrix2Xd line; ///< two points or more; a closed one ends where it begins
    MarkLabel label = {};
};

/// All that is drawn of a blank, mm.
struct BlankDrawing {
    std::vector<OutlineLoop> loops; ///< the outline, then the holes: blank_outline()
    std::vector<DrawnBend> bends = {};
    std::vector<DrawnMark> marks = {};
    std::vector<std::vector<StatedPiece>> stated = {}; ///< per loop what a CAD file says of it;
                                                       ///< empty: nothing of any
    std::string lengths_of = {};                       ///< which surface of the sheet, "neutral
                                                       ///< fibre, K 0.44"; empty: not told
    double thickness = 0;                              ///< mm, of the flat sheet; 0: not told
};

} // namespace spia
