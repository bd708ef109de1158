#include "engine/part/skin_remarks.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "engine/core/place_text.h"
#include "engine/core/text.h"
#include "engine/mesh/solid/bends/uneven_bends.h"
#include "engine/mesh/solid/border/beside_solid.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"
#include "engine/part/mark_findings.h"

namespace spia {
namespace {

/// "a solid of sheet 2 mm thick and a hollow body of its size are the same closed surface, ..."
std::string either(const ThinSolid& sheet)
{
    return fmt::format(
        "a sheet-metal solid {:.6g} mm thick and a hollow body of its size are the same closed surface, and the file "
        "does not say which it is; the sheet would be {:.2g} times as thick as it is wide",
        sheet.thickness, proportion(sheet));
}

std::vector<Eigen::Vector3d> places_of(const auto& rows)
{
    std::vector<Eigen::Vector3d> places;
    places.reserve(rows.size());
    for (const auto& row : rows)
        places.push_back(row.place);
    return places;
}

} // namespace

Remarks on_hollow(const TriMesh& mesh, const std::string& why)
{
    Remarks remarks;
    if (seems_thin_solid(mesh))
        remarks.doubt(fmt::format("most of it lies opposite to another part of itself, as in a sheet-metal solid; but "
                                  "{}. It is taken as a hollow body; if it is a sheet-metal solid, choose the skin "
                                  "that stands for it ({}) to see why it is refused",
                                  why, mention(option::skin, "middle")));
    return remarks;
}

Remarks on_border(const TriMesh& middle, const GivenSolid& solid, double tolerance)
{
    const std::vector<BesideSolid> off = beside_solid(middle, solid.mesh, solid.thickness, tolerance, solid.deflection);
    Remarks remarks;
    if (off.empty())
        return remarks;
    const auto [least, most] = std::ranges::minmax(off, {}, &BesideSolid::beside);
    std::vector<std::string> wrong; // where the solid goes on the blank ends too early
    if (most.beside > 0)
        wrong.push_back(fmt::format("too small by up to {:.2g} mm", most.beside));
    if (least.beside < 0)
        wrong.push_back(fmt::format("too large by up to {:.2g} mm", -least.beside));
    remarks.doubt(fmt::format(
        "the edge of the middle surface is off that of the solid at {}, where the blank is {}: at {} mm. Compare the "
        "outline there with the part and correct it by hand, or model that edge square to the sheet, without recesses "
        "or rounds at both skins",
        counted(off.size(), "place", "places"), fmt::join(wrong, " and "), place_text(places_of(off))));
    return remarks;
}

Remarks on_oblique_holes(const SkinMesh& middle)
{
    Remarks remarks;
    if (!middle.oblique.empty())
        remarks.notes.push_back(fmt::format("{} the sheet at an angle, at {} mm: the blank has the section at "
                                            "mid-thickness, and the slanted walls are to be machined after cutting",
                                            counted(middle.oblique.size(), "hole crosses", "holes cross"),
                                            place_text(middle.oblique)));
    return remarks;
}

Remarks on_wide_holes(const std::vector<SunkHole>& holes, SheetSide taken)
{
    Remarks remarks;
    if (const int wide = wider_at(holes, taken); wide > 0)
        remarks.doubt(fmt::format(
            "{} at the {} skin, which is laid flat: cut like this, the recesses there are lost; take the middle "
            "surface, where a hole has its least diameter ({})",
            counted(wide, "hole is wider", "holes are wider"), of_skin(taken), mention(option::skin, "middle")));
    return remarks;
}

Remarks on_bosses(const std::vector<SunkHole>& holes)
{
    std::vector<Eigen::Vector3d> places;
    double high = 0;
    for (const SunkHole& hole : holes)
        if (hole.depth < 0) {
            places.push_back(hole.centre);
            high = std::max(high, -hole.depth);
        }
    Remarks remarks;
    if (places.empty())
        return remarks;
    remarks.doubt(fmt::format("around {} something stands up from the sheet, up to {:.4g} mm, at {} mm, like a nut or "
                              "a boss that was joined with it: the blank is that of the sheet without it, with the "
                              "hole at its narrowest width; leave it out of the model",
                              counted(places.size(), "hole", "holes"), high, place_text(places)));
    return remarks;
}

Remarks on_blind_holes(const std::vector<BlindHole>& holes)
{
    Remarks remarks;
    if (holes.empty())
        return remarks;
    const double depth = std::ranges::max_element(holes, {}, &BlindHole::depth)->depth;
    remarks.doubt(fmt::format("{} not go through the sheet, up to {:.3g} mm deep, at {} mm: the blank and its drawing "
                              "do not show it; mark it by hand, or leave it out of the model",
                              counted(holes.size(), "hole does", "holes do"), depth, place_text(places_of(holes))));
    return remarks;
}

Remarks on_block(const ThinSolid& sheet)
{
    Remarks remarks;
    if (sheet_or_hollow(sheet) == ClosedSurface::perhaps_hollow)
        remarks.doubt(fmt::format("the solid is {:.2g} times as thick as it is wide, which is more like a block than a "
                                  "sheet; it is taken as sheet {:.6g} mm thick",
                                  proportion(sheet), sheet.thickness));
    return remarks;
}

Remarks on_uneven_bends(const TriMesh& solid, const ThinSolid& sheet, SheetSide laid,
                        const std::vector<StatedSurface>& surface)
{
    const std::vector<UnevenBend> bends = uneven_bends(sheet, surface);
    Remarks remarks;
    if (bends.empty())
        return remarks;
    const UnevenBend& first = bends.front();
    const Eigen::Vector3d place = solid.position.col(solid.triangle(0, first.face));
    remarks.doubt(
        fmt::format("{} arcs of radius {:.4g} and {:.4g} mm on both skins of a sheet of {:.4g} mm, at {:.6g}, {:.6g}, "
                    "{:.6g} mm{}: the sheet is not as thick there, and inner radius and flat length are taken from the "
                    "arc of the {} skin and the thickness elsewhere",
                    counted(bends.size(), "bend has", "bends have"), first.outer, first.inner, sheet.thickness,
                    place.x(), place.y(), place.z(), bends.size() > 1 ? " (the first)" : "", of_skin(laid)));
    return remarks;
}

Remarks on_taper(const ThinSolid& sheet)
{
    constexpr double uneven = 0.1; // of the thickness; chords of drawn solids come to 0.06
    Remarks remarks;
    if (sheet.thin_tenth < (1 - uneven) * sheet.thickness || sheet.thick_tenth > (1 + uneven) * sheet.thickness)
        remarks.doubt(
            fmt::format("the thickness varies: a tenth of the sheet is {:.4g} mm thick or less, a tenth "
                        "{:.4g} mm or more, and {:.4g} mm is taken everywhere; give another one if that is not "
                        "what it is cut from ({})",
                        sheet.thin_tenth, sheet.thick_tenth, sheet.thickness, mention(option::thickness)));
    return remarks;
}

Remarks on_skin(const PartFile& part, bool uneven_told)
{
    Remarks remarks;
    const SolidOrigin& solid = *part.solid;
    const int taken = solid.side == SheetSide::inner ? solid.inner_faces : solid.outer_faces;
    const std::string what = solid.skin == Skin::middle
                                 ? fmt::format("middle surface, from the {} of its {} skin,",
                                               counted(taken, "face", "faces"), of_skin(solid.side))
                                 : fmt::format("{} skin of {}", name(solid.skin), counted(taken, "face", "faces"));
    remarks.notes.push_back(fmt::format("a solid of {}{}: its {} is taken, sheet {:.6g} mm thick (another surface "
                                        "of it: {})",
                                        counted(solid.faces, "face", "faces"),
                                        solid.open ? ", some of which are missing" : "", what, solid.thickness,
                                        mention(option::skin)));
    constexpr double uneven = 1.15; // a bend with one radius on both sides is up to 1.41 times as
                                    // thick
    if (part.cad && !uneven_told && solid.most > uneven * solid.thickness)
        remarks.doubt(fmt::format(
            "the sheet is up to {:.4g} mm thick, {:.3g} times {:.4g} mm: where the arcs of both skins are not coaxial, "
            "inner radius and flat length of a bend are those for the thickness elsewhere",
            solid.most, solid.most / solid.thickness, solid.thickness));
    const std::string least = fmt::format("{:.4g}", solid.least), most = fmt::format("{:.4g}", solid.most);
    remarks.notes.push_back(
        fmt::format("thickness {}; outer skin {:.6g} mm2, inner skin {:.6g} mm2, faces across the "
                    "thickness {:.6g} mm2",
                    least == most ? least + " mm everywhere" : fmt::format("between {} and {} mm", least, most),
                    solid.outer_area, solid.inner_area, solid.rim_area));
    return remarks;
}

Remarks on_either(const ThinSolid& sheet, ClosedSurface closed)
{
    Remarks remarks;
    if (closed == ClosedSurface::perhaps_hollow)
        remarks.doubt(fmt::format("{}. It is taken as a hollow body; for a solid choose the skin that stands for it "
                                  "({})",
                                  either(sheet), mention(option::skin, "middle")));
    if (closed == ClosedSurface::perhaps_sheet)
        remarks.doubt(fmt::format("{}. It is taken as a solid; a hollow body is cut open along a seam that you give "
                                  "({})",
                                  either(sheet), mention(option::seam, "FILE")));
    return remarks;
}

} // namespace spia
