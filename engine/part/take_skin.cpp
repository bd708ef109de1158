#include "engine/part/take_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <optional>
#include <set>
#include <utility>

#include "engine/core/place_text.h"
#include "engine/core/text.h"
#include "engine/mesh/solid/bends/uneven_bends.h"
#include "engine/mesh/solid/border/beside_solid.h"
#include "engine/mesh/solid/border/onto_projection.h"
#include "engine/mesh/solid/fit/measured_cylinders.h"
#include "engine/mesh/solid/holes/sunk_holes.h"
#include "engine/mesh/solid/marks/blind_holes.h"
#include "engine/mesh/solid/marks/mark_outlines.h"
#include "engine/mesh/solid/marks/without_marks.h"
#include "engine/mesh/solid/sheet_or_hollow.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"
#include "engine/options/sheet_options.h"
#include "engine/part/cover_openings.h"
#include "engine/part/mark_findings.h"
#include "engine/part/middle_surface.h"

namespace spia {
namespace {

bool of_the_surface(const Finding& finding)
{
    return finding.fault == Fault::closed_surface || finding.fault == Fault::handle;
}

/// Why a surface may be that of a solid.
enum class Claim {
    none,
    measured, ///< it is closed: what its two skins say decides
    stated    ///< by the file, by the user, or it is so thin that nothing else can be meant
};

/// Shells of a section are sheet themselves; those that a mesher made of a solid's surface have
/// none.
bool shells_have_a_thickness(const DeckOrigin& deck)
{
    return std::any_of(deck.part_of.begin(), deck.part_of.end(),
                       [&](int p) { return deck.parts[size_t(p)].thickness.has_value(); });
}

Claim claim_of(const PartFile& part, const ReadOptions& options, bool solid)
{
    const DoctorReport& report = part.doctor;
    const bool sick = std::any_of(report.findings.begin(), report.findings.end(), [](const Finding& finding) {
        return finding.severity == Severity::fatal && !of_the_surface(finding);
    });
    if (sick || report.components != 1 || !report.boundary_loops)
        return Claim::none;
    if (options.skin)
        return Claim::stated;
    if (part.deck && shells_have_a_thickness(*part.deck))
        return Claim::none;
    if (options.seam.mode == SeamOptions::Mode::given) // of a skin of a solid, else a hollow body's
        return solid ? Claim::measured : Claim::none;
    if (*report.boundary_loops == 0)
        return solid || has_both_skins(part.mesh) ? Claim::stated : Claim::measured;
    return seems_thin_solid(part.mesh) ? Claim::stated : Claim::none;
}

/// What the triangles of a solid lie on, each; empty: not known.
using Surfaces = std::vector<StatedSurface>;

/// As a CAD file states it.
Surfaces stated_by_cad(const PartFile& part)
{
    Surfaces surface;
    if (part.cad && !part.cad->surface.empty())
        for (const int f : part.source_face)
            surface.push_back(part.cad->surface[size_t(part.cad->face[size_t(f)])]);
    return surface;
}

ThinSolidOptions faces_of(const PartFile& part, const CornerNormals* normals, const Surfaces& surface)
{
    ThinSolidOptions options;
    options.surface = surface;
    if (part.cad)
        for (const int f : part.source_face)
            options.unit.push_back(part.cad->face[size_t(f)]);
    if (normals)
        options.normal_at = [&part, normals](int f, const Eigen::Vector3d& place, const Eigen::Vector3d& own) {
            return normals->at(part.source_face[size_t(f)], place, own);
        };
    options.face_name = [&part](int f) {
        const int in_file = part.source_face[size_t(f)];
        return part.cad ? fmt::format("CAD face {}", part.cad->face[size_t(in_file)]) : fmt::format("face {}", in_file);
    };
    return options;
}

/// How many CAD faces, else faces of the file, the triangles with `counts` are of.
template <class Counts> int faces(const PartFile& part, const Counts& counts)
{
    std::set<int> found;
    for (size_t f = 0; f < part.source_face.size(); ++f)
        if (counts(f))
            found.insert(part.cad ? part.cad->face[size_t(part.source_face[f])] : part.source_face[f]);
    return int(found.size());
}

void refuse(PartFile& part, const NotASheet& reason, bool solid)
{
    std::erase_if(part.doctor.findings, of_the_surface);
    const int count = faces(part, [](size_t) { return true; });
    Finding finding{Fault::closed_surface,
                    Severity::fatal,
                    count,
                    reason.face < 0 ? -1 : part.source_face[size_t(reason.face)],
                    fmt::format("{} of {}, and {}", solid ? "it is a solid" : "it is a closed surface",
                                counted(count, "face", "faces"), reason.what()),
                    "a solid is taken apart where it is a sheet of one thickness; else give one skin of the sheet: ",
                    {},
                    {}};
    finding.advice +=
        part.cad
            ? fmt::format("choose its faces ({}, e.g. 3 or 0-17), or export it as a surface", mention(option::part))
            : "delete the other side and the faces across the thickness. If it is a hollow body, give "
              "the seam along which to cut it open";
    if (finding.first >= 0) {
        finding.where.push_back(finding.first);
        finding.place.push_back(reason.place);
    }
    part.doctor.findings.insert(part.doctor.findings.begin(), std::move(finding));
}

/// The doctor sees the skin, too: it may touch itself at a point where the solid did not.
void replace_mesh(PartFile& part, const SkinMesh& skin)
{
    PolygonSoup soup;
    for (int v = 0; v < skin.mesh.vertices(); ++v)
        soup.position.push_back(skin.mesh.position.col(v));
    for (int f = 0; f < skin.mesh.triangles(); ++f)
        soup.add_polygon(std::array{skin.mesh.triangle(0, f), skin.mesh.triangle(1, f), skin.mesh.triangle(2, f)});
    Examination examination = examine(soup, {});
    const auto vertex_in_file = [&](int v) { return part.source_vertex[size_t(skin.source_vertex[size_t(v)])]; };
    const auto face_in_file = [&](int f) { return part.source_face[size_t(skin.source_face[size_t(f)])]; };
    std::erase_if(part.doctor.findings, [](const Finding& finding) {
        // of the other skin and the faces across, too
        return of_the_surface(finding) || finding.fault == Fault::sliver;
    });
    for (Finding& finding : examination.report.findings) {
        const bool vertices = counts_vertices(finding.fault);
        for (int& i : finding.where)
            i = vertices ? vertex_in_file(i) : face_in_file(i);
        if (finding.first >= 0)
            finding.first = vertices ? vertex_in_file(finding.first) : face_in_file(finding.first);
        part.doctor.findings.push_back(std::move(finding));
    }
    part.doctor.components = examination.report.components;
    part.doctor.boundary_loops = examination.report.boundary_loops;
    part.doctor.genus = examination.report.genus;
    part.doctor.euler_characteristic = examination.report.euler_characteristic;
    for (int& v : examination.source_vertex)
        v = vertex_in_file(v);
    for (int& f : examination.source_face)
        f = face_in_file(f);
    part.source_vertex = std::move(examination.source_vertex);
    part.source_face = std::move(examination.source_face);
    part.mesh = std::move(examination.mesh);
}

/// A part without the shallow marks of its skins.
struct PlainPart {
    PartFile part;
    ThinSolid sheet;
    std::optional<Finding> marks = {};      ///< that were taken away
    std::vector<MarkOutline> outlines = {}; ///< of these
};

/// Measures the solid, too.
/// @throws NotASheet
PlainPart without_its_marks(const PartFile& part, const CornerNormals* normals, const Progress& progress)
{
    PlainPart plain{part, thin_solid(part.mesh, faces_of(part, normals, stated_by_cad(part)), progress)};
    if (plain.sheet.marks.empty())
        return plain;
    PlainSolid solid = without_marks(part.mesh, plain.sheet, stated_by_cad(part));
    plain.outlines = mark_outlines(part.mesh, plain.sheet, solid);
    plain.marks = finding_of(plain.sheet.marks, plain.sheet, part.source_face);
    plain.part.mesh = std::move(solid.mesh);
    plain.part.source_vertex.clear();
    plain.part.source_face.clear();
    for (const int v : solid.source_vertex)
        plain.part.source_vertex.push_back(part.source_vertex[size_t(v)]);
    for (const int f : solid.source_face)
        plain.part.source_face.push_back(part.source_face[size_t(f)]);
    plain.sheet = thin_solid(plain.part.mesh, faces_of(plain.part, normals, stated_by_cad(plain.part)), progress);
    return plain;
}

/// A doubt that says why it is a hollow body, if it may be another thing.
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

/// "a solid of sheet 2 mm thick and a hollow body of its size are the same closed surface, ..."
std::string either(const ThinSolid& sheet)
{
    return fmt::format(
        "a sheet-metal solid {:.6g} mm thick and a hollow body of its size are the same closed surface, and the file "
        "does not say which it is; the sheet would be {:.2g} times as thick as it is wide",
        sheet.thickness, proportion(sheet));
}

/// A surface of a solid of sheet that can be laid flat.
struct LaidSkin {
    SkinMesh skin;
    Skin kind;
    Remarks remarks;
};

/// Puts the border where the solid ends: of CAD, whose walls are no chords, what is straight also
/// where that would not be told, as long as nothing more is to be told by that.
/// @param told  mm, by how much a border is beside its place that is told
void put_border(SkinMesh& middle, const Surfaces& under, const GivenSolid& solid, double told)
{
    SkinMesh finer = middle;
    onto_projection(middle, under, solid, told);
    if (solid.deflection == 0)
        return;
    constexpr double fine = 0.1;   // of what is told
    constexpr double straight = 5; // thicknesses; holes have finer chords than the outline of the solid
    onto_projection(finer, under, solid, fine * told, straight * solid.thickness);
    onto_projection(finer, under, solid, told);
    const auto places = [&](const SkinMesh& skin) {
        return beside_solid(skin.mesh, solid.mesh, solid.thickness, told, solid.deflection).size();
    };
    if (places(finer) <= places(middle))
        middle = std::move(finer);
}

std::vector<Eigen::Vector3d> places_of(const auto& rows)
{
    std::vector<Eigen::Vector3d> places;
    places.reserve(rows.size());
    for (const auto& row : rows)
        places.push_back(row.place);
    return places;
}

/// A doubt where the edge of the blank is beside its place.
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

/// Where none was asked for and there is no middle one the outer skin is better than nothing, and a
/// doubt.
LaidSkin laid_skin(const TriMesh& solid, const ThinSolid& sheet, const std::vector<SunkHole>& holes,
                   const std::vector<OpenSink>& open, std::optional<Skin> asked, const ThinSolidOptions& units)
{
    const Skin wanted = asked.value_or(Skin::middle);
    try {
        LaidSkin laid{{}, wanted, {}};
        if (wanted == Skin::middle) {
            MiddleSurface middle = middle_surface(solid, sheet, holes, open, units);
            laid.skin = std::move(middle.skin);
            laid.remarks = std::move(middle.remarks);
            laid.remarks.add(on_oblique_holes(laid.skin));
        } else
            laid.skin = skin_of(solid, sheet, wanted, units);
        return laid;
    } catch (const NotASheet& reason) {
        if (asked)
            throw;
        LaidSkin laid{skin_of(solid, sheet, Skin::outer, units), Skin::outer, {}};
        laid.remarks.doubt(fmt::format("{}. Nothing else was asked for, so the outer skin is laid flat: lengths over "
                                       "bends are those of the outer skin, which are longer than the sheet's",
                                       reason.what()));
        return laid;
    }
}

/// On a skin the holes that are sunk there are as wide as the tool that sinks them.
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

/// What stands up from the sheet is no part of it.
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

/// What does not go through the sheet is not cut out of it.
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

/// A solid whose file says that it is one may still be a block.
Remarks on_block(const ThinSolid& sheet)
{
    Remarks remarks;
    if (sheet_or_hollow(sheet) == ClosedSurface::perhaps_hollow)
        remarks.doubt(fmt::format("the solid is {:.2g} times as thick as it is wide, which is more like a block than a "
                                  "sheet; it is taken as sheet {:.6g} mm thick",
                                  proportion(sheet), sheet.thickness));
    return remarks;
}

/// Of triangles, per face of the file; empty where none is known.
Surfaces of_file_faces(const PartFile& part, const Surfaces& surface)
{
    Surfaces result;
    for (size_t f = 0; f < surface.size(); ++f)
        if (surface[f].kind != StatedSurface::Kind::other) {
            result.resize(size_t(part.file_faces));
            result[size_t(part.source_face[f])] = surface[f];
        }
    return result;
}

/// Of bends that are not as thick as the sheet; nothing if there are none.
Remarks on_uneven_bends(const TriMesh& solid, const ThinSolid& sheet, SheetSide laid, const Surfaces& surface)
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

/// Of wedges, and of solids that a simulation of forming has thinned.
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

/// @param uneven_told  bends that are not as thick as the sheet have been told with their radii
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

/// Which of the two it is that a closed surface is taken for, where the file does not say; empty if
/// it can be a solid of sheet alone.
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

/// @param examined  with its marks
SolidOrigin origin_of(const PartFile& examined, const PlainPart& plain, const LaidSkin& laid,
                      const std::vector<SunkHole>& holes)
{
    const ThinSolid& sheet = plain.sheet;
    const auto faces_on = [&](SheetSide side) {
        return faces(plain.part, [&](size_t f) { return sheet.side[f] == side; });
    };
    SolidOrigin origin{laid.kind,
                       sheet.thickness,
                       sheet.least,
                       sheet.most,
                       sheet.outer,
                       sheet.inner,
                       area(laid.skin.mesh),
                       sheet.rim,
                       sheet.volume,
                       faces(examined, [](size_t) { return true; }),
                       faces_on(SheetSide::outer),
                       faces_on(SheetSide::inner),
                       *examined.doctor.boundary_loops > 0,
                       {},
                       laid.skin.side};
    for (const MarkOutline& outline : plain.outlines)
        origin.marks.push_back(
            {on_surface(outline, laid.kind, sheet.thickness),
             {.outer = outline.skin == SheetSide::outer, .inner = outline.skin == SheetSide::inner}});
    for (MarkLine& line : lines_of(holes, laid.kind, sheet.thickness))
        origin.marks.push_back(std::move(line));
    return origin;
}

/// The part with a skin in the place of the solid that it is; as it was if it is rather a hollow
/// body.
/// @throws NotASheet
PartFile with_skin(const PartFile& examined, Claim claim, const ReadOptions& options, bool solid,
                   const CornerNormals* normals, const Progress& progress)
{
    PlainPart plain = without_its_marks(examined, normals, progress);
    PartFile& part = plain.part;
    ThinSolid& sheet = plain.sheet;
    if (claim == Claim::measured && !solid) {
        const ClosedSurface closed = sheet_or_hollow(sheet);
        const bool hollow = closed == ClosedSurface::perhaps_hollow;
        if (hollow)
            part = examined;
        add(part, on_either(sheet, closed));
        if (hollow)
            return std::move(plain.part);
    }
    if (solid && *examined.doctor.boundary_loops == 0 && !options.skin)
        add(part, on_block(sheet));
    Surfaces surface = stated_by_cad(part);
    const bool measured = surface.empty();
    if (measured)
        surface = measured_cylinders(part.mesh, sheet);
    else
        sheet.thickness = stated_thickness(part.mesh, sheet, surface);
    const std::vector<SunkHole> holes = sunk_holes(part.mesh, sheet);
    const std::vector<OpenSink> sinks = open_sinks(part.mesh, sheet, holes);
    LaidSkin laid = laid_skin(part.mesh, sheet, holes, sinks, options.skin, faces_of(part, normals, surface));
    add(part, laid.remarks);
    if (laid.kind == Skin::middle) {
        const Surfaces stated = stated_by_cad(examined);
        const GivenSolid given{examined.mesh, stated, sheet.thickness, sheet.flipped,
                               part.cad ? part.cad->deflection : 0};
        constexpr double speck = 0.02; // of the thickness; right ones of coarse meshes are within 0.01
        put_border(laid.skin, surface, given, speck * sheet.thickness);
        add(part, on_border(laid.skin.mesh, given, speck * sheet.thickness));
    }
    const Remarks uneven = measured ? Remarks{} : on_uneven_bends(part.mesh, sheet, laid.skin.side, surface);
    add(part, uneven);
    add(part, on_open_sinks(sinks, laid.kind, laid.skin.side));
    add(part, on_bosses(holes));
    add(part, on_blind_holes(blind_holes(part.mesh, sheet)));
    part.solid = origin_of(examined, plain, laid, holes);
    if (measured)
        part.solid->surface = of_file_faces(part, surface);
    if (laid.kind != Skin::middle)
        add(part, on_wide_holes(holes, laid.skin.side));
    std::optional<Finding> sunk;
    if (!holes.empty())
        sunk = finding_of(holes, laid.kind, laid.skin.side, sheet.thickness, part.source_face);
    part.thickness_mm = sheet.thickness;
    replace_mesh(part, laid.skin);
    const Remarks taper = uneven.doubts.empty() ? on_taper(sheet) : Remarks{};
    add(part, on_skin(part, !uneven.doubts.empty() || !taper.doubts.empty()));
    add(part, taper);
    for (std::optional<Finding>* each : {&plain.marks, &sunk})
        if (*each)
            part.doctor.findings.push_back(std::move(**each));
    return std::move(plain.part);
}

} // namespace

namespace {

/// The skin of a solid whose surface is closed but for a few triangles.
std::optional<PartFile> with_skin_if_covered(const PartFile& part, const ReadOptions& options,
                                             const CornerNormals* normals, const Progress& progress)
{
    const std::optional<PartFile> closed = with_openings_covered(part);
    const Claim claim = closed ? claim_of(*closed, options, false) : Claim::none;
    if (claim == Claim::none)
        return std::nullopt;
    try {
        PartFile skin = with_skin(*closed, claim, options, false, normals, progress);
        return skin.solid ? std::optional(std::move(skin)) : std::nullopt;
    } catch (const NotASheet&) { // a surface then, with small holes
        return std::nullopt;
    }
}

} // namespace

TakenSkin take_skin(PartFile part, const ReadOptions& options, bool solid, const CornerNormals* normals,
                    const Progress& progress)
{
    if (std::optional<PartFile> skin = with_skin_if_covered(part, options, normals, progress))
        return {std::move(*skin)};
    const Claim claim = claim_of(part, options, solid);
    if (claim == Claim::none)
        return {std::move(part)};
    const bool open = *part.doctor.boundary_loops > 0;
    if (open && !seems_thin_solid(part.mesh)) { // and a skin was asked for
        part.notes.push_back("it is a surface already, not a solid, and is taken unchanged: there is no skin to "
                             "choose");
        return {std::move(part)};
    }
    try {
        return {with_skin(part, claim, options, solid, normals, progress)};
    } catch (const NotASheet& reason) {
        if (claim == Claim::measured && !reason.sheet_but_for_it) {
            add(part, on_hollow(part.mesh, reason.what()));
            return {std::move(part)};
        }
        if (open) {
            Remarks remarks;
            remarks.doubt(fmt::format("most of it lies opposite to another part of itself, as in a sheet-metal solid "
                                      "with {}; but {}. It is taken as a surface; if it is a solid, export it again "
                                      "without gaps, or close them ({})",
                                      counted(size_t(*part.doctor.boundary_loops), "opening", "openings"),
                                      reason.what(), mention(option::weld, "MM")));
            add(part, remarks);
        } else
            refuse(part, reason, solid);
        return {std::move(part), !open};
    }
}

} // namespace spia
