#include "engine/mesh/solid/sheet_or_hollow.h"

namespace spia {

double proportion(const ThinSolid& sheet)
{
    // The faces across the thickness are the outline times the thickness.
    return sheet.rim / (2 * (sheet.outer + sheet.inner));
}

ClosedSurface sheet_or_hollow(const ThinSolid& sheet)
{
    constexpr double rounding = 1e-6;
    const double thick = proportion(sheet) * (1 - rounding);
    constexpr double mostly = 0.5, thin_anyway = 0.08;
    const bool plain = !sheet.bent && sheet.outlines <= 1; // what bends at one thickness, or has holes, is no box
    if (plain && sheet.rounded > mostly && thick > thin_anyway)
        return ClosedSurface::perhaps_hollow;
    struct Limits {
        double sure, likely;
    };
    const Limits limits = sheet.outlines > 1 ? Limits{0.4, 0.5} : sheet.bent ? Limits{0.25, 0.5} : Limits{0.15, 0.4};
    return thick <= limits.sure     ? ClosedSurface::sheet
           : thick <= limits.likely ? ClosedSurface::perhaps_sheet
                                    : ClosedSurface::perhaps_hollow;
}

} // namespace spia
