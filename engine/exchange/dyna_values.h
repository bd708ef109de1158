#pragma once
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "engine/exchange/deck_fields.h"
#include "engine/exchange/deck_lines.h"
#include "engine/exchange/dyna_card.h"
#include "engine/exchange/dyna_parameters.h"

namespace spia {

/// The fields of the card at hand of an LS-DYNA deck as numbers, "&name" replaced by its parameter.
class DynaValues {
public:
    explicit DynaValues(DeckLines& lines) : lines_(lines) {}

    void cut(std::string_view line, std::initializer_list<int> widths) { cut_dyna_card(line, widths, format, fields_); }
    const DeckFields& fields() const { return fields_; }
    DeckLines& lines() { return lines_; }

    // Field i, counted from 0. @throws InputError if it is something else, or a parameter that is not defined
    std::int64_t whole(size_t i) { return lines_.whole(meant(fields_[i])); }
    std::int64_t whole_or_zero(size_t i) { return fields_[i].empty() ? 0 : whole(i); }
    double coordinate(size_t i) { return fields_[i].empty() ? 0 : lines_.coordinate(meant(fields_[i])); }
    /// 0 if there is none, nothing if its parameter is not defined: a part can be unfolded without.
    std::optional<double> thickness(size_t i);

    DynaFormat format = DynaFormat::standard; ///< of the cards that are cut
    DynaParameters parameters;

private:
    std::string_view meant(std::string_view field); ///< good until the next one
    DeckLines& lines_;
    DeckFields fields_;
    std::string meant_; ///< what the parameter stands for that was asked for last
};

} // namespace spia
