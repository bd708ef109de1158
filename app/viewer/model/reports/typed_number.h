#pragma once
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace spia::viewer {

/// A number as users type it: with a point or a comma before the decimals, in any locale, and with
/// the unit behind it that the field shows. Nothing if it is no number, or not finite: no character
/// is passed over.
/// @param units  those that may stand behind it
std::optional<double> typed_number_of(std::string_view text, std::initializer_list<std::string_view> units = {});

/// Why what was typed is not taken. @param field as its label calls it, with or without a unit;
/// empty: it has none
/// @param kept  what the field shows in its place
std::string refused_number(std::string_view text, std::string_view field, std::string_view kept);

/// What a label says in front of its unit, and the unit: "Thickness, mm" are "Thickness" and "mm".
/// Without a comma the unit is empty.
struct FieldName {
    std::string_view name, unit;
};
FieldName field_name(std::string_view label);

} // namespace spia::viewer
