#include "engine/part/remesh_part.h"

#include <algorithm>
#include <fmt/core.h>
#include <numbers>
#include <numeric>
#include <utility>

#include "engine/core/error.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"
#include "engine/part/curved_faces.h"
#include "engine/part/part_file.h"
#include "engine/part/vertex_numbers.h"
#include "engine/unfold/plan/bend_zones.h"
#include "engine/unfold/plan/free_ends.h"

namespace spia {
namespace {

std::vector<int> named(const std::vector<int>& nearest, const std::vector<int>& name)
{
    std::vector<int> result;
    for (const int i : nearest)
        result.push_back(name[size_t(i)]);
    return result;
}

/// The triangles become those that were made from the CAD faces.
void number_anew(PartFile& part)
{
    part.cad->face = named(part.source_face, part.cad->face);
    part.file_vertices = part.mesh.vertices();
    part.file_faces = part.mesh.triangles();
    for (std::vector<int>* numbers : {&part.source_vertex, &part.source_face, &part.same_as}) {
        numbers->resize(numbers == &part.source_face ? size_t(part.file_faces) : size_t(part.file_vertices));
        std::iota(numbers->begin(), numbers->end(), 0);
    }
}

const std::vector<int>& faces_as_read(const PartFile& part)
{
    return numbered_as_read(part) ? part.remeshed->original_face : part.source_face;
}

/// Bends that are sharper than the usual tolerance would be cut off, and no bend over a cylinder
/// would be found any more.
/// @returns mm; nothing if the usual one does
std::optional<double> tolerance_for_bends(const PartFile& part)
{
    if (!part.cad || part.cad->surface.empty())
        return std::nullopt;
    std::vector<StatedSurface> surface;
    for (const int f : part.source_face)
        surface.push_back(part.cad->surface[size_t(part.cad->face[size_t(f)])]);
    // chords of 20 degrees; of the diagonal
    constexpr double of_radius = 0.03, usual = 1e-3, least = 1e-5;
    const double diagonal = bounding_diagonal(part.mesh);
    double tolerance = usual * diagonal;
    const FreeEnds ends(part.mesh);
    for (const BendZone& zone : stated_zones(part.mesh, surface, part.cad->sewing_tolerance))
        if (ends.of(zone))
            tolerance = std::min(tolerance, of_radius * zone.radius);
    return tolerance < usual * diagonal ? std::optional(std::max(tolerance, least * diagonal)) : std::nullopt;
}

/// Within that, or if it cannot be kept within the usual tolerance.
RemeshResult remeshed_with_bends(const PartFile& part, const RemeshOptions& options, std::span<const int> sheet,
                                 const Progress& progress)
{
    const std::optional<double> finer = options.tolerance ? std::nullopt : tolerance_for_bends(part);
    if (!finer)
        return remesh(part.mesh, options, sheet, progress);
    RemeshOptions fine = options;
    fine.tolerance = finer;
    try {
        return remesh(part.mesh, fine, sheet, progress.part(0, 0.5));
    } catch (const InputError&) { // what is told of it has the tolerance; the bends are told as far
                                  // as they are found
        return remesh(part.mesh, options, sheet, progress.part(0.5, 1));
    }
}

} // namespace

PartFile remesh_part(PartFile part, const RemeshOptions& options, const Progress& progress)
{
    std::vector<int> sheet; // parts of a deck may differ in thickness and grade
    if (part.deck)
        for (const int face : part.source_face)
            sheet.push_back(part.deck->part_of[size_t(face)]);
    RemeshResult result = remeshed_with_bends(part, options, sheet, progress);
    Remeshed& remeshed = part.remeshed.emplace();
    remeshed.before = result.before;
    remeshed.after = result.after;
    remeshed.size = result.size;
    remeshed.tolerance = result.tolerance;
    remeshed.distance = result.distance;
    remeshed.lines = result.lines;
    remeshed.corners = result.corners;
    remeshed.seconds = result.seconds;
    remeshed.original_vertex = std::move(part.source_vertex);
    remeshed.original_face = std::move(part.source_face);
    part.source_vertex = named(result.nearest_vertex, remeshed.original_vertex);
    part.source_face = named(result.nearest_face, remeshed.original_face);
    remeshed.original = std::make_shared<TriMesh>(std::exchange(part.mesh, std::move(result.mesh)));
    if (!part.corner_normal.empty())
        onto_faces(part);
    if (part.cad)
        number_anew(part);
    std::erase_if(part.doctor.findings,
                  // of others
                  [](const Finding& finding) { return finding.fault == Fault::sliver; });
    part.notes.push_back(describe(remeshed));
    constexpr double sliver = std::numbers::pi / 180; // as the doctor has it
    int slivers = 0;
    for (int f = 0; f < part.mesh.triangles(); ++f)
        slivers += least_angle(part.mesh.position(Eigen::all, part.mesh.triangle.col(f))) < sliver;
    if (slivers > 0)
        part.notes.push_back(fmt::format(
            "{} of its triangles still {} an angle below 1 degree, where lines of the part are close to each other; strains there are unreliable",
            slivers, slivers == 1 ? "has" : "have"));
    return part;
}

PartFile as_read(const PartFile& part)
{
    PartFile result = part;
    if (!part.remeshed)
        return result;
    result.mesh = *part.remeshed->original;
    result.source_vertex = part.remeshed->original_vertex;
    result.source_face = part.remeshed->original_face;
    result.remeshed.reset();
    return result;
}

bool has_face(const PartFile& part, int number)
{
    const std::vector<int>& names = faces_as_read(part);
    return std::binary_search(names.begin(), names.end(), number);
}

std::vector<char> faces_called(const PartFile& part, std::span<const int> numbers)
{
    const auto among = [](const std::vector<int>& names, int number) {
        return std::equal_range(names.begin(), names.end(), number);
    };
    std::vector<char> chosen(size_t(part.mesh.triangles()), 0);
    bool any = false;
    for (const int number : numbers) {
        const auto [from, to] = among(part.source_face, number);
        std::fill(chosen.begin() + (from - part.source_face.begin()), chosen.begin() + (to - part.source_face.begin()),
                  1);
        any = any || from != to;
    }
    if (any || numbers.empty())
        return chosen;
    const std::vector<int>& names = faces_as_read(part);
    const ClosestPointSearch search(part.mesh);
    const TriMesh& original = *part.remeshed->original;
    for (const int number : numbers) {
        const auto [from, to] = among(names, number);
        for (auto f = from; f != to; ++f) {
            const auto corners = original.triangle.col(f - names.begin());
            chosen[size_t(search.nearest(original.position(Eigen::all, corners).rowwise().mean()).face)] = 1;
        }
    }
    return chosen;
}

std::string describe(const Remeshed& remeshed)
{
    constexpr double degrees = 180 / std::numbers::pi;
    return fmt::format(
        "remeshed from {} to {} triangles with edges up to {:.3g} mm: smallest angle {:.3g} -> {:.3g} degrees (99 % "
        "above {:.3g} -> {:.3g}), edge ratio {:.3g} -> {:.3g}; nowhere more than {:.3g} mm from the original "
        "mesh (tolerance {:.3g} mm)",
        remeshed.before.triangles, remeshed.after.triangles, remeshed.size, remeshed.before.least_angle * degrees,
        remeshed.after.least_angle * degrees, remeshed.before.least_angle_of_99 * degrees,
        remeshed.after.least_angle_of_99 * degrees, remeshed.before.edge_ratio, remeshed.after.edge_ratio,
        remeshed.distance, remeshed.tolerance);
}

} // namespace spia
