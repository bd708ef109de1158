#include <cmath>
#include <fmt/core.h>

#include "app/cli/commands.h"
#include "engine/core/error.h"

namespace spia::cli {
namespace {

constexpr double usual = 1; // mm

} // namespace

double sheet_thickness(const std::optional<double>& asked, const PartFile& part)
{
    const double thickness = asked.value_or(part.thickness_mm.value_or(usual));
    if (!(thickness > 0) || !std::isfinite(thickness))
        throw InputError(fmt::format("the thickness is {} mm; it must be above 0", thickness));
    return thickness;
}

void require_one_surface(const std::string& k_factor, const std::string& skin)
{
    if (!k_factor.empty() && (skin == "outer" || skin == "inner"))
        throw InputError(
            fmt::format("--k-factor moves the middle surface of bends to their neutral fibre, and --skin {} "
                        "takes another surface; leave one of them out",
                        skin));
}

std::string describe_thickness(const std::optional<double>& asked, const PartFile& part)
{
    const char* from = part.solid ? "as the part is" : "as in the deck";
    if (asked && part.thickness_mm && *asked != *part.thickness_mm)
        return fmt::format("the sheet is taken {:.6g} mm thick as asked for, not {:.6g} mm {}", *asked,
                           *part.thickness_mm, from);
    if (!asked && part.thickness_mm)
        return fmt::format("the sheet is taken {:.6g} mm thick {} (--thickness for another)", *part.thickness_mm, from);
    if (!asked && part.deck)
        return fmt::format(
            "the deck gives no thickness that could be taken: the sheet is taken {} mm thick (--thickness "
            "for another)",
            usual);
    return "";
}

} // namespace spia::cli
