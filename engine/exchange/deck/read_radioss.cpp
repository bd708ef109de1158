#include <fmt/core.h>
#include <map>
#include <set>

#include "engine/core/read_number.h"
#include "engine/exchange/deck/abaqus_keyword.h"
#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/deck_fields.h"
#include "engine/exchange/deck/radioss_submodels.h"
#include "engine/exchange/deck/radioss_transforms.h"
#include "engine/exchange/deck/read_deck.h"

// Layouts: Radioss block format, starter input (/BEGIN, /NODE, /SHELL, /SH3N, /PART, /PROP/TYPE1,
// /MAT), columns of ten and twenty.
namespace spia {
namespace {

class RadiossReader {
public:
    explicit RadiossReader(DeckLines& lines)
        : lines_(lines), submodels_(lines, deck_), transforms_(lines, deck_, submodels_)
    {
    }

    Deck read()
    {
        while (lines_.next()) {
            const std::string_view line = lines_.line();
            if (line.starts_with("#include"))
                lines_.include(trimmed(line.substr(8)));
            else if (line.starts_with('#') || line.starts_with('$'))
                continue;
            else if (line.starts_with('/'))
                begin_block(line);
            else if (card_) {
                (this->*card_)(line);
                ++count_;
            }
        }
        submodels_.finish();
        transforms_.apply();
        for (const auto& [part, property] : property_of_)
            if (const auto found = thickness_.find(property); found != thickness_.end() && found->second != 0)
                deck_.at(part).thickness = found->second;
        for (int p = 0; p < deck_.parts(); ++p)
            if (const auto found = material_.find(deck_.at(p).material_id.value_or(0)); found != material_.end())
                deck_.at(p).material = found->second;
        return deck_.finish("Radioss starter", lines_);
    }

private:
    using Card = void (RadiossReader::*)(std::string_view);

    /// "/PROP/SHELL/3" is three words.
    void begin_block(std::string_view line)
    {
        card_ = nullptr;
        count_ = 0;
        std::array<std::string_view, 5> word;
        size_t words = 0;
        for (std::string_view rest = trimmed(line).substr(1); words < word.size() && !rest.empty(); ++words) {
            const size_t slash = rest.find('/');
            word[words] = trimmed(rest.substr(0, slash));
            rest.remove_prefix(slash == rest.npos ? rest.size() : slash + 1);
        }
        // "//SUBMODEL"
        const std::string name = upper_case(!word[0].empty() ? word[0] : "/" + std::string(word[1]));
        if (name == "BEGIN")
            card_ = &RadiossReader::begin;
        else if (name == "NODE") {
            if (!word[1].empty() && lines_.whole(word[1]) != 0)
                lines_.fail("nodes in a unit system of their own are not read");
            card_ = &RadiossReader::node;
        } else if (name == "SHELL" || name == "SH3N") {
            part_ = deck_.part(shifted(lines_.whole(word[1]), &RadiossOffsets::part));
            card_ = name == "SHELL" ? &RadiossReader::shell : &RadiossReader::triangle;
        } else if (name == "PART") {
            part_ = deck_.part(shifted(lines_.whole(word[1]), &RadiossOffsets::part));
            card_ = &RadiossReader::part;
        } else if (name == "PROP" && is_shell_property(upper_case(word[1]))) {
            id_ = shifted(lines_.whole(word[2]), &RadiossOffsets::property);
            card_ = &RadiossReader::property;
            if (!word[3].empty() && lines_.whole(word[3]) != 0) {
                deck_.note(fmt::format(
                    "the thickness of property {} is not taken, for it is in a unit system of its own", id_));
                card_ = nullptr;
            }
        } else if (name == "MAT" && words > 2) {
            id_ = shifted(lines_.whole(word[2]), &RadiossOffsets::material);
            material_[id_] = upper_case(word[1]);
            card_ = &RadiossReader::material;
        } else if (name == "END")
            lines_.leave_file();
        else if (is_other_element(name)) {
            other_ = "/" + name;
            card_ = &RadiossReader::other_element;
        } else if (name == "GRNOD") {
            if (!word[2].empty() && transforms_.begin_group(upper_case(word[1]), lines_.whole(word[2])))
                card_ = &RadiossReader::group;
        } else if (name == "TRANSFORM") {
            if (transforms_.begin_transform(upper_case(word[1]), !word[3].empty() && lines_.whole(word[3]) != 0))
                card_ = &RadiossReader::transform;
            else
                deck_.count_unread_geometry("/TRANSFORM/" + upper_case(word[1]));
        } else if (name == "/SUBMODEL") {
            if (!word[4].empty()) // "V41"
                require_version(read_whole_number(word[4].substr(1)).value_or(0));
            submodels_.begin(lines_.whole(word[2]), !word[3].empty() && lines_.whole(word[3]) != 0);
            card_ = &RadiossReader::submodel;
        } else if (name == "/ENDSUB")
            submodels_.end();
        else if (name == "SUBMODEL")
            deck_.count_unread_geometry("/SUBMODEL");
        else if (name != "TITLE")
            deck_.count_skipped("/" + name);
    }

    static bool is_shell_property(const std::string& type)
    {
        static const std::set<std::string> known = {"SHELL",  "TYPE1",    "SH_ORTH", "TYPE9",   "SH_COMP",
                                                    "TYPE10", "SH_SANDW", "TYPE11",  "SH_FABR", "TYPE16"};
        return known.contains(type);
    }
    static bool is_other_element(const std::string& name)
    {
        static const std::set<std::string> known = {"BRICK", "BRIC20", "SHEL16", "PENTA6", "TETRA4", "TETRA10",
                                                    "QUAD",  "TRIA",   "BEAM",   "TRUSS",  "SPRING", "SPHCEL"};
        return known.contains(name);
    }

    template <size_t N> void cut(std::string_view line, const std::array<int, N>& widths)
    {
        if (line.find('\t') != line.npos)
            fields_.cut_words(line);
        else
            fields_.cut_columns(line, widths);
    }

    void require_version(std::int64_t version) const
    {
        constexpr std::int64_t narrow_cards = 44; // and before: columns of eight
        if (version > 0 && version < narrow_cards)
            lines_.fail(fmt::format("cards of version {} are not read", version));
    }

    void begin(std::string_view line)
    {
        if (count_ == 1) {
            fields_.cut_words(line);
            require_version(lines_.whole_or_zero(fields_[0]));
        } else if (count_ == 2) {
            cut(line, std::array{20, 20, 20});
            const std::string_view named = trimmed(fields_[1]);
            for (const LengthUnit unit : {LengthUnit::mm, LengthUnit::cm, LengthUnit::m, LengthUnit::inch})
                if (same_letters(named, name(unit)) || (unit == LengthUnit::inch && same_letters(named, "in")))
                    return set_unit(unit);
            if (named.empty())
                return;
            if (submodels_.is_inside())
                submodels_.set_unit({});
            else
                deck_.note(
                    fmt::format("its length unit \"{}\" is not known: it is read as mm unless one is given", named));
        }
    }

    /// Of the deck, or of the submodel that the block stands in.
    void set_unit(LengthUnit unit)
    {
        if (submodels_.is_inside())
            return submodels_.set_unit(unit);
        submodels_.set_unit_of_deck(unit);
        deck_.set_unit(unit);
    }

    std::int64_t shifted(std::int64_t id, std::int64_t RadiossOffsets::*offset) const
    {
        return submodels_.shifted(id, offset);
    }

    void node(std::string_view line)
    {
        if (trimmed(line).empty())
            return;
        cut(line, std::array{10, 20, 20, 20});
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k)
            if (const std::string_view field = fields_[size_t(1 + k)]; !field.empty())
                x[k] = lines_.coordinate(field);
        deck_.add_node(shifted(lines_.whole(fields_[0]), &RadiossOffsets::node), submodels_.length() * x);
    }

    void shell(std::string_view line)
    {
        if (trimmed(line).empty())
            return;
        // a blank field, an angle and a thickness at the end
        cut(line, std::array{10, 10, 10, 10, 10, 10, 20, 20});
        add_shell(4, fields_[7]);
    }
    void triangle(std::string_view line)
    {
        if (trimmed(line).empty())
            return;
        cut(line, std::array{10, 10, 10, 10, 20, 20, 20});
        add_shell(3, fields_[6]);
    }
    void add_shell(size_t corners, std::string_view thickness)
    {
        std::array<std::int64_t, 4> corner = {};
        for (size_t k = 0; k < corners; ++k)
            corner[k] = shifted(lines_.whole(fields_[1 + k]), &RadiossOffsets::node);
        deck_.add_shell(part_, shifted(lines_.whole(fields_[0]), &RadiossOffsets::element), corner,
                        thickness.empty() ? 0 : submodels_.length() * lines_.number(thickness));
    }

    void part(std::string_view line)
    {
        if (count_ == 0)
            deck_.at(part_).name = trimmed(line);
        if (count_ != 1)
            return;
        cut(line, std::array{10, 10, 10});
        property_of_[part_] = shifted(lines_.whole_or_zero(fields_[0]), &RadiossOffsets::property);
        deck_.at(part_).material_id = shifted(lines_.whole_or_zero(fields_[1]), &RadiossOffsets::material);
    }

    void property(std::string_view line)
    {
        constexpr int title_and_two_cards = 3;
        if (count_ != title_and_two_cards)
            return;
        cut(line, std::array{10, 10, 20}); // layers, a flag, thickness
        if (!fields_[2].empty())
            thickness_[id_] = submodels_.length() * lines_.number(fields_[2]);
    }

    void material(std::string_view line)
    {
        if (count_ == 0 && !trimmed(line).empty())
            material_[id_] = trimmed(line);
    }

    void submodel(std::string_view line) { submodels_.card(line, count_); }
    void group(std::string_view line) { transforms_.group(line, count_); }
    void transform(std::string_view line) { transforms_.transform(line, count_); }

    void other_element(std::string_view) { deck_.count_other_elements(other_ + " lines"); }

    DeckLines& lines_;
    DeckBuilder deck_;
    RadiossSubmodels submodels_;
    RadiossTransforms transforms_;
    DeckFields fields_;
    Card card_ = nullptr;
    int count_ = 0; // lines of this block so far
    int part_ = 0;
    std::int64_t id_ = 0;
    std::string other_;
    std::map<int, std::int64_t> property_of_;
    std::map<std::int64_t, double> thickness_;
    std::map<std::int64_t, std::string> material_;
};

} // namespace

Deck read_radioss(DeckLines& lines) { return RadiossReader(lines).read(); }

} // namespace spia
