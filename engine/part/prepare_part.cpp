#include "engine/part/prepare_part.h"

#include <fmt/core.h>
#include <optional>
#include <utility>

#include "engine/mesh/topology.h"
#include "engine/part/cover_openings.h"
#include "engine/part/cut_where_needed.h"
#include "engine/part/take_skin.h"

namespace spia {
namespace {

/// What it may be that a part of such a size is not meant; nothing if it is likely.
std::optional<std::string> unlikely_size(const PartFile& part, bool unit_given)
{
    if (part.mesh.vertices() == 0)
        return std::nullopt;
    constexpr double small = 5, large = 20'000; // mm; sheet parts lie between a clip and a ship's
                                                // plate
    const double diagonal = bounding_diagonal(part.mesh);
    const bool unit_known = unit_given || unit_is_stated(part);
    if (unit_known || (diagonal >= small && diagonal <= large))
        return std::nullopt;
    return fmt::format("the part is {:.4g} mm across: if that is wrong, give the unit of the file (it was read as {})",
                       diagonal, name(part.unit));
}

PartFile examined(PartFile part, const PolygonSoup& soup, const DoctorOptions& options, const Progress& progress)
{
    Examination examination = examine(soup, options, progress);
    part.mesh = std::move(examination.mesh);
    part.doctor = std::move(examination.report);
    part.source_vertex = std::move(examination.source_vertex);
    part.source_face = std::move(examination.source_face);
    part.same_as = std::move(examination.same_as);
    return part;
}

/// The skin of a solid whose surface is torn, as STL files have it: its slits welded.
/// @param part  examined without that
std::optional<TakenSkin> skin_without_slits(const PartFile& part, const PolygonSoup& soup, const ReadOptions& options,
                                            DoctorOptions doctor, const CornerNormals* normals,
                                            const Progress& progress)
{
    constexpr double widest[] = {2.5, 10}; // of the mean width: a slit may be a triangle, or have two
    const std::optional<double> width = doctor.weld && !doctor.weld_gap && !part.cad ? slit_width(part) : std::nullopt;
    for (const double times : widest) {
        if (!width)
            break;
        doctor.weld_gap = times * *width;
        TakenSkin taken = take_skin(examined(part, soup, doctor, progress), options, false, normals, progress);
        if (taken.part.solid)
            return taken;
    }
    return std::nullopt;
}

} // namespace

PartFile prepare_part(PartFile part, const PolygonSoup& soup, const ReadOptions& options, bool weld, bool solid,
                      const CornerNormals* normals, const Progress& progress)
{
    part.file_vertices = soup.vertices();
    part.file_faces = soup.polygons();
    DoctorOptions doctor = options.doctor;
    doctor.weld = options.weld.value_or(weld);
    part = examined(std::move(part), soup, doctor, progress.part(0, 0.6));
    TakenSkin taken = take_skin(part, options, solid, normals, progress.part(0.6, 0.95));
    if (!taken.part.solid)
        if (auto torn = skin_without_slits(part, soup, options, doctor, normals, progress.part(0.95, 0.95)))
            taken = std::move(*torn);
    progress.checkpoint(0.95, "finding where it must be cut open");
    part = taken.refused ? std::move(taken.part) : cut_where_needed(std::move(taken.part), options.seam, soup);
    if (auto corners = closed_corners(part, options.seam))
        part.doctor.findings.push_back(std::move(*corners));
    if (auto size = unlikely_size(part, options.unit.has_value()))
        part.notes.push_back(std::move(*size));
    return part;
}

PartFile examine_soup(const PolygonSoup& soup, const ReadOptions& options, const Progress& progress)
{
    PartFile part;
    part.format = "in memory";
    return prepare_part(std::move(part), soup, options, false, false, nullptr, progress);
}

} // namespace spia
