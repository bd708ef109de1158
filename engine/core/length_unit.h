#pragma once
#include <string_view>

namespace spia {

enum class LengthUnit { mm, cm, m, inch };

double millimetres(LengthUnit unit); ///< length of one unit
std::string_view name(LengthUnit unit);
LengthUnit length_unit(std::string_view name); ///< @throws InputError unless mm, cm, m or inch

} // namespace spia
