#include "engine/part/take_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <set>
#include <utility>

#include "engine/core/text.h"
#include "engine/mesh/solid/mark_outlines.h"
#include "engine/mesh/solid/measured_cylinders.h"
#include "engine/mesh/solid/sheet_or_hollow.h"
#include "engine/mesh/solid/sunk_holes.h"
#include "engine/mesh/solid/uneven_bends.h"
#include "engine/mesh/solid/without_marks.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"
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

/// What stood for the part until its marks were put back.
struct AsMarked {
    TriMesh mesh;
    std::vector<int> source_vertex, source_face;
};

void put_back(PartFile& part, AsMarked& marked)
{
    part.mesh = std::move(marked.mesh);
    part.source_vertex = std::move(marked.source_vertex);
    part.source_face = std::move(marked.source_face);
}

/// Measures the solid; its shallow marks are taken out of the part before.
/// @param marked, found, outlines set to the part as it was, what was done to it, and of the marks,
/// if it had any
/// @throws NotASheet
ThinSolid without_its_marks(PartFile& part, const CornerNormals* normals, std::optional<AsMarked>& marked,
                            std::optional<Finding>& found, std::vector<MarkOutline>& outlines, const Progress& progress)
{
    ThinSolid sheet = thin_solid(part.mesh, faces_of(part, normals, stated_by_cad(part)), progress);
    if (sheet.marks.empty())
        return sheet;
    PlainSolid plain = without_marks(part.mesh, sheet, stated_by_cad(part));
    outlines = mark_outlines(part.mesh, sheet, plain);
    found = finding_of(sheet.marks, sheet, part.source_face);
    std::vector<int> vertex, face;
    for (const int v : plain.source_vertex)
        vertex.push_back(part.source_vertex[size_t(v)]);
    for (const int f : plain.source_face)
        face.push_back(part.source_face[size_t(f)]);
    marked = {std::exchange(part.mesh, std::move(plain.mesh)), std::exchange(part.source_vertex, std::move(vertex)),
              std::exchange(part.source_face, std::move(face))};
    return thin_solid(part.mesh, faces_of(part, normals, stated_by_cad(part)), progress);
}

/// Says why it is a hollow body, if it may be another thing.
void note_hollow(PartFile& part, const std::string& why)
{
    if (seems_thin_solid(part.mesh))
        part.notes.push_back(fmt::format("most of it lies opposite to another part of itself, as in a solid of sheet; "
                                         "but {}. It is taken as a hollow body; if it is a solid of sheet, choose the "
                                         "skin that stands for it ({}) for the reason to refuse it",
                                         why, mention(option::skin, "middle")));
}

/// @returns whether it is taken for a solid of sheet; says so where it may be the other thing as
/// well
bool decide(PartFile& part, const ThinSolid& sheet)
{
    const ClosedSurface closed = sheet_or_hollow(sheet);
    const std::string either =
        fmt::format("a solid of sheet {:.6g} mm thick and a hollow body of its size are the same closed surface, and "
                    "the file does not say which it is; the sheet would be {:.2g} times as thick as it is wide",
                    sheet.thickness, proportion(sheet));
    if (closed == ClosedSurface::perhaps_sheet)
        doubt(part, fmt::format("{}. It is taken as a solid; a hollow body is cut open along a seam that you give ({})",
                                either, mention(option::seam, "FILE")));
    if (closed == ClosedSurface::perhaps_hollow)
        doubt(part, fmt::format("{}. It is taken as a hollow body; for a solid choose the skin that stands for it ({})",
                                either, mention(option::skin, "middle")));
    return closed != ClosedSurface::perhaps_hollow;
}

/// The surface that is wanted. Where none was asked for and there is no middle one the outer skin
/// is better than nothing, and a doubt.
/// @param wanted  set to the one that is taken
SkinMesh wanted_skin(PartFile& part, const ThinSolid& sheet, const std::vector<SunkHole>& holes,
                     const std::vector<OpenSink>& open, Skin& wanted, bool asked, const ThinSolidOptions& units)
{
    try {
        SkinMesh skin = wanted == Skin::middle ? middle_surface(part, sheet, holes, open, units)
                                               : skin_of(part.mesh, sheet, wanted, units);
        if (skin.straightened > 0)
            part.notes.push_back(fmt::format(
                "{} not halfway along an edge that crosses the sheet askew but straight below the {} skin, up to "
                "half a thickness beside it, for triangles not to turn over",
                counted(skin.straightened, "vertex of the middle surface lies", "vertices of the middle surface lie"),
                of_skin(skin.side)));
        return skin;
    } catch (const NotASheet& reason) {
        if (asked)
            throw;
        part.notes.push_back(fmt::format(
            "{}. Nothing else was asked for, so the outer skin is laid flat: lengths over bends are those of the outer "
            "skin, which are longer than the sheet's",
            reason.what()));
        part.doubts.push_back(part.notes.back());
        wanted = Skin::outer;
        return skin_of(part.mesh, sheet, wanted, units);
    }
}

/// On a skin the holes that are sunk there are as wide as the tool that sinks them.
void doubt_wide_holes(PartFile& part, const std::vector<SunkHole>& holes, SheetSide taken)
{
    if (const int wide = wider_at(holes, taken); wide > 0)
        doubt(part,
              fmt::format("{} at the {} skin, which is laid flat: cut so, what is sunk there is cut through; take "
                          "the middle surface, where a hole has its least diameter ({})",
                          counted(wide, "hole is wider", "holes are wider"), of_skin(taken),
                          mention(option::skin, "middle")));
}

/// A solid whose file says that it is one may still be a block.
void doubt_block(PartFile& part, const ThinSolid& sheet)
{
    if (sheet_or_hollow(sheet) == ClosedSurface::perhaps_hollow)
        doubt(part, fmt::format("the solid is {:.2g} times as thick as it is wide, which is more like a block than a "
                                "sheet; it is taken as sheet {:.6g} mm thick",
                                proportion(sheet), sheet.thickness));
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

/// @returns whether there are any
bool doubt_uneven_bends(PartFile& part, const ThinSolid& sheet, SheetSide laid, const Surfaces& surface)
{
    const std::vector<UnevenBend> bends = uneven_bends(sheet, surface);
    if (bends.empty())
        return false;
    const UnevenBend& first = bends.front();
    const Eigen::Vector3d place = part.mesh.position.col(part.mesh.triangle(0, first.face));
    doubt(part, fmt::format(
                    "{} arcs of radius {:.4g} and {:.4g} mm on both skins of a sheet of {:.4g} mm, at {:.6g}, {:.6g}, "
                    "{:.6g} mm{}: it is not as thick there, and inner radius and length are told and laid by the arc "
                    "of the {} skin and the thickness elsewhere",
                    counted(bends.size(), "bend has", "bends have"), first.outer, first.inner, sheet.thickness,
                    place.x(), place.y(), place.z(), bends.size() > 1 ? " (the first)" : "", of_skin(laid)));
    return true;
}

/// @param uneven_told  bends that are not as thick as the sheet have been told with their radii
void note_skin(PartFile& part, bool uneven_told)
{
    const SolidOrigin& solid = *part.solid;
    const int taken = solid.side == SheetSide::inner ? solid.inner_faces : solid.outer_faces;
    const std::string what = solid.skin == Skin::middle
                                 ? fmt::format("middle surface, from the {} of its {} skin,",
                                               counted(taken, "face", "faces"), of_skin(solid.side))
                                 : fmt::format("{} skin of {}", name(solid.skin), counted(taken, "face", "faces"));
    part.notes.push_back(fmt::format("a solid of {}{}: its {} is taken, sheet {:.6g} mm thick (another surface "
                                     "of it: {})",
                                     counted(solid.faces, "face", "faces"),
                                     solid.open ? ", some of which are missing" : "", what, solid.thickness,
                                     mention(option::skin)));
    constexpr double uneven = 1.15; // a bend with one radius on both sides is up to 1.41 times as
                                    // thick
    if (part.cad && !uneven_told && solid.most > uneven * solid.thickness)
        doubt(part,
              fmt::format(
                  "the sheet is up to {:.4g} mm thick, {:.3g} times {:.4g} mm: where arcs of both skins have not one "
                  "axis, inner radius and length of a bend are those of a sheet as thick as elsewhere",
                  solid.most, solid.most / solid.thickness, solid.thickness));
    const std::string least = fmt::format("{:.4g}", solid.least), most = fmt::format("{:.4g}", solid.most);
    part.notes.push_back(
        fmt::format("thickness {}; outer skin {:.6g} mm2, inner skin {:.6g} mm2, faces across the "
                    "thickness {:.6g} mm2",
                    least == most ? least + " mm everywhere" : fmt::format("between {} and {} mm", least, most),
                    solid.outer_area, solid.inner_area, solid.rim_area));
}

} // namespace

bool take_skin(PartFile& part, const ReadOptions& options, bool solid, const CornerNormals* normals,
               const Progress& progress)
{
    const Claim claim = claim_of(part, options, solid);
    if (claim == Claim::none)
        return false;
    const bool open = *part.doctor.boundary_loops > 0;
    if (open && !seems_thin_solid(part.mesh)) { // and a skin was asked for
        part.notes.push_back("it is no solid but a surface already, and taken as it is: there is no skin to choose");
        return false;
    }
    std::optional<AsMarked> marked;
    std::optional<Finding> marks;
    std::vector<MarkOutline> outlines;
    const int all_faces = faces(part, [](size_t) { return true; });
    try {
        ThinSolid sheet = without_its_marks(part, normals, marked, marks, outlines, progress);
        if (claim == Claim::measured && !solid && !decide(part, sheet)) {
            if (marked)
                put_back(part, *marked);
            return false;
        }
        if (solid && !open && !options.skin)
            doubt_block(part, sheet);
        Surfaces surface = stated_by_cad(part);
        const bool measured = surface.empty();
        if (measured)
            surface = measured_cylinders(part.mesh, sheet);
        else
            sheet.thickness = stated_thickness(part.mesh, sheet, surface);
        const ThinSolidOptions units = faces_of(part, normals, surface);
        Skin wanted = options.skin.value_or(Skin::middle);
        const std::vector<SunkHole> holes = sunk_holes(part.mesh, sheet);
        const std::vector<OpenSink> sinks = open_sinks(part.mesh, sheet, holes);
        SkinMesh skin = wanted_skin(part, sheet, holes, sinks, wanted, options.skin.has_value(), units);
        const bool uneven = !measured && doubt_uneven_bends(part, sheet, skin.side, surface);
        tell_open_sinks(part, sinks, wanted, skin.side);
        const auto on = [&](SheetSide side) { return [&, side](size_t f) { return sheet.side[f] == side; }; };
        part.solid = {wanted,
                      sheet.thickness,
                      sheet.least,
                      sheet.most,
                      sheet.outer,
                      sheet.inner,
                      area(skin.mesh),
                      sheet.rim,
                      sheet.volume,
                      all_faces,
                      faces(part, on(SheetSide::outer)),
                      faces(part, on(SheetSide::inner)),
                      open,
                      {},
                      skin.side};
        if (measured)
            part.solid->surface = of_file_faces(part, surface);
        for (const MarkOutline& outline : outlines)
            part.solid->marks.push_back(on_surface(outline, wanted, sheet.thickness));
        for (Eigen::Matrix3Xd& row : rows_of(holes, wanted, sheet.thickness))
            part.solid->marks.push_back(std::move(row));
        if (wanted != Skin::middle)
            doubt_wide_holes(part, holes, skin.side);
        std::optional<Finding> sunk;
        if (!holes.empty())
            sunk = finding_of(holes, wanted, skin.side, sheet.thickness, part.source_face);
        part.thickness_mm = sheet.thickness;
        replace_mesh(part, skin);
        note_skin(part, uneven);
        for (std::optional<Finding>* each : {&marks, &sunk})
            if (*each)
                part.doctor.findings.push_back(std::move(**each));
    } catch (const NotASheet& reason) {
        if (marked)
            put_back(part, *marked);
        if (claim == Claim::measured && !reason.sheet_but_for_it) {
            note_hollow(part, reason.what());
            return false;
        }
        if (open)
            part.notes.push_back(fmt::format("most of it lies opposite to another part of itself, as in a solid of "
                                             "sheet; but {}. It is taken as a surface",
                                             reason.what()));
        else
            refuse(part, reason, solid);
        return !open;
    }
    return false;
}

} // namespace spia
