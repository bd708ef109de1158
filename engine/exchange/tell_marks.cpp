#include "engine/exchange/tell_holes.h"

#include <fmt/core.h>

namespace spia {
namespace {

/// "countersink 12 mm wide, 3 mm deep, of a hole of 6 mm"
std::string words(const SunkHole& hole)
{
    return fmt::format("{} {:.4g} mm wide, {:.4g} mm deep, of a hole{}, on the {} skin",
                       hole.counterbore ? "counterbore" : "countersink", hole.diameter, hole.depth,
                       hole.least > 0 ? fmt::format(" of {:.4g} mm", hole.least) : " that is not round",
                       hole.skin == SheetSide::inner ? "inner" : "outer");
}

} // namespace

Finding finding_of(const std::vector<SunkHole>& holes, Skin taken, const std::vector<int>& source_face)
{
    Tally where;
    for (const SunkHole& hole : holes)
        where.add(source_face[size_t(hole.face)]);
    const SunkHole& first = holes.front();
    Finding finding{Fault::mark,
                    Severity::note,
                    int(holes.size()),
                    where.first,
                    fmt::format("{} at a skin than inside (a countersink, a counterbore or a chamfer): what is laid "
                                "flat has {}, and circles of the marks show where to sink; the first is a {} at "
                                "{:.6g}, {:.6g}, {:.6g}",
                                counted(int(holes.size()), "hole is wider", "holes are wider"),
                                taken == Skin::middle ? "the least diameter of each"
                                                      : fmt::format("the diameters at the {} skin", name(taken)),
                                words(first), first.centre.x(), first.centre.y(), first.centre.z()),
                    "",
                    where.where,
                    {}};
    for (size_t i = 0; i < finding.where.size(); ++i) {
        finding.place.push_back(holes[i].centre);
        finding.what.push_back(words(holes[i]));
    }
    return finding;
}

} // namespace spia
