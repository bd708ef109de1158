#include "engine/exchange/read_part.h"

#include <algorithm>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/exchange/cad_findings.h"
#include "engine/exchange/deck_choice.h"
#include "engine/exchange/file_content.h"
#include "engine/exchange/mesh_file.h"
#include "engine/exchange/read_cad.h"
#include "engine/exchange/read_deck.h"
#include "engine/exchange/stated_curvature.h"
#include "engine/exchange/take_skin.h"
#include "engine/mesh/corner_seam.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

namespace fs = std::filesystem;

/// What leads back to the deck; lengths in its unit.
DeckOrigin origin_of(const Deck& deck, const DeckChoice& choice)
{
    DeckOrigin origin;
    for (const int e : choice.element) {
        origin.element_id.push_back(deck.element[size_t(e)]);
        origin.part_of.push_back(deck.part_of[size_t(e)]);
    }
    for (int f = 0; f < choice.soup.polygons(); ++f) {
        const auto corners = choice.soup.polygon(f);
        origin.corner.push_back({corners[0], corners[1], corners[2], corners.size() > 3 ? corners[3] : -1});
    }
    for (const int v : choice.node)
        origin.node_id.push_back(deck.node[size_t(v)]);
    origin.position = choice.soup.position;
    origin.element = choice.element;
    origin.last_node = *std::max_element(deck.node.begin(), deck.node.end());
    origin.last_element = *std::max_element(deck.element.begin(), deck.element.end());
    origin.parts = deck.parts;
    origin.unit_stated = deck.unit.has_value();
    origin.copies = deck.copies;
    for (const DeckSet& set : deck.sets)
        origin.sets.push_back(set.name);
    return origin;
}

/// Fills all of the part that the deck says, in mm.
PolygonSoup soup_of_deck(const fs::path& path, const ReadOptions& options, PartFile& part, const Progress& progress)
{
    const Deck deck = read_deck(path, file_content(path), progress);
    DeckChoice choice = choose_parts(deck, options.parts);
    part.format = deck.format;
    part.unit = options.unit.value_or(deck.unit.value_or(LengthUnit::mm));
    part.notes = deck.notes;
    part.doubts = deck.doubts;
    part.notes.insert(part.notes.end(), choice.notes.begin(), choice.notes.end());
    if (deck.unit && *deck.unit != part.unit)
        part.notes.push_back(fmt::format("the deck gives its lengths in {}; they are read as {}, as requested",
                                         name(*deck.unit), name(part.unit)));
    part.deck = origin_of(deck, choice);
    for (Eigen::Vector3d& p : choice.soup.position)
        p *= millimetres(part.unit);
    if (choice.thickness)
        part.thickness_mm = *choice.thickness * millimetres(part.unit);
    part.material = choice.material;
    if (part.thickness_mm || !part.material.empty())
        part.notes.push_back(
            fmt::format("the deck gives{}{}{}",
                        part.thickness_mm ? fmt::format(" a thickness of {:.6g} mm", *part.thickness_mm) : "",
                        part.thickness_mm && !part.material.empty() ? " and" : "",
                        part.material.empty() ? "" : " the material " + part.material));
    return std::move(choice.soup);
}

/// What the doctor found that a cut cannot mend.
bool sick_beyond_a_cut(const DoctorReport& report)
{
    return std::any_of(report.findings.begin(), report.findings.end(), [](const Finding& finding) {
        return finding.severity == Severity::fatal && finding.fault != Fault::closed_surface &&
               finding.fault != Fault::handle;
    });
}

/// The seam of the options, in vertices of the mesh; of copies the first. Of a solid the vertices of its other skin stand for
/// those opposite to them.
SeamOptions in_mesh(SeamOptions seam, const PartFile& part, const PolygonSoup& file)
{
    const std::vector<int>& source = part.source_vertex;
    const auto opposite = [&](int v) -> std::optional<int> {
        if (!part.solid || v >= file.vertices())
            return std::nullopt;
        constexpr double mitred = 2; // at a corner of three walls the skins are sqrt(3) times the thickness apart
        Eigen::Index nearest = 0;
        const double distance =
            (part.mesh.position.colwise() - file.position[size_t(v)]).colwise().norm().minCoeff(&nearest);
        return distance <= mitred * part.solid->thickness ? std::optional(int(nearest)) : std::nullopt;
    };
    for (std::vector<int>& row : seam.path)
        for (int& v : row) {
            const auto found = std::lower_bound(source.begin(), source.end(), v);
            if (found != source.end() && *found == v)
                v = int(found - source.begin());
            else if (const auto across = opposite(v))
                v = *across;
            else
                throw InputError(fmt::format("the seam names vertex {}, which is not a vertex of the part (they count "
                                             "from 0 in the file's order)",
                                             v));
        }
    return seam;
}

void report_seam(const CutPart& cut, const TriMesh& uncut, PartFile& part)
{
    Tally where;
    std::vector<Eigen::Vector3d> place;
    for (size_t r = 0; r < cut.seam.size(); ++r)
        for (size_t i = 0; i < cut.seam[r].size(); ++i) {
            where.add(part.seam[r][i]);
            if (place.size() < where.where.size())
                place.push_back(uncut.position.col(cut.seam[r][i]));
        }
    const Eigen::Vector3d &from = place.front(), &to = place[std::min(place.size(), cut.seam.front().size()) - 1];
    const int paths = int(cut.seam.size());
    part.doctor.add(
        Fault::seam, Severity::repaired, where,
        fmt::format(
            "cut open along a seam of {:.4g} mm{}, from vertex {} at {:.4g}, {:.4g}, {:.4g} to vertex {} at {:.4g}, "
            "{:.4g}, {:.4g}: {}; the blank has an edge on both sides of it, to be joined after forming",
            cut.length, paths > 1 ? fmt::format(" in {} paths, the first", paths) : "", part.seam[0].front(), from.x(),
            from.y(), from.z(), part.seam[0].back(), to.x(), to.y(), to.z(), cut.why),
        "");
    part.doctor.findings.back().place = std::move(place);
}

/// "90 degrees at 4 corners"
std::string words_of(const CornerSeam& seam)
{
    return fmt::format("up to {:.3g} degrees at {}", seam.defect * 180 / std::numbers::pi,
                       counted(int(seam.corner.size()), "corner", "corners"));
}

/// Cuts open what is no sheet, or where it was asked for, and turns the findings that would have refused it into repairs.
void cut_where_needed(PartFile& part, SeamOptions seam, const PolygonSoup& file)
{
    DoctorReport& report = part.doctor;
    if (seam.mode == SeamOptions::Mode::none || sick_beyond_a_cut(report) || report.components != 1 || !report.genus)
        return;
    std::string unrolls;
    if (seam.mode == SeamOptions::Mode::corners) {
        const auto corners = *report.boundary_loops > 0 ? corner_seam(part.mesh) : std::nullopt;
        seam = {};
        if (corners) {
            seam = {SeamOptions::Mode::given, corners->path};
            unrolls = fmt::format(" it unrolls without strain now, where it lacked {}", words_of(*corners));
        } else
            part.doubts.push_back(part.notes.emplace_back("there are no corners to be cut: it unrolls as it is, or is "
                                                          "curved elsewhere too"));
    } else
        seam = in_mesh(std::move(seam), part, file);
    CutPart cut = cut_open(part.mesh, seam);
    if (!unrolls.empty())
        cut.why = unrolls.substr(1);
    if (cut.seam.empty())
        return;
    part.seam = cut.seam;
    for (std::vector<int>& row : part.seam)
        for (int& v : row)
            v = part.source_vertex[size_t(v)];
    part.seam_length = cut.length;
    for (Finding& finding : report.findings)
        if (finding.fault == Fault::closed_surface || finding.fault == Fault::handle)
            finding.severity = Severity::repaired;
    report_seam(cut, part.mesh, part);
    std::vector<int> source;
    for (const int v : cut.source)
        source.push_back(part.source_vertex[size_t(v)]);
    part.source_vertex = std::move(source);
    part.mesh = std::move(cut.mesh);
    const SurfaceType type = surface_type(part.mesh);
    report.boundary_loops = type.loops;
    report.genus = type.genus;
    report.euler_characteristic = 2 - 2 * type.genus - type.loops;
}

/// Says where a few cuts would let the part unroll.
void note_corners(PartFile& part, const SeamOptions& seam)
{
    if (!part.doctor.healthy() || seam.mode == SeamOptions::Mode::given || !surface_type(part.mesh).sheet())
        return;
    const auto corners = corner_seam(part.mesh);
    if (!corners)
        return;
    Tally where;
    std::vector<Eigen::Vector3d> place;
    for (const int v : corners->corner) {
        where.add(part.source_vertex[size_t(v)]);
        if (place.size() < where.where.size())
            place.push_back(part.mesh.position.col(v));
    }
    part.doctor.add(
        Fault::closed_corner, Severity::note, where,
        fmt::format("the sheet is only bent, but joined where it lacks {}, which strains it", words_of(*corners)),
        fmt::format("cut along {:.4g} mm from there to the border it unrolls without strain (--seam corners)",
                    corners->length));
    part.doctor.findings.back().place = std::move(place);
}

void note_size(PartFile& part, bool unit_given)
{
    if (part.mesh.vertices() == 0)
        return;
    constexpr double small = 5, large = 20'000; // mm; sheet parts lie between a clip and a ship's plate
    const double diagonal = bounding_diagonal(part.mesh);
    const bool unit_known = unit_given || (part.cad && part.cad->unit_stated) || (part.deck && part.deck->unit_stated);
    if (!unit_known && (diagonal < small || diagonal > large))
        part.notes.push_back(
            fmt::format("the part is {:.4g} mm across: if that is wrong, give the unit of the file (it was read as {})",
                        diagonal, name(part.unit)));
}

/// Examines and cuts what the file holds; the part has its format, unit and notes already.
/// @param solid  whether the file says that it is one; @param normals  of CAD faces; nullptr: unknown
void fill(PartFile& part, const PolygonSoup& soup, const ReadOptions& options, bool weld, bool solid,
          const CornerNormals* normals, const Progress& progress)
{
    part.file_vertices = soup.vertices();
    part.file_faces = soup.polygons();
    DoctorOptions doctor = options.doctor;
    doctor.weld = options.weld.value_or(weld);
    Examination examination = examine(soup, doctor, progress.part(0, 0.6));
    part.mesh = std::move(examination.mesh);
    part.doctor = std::move(examination.report);
    part.source_vertex = std::move(examination.source_vertex);
    part.source_face = std::move(examination.source_face);
    part.same_as = std::move(examination.same_as);
    const bool refused = take_skin(part, options, solid, normals, progress.part(0.6, 0.95));
    progress.checkpoint(0.95, "finding where it must be cut open");
    if (!refused)
        cut_where_needed(part, options.seam, soup);
    note_corners(part, options.seam);
    note_size(part, options.unit.has_value());
}

PartFile examine_file(const fs::path& path, const ReadOptions& options, const Progress& progress)
{
    const std::string extension = part_extension(path);
    PartFile part;
    if (is_deck("." + extension)) {
        const PolygonSoup soup = soup_of_deck(path, options, part, progress.part(0, 0.5));
        fill(part, soup, options, part.deck->copies, false, nullptr, progress.part(0.5, 1));
        return part;
    }
    if (is_cad("." + extension)) {
        const CadContent cad = read_cad(path, options.cad, options.parts, options.unit, progress.part(0, 0.8));
        part.format = cad.format;
        part.cad = CadOrigin{cad.face,          cad.faces, cad.deflection, cad.sewing_tolerance,
                             !cad.unit.empty(), cad.tree,  cad.surface};
        part.unit = options.unit.value_or(LengthUnit::mm);
        const CornerNormals normals(cad.soup, cad.normal);
        fill(part, cad.soup, options, true, cad.solid, &normals, progress.part(0.8, 1));
        part.cad->curves = cad.curves;
        part.cad->curves.renumber(part.same_as);
        report_cad(cad, part);
        return part;
    }
    if (!options.parts.empty())
        throw InputError("parts can be chosen from solver decks and CAD files only; this file is read as a whole");
    const bool gltf = extension == "gltf" || extension == "glb";
    part.unit = options.unit.value_or(gltf ? LengthUnit::m : LengthUnit::mm);
    MeshFile file = read_mesh_file(path, extension, progress.part(0, 0.5));
    part.format = std::move(file.format);
    part.notes = std::move(file.notes);
    if (gltf && !options.unit)
        part.notes.push_back("lengths were read as metres, as the glTF specification says");
    for (Eigen::Vector3d& p : file.soup.position)
        p *= millimetres(part.unit);
    fill(part, file.soup, options, gltf || extension == "stl", false, nullptr, progress.part(0.5, 1));
    return part;
}

/// Needles on CAD faces. On a part that unrolls they are strips along its straight lines, as they should be. On others they are chords that
/// differ from triangle to triangle, which is taken for strain: they go unasked, or a note says why not.
void remesh_needles(PartFile& part, std::optional<double> deflection, const Progress& progress)
{
    constexpr double needle = 15 * std::numbers::pi / 180; // of one triangle in a hundred
    constexpr double unrolls = 0.02; // bent parts measured have 0 to rounding, the flattest of the drawn ones 0.9
    if (triangle_quality(part.mesh).least_angle_of_99 > needle)
        return;
    if (curvature_off_bends(part) < unrolls) {
        if (std::erase_if(part.doctor.findings, [](const Finding& f) { return f.fault == Fault::sliver; }))
            part.notes.push_back(
                "the long narrow triangles lie along the rulings of a developable surface and do not affect the strains");
        return;
    }
    try {
        RemeshOptions remesh;
        if (deflection) // the mesh is to be as close again; not coarser than by default, nor finer than can be
            remesh.tolerance =
                std::clamp(*deflection, 1e-6 * bounding_diagonal(part.mesh), 1e-3 * bounding_diagonal(part.mesh));
        remesh_part(part, remesh, progress);
        part.notes.push_back(
            "needle triangles were remeshed, because the part does not unroll and they would falsify its strains; they can be kept (--no-remesh)");
    } catch (const InputError& error) {
        for (Finding& finding : part.doctor.findings)
            if (finding.fault == Fault::sliver)
                finding.advice =
                    "strains there are unreliable; remeshing failed (see the notes), but may work with another size or tolerance (--remesh-size or --remesh-tolerance)";
        part.notes.push_back(fmt::format(
            "needle triangles make the strains of this part unreliable, which does not unroll; they were not remeshed: {}",
            error.what()));
    }
}

/// Healthy parts alone can be remeshed.
PartFile remeshed(const fs::path& path, const ReadOptions& options, const Progress& progress)
{
    PartFile part = examine_file(path, options, progress.part(0, 0.4));
    if (part.doctor.healthy() && options.remesh)
        remesh_part(part, *options.remesh, progress.part(0.4, 1));
    else if (part.doctor.healthy() && part.cad && !options.cad.keep_triangles)
        remesh_needles(part, options.cad.deflection, progress.part(0.4, 1));
    if (part.doctor.healthy())
        check_targets(options.targets, part);
    return part;
}

/// Does the work and puts the file's name before whatever is wrong with it.
template <class Work> PartFile named(const fs::path& path, const Work& work)
{
    try {
        return work();
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path.string(), error.what()));
    }
}

} // namespace

PartFile examine_part(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress)
{
    return named(path, [&] { return remeshed(path, options, progress); });
}

PartFile examine_soup(const PolygonSoup& soup, const ReadOptions& options, const Progress& progress)
{
    PartFile part;
    part.format = "in memory";
    fill(part, soup, options, false, false, nullptr, progress);
    return part;
}

PartFile read_part(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress)
{
    return named(path, [&] {
        PartFile part = remeshed(path, options, progress);
        try {
            require_healthy(part.doctor);
        } catch (const InputError& error) {
            if (!options.parts.empty())
                throw;
            if (part.cad && part.cad->tree.bodies() > 1)
                throw InputError(fmt::format("{}\nThe file has several bodies; choose by number or name (--part):\n{}",
                                             error.what(), item_list(part.cad->tree)));
            if (!part.deck || part.deck->parts.size() < 2)
                throw;
            throw InputError(fmt::format("{}\nThe deck has several parts; choose by id or name (--part):\n{}",
                                         error.what(), part_list(part.deck->parts)));
        }
        return part;
    });
}

} // namespace spia
