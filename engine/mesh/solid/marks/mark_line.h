#pragma once
#include <Eigen/Core>

namespace spia {

/// What a line is of that is drawn on sheet and not cut.
struct MarkLabel {
    enum class Kind { mark, countersink, counterbore };

    Kind kind = Kind::mark;
    bool outer = true, inner = false;    ///< on which skins it is
    double wide = 0, deep = 0, hole = 0; ///< mm, of what is sunk, at the skin, and the least
                                         ///< diameter; 0: not known

    bool operator==(const MarkLabel&) const = default;
};
const char* name(MarkLabel::Kind kind);

/// A row of points on a surface of the sheet, 3 by #points, mm; a closed one ends where it begins.
struct MarkLine {
    Eigen::Matrix3Xd point;
    MarkLabel label;
};

} // namespace spia
