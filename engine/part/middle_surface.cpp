#include "engine/part/middle_surface.h"

#include <algorithm>
#include <fmt/core.h>
#include <set>
#include <string>

#include "engine/mesh/holes_over_bends.h"
#include "engine/mesh/onto_surfaces.h"
#include "engine/mesh/open_sinks.h"
#include "engine/mesh/round_border.h"

namespace spia {

SkinMesh middle_surface(PartFile& part, const ThinSolid& sheet, const std::vector<SunkHole>& holes,
                        const ThinSolidOptions& units)
{
    const SheetSide made_from = skin_of_middle(holes);
    if (const int most = cut_off_at(holes, made_from); most > 0)
        doubt(part, fmt::format("{} where the countersink is in the middle of the sheet, wider than the hole",
                                counted(most,
                                        "sunk hole is cut off at the skin that the middle surface is made from: laid "
                                        "flat, its edge is",
                                        "sunk holes are cut off at the skin that the middle surface is made from: laid "
                                        "flat, their edges are")));
    const auto not_least = [](int count) {
        return count == 1
                   ? "laid flat, its edge is about where the wall crosses the middle of the sheet, not its least "
                     "diameter"
                   : "laid flat, their edges are about where the walls cross the middle of the sheet, not their "
                     "least diameters";
    };
    if (const int bent = sunk_in_bends(holes); bent > 0)
        doubt(part, fmt::format("{}: {}", counted(bent, "hole is sunk in a bend", "holes are sunk in bends"),
                                not_least(bent)));
    if (const int through = int(sunk_through(holes, sheet.thickness).size()); through > 0)
        doubt(part, fmt::format("{} no straight wall below: {}",
                                counted(through, "sunk hole is cut off and has", "sunk holes are cut off and have"),
                                not_least(through)));
    const bool exchanged = made_from == SheetSide::inner;
    const ThinSolid from = exchanged ? sides_exchanged(sheet) : sheet;
    const std::vector<SunkHole> sunk = exchanged ? sunk_holes(part.mesh, from) : holes;
    SkinMesh skin = skin_of(part.mesh, from, Skin::middle, units);
    if (!units.surface.empty())
        onto_surfaces(skin, part.mesh, from, units);
    straighten_holes(skin, part.mesh, sunk, from.thickness);
    if (!units.surface.empty()) {
        const std::vector<int> done = holes_over_bends(skin, part.mesh, from, units.surface);
        round_border(skin, part.mesh, from, units.surface, done);
    }
    narrow_holes(skin, sunk);
    if (exchanged) {
        skin.mesh.triangle.row(1).swap(skin.mesh.triangle.row(2));
        skin.side = SheetSide::inner;
    }
    return skin;
}

void tell_open_sinks(PartFile& part, const ThinSolid& sheet, const std::vector<SunkHole>& holes)
{
    const std::vector<OpenSink> sinks = open_sinks(part.mesh, sheet, holes);
    for (const bool land : {false, true}) {
        const auto first = std::ranges::find(sinks, land, &OpenSink::land);
        if (first == sinks.end())
            continue;
        const int count = int(std::ranges::count(sinks, land, &OpenSink::land));
        const std::string text =
            fmt::format("{} open at a border or at another hole, {}at {:.6g}, {:.6g}, {:.6g}",
                        counted(count, "countersink is", "countersinks are"), count > 1 ? "the first " : "",
                        first->place.x(), first->place.y(), first->place.z());
        if (land)
            part.notes.push_back(text + ": the hole below is laid flat, marks do not show where to sink");
        else
            doubt(part, text + ": no straight wall is below, and the edge that is laid flat lies where the wall "
                               "crosses the middle of the sheet, unevenly; draw it at its least diameter");
    }
}

} // namespace spia
