#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/exchange/deck/deck.h"
#include "engine/exchange/deck/deck_lines.h"
#include "engine/exchange/file_format.h"

namespace spia {

/// Those that read_deck() reads: LS-DYNA keyword, Nastran bulk data, Abaqus and CalculiX, Gmsh,
/// Radioss starter.
std::vector<FileFormat> deck_file_formats();

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
