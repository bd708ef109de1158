#pragma once
#include <span>
#include <string>
#include <vector>

#include "engine/exchange/deck/deck.h"
#include "engine/mesh/soup.h"

namespace spia {

/// Shells taken from a deck as the faces of one part.
struct DeckChoice {
    PolygonSoup soup;                     ///< in the unit of the deck; only nodes that are used
    std::vector<int> element;             ///< per face its index in the deck, ascending
    std::vector<int> node;                ///< per vertex its index in the deck, ascending
    std::optional<double> thickness = {}; ///< in the unit of the deck; only if all have the same
    std::string material = {};            ///< only if all have the same
    std::vector<std::string> notes = {};
};

/// Takes the shells of parts by id or name, or of sets by name; all shells if nothing is wanted.
/// Upper and lower case are equal unless that makes a name ambiguous.
/// @throws InputError if there is no such part or several, it has no shells, or shells of it lack a
/// node
DeckChoice choose_parts(const Deck& deck, std::span<const std::string> wanted);

/// One line for each part with shells, as messages show it; of many the first ones.
std::string part_list(std::span<const DeckPart> parts);

/// "3 Hood   240 shells, 1.2 thick, DC04"
std::string describe(const DeckPart& part);

/// "3 Hood": what a part is called.
std::string title(const DeckPart& part);

} // namespace spia
