#include "engine/pipeline/flat_thickness.h"

#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia {

double flat_thickness(const std::optional<double>& asked, const PartFile& part, double usual)
{
    const double thickness = asked.value_or(part.thickness_mm.value_or(usual));
    if (!(thickness > 0) || !std::isfinite(thickness))
        throw InputError(fmt::format("the thickness is {} mm; it must be above 0", thickness));
    return thickness;
}

} // namespace spia
