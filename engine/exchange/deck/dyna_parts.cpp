#include "engine/exchange/deck/dyna_parts.h"

#include <algorithm>
#include <array>

#include "engine/core/read_number.h"

namespace spia {

void DynaParts::begin(const DynaKeyword& keyword)
{
    keyword_ = keyword.name;
    title_.clear();
    count_ = more_ = 0;
    titled_ = keyword.has("TITLE");
}

bool DynaParts::begin_part(const DynaKeyword& keyword)
{
    for (const char* untitled :
         {"MOVE", "SENSOR", "ANNEAL", "ADAPTIVE_FAILURE", "DUPLICATE", "MODES", "STACKED_ELEMENTS"})
        if (keyword.has(untitled))
            return false;
    begin(keyword);
    composite_ = keyword.has("COMPOSITE");
    long_plies_ = keyword.has("LONG");
    inertia_ = keyword.has("INERTIA");
    cards_behind_ = 0;
    for (const char* option : {"REPOSITION", "CONTACT", "PRINT", "ATTACHMENT_NODES"})
        cards_behind_ += keyword.has(option);
    return true;
}

void DynaParts::part(std::string_view line)
{
    if (count_ == 0) {
        title_ = trimmed(line);
        count_ = 1;
        return;
    }
    values_.cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
    if (count_ == 1)
        first_card();
    else if (more_ == 0)
        return ply();
    else {
        constexpr size_t own_axes = 4; // if 1, they follow on a fourth card
        if (inertia_ && count_++ == 2)
            more_ += values_.whole_or_zero(own_axes) == 1;
        --more_;
    }
    if (more_ == 0 && !composite_)
        count_ = 0;
}

void DynaParts::first_card()
{
    part_ = deck_.part(values_.id(0, &DynaPlacement::part));
    deck_.at(part_).name = title_;
    if (!composite_) {
        section_of_[part_] = values_.id(1, &DynaPlacement::section);
        deck_.at(part_).material_id = values_.id(2, &DynaPlacement::material);
    }
    count_ = 2;
    more_ = cards_behind_ + (inertia_ ? 3 : 0);
}

/// Of a composite part: up to two layers, each material, thickness, angle, thermal material.
void DynaParts::ply()
{
    for (size_t k = 0; k < (long_plies_ ? 4 : 8); k += 4)
        if (const auto t = values_.thickness(k + 1); t && *t > 0) {
            DeckPart& composite = deck_.at(part_);
            composite.thickness = composite.thickness.value_or(0) + *t;
            if (!composite.material_id)
                composite.material_id = values_.id(k, &DynaPlacement::material);
        }
}

void DynaParts::begin_section(const DynaKeyword& keyword)
{
    begin(keyword);
    repeats_ = keyword.name == "SECTION_SHELL" || keyword.name == "SECTION_SHELL_TITLE";
}

void DynaParts::section(std::string_view line)
{
    if (count_ < 0)
        return;
    if (more_ > 0) {
        --more_;
    } else if (titled_ && count_ == 0) {
        count_ = 1;
    } else if (count_ == int(titled_)) {
        if (trimmed(line).empty())
            return;
        values_.cut(line, {10, 10, 10, 10, 10, 10, 10, 10});
        section_ = values_.id(0, &DynaPlacement::section);
        const bool angles_follow = values_.whole_or_zero(6) == 1;
        constexpr std::int64_t usual_layers = 2; // where the card says none [LS-DYNA Keyword
                                                 // Manual, NIP]
        const std::int64_t layers = angles_follow ? values_.whole_or_zero(3) : 0;
        layers_ = angles_follow && layers == 0 ? usual_layers : layers;
        ++count_;
    } else {
        values_.cut(line, {10, 10, 10, 10});
        sections_[section_] = mean_thickness();
        constexpr std::int64_t most_layers = 10000;
        more_ = int((std::clamp<std::int64_t>(layers_, 0, most_layers) + 7) / 8);
        count_ = repeats_ ? 0 : -1;
    }
}

/// Of the four corners; those that are not given are as the first.
std::optional<double> DynaParts::mean_thickness()
{
    const auto first = values_.thickness(0);
    if (!first || *first == 0)
        return std::nullopt;
    std::array<double, 4> thick = {};
    for (size_t k = 0; k < 4; ++k) {
        const auto t = values_.thickness(k);
        thick[k] = t && *t != 0 ? *t : *first;
    }
    return mean(thick);
}

void DynaParts::begin_material(const DynaKeyword& keyword) { begin(keyword); }

void DynaParts::material(std::string_view line)
{
    if (count_ < 0)
        return;
    if (titled_ && count_ == 0) {
        title_ = trimmed(line);
        count_ = 1;
        return;
    }
    values_.cut(line, {10});
    // newer decks may give a name instead
    if (const auto id = read_whole_number(values_.fields()[0]))
        materials_[*id + values_.placement.material] = {keyword_, title_};
    count_ = -1;
}

void DynaParts::finish()
{
    for (const auto& [part, section] : section_of_)
        if (const auto found = sections_.find(section); found != sections_.end())
            deck_.at(part).thickness = found->second;
    for (int p = 0; p < deck_.parts(); ++p) {
        DeckPart& part = deck_.at(p);
        if (const auto found = materials_.find(part.material_id.value_or(0)); found != materials_.end())
            part.material = found->second.title.empty() ? found->second.keyword : found->second.title;
    }
}

} // namespace spia
