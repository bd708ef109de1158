#include <algorithm>
#include <fmt/core.h>
#include <map>

#include "engine/core/read_number.h"
#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/gmsh_values.h"
#include "engine/exchange/deck/read_deck.h"

// Layout: Gmsh reference manual, "MSH file format" (4.1, and 4.0 of Gmsh 4.0) and "Legacy formats"
// (versions 1 and 2), as text and, of 4.1 and 2, binary.
namespace spia {
namespace {

/// 3 or 4 for a triangle or a quadrangle of any order, whose corners come first; 0 for other
/// elements.
size_t corners_of(std::int64_t type)
{
    for (const int triangle : {2, 9, 20, 21, 22, 23, 24, 25, 42, 43, 44, 45, 46, 52, 53, 54, 55, 56})
        if (type == triangle)
            return 3;
    for (const int quadrangle : {3, 10, 16, 36, 37, 38, 39, 40, 41, 47, 48, 49, 50, 51, 57, 58, 59, 60, 61})
        if (type == quadrangle)
            return 4;
    return 0;
}

bool is_point_or_line(std::int64_t type) { return type == 15 || type == 1 || type == 8 || (type >= 26 && type <= 28); }

/// Nodes of an element, which a binary file does not say; 0: not known.
std::int64_t nodes_of(std::int64_t type)
{
    constexpr std::array<int, 67> nodes = {0,   2,  3,  4,  4,  8,  6,  5,  3,  6,  9,  10, 27, 18, 14, 1,  8,
                                           20,  15, 13, 9,  10, 12, 15, 15, 21, 4,  5,  6,  20, 35, 56, 22, 28,
                                           0,   0,  16, 25, 36, 12, 16, 20, 28, 36, 45, 55, 66, 49, 64, 81, 100,
                                           121, 18, 21, 24, 27, 30, 24, 28, 32, 36, 40, 7,  8,  9,  10, 11};
    return type == 92 ? 64 : type == 93 ? 125 : type > 0 && type < std::ssize(nodes) ? nodes[size_t(type)] : 0;
}

/// A negative tag means that the surface is turned over in its group.
std::int64_t group_of(std::int64_t tag) { return tag < 0 && tag != INT64_MIN ? -tag : tag; }

class GmshReader {
public:
    explicit GmshReader(DeckLines& lines) : lines_(lines), values_(lines) {}

    Deck read()
    {
        while (lines_.next()) {
            const std::string_view head = trimmed(lines_.line());
            if (head == "$MeshFormat")
                format();
            else if (head == "$PhysicalNames")
                names();
            else if (head == "$Entities")
                entities(), require_end();
            else if (head == "$Nodes")
                nodes(), require_end();
            else if (head == "$ParametricNodes") // of version 2
                parametric_nodes(), require_end();
            else if (head == "$Elements")
                elements(), require_end();
            else if (head == "$NOD") // of format 1, which has no head
                begin_old(), nodes();
            else if (head == "$ELM")
                old_elements();
            else if (head.starts_with('$') && !head.starts_with("$End") && !head.starts_with("$END")) {
                if (head == "$PartitionedEntities")
                    deck_.note("the mesh is partitioned, and the groups of its surfaces are not read");
                pass_over(head);
            }
        }
        if (version_ == 0)
            lines_.fail("this is no mesh of Gmsh: there is neither $MeshFormat nor $NOD");
        for (const auto& [tag, part] : part_of_group_)
            if (const auto name = name_.find(tag); name != name_.end())
                deck_.at(part).name = name->second;
        for (auto& [tag, shells] : further_) {
            const auto name = name_.find(tag);
            deck_.add_set(name != name_.end() ? name->second : fmt::format("{}", tag), std::move(shells));
        }
        return deck_.finish(fmt::format("Gmsh {:.1f}", version_), lines_);
    }

private:
    std::int64_t whole(size_t i) const { return values_.whole(i); }
    std::int64_t count_in_text()
    {
        values_.next_line();
        return whole(0);
    }
    /// Of the blocks of a section of version 4.
    std::int64_t blocks()
    {
        values_.next("zzzz");
        return whole(0);
    }

    /// Of a binary section that was read.
    void require_end()
    {
        if (!values_.binary())
            return;
        const bool there = lines_.next() && (!trimmed(lines_.line()).empty() || lines_.next());
        if (!there || !lines_.line().starts_with("$End"))
            lines_.fail("the section does not end where it should: the file is damaged, perhaps by a transfer as text");
    }

    void pass_over(std::string_view head)
    {
        const std::string end = "$End" + std::string(head.substr(1));
        while (lines_.next())
            if (trimmed(lines_.line()) == end)
                return;
        lines_.fail(fmt::format("{} is missing", end));
    }

    void format()
    {
        values_.next_line();
        version_ = lines_.number(first_word());
        const bool binary = whole(1) != 0;
        if (version_ != 4.1 && version_ != 4 && !(version_ >= 2 && version_ < 3))
            lines_.fail(
                fmt::format("version {} of the format is not read, but 2, 4 and 4.1 and, with $NOD, 1", version_));
        if (binary && version_ == 4)
            lines_.fail("binary meshes of version 4.0 are not read; save it as version 4.1 (Gmsh: "
                        "Mesh.MshFileVersion = 4.1)");
        if (binary)
            values_.begin_binary(whole(2));
    }

    std::string_view first_word() const
    {
        const std::string_view line = trimmed(lines_.line());
        return line.substr(0, line.find_first_of(" \t"));
    }

    void begin_old()
    {
        if (version_ != 0)
            lines_.fail("$NOD is of version 1 of the format, which has no $MeshFormat");
        version_ = 1;
    }

    void require_format() const
    {
        if (version_ == 0)
            lines_.fail("$MeshFormat must come first");
    }

    void names()
    {
        for (std::int64_t n = count_in_text(); n > 0; --n) {
            values_.next_line();
            const std::string_view line = lines_.line();
            const size_t open = line.find('"'), close = line.rfind('"');
            if (whole(0) == 2 && open < close && close != line.npos)
                name_[whole(1)] = std::string(line.substr(open + 1, close - open - 1));
        }
    }

    /// The physical groups of each surface: the first one is its part, the others are sets.
    void entities()
    {
        values_.next("zzzz");
        const std::int64_t number[] = {whole(0), whole(1), whole(2), whole(3)};
        for (int dimension = 0; dimension < (values_.binary() ? 4 : 3); ++dimension)
            for (std::int64_t n = 0; n < number[dimension]; ++n)
                entity(dimension);
    }

    void entity(int dimension)
    {
        const bool point = dimension == 0; // has no box and no boundary
        values_.next(point ? "idddz" : "iddddddz");
        if (point && !values_.binary())
            return;
        const size_t at = point ? 4 : 7;
        if (!values_.binary() && dimension != 2)
            return;
        const std::int64_t tag = whole(0), said = whole(at);
        values_.more("i", said);
        constexpr std::int64_t most = 30; // of one line
        const std::int64_t groups = std::clamp<std::int64_t>(said, 0, most);
        for (std::int64_t k = 0; k < groups && dimension == 2; ++k)
            groups_of_surface_[tag].push_back(group_of(whole(at + 1 + size_t(k))));
        if (values_.binary() && !point) {
            values_.next("z");
            values_.more("i", whole(0));
        }
    }

    void nodes()
    {
        require_format();
        if (version_ < 4) {
            for (std::int64_t n = count_in_text(); n > 0; --n) {
                values_.next("iddd");
                node(whole(0), 1);
            }
            return;
        }
        for (std::int64_t left = blocks(); left > 0; --left) {
            values_.next("iiiz");
            const std::int64_t dimension = whole(0), parametric = whole(2);
            std::int64_t n = whole(3);
            if (version_ == 4) {
                for (; n > 0; --n) {
                    values_.next_line();
                    node(whole(0), 1);
                }
                continue;
            }
            std::vector<std::int64_t> ids;
            for (; n > 0; --n) {
                values_.next("z");
                ids.push_back(whole(0));
            }
            for (const std::int64_t id : ids) {
                values_.next("ddd");
                if (parametric != 0) // its parameters on a curve or surface
                    values_.more("d", std::clamp<std::int64_t>(dimension, 0, 3));
                node(id, 0);
            }
        }
    }

    /// Each with its place on a curve or surface behind it.
    void parametric_nodes()
    {
        require_format();
        for (std::int64_t n = count_in_text(); n > 0; --n) {
            values_.next("idddii");
            const std::int64_t dimension = whole(4);
            values_.more("d", dimension == 1 || dimension == 2 ? dimension : 0);
            node(whole(0), 1);
        }
    }

    void node(std::int64_t id, size_t first)
    {
        deck_.add_node(id, {values_.coordinate(first), values_.coordinate(first + 1), values_.coordinate(first + 2)});
    }

    void elements()
    {
        require_format();
        if (version_ < 4)
            return values_.binary() ? flat_binary_elements() : flat_elements();
        for (std::int64_t left = blocks(); left > 0; --left) {
            values_.next("iiiz");
            const bool old = version_ == 4;
            const std::int64_t surface = whole(old ? 0 : 1), type = whole(2);
            const auto groups = groups_of_surface_.find(surface);
            const bool grouped = groups != groups_of_surface_.end();
            for (std::int64_t n = whole(3); n > 0; --n) {
                values_.next("z");
                values_.more("z", nodes_in_binary(type));
                const size_t before = deck_.shells();
                element(whole(0), type, grouped ? groups->second[0] : 0, surface, 1);
                for (size_t k = 1; grouped && k < groups->second.size() && deck_.shells() > before; ++k)
                    further_[groups->second[k]].push_back(int(before));
            }
        }
    }

    /// Of version 2: number, type, tags, nodes.
    void flat_elements()
    {
        for (std::int64_t n = count_in_text(); n > 0; --n) {
            values_.next_line();
            const std::int64_t tags = checked_tags(whole(2));
            const std::int64_t group = tags > 0 ? group_of(whole(3)) : 0, surface = tags > 1 ? whole(4) : 0;
            element(whole(0), whole(1), group, surface, 3 + size_t(tags));
        }
    }

    /// Some of one type together: type, how many, tags of each; then number, tags and nodes of
    /// each.
    void flat_binary_elements()
    {
        for (std::int64_t n = count_in_text(); n > 0;) {
            values_.next("iii");
            const std::int64_t type = whole(0), some = whole(1), tags = checked_tags(whole(2));
            if (some < 1 || some > n)
                lines_.fail(fmt::format("{} elements are said to be in a row, of {}", some, n));
            for (std::int64_t k = 0; k < some; ++k) {
                values_.next("i");
                values_.more("i", tags + nodes_in_binary(type));
                const std::int64_t group = tags > 0 ? group_of(whole(1)) : 0, surface = tags > 1 ? whole(2) : 0;
                element(whole(0), type, group, surface, 1 + size_t(tags));
            }
            n -= some;
        }
    }

    /// Of version 1: number, type, physical group, surface, how many nodes, nodes.
    void old_elements()
    {
        require_format();
        for (std::int64_t n = count_in_text(); n > 0; --n) {
            values_.next_line();
            element(whole(0), whole(1), group_of(whole(2)), whole(3), 5);
        }
    }

    std::int64_t checked_tags(std::int64_t tags) const
    {
        if (tags < 0 || tags > 30)
            lines_.fail(fmt::format("the element has {} tags", tags));
        return tags;
    }

    /// @throws InputError in a binary file where it is not known
    std::int64_t nodes_in_binary(std::int64_t type) const
    {
        const std::int64_t nodes = nodes_of(type);
        if (nodes == 0 && values_.binary())
            lines_.fail(fmt::format("elements of type {} are not known, and a binary file does not say where they end; "
                                    "save it as text (Gmsh: Mesh.Binary = 0)",
                                    type));
        return nodes;
    }

    void element(std::int64_t id, std::int64_t type, std::int64_t group, std::int64_t surface, size_t first)
    {
        const size_t corners = corners_of(type);
        if (corners == 0) {
            if (!is_point_or_line(type))
                deck_.count_other_elements(fmt::format("type {}", type));
            return;
        }
        std::array<std::int64_t, 4> corner = {};
        for (size_t k = 0; k < corners; ++k)
            corner[k] = whole(first + k);
        deck_.add_shell(part_of(group, surface), id, corner);
    }

    /// That of the physical group; without one that of the surface.
    int part_of(std::int64_t group, std::int64_t surface)
    {
        if (group == 0)
            return deck_.part_named(fmt::format("surface {}", surface));
        const auto [found, is_new] = part_of_group_.try_emplace(group, 0);
        if (is_new)
            found->second = deck_.part(group);
        return found->second;
    }

    DeckLines& lines_;
    DeckBuilder deck_;
    GmshValues values_;
    double version_ = 0;
    // of physical groups of surfaces
    std::map<std::int64_t, std::string> name_;
    std::map<std::int64_t, std::vector<std::int64_t>> groups_of_surface_; // format 4
    // shells of groups that are nobody's first
    std::map<std::int64_t, std::vector<int>> further_;
    std::map<std::int64_t, int> part_of_group_;
};

} // namespace

Deck read_gmsh(DeckLines& lines) { return GmshReader(lines).read(); }

} // namespace spia
