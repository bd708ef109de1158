#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/exchange/length_unit.h"

namespace spia {

/// Shell elements of a deck that belong together: a part (LS-DYNA, Radioss), a property (Nastran), a shell section or
/// element set (Abaqus), a physical group or a surface (Gmsh).
struct DeckPart {
    std::optional<std::int64_t> id = {};               ///< Abaqus has none
    std::string name = {};                             ///< empty if the deck gives none
    std::optional<double> thickness = {};              ///< in the unit of the deck
    std::string material = {};                         ///< its title, else the keyword that defines it; empty: none
    std::optional<std::int64_t> material_id = {};      ///< in the deck
    int elements = 0;                                  ///< shells with all their nodes
    int broken = 0;                                    ///< shells that name a node that is not there; they are left out
    std::int64_t broken_element = 0, missing_node = 0; ///< of the first of these, their ids
};

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
    std::vector<double> thickness = {};     ///< #E, mean of the element's own at its corners, 0: it has none; or empty
    std::vector<DeckPart> parts;            ///< also those without shells; in the order in which they are first named
    std::vector<DeckSet> sets;
    std::vector<std::string> notes; ///< what was passed over, left out, or deserves a word
    bool copies = false; ///< some shells are moved copies: nodes of edges that they share with others are apart
    std::vector<std::string> doubts = {}; ///< those of the notes after which shells may be missing

    int elements() const { return int(corner.size()); }
    int nodes() const { return int(position.size()); }
};

} // namespace spia
