#pragma once
#include <string>
#include <vector>

#include "engine/mesh/topology.h"
#include "engine/unfold/plan/bends.h"

namespace spia {

/// A line on a mesh: straight from point to point, every point on it.
struct SheetLine {
    std::string name;
    Eigen::Matrix3Xd point; ///< mm; of a line in the plane z = 0
    bool closed = false;    ///< from the last point back to the first
};

double length(const SheetLine& line); ///< mm

/// @throws InputError unless there is a finite place of the blank for each vertex of the part
void require_flat(const TriMesh& part, const Eigen::Matrix2Xd& flat);

/// Where faces end at the part's own edge, in a state of it: after a step of the freed faces the
/// developed edge of the flange, a trim line on the target surface. In the order of their smallest
/// vertices.
/// @param state 3 by #V, mm
std::vector<SheetLine> trim_lines(const TriMesh& part, const Eigen::Matrix3Xd& state, const FaceSet& freed);

/// Where to bend a blank: of a bend between two regions its first and its last line ("bend 1,
/// region 2") and the line in the middle between them ("bend 1"); of a sharp one the edge itself. A
/// hole or a corner may part a line into several.
/// @param map of the part; @param flat 2 by #V, mm: the blank
std::vector<SheetLine> bend_lines(const TriMesh& part, const BendMap& map, const Eigen::Matrix2Xd& flat);

} // namespace spia
