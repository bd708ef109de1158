#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/forming/blank.h"
#include "engine/part/part_file.h"

namespace spia {

/// Formats that give results back to solver decks, by the names the command line uses: dynain,
/// nastran and mapping (thickness and strains on the elements of the deck), and the blank as a
/// mesh: blank-k, blank-bdf, blank-inp, blank-msh.
const std::vector<std::string>& deck_formats();
const std::vector<std::string>& blank_mesh_formats(); ///< the last four of them
bool is_deck_format(const std::string& format);

/// dynain NAME-dynain.k, nastran NAME-thickness.bdf and NAME-strains.csv, mapping NAME-elements.csv
/// and NAME-nodes.csv; blank-k NAME-blank.k and so on. Lengths are in the unit of the deck. @pre
/// is_deck_format()
std::vector<std::string> deck_file_names(const std::string& format, const std::string& name);

/// Finds out what would keep write_deck_files() from writing, before the work. @throws InputError
/// if ids do not allow it
void require_deck_ids(std::span<const std::string> formats, const PartFile& part);

/// Writes those of some formats that are deck formats, others are passed over.
/// @param face  of forming the blank into the part
/// @param unit  of the lengths, if the part is not from a deck
/// @returns the files, in the order of the formats
/// @throws InputError if ids do not allow it (part_shells()); ExchangeError if a file cannot be
/// written
std::vector<std::filesystem::path> write_deck_files(const std::filesystem::path& folder, const std::string& name,
                                                    std::span<const std::string> formats, const PartFile& part,
                                                    const Blank& blank, const SheetFields& face,
                                                    LengthUnit unit = LengthUnit::mm);

} // namespace spia
