#include <fmt/core.h>

#include "app/cli/commands.h"
#include "engine/core/error.h"

namespace spia::cli {

void require_one_surface(const std::string& k_factor, const std::string& skin)
{
    if (!k_factor.empty() && (skin == "outer" || skin == "inner"))
        throw InputError(fmt::format(
            "--k-factor needs the middle surface, but --skin {} takes another one; leave one of them out", skin));
}

std::string describe_thickness(const std::optional<double>& asked, const PartFile& part)
{
    const char* from = part.solid ? "as the part is" : "as in the deck";
    if (asked && part.thickness_mm && *asked != *part.thickness_mm)
        return fmt::format("the sheet is taken {:.6g} mm thick as requested, not {:.6g} mm {}", *asked,
                           *part.thickness_mm, from);
    if (!asked && part.thickness_mm)
        return fmt::format("the sheet is taken {:.6g} mm thick {} (--thickness for another)", *part.thickness_mm, from);
    if (!asked && part.deck)
        return fmt::format(
            "the deck gives no usable thickness: the sheet is taken {} mm thick (--thickness for another)",
            FlattenOptions{}.thickness);
    return "";
}

} // namespace spia::cli
