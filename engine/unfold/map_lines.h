#pragma once
#include <span>
#include <string>
#include <vector>

#include "engine/unfold/sheet_lines.h"

namespace spia {

/// Lines that were carried over, and what could not be.
struct MappedLines {
    std::vector<SheetLine> lines;      ///< in the order given
    std::vector<std::string> left_out; ///< which line, where and why; a line that leaves the sheet
                                       ///< is left out whole
};

/// Lines drawn on the blank, on the part; they gain a point wherever they cross an edge of the
/// mesh, and so lie on the part everywhere.
/// @param flat 2 by #V, mm: the blank
/// @param lines points with x and y in the blank; z has no meaning
/// @throws InputError if the blank is none of this part
MappedLines to_part(const TriMesh& part, const Eigen::Matrix2Xd& flat, std::span<const SheetLine> lines);

/// Lines that lie on the part, on the blank. Between its points a line follows the part where that
/// is nearest; where the sheet is folded onto itself that may be its other layer. One that is
/// farther from the part than half a percent of its diagonal, or jumps from one place of the blank
/// to another, is left out.
/// @throws InputError as above
MappedLines to_blank(const TriMesh& part, const Eigen::Matrix2Xd& flat, std::span<const SheetLine> lines);

/// One line. @throws InputError also if it leaves the sheet, naming the point
SheetLine to_part(const TriMesh& part, const Eigen::Matrix2Xd& flat, const SheetLine& line);
SheetLine to_blank(const TriMesh& part, const Eigen::Matrix2Xd& flat, const SheetLine& line);

} // namespace spia
