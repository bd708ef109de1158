#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "engine/exchange/deck/deck_fields.h"
#include "engine/exchange/deck/deck_lines.h"
#include "engine/exchange/deck/dyna_card.h"
#include "engine/exchange/deck/dyna_parameters.h"

namespace spia {

/// What *INCLUDE_TRANSFORM does to what a file holds: added to its ids, applied to its lengths.
struct DynaPlacement {
    std::int64_t node = 0, element = 0, part = 0, material = 0, section = 0, set = 0;
    double length = 1;                                   ///< factor, of coordinates and thicknesses
    Eigen::Affine3d place = Eigen::Affine3d::Identity(); ///< of coordinates, with the factor in it

    /// That of a file included by one that is placed like this.
    DynaPlacement of_inner(const DynaPlacement& inner) const;
};

/// The fields of the card at hand of an LS-DYNA deck as numbers, "&name" replaced by its parameter.
class DynaValues {
public:
    explicit DynaValues(DeckLines& lines) : lines_(lines) {}

    void cut(std::string_view line, std::initializer_list<int> widths) { cut_dyna_card(line, widths, format, fields_); }
    const DeckFields& fields() const { return fields_; }
    DeckLines& lines() { return lines_; }

    // Field i, counted from 0. @throws InputError if it is something else, or a parameter that is
    // not defined
    std::int64_t whole(size_t i) { return lines_.whole(meant(fields_[i])); }
    /// An id and what is added to it in this file; 0 stays: there is none.
    std::int64_t id(size_t i, std::int64_t DynaPlacement::*offset)
    {
        const std::int64_t written = whole_or_zero(i);
        return written == 0 ? 0 : written + placement.*offset;
    }
    std::int64_t whole_or_zero(size_t i) { return fields_[i].empty() ? 0 : whole(i); }
    double coordinate(size_t i) { return fields_[i].empty() ? 0 : lines_.coordinate(meant(fields_[i])); }
    /// With the file's factor of lengths. 0 if there is none, nothing if its parameter is not
    /// defined: a part can be unfolded without.
    std::optional<double> thickness(size_t i);

    DynaFormat format = DynaFormat::standard; ///< of the cards that are cut
    DynaParameters parameters;
    DynaPlacement placement; ///< of the file at hand

private:
    std::string_view meant(std::string_view field); ///< good until the next one
    DeckLines& lines_;
    DeckFields fields_;
    std::string meant_; ///< what the parameter stands for that was asked for last
};

} // namespace spia
