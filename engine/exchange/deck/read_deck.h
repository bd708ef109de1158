#pragma once
#include <filesystem>
#include <string>

#include "engine/core/progress.h"
#include "engine/exchange/deck/deck.h"
#include "engine/exchange/deck/deck_lines.h"

namespace spia {

/// Whether the ending (lower case, with its dot) is that of a solver deck: .k .key .dyn LS-DYNA
/// keyword, .bdf .nas .dat Nastran bulk data, .inp Abaqus and CalculiX, .msh Gmsh 2 and 4 (text),
/// .rad Radioss starter.
bool is_deck(std::string_view extension);

/// Reads nodes, shells, parts, thicknesses and material names of a deck and of the files that it
/// includes; what else is in it is passed over, and a note says so. A checkpoint every few thousand
/// lines.
/// @throws InputError  with line, and file if it is an included one
Deck read_deck(const std::filesystem::path& file, std::string content, const Progress& progress = {});

/// The readers, one for each format.
Deck read_dyna(DeckLines& lines);
Deck read_nastran(DeckLines& lines);
Deck read_abaqus(DeckLines& lines);
Deck read_gmsh(DeckLines& lines);
Deck read_radioss(DeckLines& lines);

} // namespace spia
