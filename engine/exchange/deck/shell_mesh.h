#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/length_unit.h"

namespace spia {

/// Elements of a solver deck that belong together, with the number that decks want.
struct ShellPart {
    std::int64_t id = 1;
    std::string name = {};     ///< may be empty
    std::string material = {}; ///< what the deck calls it; may be empty
    std::int64_t material_id = 1;
    double thickness = 0; ///< of the flat sheet, in the unit of the mesh; 0: not the same
                          ///< everywhere
};

/// Nodes and shells with the ids of a solver deck, ready to be written; all nodes are used.
struct ShellMesh {
    LengthUnit unit = LengthUnit::mm;
    std::vector<std::int64_t> node;         ///< #N ids, each once
    Eigen::Matrix3Xd position;              ///< 3 by #N, in the unit
    std::vector<std::array<int, 4>> corner; ///< #E, different nodes; the last is -1 in a triangle
    std::vector<std::int64_t> element;      ///< #E ids, each once
    std::vector<int> part_of;               ///< #E, index into parts
    std::vector<ShellPart> parts;           ///< those that have elements
    std::vector<std::string> notes = {};    ///< what differs from the deck

    int nodes() const { return int(node.size()); }
    int elements() const { return int(element.size()); }
    size_t corners(int e) const { return corner[size_t(e)][3] < 0 ? 3 : 4; }
};

} // namespace spia
