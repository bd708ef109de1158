#include "engine/part/prepare_part.h"

#include <fmt/core.h>

#include "engine/mesh/topology.h"
#include "engine/part/cut_where_needed.h"
#include "engine/part/take_skin.h"

namespace spia {
namespace {

void note_size(PartFile& part, bool unit_given)
{
    if (part.mesh.vertices() == 0)
        return;
    constexpr double small = 5, large = 20'000; // mm; sheet parts lie between a clip and a ship's
                                                // plate
    const double diagonal = bounding_diagonal(part.mesh);
    const bool unit_known = unit_given || (part.cad && part.cad->unit_stated) || (part.deck && part.deck->unit_stated);
    if (!unit_known && (diagonal < small || diagonal > large))
        part.notes.push_back(
            fmt::format("the part is {:.4g} mm across: if that is wrong, give the unit of the file (it was read as {})",
                        diagonal, name(part.unit)));
}

} // namespace

void prepare_part(PartFile& part, const PolygonSoup& soup, const ReadOptions& options, bool weld, bool solid,
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

PartFile examine_soup(const PolygonSoup& soup, const ReadOptions& options, const Progress& progress)
{
    PartFile part;
    part.format = "in memory";
    prepare_part(part, soup, options, false, false, nullptr, progress);
    return part;
}

} // namespace spia
