#include <fmt/core.h>

#include "app/cli/commands.h"

namespace spia::cli {

double sheet_thickness(const std::optional<double>& asked, const PartFile& part)
{
    constexpr double usual = 1;
    return asked.value_or(part.thickness_mm.value_or(usual));
}

std::string thickness_in_words(const std::optional<double>& asked, const PartFile& part)
{
    const char* from = part.solid ? "as the part is" : "as in the deck";
    if (asked && part.thickness_mm && *asked != *part.thickness_mm)
        return fmt::format("the sheet is taken {:.6g} mm thick as asked for, not {:.6g} mm {}", *asked,
                           *part.thickness_mm, from);
    if (!asked && part.thickness_mm)
        return fmt::format("the sheet is taken {:.6g} mm thick {} (--thickness for another)", *part.thickness_mm,
                           from);
    if (!asked && part.deck)
        return "the deck gives no thickness that could be taken: the sheet is taken 1 mm thick (--thickness for another)";
    return "";
}

} // namespace spia::cli
