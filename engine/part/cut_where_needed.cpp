#include "engine/part/cut_where_needed.h"

#include <algorithm>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/mesh/cut/corner_seam.h"
#include "engine/mesh/topology.h"
#include "engine/options/part_options.h"

namespace spia {
namespace {

/// What the doctor found that a cut cannot mend.
bool sick_beyond_a_cut(const DoctorReport& report)
{
    return std::any_of(report.findings.begin(), report.findings.end(), [](const Finding& finding) {
        return finding.severity == Severity::fatal && finding.fault != Fault::closed_surface &&
               finding.fault != Fault::handle;
    });
}

/// The seam of the options, in vertices of the mesh; of copies the first. Of a solid the vertices
/// of its other skin stand for those opposite to them.
SeamOptions in_mesh(SeamOptions seam, const PartFile& part, const PolygonSoup& file)
{
    const std::vector<int>& source = part.source_vertex;
    const auto opposite = [&](int v) -> std::optional<int> {
        if (!part.solid || v >= file.vertices())
            return std::nullopt;
        constexpr double mitred = 2; // at a corner of three walls the skins are sqrt(3) times the
                                     // thickness apart
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

/// @param row  of the seam, vertices of the file
Finding finding_of(const CutPart& cut, const TriMesh& uncut, const std::vector<std::vector<int>>& row)
{
    Tally where;
    std::vector<Eigen::Vector3d> place;
    for (size_t r = 0; r < cut.seam.size(); ++r)
        for (size_t i = 0; i < cut.seam[r].size(); ++i) {
            where.add(row[r][i]);
            if (place.size() < where.where.size())
                place.push_back(uncut.position.col(cut.seam[r][i]));
        }
    const Eigen::Vector3d &from = place.front(), &to = place[std::min(place.size(), cut.seam.front().size()) - 1];
    const int paths = int(cut.seam.size());
    return Finding{
        Fault::seam,
        Severity::repaired,
        where.count,
        where.first,
        fmt::format(
            "cut open along a seam of {:.4g} mm{}, from vertex {} at {:.4g}, {:.4g}, {:.4g} mm to vertex {} at {:.4g}, "
            "{:.4g}, {:.4g} mm: {}; the blank has an edge on both sides of it, to be joined after forming",
            cut.length, paths > 1 ? fmt::format(" in {} paths, the first", paths) : "", row[0].front(), from.x(),
            from.y(), from.z(), row[0].back(), to.x(), to.y(), to.z(), cut.why),
        "",
        where.where,
        std::move(place)};
}

/// "at 4 corners and around 1 opening, up to 90 degrees away from flat"
std::string describe(const CornerSeam& seam)
{
    const size_t corners = seam.corner.size(), openings = seam.opening.size();
    return fmt::format(
        "{}{}{}, up to {:.3g} degrees away from flat", corners > 0 ? "at " + counted(corners, "corner", "corners") : "",
        corners > 0 && openings > 0 ? " and " : "",
        openings > 0 ? "around " + counted(openings, "opening", "openings") : "", seam.defect * 180 / std::numbers::pi);
}

} // namespace

PartFile cut_where_needed(PartFile part, SeamOptions seam, const PolygonSoup& file)
{
    DoctorReport& report = part.doctor;
    if (seam.mode == SeamOptions::Mode::none || sick_beyond_a_cut(report) || report.components != 1 || !report.genus)
        return part;
    std::string unrolls;
    if (seam.mode == SeamOptions::Mode::corners) {
        const auto corners = *report.boundary_loops > 0 ? corner_seam(part.mesh) : std::nullopt;
        seam = {};
        if (corners) {
            seam = {SeamOptions::Mode::given, corners->path};
            unrolls = fmt::format(" it unrolls without strain now, cut {}", describe(*corners));
        } else
            part.doubts.push_back(part.notes.emplace_back("there are no corners to cut: it unrolls uncut, or is curved "
                                                          "elsewhere too"));
    } else
        seam = in_mesh(std::move(seam), part, file);
    CutPart cut = cut_open(part.mesh, seam);
    if (!unrolls.empty())
        cut.why = unrolls.substr(1);
    if (cut.seam.empty())
        return part;
    part.seam = cut.seam;
    for (std::vector<int>& row : part.seam)
        for (int& v : row)
            v = part.source_vertex[size_t(v)];
    part.seam_length = cut.length;
    for (Finding& finding : report.findings)
        if (finding.fault == Fault::closed_surface || finding.fault == Fault::handle)
            finding.severity = Severity::repaired;
    report.findings.push_back(finding_of(cut, part.mesh, part.seam));
    std::vector<int> source;
    for (const int v : cut.source)
        source.push_back(part.source_vertex[size_t(v)]);
    part.source_vertex = std::move(source);
    part.mesh = std::move(cut.mesh);
    const SurfaceType type = surface_type(part.mesh);
    report.boundary_loops = type.loops;
    report.genus = type.genus;
    report.euler_characteristic = 2 - 2 * type.genus - type.loops;
    return part;
}

std::optional<Finding> closed_corners(const PartFile& part, const SeamOptions& seam)
{
    if (!part.doctor.healthy() || seam.mode == SeamOptions::Mode::given || !surface_type(part.mesh).sheet())
        return std::nullopt;
    const auto corners = corner_seam(part.mesh);
    if (!corners)
        return std::nullopt;
    Tally where;
    std::vector<Eigen::Vector3d> place;
    for (const std::vector<int>* found : {&corners->corner, &corners->opening})
        for (const int v : *found) {
            where.add(part.source_vertex[size_t(v)]);
            if (place.size() < where.where.size())
                place.push_back(part.mesh.position.col(v));
        }
    return Finding{
        Fault::closed_corner,
        Severity::note,
        where.count,
        where.first,
        fmt::format("the sheet is only bent, but joined {}, which strains it", describe(*corners)),
        fmt::format("cut along {:.4g} mm from there to the border it unrolls without strain, unless it then overlaps "
                    "itself ({})",
                    corners->length, mention(option::seam, "corners")),
        where.where,
        std::move(place)};
}

} // namespace spia
