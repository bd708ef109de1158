#include <algorithm>
#include <fmt/core.h>
#include <map>

#include "engine/exchange/deck_builder.h"
#include "engine/exchange/deck_fields.h"
#include "engine/exchange/deck_number.h"
#include "engine/exchange/read_deck.h"

// Layout: Gmsh reference manual, "MSH file format" (4.1, and 4.0 of Gmsh 4.0) and "Legacy formats" (version 2).
namespace spia {
namespace {

/// 3 or 4 for a triangle or a quadrangle of any order, whose corners come first; 0 for other elements.
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

/// A negative tag means that the surface is turned over in its group.
std::int64_t group_of(std::int64_t tag) { return tag < 0 && tag != INT64_MIN ? -tag : tag; }

class GmshReader {
public:
    explicit GmshReader(DeckLines& lines) : lines_(lines) {}

    Deck read()
    {
        while (lines_.next()) {
            const std::string_view head = trimmed(lines_.line());
            if (head == "$MeshFormat")
                format();
            else if (head == "$PhysicalNames")
                names();
            else if (head == "$Entities")
                entities();
            else if (head == "$Nodes")
                nodes();
            else if (head == "$Elements")
                elements();
            else if (head.starts_with('$') && !head.starts_with("$End")) {
                if (head == "$PartitionedEntities")
                    deck_.note("the mesh is partitioned, and the groups of its surfaces are not read");
                pass_over(head);
            }
        }
        if (version_ == 0)
            lines_.fail("this is no mesh of Gmsh: there is no $MeshFormat");
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
    /// The words of the next line of a section.
    void next()
    {
        if (!lines_.next())
            lines_.fail("the file ends in the middle of a section");
        if (trimmed(lines_.line()).starts_with('$'))
            lines_.fail("the section is shorter than it says");
        fields_.cut_words(lines_.line());
    }
    std::int64_t whole(size_t i) const { return lines_.whole(fields_[i]); }
    std::int64_t count()
    {
        next();
        return whole(0);
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
        next();
        version_ = lines_.number(fields_[0]);
        if (whole(1) != 0)
            lines_.fail("this is a binary mesh; save it as text (Gmsh: Mesh.Binary = 0)");
        if (version_ != 4.1 && version_ != 4 && !(version_ >= 2 && version_ < 3))
            lines_.fail(fmt::format("version {} of the format is not read, but 2, 4 and 4.1", version_));
    }

    void require_format() const
    {
        if (version_ == 0)
            lines_.fail("$MeshFormat must come first");
    }

    void names()
    {
        for (std::int64_t n = count(); n > 0; --n) {
            next();
            const std::string_view line = lines_.line();
            const size_t open = line.find('"'), close = line.rfind('"');
            if (whole(0) == 2 && open < close && close != line.npos)
                name_[whole(1)] = std::string(line.substr(open + 1, close - open - 1));
        }
    }

    /// The physical groups of each surface: the first one is its part, the others are sets.
    void entities()
    {
        next();
        const std::int64_t points_and_curves[] = {whole(0), whole(1)};
        const std::int64_t surfaces = whole(2);
        for (const std::int64_t number : points_and_curves)
            for (std::int64_t n = 0; n < number; ++n)
                next();
        for (std::int64_t n = 0; n < surfaces; ++n) {
            next();
            constexpr std::int64_t most = 30; // of one line
            const std::int64_t groups = std::clamp<std::int64_t>(whole(7), 0, most);
            for (std::int64_t k = 0; k < groups; ++k) // behind the tag and the box
                groups_of_surface_[whole(0)].push_back(group_of(whole(size_t(8 + k))));
        }
    }

    void nodes()
    {
        require_format();
        if (version_ < 4) {
            for (std::int64_t n = count(); n > 0; --n) {
                next();
                node(whole(0), 1);
            }
            return;
        }
        for (std::int64_t blocks = count(); blocks > 0; --blocks) {
            next();
            std::int64_t n = whole(3);
            if (version_ == 4) {
                for (; n > 0; --n) {
                    next();
                    node(whole(0), 1);
                }
                continue;
            }
            std::vector<std::int64_t> ids;
            for (; n > 0; --n) {
                next();
                ids.push_back(whole(0));
            }
            for (const std::int64_t id : ids) {
                next();
                node(id, 0);
            }
        }
    }

    void node(std::int64_t id, size_t first)
    {
        deck_.add_node(id, {lines_.coordinate(fields_[first]), lines_.coordinate(fields_[first + 1]),
                            lines_.coordinate(fields_[first + 2])});
    }

    void elements()
    {
        require_format();
        if (version_ < 4) {
            for (std::int64_t n = count(); n > 0; --n) {
                next();
                const std::int64_t tags = whole(2);
                if (tags < 0 || tags > 30)
                    lines_.fail(fmt::format("the element has {} tags", tags));
                const std::int64_t group = tags > 0 ? group_of(whole(3)) : 0, surface = tags > 1 ? whole(4) : 0;
                element(whole(0), whole(1), group, surface, 3 + size_t(tags));
            }
            return;
        }
        for (std::int64_t blocks = count(); blocks > 0; --blocks) {
            next();
            const bool old = version_ == 4;
            const std::int64_t surface = whole(old ? 0 : 1), type = whole(2);
            const auto groups = groups_of_surface_.find(surface);
            const bool grouped = groups != groups_of_surface_.end();
            for (std::int64_t n = whole(3); n > 0; --n) {
                next();
                const size_t before = deck_.shells();
                element(whole(0), type, grouped ? groups->second[0] : 0, surface, 1);
                for (size_t k = 1; grouped && k < groups->second.size() && deck_.shells() > before; ++k)
                    further_[groups->second[k]].push_back(int(before));
            }
        }
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
    DeckFields fields_;
    double version_ = 0;
    std::map<std::int64_t, std::string> name_;                            // of physical groups of surfaces
    std::map<std::int64_t, std::vector<std::int64_t>> groups_of_surface_; // format 4
    std::map<std::int64_t, std::vector<int>> further_;                    // shells of groups that are nobody's first
    std::map<std::int64_t, int> part_of_group_;
};

} // namespace

Deck read_gmsh(DeckLines& lines) { return GmshReader(lines).read(); }

} // namespace spia
