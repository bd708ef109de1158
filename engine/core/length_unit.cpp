#include "engine/core/length_unit.h"

#include <array>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia {
namespace {

struct UnitName {
    LengthUnit unit;
    std::string_view name;
    double millimetres;
};
constexpr std::array<UnitName, 4> units = {{{LengthUnit::mm, "mm", 1},
                                            {LengthUnit::cm, "cm", 10},
                                            {LengthUnit::m, "m", 1000},
                                            {LengthUnit::inch, "inch", 25.4}}};

} // namespace

double millimetres(LengthUnit unit) { return units[size_t(unit)].millimetres; }

std::string_view name(LengthUnit unit) { return units[size_t(unit)].name; }

LengthUnit length_unit(std::string_view name)
{
    for (const UnitName& known : units)
        if (known.name == name)
            return known.unit;
    throw InputError(fmt::format("'{}' is not a unit of length here; give mm, cm, m or inch", name));
}

} // namespace spia
