#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/core.h>
#include <map>
#include <optional>
#include <set>

#include "engine/core/read_number.h"
#include "engine/core/text.h"
#include "engine/exchange/deck/abaqus_elements.h"
#include "engine/exchange/deck/abaqus_instances.h"
#include "engine/exchange/deck/abaqus_keyword.h"
#include "engine/exchange/deck/abaqus_nodes.h"
#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/deck_fields.h"
#include "engine/exchange/deck/read_deck.h"
#include "engine/mesh/doctor/doctor.h"

// Layouts: Abaqus Keywords Reference Guide and the CalculiX manual (*NODE, *ELEMENT, *ELSET, *SHELL
// SECTION, *INCLUDE).
namespace spia {
namespace {

/// Nodes of a shell, membrane or plane element by its type, the digit of "S4R", "STRI65", "M3D4",
/// "CPS3"; 0: it is none. Gmsh writes all surfaces as plane stress.
int nodes_of(const std::string& type)
{
    for (const std::string_view start :
         {"STRI", "SFM3D", "M3D", "CPEG", "CPE", "CPS", "DCC2D", "DC2D", "AC2D", "DS", "S"})
        if (type.size() > start.size() && type.starts_with(start)) {
            const char digit = type[start.size()];
            return std::string_view("34689").find(digit) != std::string_view::npos ? digit - '0' : 0;
        }
    return 0;
}

class AbaqusReader {
public:
    explicit AbaqusReader(DeckLines& lines)
        : lines_(lines), nodes_(lines, deck_), elements_(lines, deck_), instances_(lines, deck_)
    {
    }

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
        instances_.place_all();
        if (middle_nodes_ > 0)
            deck_.note(fmt::format("{} nodes between corners; the corners are taken",
                                   counted(middle_nodes_, "shell has", "shells have")));
        return deck_.finish("Abaqus input", lines_);
    }

private:
    using Card = void (AbaqusReader::*)();
    struct Section {
        std::string set, material;
        double thickness;
        bool layers, mirrored, varies; ///< of layers; of their mirror images too; from place to
                                       ///< place
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
        end_block();
        if (nodes_.begin(keyword))
            card_ = &AbaqusReader::node_line;
        else if (keyword.name == "ELEMENT")
            begin_elements(keyword);
        else if (keyword.name == "ELGEN") {
            elements_.begin_generation(keyword);
            card_ = &AbaqusReader::generation;
        } else if (keyword.name == "ELCOPY") {
            elements_.copy(keyword);
            deck_.set_copies();
        } else if (keyword.name == "ELSET")
            begin_set(keyword);
        else if (keyword.name == "SHELL SECTION" || keyword.name == "SHELL GENERAL SECTION" ||
                 keyword.name == "MEMBRANE SECTION")
            begin_section(keyword);
        else if (is_scope(keyword.name))
            begin_scope(keyword);
        else if (makes_geometry(keyword.name))
            deck_.count_unread_geometry("*" + keyword.name);
        else if (keyword.name != "HEADING")
            deck_.count_skipped("*" + keyword.name);
        if (card_ && keyword.has("INPUT"))
            lines_.include(keyword["INPUT"]);
    }

    void end_block()
    {
        require_whole_shell();
        nodes_.end();
        card_ = nullptr;
    }

    /// Whether nodes or elements come from it, or are moved by it, in ways that are not read.
    static bool makes_geometry(const std::string& keyword)
    {
        static const std::set<std::string> known = {"NMAP", "IMPORT", "SUBSTRUCTURE COPY"};
        return known.contains(keyword);
    }

    static bool is_scope(const std::string& keyword)
    {
        static const std::set<std::string> known = {"PART", "END PART", "ASSEMBLY", "INSTANCE", "END INSTANCE"};
        return known.contains(keyword);
    }

    /// Numbers and names hold for a part, an instance, or for what is outside of them.
    void begin_scope(const AbaqusKeyword& keyword)
    {
        close_scope();
        if (keyword.name == "PART")
            instances_.begin_part(keyword["NAME"]);
        else if (keyword.name == "INSTANCE") {
            instances_.begin_instance(keyword);
            card_ = &AbaqusReader::placement;
        } else
            return;
        scope_ = keyword["NAME"];
    }

    void node_line() { nodes_.card(fields_); }
    void generation() { elements_.generate(fields_); }
    void placement() { instances_.placement(fields_); }

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

    void other_element()
    {
        deck_.count_other_elements(type_ + " lines");
        if (const auto id = read_whole_number(fields_[0])) // or a node, where this line goes on
                                                           // with one before
            elements_.add_other(*id);
    }

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
        elements_.add(part_, numbers_[0], std::span(numbers_).subspan(1, corners), element_set_);
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
            if (const auto id = read_whole_number(fields_[k]))
                elements_.sets().add(set_, *id, *id, 1);
            else if (!fields_[k].empty())
                elements_.sets().add_set(set_, without_quotes(fields_[k]));
    }

    void generated()
    {
        const std::int64_t step = fields_[2].empty() ? 1 : lines_.whole(fields_[2]);
        if (step < 1)
            lines_.fail(fmt::format("the step is {}; it must be above 0", step));
        elements_.sets().add(set_, lines_.whole(fields_[0]), lines_.whole(fields_[1]), step);
    }

    void begin_section(const AbaqusKeyword& keyword)
    {
        sections_.push_back({std::string(keyword["ELSET"]), std::string(keyword["MATERIAL"]), 0,
                             keyword.has("COMPOSITE"), keyword.has("SYMMETRIC"),
                             keyword.has("NODAL THICKNESS") || keyword.has("SHELL THICKNESS")});
        card_ = &AbaqusReader::section;
        if (keyword.name == "SHELL GENERAL SECTION" && !keyword.has("MATERIAL") && !keyword.has("COMPOSITE")) {
            card_ = nullptr; // what follows is its stiffness [Abaqus Keywords Reference, *SHELL
                             // GENERAL SECTION]
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
        end_block();
        for (const Section& section : sections_)
            assign(section);
        name_rests();
        const size_t first_set = deck_.sets();
        keep_sets();
        const DeckRange scope = deck_.scope();
        deck_.close_scope();
        instances_.end_scope(scope, first_set);
        nodes_.close_scope();
        elements_.close_scope();
        sections_.clear();
        part_of_name_.clear();
        scope_.clear();
    }

    void assign(const Section& section)
    {
        if (section.set.empty())
            return;
        if (!elements_.sets().has(section.set)) {
            constexpr int most = 10;
            if (lost_sections_++ < most)
                deck_.note(fmt::format("there is a section for the element set {}, but no such set", section.set));
            return;
        }
        const int part = part_of(section.set);
        for (const int e : elements_.members(section.set))
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
        for (size_t e = deck_.first_of_scope(); e < deck_.shells(); ++e) {
            const int part = elements_.first_part(e);
            (part == deck_.part_of_shell(e) ? full : robbed).insert(part);
        }
        for (const int part : robbed)
            if (full.contains(part))
                deck_.at(part).name += " (rest)";
    }

    /// For the user to choose from, as long as they take no more room than a deck of this size may.
    void keep_sets()
    {
        std::int64_t room = 64 * std::int64_t(elements_.by_id().size());
        for (const std::string& name : elements_.sets().names()) {
            std::vector<int> members = elements_.members(name);
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
    AbaqusNodes nodes_;
    AbaqusElements elements_;
    AbaqusInstances instances_;
    DeckFields fields_;
    Card card_ = nullptr;
    std::string type_, element_set_, set_, scope_;
    size_t wanted_ = 0;
    std::vector<std::int64_t> numbers_; // of the element that is being read
    int part_ = 0, middle_nodes_ = 0, lost_sections_ = 0;
    std::vector<Section> sections_;
    std::map<std::string, int> part_of_name_;
    std::set<std::string> taken_names_, taken_sets_;
};

} // namespace

Deck read_abaqus(DeckLines& lines) { return AbaqusReader(lines).read(); }

} // namespace spia
