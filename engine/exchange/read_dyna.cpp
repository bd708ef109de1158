#include <algorithm>
#include <fmt/core.h>
#include <map>
#include <optional>

#include "engine/exchange/deck_builder.h"
#include "engine/exchange/deck_number.h"
#include "engine/exchange/dyna_card.h"
#include "engine/exchange/dyna_parameters.h"
#include "engine/exchange/read_deck.h"

// Card layouts: LS-DYNA Keyword User's Manual, volume I (*NODE, *ELEMENT_SHELL, *PART, *SECTION_SHELL, *INCLUDE, *PARAMETER;
// "Getting started" for I10=Y, LONG=Y and the marks %, +, -).
namespace spia {
namespace {

class DynaReader {
public:
    explicit DynaReader(DeckLines& lines) : lines_(lines) {}

    Deck read()
    {
        while (lines_.next()) {
            while (int(block_.size()) > lines_.depth())
                block_.pop_back(); // back from an included file, in the block that it was included from
            const std::string_view line = lines_.line();
            if (line.starts_with('*'))
                begin_block(line);
            else if (!line.starts_with('$') && top().card)
                (this->*top().card)(line);
            while (int(block_.size()) < lines_.depth())
                block_.push_back({.usual = child_format_, .format = child_format_});
        }
        return finish();
    }

private:
    using Card = void (DynaReader::*)(std::string_view);
    struct Block {
        DynaFormat usual = DynaFormat::standard, format = DynaFormat::standard;
        Card card = nullptr; // what reads a line of it; null: it is passed over
        int count = 0;       // cards of the current entry so far
        int more = 0;        // cards still to be passed over
        bool title = false;  // one comes first
        bool repeats = true; // several entries may follow each other
        std::string keyword = {};
        std::string text = {}; // a title, or the beginning of a file name
    };
    struct Material {
        std::string keyword, title;
    };
    Block& top() { return block_.back(); }
    void cut(std::string_view line, std::initializer_list<int> widths)
    {
        cut_dyna_card(line, widths, top().format, fields_);
    }

    void begin_block(std::string_view line)
    {
        require_whole_shell();
        const DynaKeyword keyword(line, top().usual);
        Block& block = top();
        block = {.usual = block.usual, .format = keyword.format, .keyword = keyword.name};
        block.title = keyword.has("TITLE");
        if (keyword.name == "KEYWORD")
            block.usual = dyna_format(keyword.options, block.usual);
        else if (keyword.name == "END")
            lines_.leave_file();
        else if (keyword.name == "NODE")
            block.card = &DynaReader::node;
        else if (keyword.is("ELEMENT_SHELL") && !keyword.has("COMPOSITE") && !keyword.has("NURBS"))
            begin_shells(keyword);
        else if (keyword.is("PART"))
            begin_parts(keyword);
        else if (keyword.is("SECTION_SHELL")) {
            block.card = &DynaReader::section;
            block.repeats = keyword.name == "SECTION_SHELL" || keyword.name == "SECTION_SHELL_TITLE";
        } else if (keyword.is("MAT") && !keyword.name.starts_with("MAT_ADD"))
            block.card = &DynaReader::material;
        else if (keyword.name == "INCLUDE")
            block.card = &DynaReader::include;
        else if (keyword.is("INCLUDE_PATH"))
            block.card = &DynaReader::folder;
        else if (keyword.name == "PARAMETER" || keyword.name == "PARAMETER_GLOBAL" || keyword.name == "PARAMETER_LOCAL")
            block.card = &DynaReader::parameter;
        else if (keyword.is("PARAMETER_EXPRESSION"))
            block.card = &DynaReader::expression;
        else if (keyword.is("ELEMENT") && !keyword.is("ELEMENT_SHELL"))
            block.card = &DynaReader::other_element;
        else if (keyword.name != "TITLE" && keyword.name != "COMMENT")
            deck_.count_skipped("*" + keyword.name);
    }

    void node(std::string_view line)
    {
        if (trimmed(line).empty())
            return;
        cut(line, {8, 16, 16, 16});
        deck_.add_node(whole(fields_[0]), {coordinate(fields_[1]), coordinate(fields_[2]), coordinate(fields_[3])});
    }

    void begin_shells(const DynaKeyword& keyword)
    {
        top().card = &DynaReader::shell;
        with_thickness_ = keyword.has("THICKNESS") || keyword.has("BETA") || keyword.has("MCID");
        cards_behind_ = int(keyword.has("OFFSET")) + int(keyword.has("DOF"));
    }

    void shell(std::string_view line)
    {
        Block& block = top();
        if (block.count == 0 && block.more > 0) {
            --block.more;
            return;
        }
        if (block.count == 0) {
            if (trimmed(line).empty())
                return;
            cut(line, {8, 8, 8, 8, 8, 8, 8, 8, 8, 8});
            shell_ = {whole(fields_[0]), whole(fields_[1]), {}};
            for (size_t k = 0; k < 4; ++k)
                shell_.corner[k] = whole_or_zero(fields_[2 + k]);
            const bool middle_nodes = whole_or_zero(fields_[6]) > 0;
            middle_nodes_ += middle_nodes;
            block.more = cards_behind_ + int(with_thickness_ && middle_nodes);
            block.count = with_thickness_;
            if (!with_thickness_)
                deck_.add_shell(deck_.part(shell_.part), shell_.id, shell_.corner);
            return;
        }
        cut(line, {16, 16, 16, 16, 16});
        const bool triangle = shell_.corner[3] == 0 || shell_.corner[3] == shell_.corner[2];
        double sum = 0;
        for (size_t k = 0; k < (triangle ? 3 : 4); ++k)
            sum += thickness(fields_[k]).value_or(0) / (triangle ? 3 : 4);
        deck_.add_shell(deck_.part(shell_.part), shell_.id, shell_.corner, sum);
        block.count = 0;
    }

    void require_whole_shell()
    {
        if (top().card == &DynaReader::shell && top().count > 0)
            lines_.fail(fmt::format("the card with the thickness of element {} is missing", shell_.id));
    }

    void begin_parts(const DynaKeyword& keyword)
    {
        for (const char* untitled :
             {"MOVE", "SENSOR", "ANNEAL", "ADAPTIVE_FAILURE", "DUPLICATE", "MODES", "STACKED_ELEMENTS"})
            if (keyword.has(untitled))
                return deck_.count_skipped("*" + keyword.name);
        composite_ = keyword.has("COMPOSITE");
        long_plies_ = keyword.has("LONG");
        inertia_ = keyword.has("INERTIA");
        cards_behind_part_ = 0;
        for (const char* option : {"REPOSITION", "CONTACT", "PRINT", "ATTACHMENT_NODES"})
            cards_behind_part_ += keyword.has(option);
        top().card = &DynaReader::part;
    }

    void part(std::string_view line)
    {
        Block& block = top();
        if (block.count == 0) {
            block.text = trimmed(line);
            block.count = 1;
            return;
        }
        if (block.count == 1) {
            cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
            part_ = deck_.part(whole(fields_[0]));
            deck_.at(part_).name = block.text;
            if (!composite_) {
                section_of_[part_] = whole_or_zero(fields_[1]);
                deck_.at(part_).material_id = whole_or_zero(fields_[2]);
            }
            block.count = 2;
            block.more = cards_behind_part_ + (inertia_ ? 3 : 0);
        } else if (block.more == 0) {
            return ply(line);
        } else {
            if (inertia_ && block.count++ == 2) { // the first of its cards says whether there is a fourth
                cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
                block.more += whole_or_zero(fields_[4]) == 1;
            }
            --block.more;
        }
        if (block.more == 0 && !composite_)
            block.count = 0;
    }

    /// Of a composite part: up to two layers, each material, thickness, angle, material.
    void ply(std::string_view line)
    {
        cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
        for (size_t k = 0; k < (long_plies_ ? 4 : 8); k += 4)
            if (const auto t = thickness(fields_[k + 1]); t && *t > 0) {
                DeckPart& composite = deck_.at(part_);
                composite.thickness = composite.thickness.value_or(0) + *t;
                if (!composite.material_id)
                    composite.material_id = whole_or_zero(fields_[k]);
            }
    }

    void section(std::string_view line)
    {
        Block& block = top();
        if (block.count < 0)
            return;
        if (block.more > 0) {
            --block.more;
            return;
        }
        if (block.title && block.count == 0) {
            block.count = 1;
        } else if (block.count == int(block.title)) {
            if (trimmed(line).empty())
                return;
            cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
            section_ = whole(fields_[0]);
            layers_ = whole_or_zero(fields_[6]) == 1 ? whole_or_zero(fields_[3]) : 0;
            ++block.count;
        } else {
            cut(line, {10, 10, 10, 10});
            sections_[section_] = mean_thickness();
            constexpr std::int64_t most_layers = 10000;
            block.more = int((std::clamp<std::int64_t>(layers_, 0, most_layers) + 7) / 8);
            block.count = block.repeats ? 0 : -1;
        }
    }

    /// Of the four corners; those that are not given are as the first.
    std::optional<double> mean_thickness()
    {
        const auto first = thickness(fields_[0]);
        if (!first || !(*first > 0))
            return std::nullopt;
        double sum = 0;
        for (size_t k = 0; k < 4; ++k) {
            const auto t = thickness(fields_[k]);
            sum += t && *t > 0 ? *t : *first;
        }
        return sum / 4;
    }

    void material(std::string_view line)
    {
        Block& block = top();
        if (block.title && block.count == 0) {
            block.text = trimmed(line);
            block.count = 1;
            return;
        }
        cut(line, {10});
        if (!fields_[0].empty()) // also the names that newer decks give
            if (const auto id = deck_whole(fields_[0]))
                materials_[*id] = {block.keyword, block.text};
        block.card = nullptr;
    }

    void include(std::string_view line)
    {
        line = trimmed(line);
        Block& block = top();
        if (line.empty())
            return;
        if (line.ends_with(" +")) {
            block.text += trimmed(line.substr(0, line.size() - 2));
            return;
        }
        const std::string name = block.text + std::string(line);
        block.text.clear();
        child_format_ = block.format;
        lines_.include(name);
    }

    void folder(std::string_view line)
    {
        if (!trimmed(line).empty())
            lines_.add_folder(trimmed(line), top().keyword == "INCLUDE_PATH_RELATIVE");
    }

    void parameter(std::string_view line)
    {
        cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
        parameters_.define(fields_);
    }
    void expression(std::string_view line)
    {
        parameters_.define_expression(line, top().format == DynaFormat::wide ? 20 : 10);
    }
    void other_element(std::string_view) { deck_.count_other_elements("*" + top().keyword + " lines"); }

    /// What a field says, with "&name" replaced. @throws InputError if it is not defined
    std::string_view meant(std::string_view field)
    {
        if (!DynaParameters::is_name(field))
            return field;
        const std::string* value = parameters_.find(field);
        if (!value)
            lines_.fail(fmt::format("the parameter {} is not defined", field.substr(0, 40)));
        return *value;
    }
    std::int64_t whole(std::string_view field) { return lines_.whole(meant(field)); }
    std::int64_t whole_or_zero(std::string_view field) { return field.empty() ? 0 : whole(field); }
    double coordinate(std::string_view field) { return field.empty() ? 0 : lines_.coordinate(meant(field)); }
    /// Nothing if the parameter is not defined; the end of the deck tells of it.
    std::optional<double> thickness(std::string_view field)
    {
        if (field.empty())
            return 0;
        const std::string* value = DynaParameters::is_name(field) ? parameters_.find(field) : nullptr;
        if (DynaParameters::is_name(field) && !value)
            return std::nullopt;
        return lines_.number(value ? std::string_view(*value) : field);
    }

    Deck finish()
    {
        require_whole_shell();
        for (const auto& [part, section] : section_of_)
            if (const auto found = sections_.find(section); found != sections_.end())
                deck_.at(part).thickness = found->second;
        for (int p = 0; p < deck_.parts(); ++p) {
            DeckPart& part = deck_.at(p);
            if (const auto found = materials_.find(part.material_id.value_or(0)); found != materials_.end())
                part.material = found->second.title.empty() ? found->second.keyword : found->second.title;
        }
        if (const std::string names = parameters_.undefined(); !names.empty())
            deck_.note("thicknesses are missing because parameters are not defined: " + names);
        if (middle_nodes_ > 0)
            deck_.note(fmt::format("{} shells have nodes on their edges; their corners are taken", middle_nodes_));
        return deck_.finish("LS-DYNA keyword", lines_.notes);
    }

    struct Shell {
        std::int64_t id, part;
        std::array<std::int64_t, 4> corner;
    };
    DeckLines& lines_;
    DeckBuilder deck_;
    DeckFields fields_;
    DynaParameters parameters_;
    std::vector<Block> block_ = {Block()}; // of the files that are open
    DynaFormat child_format_ = DynaFormat::standard;
    Shell shell_ = {};
    bool with_thickness_ = false, composite_ = false, long_plies_ = false, inertia_ = false;
    int cards_behind_ = 0, cards_behind_part_ = 0, middle_nodes_ = 0;
    int part_ = 0;
    std::int64_t section_ = 0, layers_ = 0;
    std::map<int, std::int64_t> section_of_;
    std::map<std::int64_t, std::optional<double>> sections_;
    std::map<std::int64_t, Material> materials_;
};

} // namespace

Deck read_dyna(DeckLines& lines) { return DynaReader(lines).read(); }

} // namespace spia
