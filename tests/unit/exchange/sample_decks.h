#pragma once
#include <array>
#include <fmt/core.h>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/exchange/deck/read_deck.h"

namespace spia::sample {

/// A bent strip of two parts, 7 "Hood" (four quads, 1.25 thick) and 9 "Rail" (a quad and two
/// triangles, 0.75 thick); ids of nodes 101, 111, ..., of elements 501, 502, ... Its coordinates
/// fit into eight characters.
struct Strip {
    struct Shell {
        int id, part;
        std::vector<int> node;
    };
    std::vector<std::pair<int, std::array<double, 3>>> node;
    std::vector<Shell> shell;

    Strip()
    {
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 4; ++i)
                node.push_back({101 + 10 * (4 * j + i), {12.5 * i, -8.25 * j, 0.125 * i * i - 0.5 * j}});
        const auto id = [](int i, int j) { return 101 + 10 * (4 * j + i); };
        int next = 501;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 2; ++j) {
                const std::vector<int> quad = {id(i, j), id(i, j + 1), id(i + 1, j + 1), id(i + 1, j)};
                if (i == 2 && j == 1) {
                    shell.push_back({next++, 9, {quad[0], quad[1], quad[2]}});
                    shell.push_back({next++, 9, {quad[0], quad[2], quad[3]}});
                } else
                    shell.push_back({next++, i == 2 ? 9 : 7, quad});
            }
    }
};

inline std::string dyna(const char* options = "", int w = 8, int number_width = 16, const char* mark = "",
                        int card = 10)
{
    std::string text = fmt::format("$ a comment\n*KEYWORD{}\n*TITLE\na strip\n", options);
    for (const auto& [id, name, t] : {std::tuple(7, "Hood", 1.25), std::tuple(9, "Rail", 0.75)})
        text += fmt::format(
            "*PART\n{1}\n{0:>{2}}{0:>{2}}{3:>{2}}\n*SECTION_SHELL_TITLE\nsheet\n{0:>{2}}{3:>{2}}\n{4:>{2}}{4:>{2}}{4:>{2}}{4:>{2}}\n",
            id, name, card, 2, t);
    text += fmt::format("*MAT_PIECEWISE_LINEAR_PLASTICITY_TITLE\nDC04\n{:>{}}\n*NODE{}\n", 2, card, mark);
    const Strip strip;
    for (const auto& [id, x] : strip.node)
        text += fmt::format("{:>{}}{:>{}}{:>{}}{:>{}}\n", id, w, x[0], number_width, x[1], number_width, x[2],
                            number_width);
    text += fmt::format("*ELEMENT_SHELL{}\n", mark);
    for (const auto& s : strip.shell) {
        text += fmt::format("{:>{}}{:>{}}", s.id, w, s.part, w);
        for (size_t k = 0; k < 4; ++k)
            text += fmt::format("{:>{}}", s.node[std::min(k, s.node.size() - 1)], w);
        text += "\n";
    }
    return text + "*END\n*NODE\nnothing of this is read\n";
}

inline std::string dyna_commas()
{
    std::string text = "*KEYWORD\n*PART\nHood\n7,7,2\nRail\n9,9,2\n*SECTION_SHELL\n7,2\n1.25,1.25,1.25,1.25\n9,2\n.75\n"
                       "*MAT_ELASTIC_TITLE\nDC04\n2,7.8e-9\n*NODE\n";
    const Strip strip;
    for (const auto& [id, x] : strip.node)
        text += fmt::format("{}, {}, {}, {}\n", id, x[0], x[1], x[2]);
    text += "*ELEMENT_SHELL\n";
    for (const auto& s : strip.shell)
        text += fmt::format("{},{},{},{},{},{}\n", s.id, s.part, s.node[0], s.node[1], s.node[2],
                            s.node.size() > 3 ? s.node[3] : 0);
    return text;
}

enum class Field { small, large, free };
inline std::string nastran(Field field)
{
    const auto entry = [&](const char* name, const std::vector<std::string>& fields) {
        std::string line = name;
        if (field == Field::free) {
            for (const std::string& f : fields)
                line += "," + f;
        } else if (field == Field::small) {
            line = fmt::format("{:<8}", line);
            for (const std::string& f : fields)
                line += fmt::format("{:>8}", f);
        } else {
            line = fmt::format("{:<8}", line + "*");
            for (size_t k = 0; k < fields.size(); ++k)
                line += fmt::format("{}{:>16}", k == 4 ? "*\n*       " : "", fields[k]);
        }
        return line + "\n";
    };
    std::string text =
        "SOL 101\nCEND\nTITLE = a strip\nBEGIN BULK\n$HMNAME PROP           7\"Hood\" 4\n$HMNAME PROP           9\"Rail\" 4\n";
    text += entry("MAT1", {"2", "210000."});
    text += entry("PSHELL", {"7", "2", "1.25"}) + entry("PSHELL", {"9", "2", "7.5-1"});
    const Strip strip;
    for (const auto& [id, x] : strip.node)
        text += entry("GRID", {std::to_string(id), "", fmt::format("{:.4f}", x[0]), fmt::format("{}", x[1]),
                               fmt::format("{}", x[2])});
    for (const auto& s : strip.shell) {
        std::vector<std::string> fields = {std::to_string(s.id), std::to_string(s.part)};
        for (const int v : s.node)
            fields.push_back(std::to_string(v));
        text += entry(s.node.size() == 3 ? "CTRIA3" : "CQUAD4", fields);
    }
    return text + "ENDDATA\n";
}

inline std::string abaqus()
{
    std::string text = "*Heading\n** a strip\n*Node, nset=all\n";
    const Strip strip;
    for (const auto& [id, x] : strip.node)
        text += fmt::format("{}, {}, {}, {}\n", id, x[0], x[1], x[2]);
    std::string hood;
    for (const auto& s : strip.shell) { // a block for each, for their order
        text += s.node.size() == 3 ? "*ELEMENT, type=S3R\n" : "*ELEMENT, TYPE = s4r\n";
        text += std::to_string(s.id);
        for (const int v : s.node)
            text += fmt::format(",{}", v);
        text += "\n";
    }
    return text +
           "*Elset, elset=HOOD, generate\n501,504,1\n*Elset, elset=Rail\n505, 506,\n507\n"
           "*Shell Section, elset=Hood, material=DC04\n1.25, 5\n*Shell Section, elset=RAIL, material=DC04\n 0.75 ,\n";
}

inline std::string gmsh(const std::string& version)
{
    const Strip strip;
    std::string text = fmt::format(
        "$MeshFormat\n{} 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n1 9 \"edge of nine\"\n2 7 \"Hood\"\n2 9 \"Rail\"\n1 7 \"edge\"\n"
        "$EndPhysicalNames\n",
        version);
    const size_t nodes = strip.node.size(), shells = strip.shell.size();
    if (version[0] == '2') {
        text += fmt::format("$Nodes\n{}\n", nodes);
        for (const auto& [id, x] : strip.node)
            text += fmt::format("{} {} {} {}\n", id, x[0], x[1], x[2]);
        text += fmt::format("$EndNodes\n$Elements\n{}\n1 1 2 1 1 101 111\n", shells + 1);
        for (const auto& s : strip.shell) {
            text += fmt::format("{} {} 2 {} {}", s.id, s.node.size() == 3 ? 2 : 3, s.part, s.part + 100);
            for (const int v : s.node)
                text += fmt::format(" {}", v);
            text += "\n";
        }
        return text + "$EndElements\n";
    }
    const bool old = version == "4" || version == "4.0";
    text +=
        "$Entities\n1 1 2 0\n1 0 0 0 0 0 0 0\n3 0 0 0 1 1 1 1 1 0\n107 0 0 0 1 1 1 1 7 1 3\n109 0 0 0 1 1 1 2 9 8 1 3\n$EndEntities\n";
    text += old ? fmt::format("$Nodes\n1 {0}\n107 2 0 {0}\n", nodes)
                : fmt::format("$Nodes\n1 {0} 101 211\n2 107 0 {0}\n", nodes);
    std::string places;
    for (const auto& [id, x] : strip.node) {
        text += old ? fmt::format("{} {} {} {}\n", id, x[0], x[1], x[2]) : fmt::format("{}\n", id);
        places += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
    }
    text += (old ? "" : places) + "$EndNodes\n$Elements\n";
    text += old ? fmt::format("{} {}\n1 3 1 1\n1 101 111\n", shells + 1, shells + 1)
                : fmt::format("{} {} 1 507\n1 3 1 1\n1 101 111\n", shells + 1, shells + 1);
    for (const auto& s : strip.shell) {
        text += old ? fmt::format("{} 2 {} 1\n{}", s.part + 100, s.node.size() == 3 ? 2 : 3, s.id)
                    : fmt::format("2 {} {} 1\n{}", s.part + 100, s.node.size() == 3 ? 2 : 3, s.id);
        for (const int v : s.node)
            text += fmt::format(" {}", v);
        text += "\n";
    }
    return text + "$EndElements\n";
}

inline std::string radioss()
{
    std::string text =
        "#RADIOSS STARTER\n/BEGIN\nstrip\n      2022         0\n                  kg                  mm                  ms\n"
        "                  kg                  mm                  ms\n/MAT/PLAS_JOHNS/2\nDC04\n             7.85E-6\n";
    for (const auto& [id, name, t] : {std::tuple(7, "Hood", 1.25), std::tuple(9, "Rail", 0.75)})
        text += fmt::format(
            "/PROP/{2}/{0}\nsheet\n#   Ishell\n        24\n#  hm\n                   0\n#  N   Istrain               Thick\n"
            "         5         0{3:>20}\n/PART/{0}\n{1}\n{0:>10}{4:>10}\n",
            id, name, id == 7 ? "SHELL" : "TYPE1", t, 2);
    text += "/NODE\n";
    const Strip strip;
    for (const auto& [id, x] : strip.node)
        text += fmt::format("{:>10}{:>20}{:>20}{:>20}\n", id, x[0], x[1], x[2]);
    for (const auto& s : strip.shell) {
        text += fmt::format("/{}/{}\n{:>10}", s.node.size() == 3 ? "SH3N" : "SHELL", s.part, s.id);
        for (const int v : s.node)
            text += fmt::format("{:>10}", v);
        text += "\n";
    }
    return text + "/END\n/NODE\nnothing of this is read\n";
}

/// The strip in every spelling, by a name whose ending says the format.
inline std::vector<std::pair<std::string, std::string>> decks()
{
    return {{"standard.k", dyna()},
            {"commas.key", dyna_commas()},
            {"i10.dyn", dyna(" I10=Y", 10)},
            {"long.k", dyna(" LONG = Y", 20, 20, "", 20)},
            {"marked_i10.k", dyna("", 10, 16, " %")},
            {"marked_long.k", dyna("", 20, 20, "+")},
            {"small.bdf", nastran(Field::small)},
            {"large.nas", nastran(Field::large)},
            {"free.dat", nastran(Field::free)},
            {"strip.inp", abaqus()},
            {"two.msh", gmsh("2.2")},
            {"four.msh", gmsh("4")},
            {"four_one.msh", gmsh("4.1")},
            {"strip.rad", radioss()}};
}

inline Deck read(const std::string& name, const std::string& text) { return read_deck("/nowhere/" + name, text); }

/// What reading it is refused with; empty if it is not refused.
inline std::string refusal(const std::string& name, const std::string& text)
{
    try {
        read(name, text);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

inline bool has_note(const Deck& deck, const std::string& words)
{
    for (const std::string& note : deck.notes)
        if (note.find(words) != note.npos)
            return true;
    return false;
}

} // namespace spia::sample
