#include "engine/part/take_skin.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <optional>
#include <set>
#include <utility>

#include "engine/core/text.h"
#include "engine/mesh/solid/border/beside_solid.h"
#include "engine/mesh/solid/border/onto_projection.h"
#include "engine/mesh/solid/fit/coordinate_rounding.h"
#include "engine/mesh/solid/fit/measured_cylinders.h"
#include "engine/mesh/solid/holes/sunk_holes.h"
#include "engine/mesh/solid/marks/blind_holes.h"
#include "engine/mesh/solid/marks/mark_outlines.h"
#include "engine/mesh/solid/marks/without_marks.h"
#include "engine/mesh/solid/sheet_or_hollow.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"
#include "engine/part/cover_openings.h"
#include "engine/part/mark_findings.h"
#include "engine/part/middle_surface.h"
#include "engine/part/skin_remarks.h"

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
    const double rounding = measured ? coordinate_rounding(part.mesh.position, millimetres(part.unit)) : 0;
    if (measured)
        surface = measured_cylinders(part.mesh, sheet, rounding);
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
    if (measured) {
        part.solid->surface = of_file_faces(part, surface);
        part.solid->rounding = rounding;
    }
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
