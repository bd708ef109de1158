#include <algorithm>
#include <fmt/core.h>
#include <set>
#include <utility>

#include "engine/exchange/deck_builder.h"
#include "engine/exchange/deck_number.h"
#include "engine/exchange/dyna_card.h"
#include "engine/exchange/dyna_parts.h"
#include "engine/exchange/dyna_values.h"
#include "engine/exchange/read_deck.h"

// Card layouts: LS-DYNA Keyword User's Manual, volume I (*NODE, *ELEMENT_SHELL, *PART, *SECTION_SHELL, *INCLUDE,
// *PARAMETER; "Getting started" for I10=Y, LONG=Y and the marks %, +, -).
namespace spia {
namespace {

class DynaReader {
public:
    explicit DynaReader(DeckLines& lines) : lines_(lines), values_(lines), parts_(values_, deck_) {}

    Deck read()
    {
        while (lines_.next()) {
            while (int(file_.size()) > lines_.depth()) {
                file_.pop_back(); // back from an included file, in the block that it was included from
                values_.parameters.leave_file();
            }
            const std::string_view line = lines_.line();
            values_.format = top().format;
            if (line.starts_with('*'))
                begin_block(line);
            else if (!line.starts_with('$') && top().card)
                (this->*top().card)(line);
            while (int(file_.size()) < lines_.depth()) {
                file_.push_back({.usual = child_format_, .format = child_format_});
                values_.parameters.enter_file();
            }
        }
        return finish();
    }

private:
    using Card = void (DynaReader::*)(std::string_view);
    /// Where a file that is open stands.
    struct File {
        DynaFormat usual = DynaFormat::standard, format = DynaFormat::standard; // of the file, of the block
        Card card = nullptr;                                                    // null: lines are passed over
        std::string keyword = {};
        std::string text = {}; // the beginning of a file name
    };
    File& top() { return file_.back(); }

    void begin_block(std::string_view line)
    {
        require_whole_shell();
        const DynaKeyword keyword(line, top().usual);
        File& file = top();
        file = {.usual = file.usual, .format = keyword.format, .keyword = keyword.name};
        if (keyword.name == "KEYWORD") {
            file.usual = dyna_format(keyword.options, file.usual);
            end_missing_ = end_missing_ || lines_.depth() == 1;
        } else if (keyword.name == "END") {
            end_missing_ = end_missing_ && lines_.depth() > 1;
            lines_.leave_file();
        } else
            file.card = card_of(keyword);
    }

    /// Shells with cards that are known; others (laminates, NURBS, sources of shells) have cards of their own.
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
        if (keyword.is("INCLUDE_PATH"))
            return &DynaReader::folder;
        if (keyword.name == "PARAMETER" || keyword.name == "PARAMETER_GLOBAL" || keyword.name == "PARAMETER_LOCAL")
            return &DynaReader::parameter;
        if (keyword.is("PARAMETER_EXPRESSION"))
            return &DynaReader::expression;
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
        deck_.add_node(values_.whole(0), {values_.coordinate(1), values_.coordinate(2), values_.coordinate(3)});
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
        shell_ = {values_.whole(0), values_.whole(1), {}};
        for (size_t k = 0; k < 4; ++k)
            shell_.corner[k] = values_.whole_or_zero(2 + k);
        const bool middle_nodes = values_.whole_or_zero(6) > 0;
        middle_nodes_ += middle_nodes;
        directed_ += not_written_back_;
        passed_over_ = cards_behind_ + int(with_thickness_ && middle_nodes);
        thickness_next_ = with_thickness_;
        if (!with_thickness_)
            deck_.add_shell(deck_.part(shell_.part), shell_.id, shell_.corner);
    }

    /// The mean over the corners. One that is not given is zero, and zero is that of the section [LS-DYNA Keyword Manual Vol. I,
    /// *ELEMENT_SHELL_THICKNESS], which is not known here: then the whole element has that of its section.
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

    void include(std::string_view line)
    {
        line = trimmed(line);
        if (line.empty())
            return;
        if (line.ends_with(" +")) {
            top().text += trimmed(line.substr(0, line.size() - 2));
            return;
        }
        const std::string name = std::exchange(top().text, {}) + std::string(line);
        child_format_ = top().format;
        lines_.include(name);
    }
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
        parts_.finish();
        if (const std::string names = values_.parameters.undefined(); !names.empty())
            deck_.note("thicknesses are missing because parameters are not defined: " + names);
        if (end_missing_)
            deck_.doubt("the deck does not end with *END: if it was cut off, shells are missing");
        if (some_corners_ > 0)
            deck_.note(
                fmt::format("{} shells have a thickness at some of their corners only: that of their section is taken",
                            some_corners_));
        if (middle_nodes_ > 0)
            deck_.note(fmt::format("{} shells have nodes on their edges; their corners are taken", middle_nodes_));
        if (directed_ > 0)
            deck_.note(
                fmt::format("{} shells have a material direction or an offset; what is written for this deck does "
                            "not repeat them",
                            directed_));
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
    std::vector<File> file_ = {File()}; // those that are open
    DynaFormat child_format_ = DynaFormat::standard;
    Shell shell_ = {};
    bool with_thickness_ = false, thickness_next_ = false, not_written_back_ = false;
    bool end_missing_ = false; // of a deck that says where it begins
    int cards_behind_ = 0, passed_over_ = 0, middle_nodes_ = 0, some_corners_ = 0, directed_ = 0;
};

} // namespace

Deck read_dyna(DeckLines& lines) { return DynaReader(lines).read(); }

} // namespace spia
