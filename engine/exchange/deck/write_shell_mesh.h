#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/exchange/deck/shell_mesh.h"

namespace spia {

/// Writes nodes, elements and parts, with thicknesses where parts have one: the ending says the
/// format, .k LS-DYNA keyword (the columns of I10=Y where an id has more than eight digits), .bdf
/// Nastran bulk data (GRID in large field), .inp Abaqus and CalculiX, .msh Gmsh 2.2 (text).
/// read_deck() gives the same again: coordinates to fixed_number() in 16 columns (.k, .bdf) or 20
/// (.inp, for CalculiX reads no more), exactly in .msh. Materials are named, not described.
/// @param title  what it is, for the head of the file
/// @throws InputError if an id does not fit; ExchangeError if the file cannot be written
void write_shell_mesh(const std::filesystem::path& path, const ShellMesh& mesh, std::string_view title);

// What files with results on the elements have in common with these.

/// "$ SPIA 0.1: what it is; lengths mm", then the notes, one comment each.
std::string shell_mesh_head(const ShellMesh& mesh, std::string_view title, std::string_view comment);

/// Characters for an id in an LS-DYNA deck: 8, or 10 with the option I10=Y. @throws InputError if
/// 10 do not hold all ids
int dyna_id_width(const ShellMesh& mesh);
std::string dyna_keyword(int id_width); ///< "*KEYWORD" with what says the width
std::string dyna_nodes(const ShellMesh& mesh, int id_width);
std::string dyna_shell(const ShellMesh& mesh, int element, int id_width); ///< its first card

std::string nastran_grids(const ShellMesh& mesh);
/// CQUAD4 or CTRIA3, with the thickness of each corner if there is one (then in large field).
/// @param corner_thickness four, or null
std::string nastran_shell(const ShellMesh& mesh, int element, const double* corner_thickness);

} // namespace spia
