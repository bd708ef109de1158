#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace spia {

/// Shell elements of a deck that belong together: a part (LS-DYNA, Radioss), a property (Nastran),
/// a shell section or element set (Abaqus), a physical group or a surface (Gmsh).
struct DeckPart {
    std::optional<std::int64_t> id = {};               ///< Abaqus has none
    std::string name = {};                             ///< empty if the deck gives none
    std::optional<double> thickness = {};              ///< in the unit of the deck
    std::string material = {};                         ///< its title, else the keyword that defines
                                                       ///< it; empty: none
    std::optional<std::int64_t> material_id = {};      ///< in the deck
    int elements = 0;                                  ///< shells with all their nodes
    int broken = 0;                                    ///< shells that name a node that is not
                                                       ///< there; they are left out
    std::int64_t broken_element = 0, missing_node = 0; ///< of the first of these, their ids
};

} // namespace spia
