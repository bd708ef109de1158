#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>
#include <set>

#include "engine/exchange/abaqus_keyword.h"
#include "engine/exchange/deck_builder.h"
#include "engine/exchange/deck_fields.h"
#include "engine/exchange/deck_number.h"
#include "engine/exchange/element_sets.h"
#include "engine/exchange/read_deck.h"

// Layouts: Abaqus Keywords Reference Guide and the CalculiX manual (*NODE, *ELEMENT, *ELSET, *SHELL SECTION, *INCLUDE).
namespace spia {
namespace {

/// Nodes of a shell, membrane or plane element by its type, the digit of "S4R", "STRI65", "M3D4", "CPS3"; 0: it is none. Gmsh writes
/// all surfaces as plane stress.
int nodes_of(const std::string& type)
{
    for (const std::string_view start : {"STRI", "SFM3D", "M3D", "CPEG", "CPE", "CPS", "DS", "S"})
        if (type.size() > start.size() && type.starts_with(start)) {
            const char digit = type[start.size()];
            return std::string_view("34689").find(digit) != std::string_view::npos ? digit - '0' : 0;
        }
    return 0;
}

class AbaqusReader {
public:
    explicit AbaqusReader(DeckLines& lines) : lines_(lines) {}

    Deck read()
    {
        while (lines_.next()) {
            const std::string_view line = trimmed(lines_.line());
            if (line.empty() || line.starts_with("**"))
                continue;
            if (line.starts_with('*'))
                begin_block(AbaqusKeyword(whole_keyword(line)));
            else if (card_) {
                fields_.cut_commas(line);
                if (fields_.count() > DeckFields::most)
                    lines_.fail(fmt::format("there are {} entries on this line", fields_.count()));
                (this->*card_)();
            }
        }
        close_scope();
        if (moved_ > 0) {
            const std::string text = fmt::format(
                "{} instances are moved or turned in the assembly; their parts are taken as they were drawn", moved_);
            instances_ > 1 ? deck_.doubt(text) : deck_.note(text); // one alone has the same blank anywhere
        }
        if (middle_nodes_ > 0)
            deck_.note(fmt::format("{} shells have nodes on their edges; their corners are taken", middle_nodes_));
        return deck_.finish("Abaqus input", lines_);
    }

private:
    using Card = void (AbaqusReader::*)();
    struct Section {
        std::string set, material;
        double thickness;
        bool layers, mirrored, varies; ///< of layers; of their mirror images too; from place to place
    };

    /// A keyword line that ends with a comma goes on in the next one.
    std::string whole_keyword(std::string_view line)
    {
        std::string text(line);
        while (text.ends_with(',') && lines_.next())
            text += trimmed(lines_.line());
        return text;
    }

    void begin_block(const AbaqusKeyword& keyword)
    {
        if (keyword.name == "INCLUDE")
            return lines_.include(keyword["INPUT"]); // in the middle of the block, if there is one
        require_whole_shell();
        card_ = nullptr;
        if (keyword.name == "NODE")
            begin_nodes(keyword);
        else if (keyword.name == "ELEMENT")
            begin_elements(keyword);
        else if (keyword.name == "ELSET")
            begin_set(keyword);
        else if (keyword.name == "SHELL SECTION" || keyword.name == "SHELL GENERAL SECTION" ||
                 keyword.name == "MEMBRANE SECTION")
            begin_section(keyword);
        else if (keyword.name == "PART" || keyword.name == "INSTANCE") {
            close_scope();
            scope_ = keyword["NAME"];
            system_ = Eigen::Affine3d::Identity();
            system_points_.clear();
            if (keyword.name == "INSTANCE") {
                ++instances_;
                card_ = &AbaqusReader::placement;
            }
        } else if (keyword.name == "END PART" || keyword.name == "END INSTANCE" || keyword.name == "ASSEMBLY")
            close_scope();
        else if (keyword.name == "SYSTEM") {
            system_points_.clear();
            system_ = Eigen::Affine3d::Identity();
            card_ = &AbaqusReader::system;
        } else if (makes_geometry(keyword.name))
            deck_.count_unread_geometry("*" + keyword.name);
        else if (keyword.name != "HEADING")
            deck_.count_skipped("*" + keyword.name);
        if (card_ && keyword.has("INPUT"))
            lines_.include(keyword["INPUT"]);
    }

    /// Whether nodes or elements come from it, or are moved by it.
    static bool makes_geometry(const std::string& keyword)
    {
        static const std::set<std::string> known = {"NGEN",  "NFILL",  "NCOPY",  "NMAP",
                                                    "ELGEN", "ELCOPY", "IMPORT", "SUBSTRUCTURE COPY"};
        return known.contains(keyword);
    }

    void begin_nodes(const AbaqusKeyword& keyword)
    {
        const std::string system = upper_case(keyword["SYSTEM"]);
        if (!system.empty() && system != "R" && system != "C")
            lines_.fail("nodes in spherical coordinates are not read; write them in rectangular ones");
        cylindrical_ = system == "C";
        place_system();
        card_ = &AbaqusReader::node;
    }

    void node()
    {
        Eigen::Vector3d x = point(1);
        if (cylindrical_) { // radius, degrees, height
            const double angle = x.y() * std::numbers::pi / 180;
            x = {x.x() * std::cos(angle), x.x() * std::sin(angle), x.z()};
        }
        deck_.add_node(lines_.whole(fields_[0]), system_ * x);
    }

    Eigen::Vector3d point(size_t first) const
    {
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        for (size_t k = 0; k < 3; ++k)
            if (const std::string_view field = fields_[first + k]; !field.empty())
                x[Eigen::Index(k)] = lines_.coordinate(field);
        return x;
    }

    /// Points of that of the nodes that follow: its origin, a point on its first axis and one in the plane of the first and second; without
    /// the last its third axis stays that of the space, without both all do [Abaqus Keywords Reference, *SYSTEM].
    void system()
    {
        system_points_.push_back(point(0));
        if (!fields_[3].empty() || !fields_[4].empty() || !fields_[5].empty())
            system_points_.push_back(point(3));
        if (system_points_.size() > 3)
            lines_.fail("*SYSTEM has more than three points");
    }

    /// Of the points that were given.
    void place_system()
    {
        if (system_points_.empty())
            return;
        system_ = Eigen::Translation3d(system_points_[0]);
        if (system_points_.size() == 1)
            return;
        Eigen::Vector3d first = system_points_[1] - system_points_[0], third = Eigen::Vector3d::UnitZ();
        if (system_points_.size() == 2)
            first.z() = 0;
        else
            third = first.cross(system_points_[2] - system_points_[0]);
        constexpr double on_a_line = 1e-12; // of the lengths
        if (!(first.norm() > 0) || !(third.norm() > on_a_line * first.norm()))
            lines_.fail("the points of *SYSTEM lie on a line");
        first.normalize();
        third.normalize();
        Eigen::Matrix3d axes;
        axes << first, third.cross(first), third;
        system_.linear() = axes;
    }

    void begin_elements(const AbaqusKeyword& keyword)
    {
        type_ = upper_case(keyword["TYPE"]);
        if (type_.empty())
            lines_.fail("*ELEMENT does not say which TYPE");
        wanted_ = size_t(nodes_of(type_));
        element_set_ = keyword["ELSET"];
        part_ = part_of(!element_set_.empty() ? element_set_
                        : scope_.empty()      ? std::string("elements without a set")
                                              : scope_);
        card_ = wanted_ > 0 ? &AbaqusReader::shell : &AbaqusReader::other_element;
    }

    void other_element() { deck_.count_other_elements(type_ + " lines"); }

    /// Nodes may go on in the next line.
    void shell()
    {
        for (size_t k = 0; k < fields_.count(); ++k)
            if (!fields_[k].empty())
                numbers_.push_back(lines_.whole(fields_[k]));
        if (numbers_.size() < wanted_ + 1)
            return;
        if (numbers_.size() > wanted_ + 1)
            lines_.fail(fmt::format("an element of type {} has {} nodes, not {}", type_, wanted_, numbers_.size() - 1));
        const size_t corners = wanted_ == 3 || wanted_ == 6 ? 3 : 4;
        middle_nodes_ += wanted_ > 4;
        deck_.add_shell(part_, numbers_[0], std::span(numbers_).subspan(1, corners));
        first_part_.push_back(part_);
        if (!element_set_.empty())
            sets_.add(element_set_, numbers_[0], numbers_[0], 1);
        numbers_.clear();
    }

    void require_whole_shell()
    {
        if (!numbers_.empty())
            lines_.fail(fmt::format("element {} of type {} has {} nodes, not {}", numbers_[0], type_, wanted_,
                                    numbers_.size() - 1));
    }

    void begin_set(const AbaqusKeyword& keyword)
    {
        if (keyword.has("INSTANCE")) { // its numbers are those of an instance, not of the part
            deck_.count_skipped("*ELSET of an instance");
            return;
        }
        set_ = keyword["ELSET"];
        if (set_.empty())
            lines_.fail("*ELSET does not say which ELSET");
        card_ = keyword.has("GENERATE") ? &AbaqusReader::generated : &AbaqusReader::listed;
    }

    void listed()
    {
        for (size_t k = 0; k < fields_.count(); ++k)
            if (const auto id = deck_whole(fields_[k]))
                sets_.add(set_, *id, *id, 1);
            else if (!fields_[k].empty())
                sets_.add_set(set_, without_quotes(fields_[k]));
    }

    void generated()
    {
        const std::int64_t step = fields_[2].empty() ? 1 : lines_.whole(fields_[2]);
        if (step < 1)
            lines_.fail(fmt::format("the step is {}; it must be above 0", step));
        sets_.add(set_, lines_.whole(fields_[0]), lines_.whole(fields_[1]), step);
    }

    void begin_section(const AbaqusKeyword& keyword)
    {
        sections_.push_back({std::string(keyword["ELSET"]), std::string(keyword["MATERIAL"]), 0,
                             keyword.has("COMPOSITE"), keyword.has("SYMMETRIC"),
                             keyword.has("NODAL THICKNESS") || keyword.has("SHELL THICKNESS")});
        card_ = &AbaqusReader::section;
        if (keyword.name == "SHELL GENERAL SECTION" && !keyword.has("MATERIAL") && !keyword.has("COMPOSITE")) {
            card_ = nullptr; // what follows is its stiffness [Abaqus Keywords Reference, *SHELL GENERAL SECTION]
            deck_.count_skipped("*SHELL GENERAL SECTION by its stiffness");
        }
    }

    void section()
    {
        Section& section = sections_.back();
        if (fields_[0].empty() || (section.thickness != 0 && !section.layers))
            return;
        const double layer = lines_.number(fields_[0]);
        section.thickness += section.layers && section.mirrored ? 2 * layer : layer;
        if (section.layers && section.material.empty())
            section.material = fields_[2];
    }

    void placement()
    {
        bool moved = false;
        for (size_t k = 0; k < fields_.count(); ++k)
            moved = moved || (!fields_[k].empty() && lines_.number(fields_[k]) != 0);
        moved_ += moved;
        card_ = moved ? nullptr : &AbaqusReader::rotation;
    }

    /// The second line of a placement: an axis and an angle.
    void rotation()
    {
        ++moved_;
        card_ = nullptr;
    }

    /// A part of this scope; one of the same name elsewhere is another one.
    int part_of(const std::string& name)
    {
        const std::string key = upper_case(name);
        if (const auto found = part_of_name_.find(key); found != part_of_name_.end())
            return found->second;
        const bool taken = !taken_names_.insert(key).second;
        return part_of_name_[key] = deck_.part_named(taken ? fmt::format("{}.{}", scope_, name) : name);
    }

    /// Element ids, sets and sections of a part hold for this part alone.
    void close_scope()
    {
        require_whole_shell();
        std::vector<std::pair<std::int64_t, int>> by_id;
        for (size_t e = deck_.first_of_scope(); e < deck_.shells(); ++e)
            by_id.emplace_back(deck_.shell_id(e), int(e));
        std::sort(by_id.begin(), by_id.end());
        for (const Section& section : sections_)
            assign(section, by_id);
        name_rests();
        keep_sets(by_id);
        deck_.close_scope();
        sets_.clear();
        sections_.clear();
        part_of_name_.clear();
        scope_.clear();
    }

    void assign(const Section& section, const std::vector<std::pair<std::int64_t, int>>& by_id)
    {
        if (section.set.empty())
            return;
        if (!sets_.has(section.set)) {
            constexpr int most = 10;
            if (lost_sections_++ < most)
                deck_.note(fmt::format("there is a section for the element set {}, but no such set", section.set));
            return;
        }
        const int part = part_of(section.set);
        for (const int e : sets_.members(section.set, by_id, steps_))
            deck_.move_shell(size_t(e), part);
        if (section.varies)
            deck_.note(fmt::format("the thickness of the section for {} is given by its nodes or a distribution, which "
                                   "are not read: it has none",
                                   section.set));
        else if (section.thickness != 0)
            deck_.at(part).thickness = section.thickness;
        deck_.at(part).material = section.material;
    }

    /// A set of which sections took shells away is more than the part that is left of it.
    void name_rests()
    {
        std::set<int> full, robbed;
        for (size_t e = deck_.first_of_scope(); e < deck_.shells(); ++e)
            (first_part_[e] == deck_.part_of_shell(e) ? full : robbed).insert(first_part_[e]);
        for (const int part : robbed)
            if (full.contains(part))
                deck_.at(part).name += " (rest)";
    }

    /// For the user to choose from, as long as they take no more room than a deck of this size may.
    void keep_sets(const std::vector<std::pair<std::int64_t, int>>& by_id)
    {
        std::int64_t room = 64 * std::int64_t(by_id.size());
        for (const std::string& name : sets_.names()) {
            std::vector<int> members = sets_.members(name, by_id, steps_);
            room -= std::int64_t(members.size());
            if (room < 0)
                return deck_.note(fmt::format("the element sets from {} on cannot be chosen; they are too many", name));
            const bool taken = !taken_sets_.insert(upper_case(name)).second;
            if (!members.empty())
                deck_.add_set(taken ? fmt::format("{}.{}", scope_, name) : name, std::move(members));
        }
    }

    DeckLines& lines_;
    DeckBuilder deck_;
    Eigen::Affine3d system_ = Eigen::Affine3d::Identity(); // of the nodes that are read
    std::vector<Eigen::Vector3d> system_points_;
    bool cylindrical_ = false;
    DeckFields fields_;
    Card card_ = nullptr;
    std::string type_, element_set_, set_, scope_;
    size_t wanted_ = 0;
    std::vector<std::int64_t> numbers_; // of the element that is being read
    int part_ = 0, instances_ = 0, moved_ = 0, middle_nodes_ = 0, lost_sections_ = 0;
    std::vector<int> first_part_; // per shell, before sections
    ElementSets sets_;
    std::vector<Section> sections_;
    std::map<std::string, int> part_of_name_;
    std::set<std::string> taken_names_, taken_sets_;
    std::int64_t steps_ = 300'000'000; // a few seconds
};

} // namespace

Deck read_abaqus(DeckLines& lines) { return AbaqusReader(lines).read(); }

} // namespace spia
