#pragma once
#include <filesystem>
#include <string_view>

#include "engine/exchange/deck/part_shells.h"

namespace spia {

/// What forming did to the elements of a part, for the next calculation with its deck, in the unit
/// of the deck. Ids, corners and places are those of the deck.
struct ElementResults {
    const PartShells* shells;
    const ElementFields* fields;
};

/// As LS-DYNA's dynain: *NODE, *ELEMENT_SHELL_THICKNESS with the thickness at the corners,
/// *INITIAL_STRESS_SHELL with the effective plastic strain (the equivalent strain; stresses are 0:
/// those of the tools are gone with them) and *INITIAL_STRAIN_SHELL with the strain tensor of the
/// middle surface at both skins. Numbers in 16 columns (fixed_number(); LARGE = 1). No *PART: the
/// deck has it.
/// @param title  what it is, for the head of the file
/// @throws InputError if an id does not fit; ExchangeError if the file cannot be written
void write_dynain(const std::filesystem::path& path, const ElementResults& results, std::string_view title);

/// As Nastran bulk data to be included: GRID, and CQUAD4 and CTRIA3 with the thickness at the
/// corners (T1 to T4), in large field. No PSHELL: the deck has it. @throws as write_dynain()
void write_nastran_thickness(const std::filesystem::path& path, const ElementResults& results, std::string_view title);

/// element,part,plastic_strain,strain_major,strain_minor - one row per element; all digits.
void write_strains_csv(const std::filesystem::path& path, const ElementResults& results);

/// element,part,thickness,thinning,plastic_strain,strain_major,strain_minor - one row per element;
/// thickness_inch if that is the unit.
void write_elements_csv(const std::filesystem::path& path, const ElementResults& results);

/// node,blank_node,blank_x,blank_y - one row per node of the blank: its id in the deck, and in the
/// mesh of the blank.
void write_nodes_csv(const std::filesystem::path& path, const BlankShells& blank);

} // namespace spia
