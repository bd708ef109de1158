#include "engine/part/middle_surface.h"

#include <algorithm>
#include <fmt/core.h>
#include <string>

#include "engine/core/place_text.h"
#include "engine/core/text.h"
#include "engine/mesh/solid/bends/holes_over_bends.h"
#include "engine/mesh/solid/border/move_in_flats.h"
#include "engine/mesh/solid/border/onto_surfaces.h"
#include "engine/mesh/solid/holes/round_border.h"
#include "engine/mesh/solid/holes/sunk_holes.h"
#include "engine/part/mark_findings.h"

namespace spia {

namespace {

/// How many have no border of the hole at a skin, but their own.
int cut_at(SheetSide skin, const std::vector<SunkHole>& holes, const std::vector<OpenSink>& open)
{
    const auto apart = [&](const SunkHole& hole) {
        return hole.skin == skin && (hole.diameter == 0 || hole.touching); // in a bend, or with no sheet beside it
    };
    const auto above = [&](const OpenSink& sink) { return sink.land && sink.skin == skin; };
    return cut_off_at(holes, skin) + int(std::ranges::count_if(holes, apart) + std::ranges::count_if(open, above));
}

/// "2 countersinks are open at a border, a bend or another hole, at 1, 2, 3; 4, 5, 6"
std::string counted_open(const std::vector<OpenSink>& sinks)
{
    const bool counterbores = std::ranges::all_of(sinks, &OpenSink::counterbore),
               countersinks = std::ranges::none_of(sinks, &OpenSink::counterbore);
    const int count = int(sinks.size());
    std::vector<Eigen::Vector3d> places;
    places.reserve(sinks.size());
    for (const OpenSink& sink : sinks)
        places.push_back(sink.place);
    return fmt::format("{} open at a border, a bend or another hole, at {} mm",
                       countersinks   ? counted(count, "countersink is", "countersinks are")
                       : counterbores ? counted(count, "counterbore is", "counterbores are")
                                      : counted(count, "sink is", "countersinks and counterbores are"),
                       place_text(places));
}

} // namespace

MiddleSurface middle_surface(const TriMesh& solid, const ThinSolid& sheet, const std::vector<SunkHole>& holes,
                             const std::vector<OpenSink>& open, const ThinSolidOptions& units)
{
    MiddleSurface result;
    Remarks& remarks = result.remarks;
    const int outer = cut_at(SheetSide::outer, holes, open), inner = cut_at(SheetSide::inner, holes, open);
    const bool exchanged = outer > inner;
    const SheetSide made_from = exchanged ? SheetSide::inner : SheetSide::outer;
    if (const int cut = cut_off_at(holes, made_from); cut > 0)
        remarks.doubt(
            fmt::format("{} where the countersink is in the middle of the sheet, wider than the hole",
                        counted(cut,
                                "sunk hole is cut off at the skin that the middle surface is made from: laid "
                                "flat, its edge is",
                                "sunk holes are cut off at the skin that the middle surface is made from: laid "
                                "flat, their edges are")));
    if (const int bent = int(sunk_in_bends(holes).size()); bent > 0)
        remarks.doubt(fmt::format("{} at the {} skin, and the least diameter only where a straight wall ends there",
                                  counted(bent, "hole is sunk in a bend: laid flat, its edge is that",
                                          "holes are sunk in bends: laid flat, their edges are those"),
                                  of_skin(made_from)));
    if (const int through = int(sunk_through(holes, sheet.thickness).size()); through > 0)
        remarks.doubt(
            counted(through,
                    "sunk hole is cut off and has no straight wall below: laid flat, its edge is about where "
                    "the wall crosses the middle of the sheet, not its least diameter",
                    "sunk holes are cut off and have no straight wall below: laid flat, their edges are about "
                    "where the walls cross the middle of the sheet, not their least diameters"));
    const ThinSolid from = exchanged ? sides_exchanged(sheet) : sheet;
    const std::vector<SunkHole> sunk = exchanged ? sunk_holes(solid, from) : holes;
    SkinMesh& skin = result.skin = skin_of(solid, from, Skin::middle, units);
    if (!units.surface.empty())
        onto_surfaces(skin, solid, from, units);
    straighten_holes(skin, solid, sunk, from.thickness);
    if (!units.surface.empty()) {
        const std::vector<int> done = holes_over_bends(skin, solid, from, units.surface);
        round_border(skin, solid, from, units.surface, done);
    }
    settle_in_flats(skin);
    std::vector<Eigen::Vector3d> wide;
    for (const SunkHole* hole : narrow_holes(skin, sunk))
        wide.push_back(hole->centre);
    if (!wide.empty())
        remarks.doubt(fmt::format("{} wide as what is sunk, at {} mm: triangles between its rim and what is "
                                  "beside it would turn over; draw the hole at its least diameter",
                                  counted(wide.size(), "sunk hole is laid flat as", "sunk holes are laid flat as"),
                                  place_text(wide)));
    if (exchanged) {
        skin.mesh.triangle.row(1).swap(skin.mesh.triangle.row(2));
        skin.side = SheetSide::inner;
    }
    return result;
}

Remarks on_open_sinks(const std::vector<OpenSink>& open, Skin taken, SheetSide side)
{
    Remarks remarks;
    std::vector<OpenSink> through, above, below;
    for (const OpenSink& sink : open)
        (!sink.land ? through : sink.skin == side ? above : below).push_back(sink);
    if (!through.empty())
        remarks.doubt(counted_open(through) +
                      ": no straight wall is below, and the edge that is laid flat lies where "
                      "the wall crosses the middle of the sheet, unevenly; draw it at its least "
                      "diameter");
    if (!above.empty() && taken == Skin::middle)
        remarks.doubt(counted_open(above) + fmt::format(": others are sunk at the other skin, and what is laid flat is "
                                                        "its edge at the {} skin, wider than the hole below; draw the "
                                                        "hole",
                                                        of_skin(side)));
    else if (!above.empty())
        remarks.notes.push_back(counted_open(above) +
                                fmt::format(": its edge at the {} skin is laid flat, wider than the "
                                            "hole below",
                                            of_skin(side)));
    if (!below.empty())
        remarks.notes.push_back(counted_open(below) + ": the hole below is laid flat, and no marks show where to "
                                                      "countersink or counterbore");
    return remarks;
}

} // namespace spia
