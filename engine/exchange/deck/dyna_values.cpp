#include "engine/exchange/deck/dyna_values.h"

#include <fmt/core.h>

namespace spia {

DynaPlacement DynaPlacement::of_inner(const DynaPlacement& inner) const
{
    return {node + inner.node,       element + inner.element, part + inner.part,     material + inner.material,
            section + inner.section, set + inner.set,         length * inner.length, place * inner.place};
}

std::string_view DynaValues::meant(std::string_view field)
{
    if (!DynaParameters::is_name(field))
        return field;
    std::optional<std::string> value = parameters.find(field);
    if (!value)
        lines_.fail(fmt::format("the parameter {} is not defined before, or its expression is not understood",
                                field.substr(0, 40)));
    meant_ = std::move(*value);
    return meant_;
}

std::optional<double> DynaValues::thickness(size_t i)
{
    const std::string_view field = fields_[i];
    if (field.empty())
        return 0;
    if (!DynaParameters::is_name(field))
        return placement.length * lines_.number(field);
    const std::optional<std::string> value = parameters.find(field);
    return value ? std::optional(placement.length * lines_.number(*value)) : std::nullopt;
}

} // namespace spia
