#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/part/deck_part.h"

namespace spia {

/// A named choice of shells, which may overlap with others (Abaqus: *ELSET).
struct DeckSet {
    std::string name;
    std::vector<int> elements; ///< indices, ascending
    int broken = 0;            ///< shells that name a node that is not there; they are left out
};

/// Nodes and shell elements of a solver deck, in the order of its files.
struct Deck {
    std::string format;                     ///< for people, e.g. "Nastran bulk data"
    std::optional<LengthUnit> unit = {};    ///< only Radioss names one
    std::vector<Eigen::Vector3d> position;  ///< #N, in the unit of the deck
    std::vector<std::int64_t> node;         ///< #N ids
    std::vector<std::array<int, 4>> corner; ///< #E, indices of nodes; the last is -1 in a triangle
    std::vector<std::int64_t> element;      ///< #E ids
    std::vector<int> part_of;               ///< #E, index into parts
    std::vector<double> thickness = {};     ///< #E, mean of the element's own at its corners, 0: it
                                            ///< has none; or empty
    std::vector<DeckPart> parts;            ///< also those without shells; in the order in which
                                            ///< they are first named
    std::vector<DeckSet> sets;
    std::vector<std::string> notes;       ///< what was passed over, left out, or deserves a word
    bool copies = false;                  ///< some shells are moved copies: nodes of edges that
                                          ///< they share with others are apart
    std::vector<std::string> doubts = {}; ///< those of the notes after which shells may be missing

    int elements() const { return int(corner.size()); }
    int nodes() const { return int(position.size()); }
};

} // namespace spia
