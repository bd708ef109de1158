#include "engine/exchange/deck/write_shell_mesh.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/exchange/provenance.h"
#include "engine/exchange/text/fixed_number.h"
#include "engine/exchange/text/text_encoding.h"

// Card layouts: LS-DYNA Keyword User's Manual, volume I, *NODE (I8, 3 E16), *ELEMENT_SHELL (10 I8),
// *PART (title; 8 I10), *SECTION_SHELL (two cards of 8 fields of 10), "Getting started" for I10=Y;
// MSC Nastran Quick Reference Guide, "Format of bulk data entries", GRID, CQUAD4, CTRIA3, PSHELL;
// Abaqus Keywords Reference Guide, *NODE, *ELEMENT, *SHELL SECTION; Gmsh reference manual, "MSH
// file format version 2".
namespace spia {
namespace {

constexpr std::int64_t most_in_8 = 99'999'999; // of eight columns

/// For the rest of a line: no control characters, not too long.
std::string one_line(std::string_view text, size_t most)
{
    std::string line = readable(text);
    if (line.size() > most) {
        const auto in_letter = [&](size_t i) { return (static_cast<unsigned char>(line[i]) & 0xc0) == 0x80; };
        while (most > 0 && in_letter(most))
            --most;
        line.resize(most);
    }
    while (!line.empty() && line.back() == ' ')
        line.pop_back();
    return line;
}

/// A name that Abaqus takes without quotes.
std::string set_name(std::string_view text, std::set<std::string>& taken, std::int64_t id)
{
    std::string name;
    for (const char c : text.substr(0, 60))
        name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' ? c : '_';
    if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0])))
        name = "PART_" + name;
    std::string upper = name;
    std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    if (!taken.insert(upper).second) {
        name += fmt::format("_{}", id);
        taken.insert(upper + fmt::format("_{}", id));
    }
    return name;
}

std::string dyna(const ShellMesh& mesh, std::string_view title)
{
    const int w = dyna_id_width(mesh);
    std::string text = dyna_keyword(w) + shell_mesh_head(mesh, title, "$");
    auto end = std::back_inserter(text);
    for (const ShellPart& part : mesh.parts) {
        std::string name = one_line(part.name, 70);
        if (name.empty() || name[0] == '*' || name[0] == '$')
            name = fmt::format("part {}{}{}", part.id, name.empty() ? "" : " ", name);
        constexpr int element_form = 2; // Belytschko-Tsay
        fmt::format_to(end, "*PART\n{}\n{}{}{}\n", name, fixed_number(part.id, 10), fixed_number(part.id, 10),
                       fixed_number(part.material_id, 10));
        const std::string thick = fixed_number(part.thickness, 10);
        fmt::format_to(end, "*SECTION_SHELL\n{}{}\n{}{}{}{}\n", fixed_number(part.id, 10),
                       fixed_number(element_form, 10), thick, thick, thick, thick);
    }
    text += dyna_nodes(mesh, w) + "*ELEMENT_SHELL\n";
    for (int e = 0; e < mesh.elements(); ++e)
        text += dyna_shell(mesh, e, w);
    return text + "*END\n";
}

std::string nastran(const ShellMesh& mesh, std::string_view title)
{
    std::string text = shell_mesh_head(mesh, title, "$") + "BEGIN BULK\n";
    auto end = std::back_inserter(text);
    for (const ShellPart& part : mesh.parts) {
        if (!part.name.empty())
            fmt::format_to(end, "$HMNAME PROP{}\"{}\"\n", fixed_number(part.id, 12), one_line(part.name, 60));
        if (part.thickness > 0) // MID1 is left open: no material is described
            fmt::format_to(end, "PSHELL* {}{}{}\n*\n", fixed_number(part.id, 16), std::string(16, ' '),
                           fixed_number(part.thickness, 16));
    }
    text += nastran_grids(mesh);
    for (int e = 0; e < mesh.elements(); ++e)
        text += nastran_shell(mesh, e, nullptr);
    return text + "ENDDATA\n";
}

std::string abaqus(const ShellMesh& mesh, std::string_view title)
{
    std::string text = "*HEADING\n" + shell_mesh_head(mesh, title, "**") + "*NODE\n";
    auto end = std::back_inserter(text);
    for (int n = 0; n < mesh.nodes(); ++n) {
        const auto x = mesh.position.col(n);
        fmt::format_to(end, "{},{},{},{}\n", mesh.node[size_t(n)], fixed_number(x[0], 20), fixed_number(x[1], 20),
                       fixed_number(x[2], 20));
    }
    std::set<std::string> taken;
    std::vector<std::vector<int>> elements(mesh.parts.size());
    for (int e = 0; e < mesh.elements(); ++e)
        elements[size_t(mesh.part_of[size_t(e)])].push_back(e);
    for (size_t p = 0; p < mesh.parts.size(); ++p) {
        const ShellPart& part = mesh.parts[p];
        const std::string set = set_name(part.name, taken, part.id);
        for (const size_t corners : {size_t(3), size_t(4)}) {
            bool first = true;
            for (const int e : elements[p]) {
                if (mesh.corners(e) != corners)
                    continue;
                if (std::exchange(first, false))
                    fmt::format_to(end, "*ELEMENT, TYPE={}, ELSET={}\n", corners == 3 ? "S3" : "S4R", set);
                fmt::format_to(end, "{}", mesh.element[size_t(e)]);
                for (size_t k = 0; k < corners; ++k)
                    fmt::format_to(end, ",{}", mesh.node[size_t(mesh.corner[size_t(e)][k])]);
                text += '\n';
            }
        }
        std::set<std::string> free;
        if (part.thickness > 0)
            fmt::format_to(end, "*SHELL SECTION, ELSET={}, MATERIAL={}\n{}\n", set,
                           set_name(part.material.empty() ? "SHEET" : part.material, free, 0),
                           fixed_number(part.thickness, 20));
    }
    return text;
}

std::string gmsh(const ShellMesh& mesh, std::string_view title)
{
    constexpr int triangle = 2, quadrangle = 3;
    std::string text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\n" + shell_mesh_head(mesh, title, "") + "$EndComments\n";
    auto end = std::back_inserter(text);
    fmt::format_to(end, "$PhysicalNames\n{}\n", mesh.parts.size());
    for (const ShellPart& part : mesh.parts) {
        std::string name = one_line(part.name.empty() ? fmt::format("part {}", part.id) : part.name, 120);
        std::replace(name.begin(), name.end(), '"', '\'');
        fmt::format_to(end, "2 {} \"{}\"\n", part.id, name);
    }
    fmt::format_to(end, "$EndPhysicalNames\n$Nodes\n{}\n", mesh.nodes());
    for (int n = 0; n < mesh.nodes(); ++n)
        fmt::format_to(end, "{} {} {} {}\n", mesh.node[size_t(n)], mesh.position(0, n), mesh.position(1, n),
                       mesh.position(2, n));
    fmt::format_to(end, "$EndNodes\n$Elements\n{}\n", mesh.elements());
    for (int e = 0; e < mesh.elements(); ++e) {
        const auto part = mesh.parts[size_t(mesh.part_of[size_t(e)])].id;
        fmt::format_to(end, "{} {} 2 {} {}", mesh.element[size_t(e)], mesh.corners(e) == 3 ? triangle : quadrangle,
                       part, part);
        for (size_t k = 0; k < mesh.corners(e); ++k)
            fmt::format_to(end, " {}", mesh.node[size_t(mesh.corner[size_t(e)][k])]);
        text += '\n';
    }
    return text + "$EndElements\n";
}

} // namespace

std::string shell_mesh_head(const ShellMesh& mesh, std::string_view title, std::string_view comment)
{
    std::string text =
        fmt::format("{} {}: {}; lengths {}\n", comment, program_name(), one_line(title, 120), name(mesh.unit));
    for (const std::string& note : mesh.notes)
        text += fmt::format("{} {}\n", comment, note);
    return text;
}

int dyna_id_width(const ShellMesh& mesh)
{
    std::int64_t greatest = 0;
    for (const auto* ids : {&mesh.node, &mesh.element})
        for (const std::int64_t id : *ids)
            greatest = std::max(greatest, id);
    for (const ShellPart& part : mesh.parts)
        greatest = std::max(greatest, part.id);
    fixed_number(greatest, 10);
    return greatest <= most_in_8 ? 8 : 10;
}

std::string dyna_keyword(int id_width) { return id_width == 8 ? "*KEYWORD\n" : "*KEYWORD I10=Y\n"; }

std::string dyna_nodes(const ShellMesh& mesh, int id_width)
{
    std::string text = "*NODE\n";
    for (int n = 0; n < mesh.nodes(); ++n) {
        text += fixed_number(mesh.node[size_t(n)], id_width);
        for (int k = 0; k < 3; ++k)
            text += fixed_number(mesh.position(k, n), 16);
        text += '\n';
    }
    return text;
}

std::string dyna_shell(const ShellMesh& mesh, int element, int id_width)
{
    const size_t e = size_t(element);
    std::string text =
        fixed_number(mesh.element[e], id_width) + fixed_number(mesh.parts[size_t(mesh.part_of[e])].id, id_width);
    for (size_t k = 0; k < 4; ++k) // the fourth of a triangle is the third
        text += fixed_number(mesh.node[size_t(mesh.corner[e][std::min(k, mesh.corners(element) - 1)])], id_width);
    return text + '\n';
}

std::string nastran_grids(const ShellMesh& mesh)
{
    std::string text;
    for (int n = 0; n < mesh.nodes(); ++n)
        text += fmt::format("GRID*   {}{}{}{}\n*       {}\n", fixed_number(mesh.node[size_t(n)], 16),
                            std::string(16, ' '), fixed_number(mesh.position(0, n), 16),
                            fixed_number(mesh.position(1, n), 16), fixed_number(mesh.position(2, n), 16));
    return text;
}

std::string nastran_shell(const ShellMesh& mesh, int element, const double* corner_thickness)
{
    const size_t e = size_t(element), corners = mesh.corners(element);
    std::vector<std::int64_t> id = {mesh.element[e], mesh.parts[size_t(mesh.part_of[e])].id};
    for (size_t k = 0; k < corners; ++k)
        id.push_back(mesh.node[size_t(mesh.corner[e][k])]);
    const bool large = corner_thickness || *std::max_element(id.begin(), id.end()) > most_in_8;
    std::string text = fmt::format("{:<8}", fmt::format("{}{}", corners == 3 ? "CTRIA3" : "CQUAD4", large ? "*" : ""));
    if (!large) { // some programs read no other
        for (const std::int64_t number : id)
            text += fixed_number(number, 8);
        return text + '\n';
    }
    std::vector<std::string> field;
    for (const std::int64_t number : id)
        field.push_back(fixed_number(number, 16));
    if (corner_thickness) {
        constexpr size_t first_thickness =
            10; // T1, behind angle, offset, an unused field and TFLAG (blank: T are lengths)
        field.resize(first_thickness, std::string(16, ' '));
        for (size_t k = 0; k < corners; ++k)
            field.push_back(fixed_number(corner_thickness[k], 16));
    }
    for (size_t k = 0; k < field.size(); ++k)
        text += (k > 0 && k % 4 == 0 ? "\n*       " : "") + field[k];
    if ((field.size() + 3) / 4 % 2 == 1) // an entry in large field has an even number of lines
        text += "\n*";
    return text + '\n';
}

void write_shell_mesh(const std::filesystem::path& path, const ShellMesh& mesh, std::string_view title)
{
    const std::string ending = path.extension().string();
    if (ending == ".k")
        write_atomically(path, dyna(mesh, title));
    else if (ending == ".bdf")
        write_atomically(path, nastran(mesh, title));
    else if (ending == ".inp")
        write_atomically(path, abaqus(mesh, title));
    else if (ending == ".msh")
        write_atomically(path, gmsh(mesh, title));
    else
        throw InputError(fmt::format("meshes are written as .k, .bdf, .inp and .msh, not as \"{}\"", ending));
}

} // namespace spia
