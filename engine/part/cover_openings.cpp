#include "engine/part/cover_openings.h"

#include <algorithm>
#include <fmt/core.h>
#include <utility>

#include "engine/core/place_text.h"
#include "engine/core/text.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/doctor/small_openings.h"

namespace spia {
namespace {

Finding finding_of(const CoveredOpenings& covered, const PartFile& part)
{
    Tally where;
    Finding finding{Fault::opening, Severity::repaired, 0, -1, {}, {}};
    for (size_t i = 0; i < covered.loop.size(); ++i) {
        const int v = covered.loop[i].front();
        where.add(part.source_vertex[size_t(v)]);
        if (finding.place.size() < where.where.size()) {
            finding.place.push_back(part.mesh.position.col(v));
            finding.what.push_back(fmt::format("{:.3g} mm wide", covered.width[i]));
        }
    }
    finding.count = where.count;
    finding.first = where.first;
    finding.where = std::move(where.where);
    finding.text =
        fmt::format("the surface is closed but for {} up to {:.3g} mm wide, at {} mm: covered with {}",
                    counted(covered.loop.size(), "opening", "openings"), *std::ranges::max_element(covered.width),
                    place_text(finding.place), counted(covered.beside.size(), "triangle", "triangles"));
    finding.advice = "where a whole face is missing, export the part again";
    return finding;
}

std::optional<CoveredOpenings> covered_openings(const PartFile& part)
{
    if (part.cad || !part.doctor.boundary_loops || *part.doctor.boundary_loops == 0)
        return std::nullopt;
    return cover_small_openings(part.mesh);
}

} // namespace

std::optional<PartFile> with_openings_covered(const PartFile& part)
{
    std::optional<CoveredOpenings> covered = covered_openings(part);
    if (!covered)
        return std::nullopt;
    PartFile closed = part;
    const Finding& finding = closed.doctor.findings.emplace_back(finding_of(*covered, part));
    if (!covered->surely)
        closed.doubts.push_back(
            closed.notes.emplace_back(finding.text + ". Compare the blank with the part there, or export it again"));
    closed.mesh = std::move(covered->mesh);
    for (const int f : covered->beside)
        closed.source_face.push_back(part.source_face[size_t(f)]);
    const SurfaceType type = surface_type(closed.mesh);
    closed.doctor.boundary_loops = type.loops;
    closed.doctor.genus = type.genus;
    closed.doctor.euler_characteristic = 2 - 2 * type.genus - type.loops;
    return closed;
}

std::optional<double> slit_width(const PartFile& part)
{
    const std::optional<CoveredOpenings> covered = covered_openings(part);
    return covered ? std::optional(*std::ranges::max_element(covered->width)) : std::nullopt;
}

} // namespace spia
