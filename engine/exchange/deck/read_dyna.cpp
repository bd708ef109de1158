#include <algorithm>
#include <fmt/core.h>
#include <set>
#include <utility>

#include "engine/core/read_number.h"
#include "engine/core/text.h"
#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/dyna_card.h"
#include "engine/exchange/deck/dyna_node_moves.h"
#include "engine/exchange/deck/dyna_parts.h"
#include "engine/exchange/deck/dyna_transforms.h"
#include "engine/exchange/deck/dyna_values.h"
#include "engine/exchange/deck/read_deck.h"
#include "engine/mesh/doctor/doctor.h"

// Card layouts: LS-DYNA Keyword User's Manual, volume I (*NODE, *ELEMENT_SHELL, *PART,
// *SECTION_SHELL, *INCLUDE, *PARAMETER; "Getting started" for I10=Y, LONG=Y and the marks %, +, -).
namespace spia {
namespace {

class DynaReader {
public:
    explicit DynaReader(DeckLines& lines)
        : lines_(lines), values_(lines), parts_(values_, deck_), transforms_(values_),
          moves_(values_, deck_, transforms_)
    {
    }

    Deck read()
    {
        while (lines_.next()) {
            while (int(file_.size()) > lines_.depth()) {
                file_.pop_back(); // back from an included file, in the block that it was included
                                  // from
                values_.parameters.leave_file();
            }
            const std::string_view line = lines_.line();
            values_.format = top().format;
            values_.placement = top().placement;
            if (line.starts_with('*'))
                begin_block(line);
            else if (!line.starts_with('$') && top().card)
                (this->*top().card)(line);
            while (int(file_.size()) < lines_.depth()) {
                file_.push_back({.usual = child_format_, .format = child_format_, .placement = child_placement_});
                values_.parameters.enter_file();
            }
        }
        return finish();
    }

private:
    using Card = void (DynaReader::*)(std::string_view);
    /// Where a file that is open stands.
    struct File {
        // of the file, of the block
        DynaFormat usual = DynaFormat::standard, format = DynaFormat::standard;
        // null: lines are passed over
        Card card = nullptr;
        std::string keyword = {};
        std::string text = {}; // the beginning of a file name
        int cards = 0;         // of an *INCLUDE_TRANSFORM so far
        DynaPlacement placement = {};
    };
    File& top() { return file_.back(); }

    void begin_block(std::string_view line)
    {
        require_whole_shell();
        if (top().cards > 0)
            lines_.fail("the cards of *INCLUDE_TRANSFORM before this are not complete");
        const DynaKeyword keyword(line, top().usual);
        File& file = top();
        file = {.usual = file.usual, .format = keyword.format, .keyword = keyword.name, .placement = file.placement};
        if (keyword.name == "KEYWORD") {
            file.usual = dyna_format(keyword.options, file.usual);
            end_missing_ = end_missing_ || lines_.depth() == 1;
        } else if (keyword.name == "END") {
            end_missing_ = end_missing_ && lines_.depth() > 1;
            lines_.leave_file();
        } else
            file.card = card_of(keyword);
    }

    /// Shells with cards that are known; others (laminates, NURBS, sources of shells) have cards of
    /// their own.
    static bool is_shell(const DynaKeyword& keyword)
    {
        if (!keyword.is("ELEMENT_SHELL"))
            return false;
        for (std::string_view rest = std::string_view(keyword.name).substr(13); !rest.empty();) {
            const size_t end = std::min(rest.find('_', 1), rest.size());
            static const std::set<std::string_view> known = {"_THICKNESS", "_BETA", "_MCID", "_OFFSET", "_DOF"};
            if (!known.contains(rest.substr(0, end)))
                return false;
            rest.remove_prefix(end);
        }
        return true;
    }

    /// Whether nodes or shells come from it, or are moved by it, in ways that are not read.
    static bool makes_geometry(const DynaKeyword& keyword)
    {
        const auto is_one_of = [&](std::initializer_list<const char*> names) {
            return std::any_of(names.begin(), names.end(), [&](const char* name) { return keyword.is(name); });
        };
        // These hold results, the course of a compensation, or where material enters.
        if (is_one_of({"INCLUDE_STAMPED", "INCLUDE_COMPENSATION", "INCLUDE_MULTISCALE", "ELEMENT_SHELL_SOURCE_SINK"}))
            return false;
        return is_one_of({"INCLUDE", "NODE_TRANSFORM", "NODE_MERGE", "ELEMENT_SHELL", "ELEMENT_GENERATE_SHELL",
                          "PART_MOVE", "PART_DUPLICATE", "COMPONENT"});
    }

    /// What reads the cards of a block; null if it is not read.
    Card card_of(const DynaKeyword& keyword)
    {
        if (keyword.name == "NODE")
            return &DynaReader::node;
        if (is_shell(keyword)) {
            with_thickness_ = keyword.has("THICKNESS") || keyword.has("BETA") || keyword.has("MCID");
            cards_behind_ = int(keyword.has("OFFSET")) + int(keyword.has("DOF"));
            passed_over_ = 0;
            not_written_back_ = keyword.has("BETA") || keyword.has("MCID") || keyword.has("OFFSET");
            return &DynaReader::shell;
        }
        if (keyword.is("PART") && parts_.begin_part(keyword))
            return &DynaReader::part;
        if (keyword.is("SECTION_SHELL")) {
            parts_.begin_section(keyword);
            return &DynaReader::section;
        }
        if (keyword.is("MAT") && !keyword.name.starts_with("MAT_ADD")) {
            parts_.begin_material(keyword);
            return &DynaReader::material;
        }
        if (keyword.name == "INCLUDE")
            return &DynaReader::include;
        if (keyword.name == "INCLUDE_TRANSFORM")
            return &DynaReader::include_transform;
        if (keyword.is("INCLUDE_PATH"))
            return &DynaReader::folder;
        if (keyword.is("DEFINE_TRANSFORMATION")) {
            transforms_.begin(keyword);
            return &DynaReader::transformation;
        }
        if (keyword.name == "PARAMETER" || keyword.name == "PARAMETER_GLOBAL" || keyword.name == "PARAMETER_LOCAL")
            return &DynaReader::parameter;
        if (keyword.is("PARAMETER_EXPRESSION"))
            return &DynaReader::expression;
        if (keyword.name == "NODE_TRANSFORM")
            return &DynaReader::node_transform;
        if (moves_.begin_set(keyword))
            return &DynaReader::node_set;
        if (makes_geometry(keyword)) {
            deck_.count_unread_geometry("*" + keyword.name);
            return nullptr;
        }
        if (keyword.is("ELEMENT"))
            return &DynaReader::other_element;
        if (keyword.name != "TITLE" && keyword.name != "COMMENT")
            deck_.count_skipped("*" + keyword.name);
        return nullptr;
    }

    void node(std::string_view line)
    {
        if (trimmed(line).empty())
            return;
        values_.cut(line, {8, 16, 16, 16});
        const Eigen::Vector3d x(values_.coordinate(1), values_.coordinate(2), values_.coordinate(3));
        deck_.add_node(values_.id(0, &DynaPlacement::node), values_.placement.place * x);
    }

    void shell(std::string_view line)
    {
        if (thickness_next_)
            return thickness(line);
        if (passed_over_ > 0) {
            --passed_over_;
            return;
        }
        if (trimmed(line).empty())
            return;
        values_.cut(line, {8, 8, 8, 8, 8, 8, 8, 8, 8, 8});
        shell_ = {values_.id(0, &DynaPlacement::element), values_.id(1, &DynaPlacement::part), {}};
        for (size_t k = 0; k < 4; ++k)
            shell_.corner[k] = values_.id(2 + k, &DynaPlacement::node);
        const bool middle_nodes = values_.whole_or_zero(6) > 0;
        middle_nodes_ += middle_nodes;
        directed_ += not_written_back_;
        passed_over_ = cards_behind_ + int(with_thickness_ && middle_nodes);
        thickness_next_ = with_thickness_;
        if (!with_thickness_)
            deck_.add_shell(deck_.part(shell_.part), shell_.id, shell_.corner);
    }

    /// The mean over the corners. One that is not given is zero, and zero is that of the section
    /// [LS-DYNA Keyword Manual Vol. I, *ELEMENT_SHELL_THICKNESS], which is not known here: then the
    /// whole element has that of its section.
    void thickness(std::string_view line)
    {
        values_.cut(line, {16, 16, 16, 16, 16});
        const bool triangle = shell_.corner[3] == 0 || shell_.corner[3] == shell_.corner[2];
        std::array<double, 4> thick = {};
        for (size_t k = 0; k < 4; ++k)
            thick[k] = values_.thickness(k).value_or(0);
        const auto given = std::span(thick).first(triangle ? 3 : 4);
        const auto zeros = std::count_if(given.begin(), given.end(), [](double t) { return t == 0; });
        some_corners_ += zeros > 0 && zeros < std::ssize(given);
        deck_.add_shell(deck_.part(shell_.part), shell_.id, shell_.corner, zeros == 0 ? mean(given) : 0);
        thickness_next_ = false;
    }

    void require_whole_shell() const
    {
        if (thickness_next_)
            lines_.fail(fmt::format("the card with the thickness of element {} is missing", shell_.id));
    }

    void part(std::string_view line) { parts_.part(line); }
    void section(std::string_view line) { parts_.section(line); }
    void material(std::string_view line) { parts_.material(line); }

    /// @returns whether the name is complete
    bool file_name(std::string_view line)
    {
        line = trimmed(line);
        const bool goes_on = line.ends_with(" +");
        top().text += goes_on ? trimmed(line.substr(0, line.size() - 2)) : line;
        return !goes_on && !top().text.empty();
    }
    void include(std::string_view line)
    {
        if (!file_name(line))
            return;
        child_format_ = top().format;
        child_placement_ = top().placement;
        lines_.include(std::exchange(top().text, {}));
    }

    /// Five cards, blank ones too: name, offsets, offset of all other ids, factors, number of the
    /// transformation.
    void include_transform(std::string_view line)
    {
        int& card = top().cards;
        if (card == 0) {
            card = int(file_name(line));
            return;
        }
        values_.cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
        if (++card == 2)
            inner_ = {.node = values_.whole_or_zero(0),
                      .element = values_.whole_or_zero(1),
                      .part = values_.whole_or_zero(2),
                      .material = values_.whole_or_zero(3),
                      .set = values_.whole_or_zero(4)};
        else if (card == 3)
            inner_.section = values_.whole_or_zero(0);
        else if (card == 4) {
            if (const double factor = values_.coordinate(2); factor != 0)
                inner_.length = factor;
        } else {
            const std::string name = std::exchange(top().text, {});
            card = 0;
            inner_.place = Eigen::Scaling(inner_.length);
            if (const std::int64_t id = values_.whole_or_zero(0); id != 0) {
                const auto transform = transforms_.find(id);
                if (!transform)
                    deck_.doubt(fmt::format("{} is not moved: its *DEFINE_TRANSFORMATION {} is not there or not read",
                                            name, id));
                inner_.place = transform.value_or(Eigen::Affine3d::Identity()) * inner_.place;
            }
            child_format_ = top().format;
            child_placement_ = top().placement.of_inner(inner_);
            deck_.set_copies();
            lines_.include(name, true);
        }
    }
    void transformation(std::string_view line) { transforms_.card(line); }
    void node_set(std::string_view line) { moves_.set_card(line); }
    void node_transform(std::string_view line) { moves_.move_card(line); }

    void folder(std::string_view line)
    {
        if (!trimmed(line).empty())
            lines_.add_folder(trimmed(line), top().keyword == "INCLUDE_PATH_RELATIVE");
    }

    void parameter(std::string_view line)
    {
        values_.cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
        values_.parameters.define(values_.fields(), top().keyword == "PARAMETER_LOCAL");
    }
    void expression(std::string_view line)
    {
        values_.parameters.define_expression(line, values_.format == DynaFormat::wide ? 20 : 10,
                                             top().keyword.ends_with("_LOCAL"));
    }

    void other_element(std::string_view) { deck_.count_other_elements("*" + top().keyword + " lines"); }

    Deck finish()
    {
        require_whole_shell();
        moves_.apply();
        parts_.finish();
        if (const std::string names = values_.parameters.undefined(); !names.empty())
            deck_.doubt("thicknesses are missing because parameters are not defined, or their expressions are not "
                        "understood (*PARAMETER, *PARAMETER_EXPRESSION): " +
                        names);
        if (end_missing_)
            deck_.doubt("the deck does not end with *END: if it was cut off, shells are missing");
        if (some_corners_ > 0)
            deck_.note(fmt::format("{} a thickness at some of their corners only: that of their section is taken",
                                   counted(some_corners_, "shell has", "shells have")));
        if (middle_nodes_ > 0)
            deck_.note(fmt::format("{} nodes between corners; the corners are taken",
                                   counted(middle_nodes_, "shell has", "shells have")));
        if (directed_ > 0)
            deck_.note(
                fmt::format("{} a material direction or an offset; what is written for this deck does not repeat them",
                            counted(directed_, "shell has", "shells have")));
        return deck_.finish("LS-DYNA keyword", lines_);
    }

    struct Shell {
        std::int64_t id, part;
        std::array<std::int64_t, 4> corner;
    };
    DeckLines& lines_;
    DynaValues values_;
    DeckBuilder deck_;
    DynaParts parts_;
    DynaTransforms transforms_;
    DynaNodeMoves moves_;
    std::vector<File> file_ = {File()}; // those that are open
    DynaFormat child_format_ = DynaFormat::standard;
    DynaPlacement child_placement_, inner_;
    Shell shell_ = {};
    bool with_thickness_ = false, thickness_next_ = false, not_written_back_ = false;
    bool end_missing_ = false; // of a deck that says where it begins
    int cards_behind_ = 0, passed_over_ = 0, middle_nodes_ = 0, some_corners_ = 0, directed_ = 0;
};

} // namespace

Deck read_dyna(DeckLines& lines) { return DynaReader(lines).read(); }

} // namespace spia
