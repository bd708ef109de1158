#include "engine/mesh/doctor/doctor.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/mesh/doctor/doctor_checks.h"
#include "engine/mesh/doctor/surface_triangles.h"

namespace spia {
namespace {

using Eigen::Vector3d;

/// Vertices in the order of the soup, copies behind their originals, unused ones left out.
Examination number_vertices(const MendedSurface& s, DoctorReport report)
{
    std::vector<char> used(s.home.size(), 0);
    for (const Triangle& t : s.triangle)
        for (const int v : t)
            used[size_t(v)] = 1;
    std::vector<int> order;
    for (size_t v = 0; v < s.home.size(); ++v)
        if (used[v])
            order.push_back(int(v));
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return s.home[size_t(a)] < s.home[size_t(b)]; });

    Examination result;
    std::vector<int> new_number(s.home.size(), -1);
    result.mesh.position.resize(3, long(order.size()));
    for (size_t i = 0; i < order.size(); ++i) {
        const int home = s.home[size_t(order[i])];
        new_number[size_t(order[i])] = int(i);
        result.source_vertex.push_back(home);
        result.mesh.position.col(long(i)) = s.soup.position[size_t(home)];
    }
    result.mesh.triangle.resize(3, long(s.triangle.size()));
    for (size_t f = 0; f < s.triangle.size(); ++f)
        for (size_t k = 0; k < 3; ++k)
            result.mesh.triangle(long(k), long(f)) = new_number[size_t(s.triangle[f][k])];
    result.source_face = s.number;
    result.report = std::move(report);
    return result;
}

/// Where the faults are; what is repaired may be gone from the mesh.
void locate(const PolygonSoup& soup, DoctorReport& report)
{
    for (Finding& finding : report.findings)
        for (const int number : finding.where) {
            if (counts_vertices(finding.fault)) {
                finding.place.push_back(soup.position[size_t(number)]);
                continue;
            }
            Vector3d middle = Vector3d::Zero();
            int known = 0;
            for (const int v : soup.polygon(number))
                if (v >= 0 && v < soup.vertices()) {
                    middle += soup.position[size_t(v)];
                    ++known;
                }
            finding.place.push_back(known ? Vector3d(middle / known) : Vector3d(Vector3d::Zero()));
        }
}

} // namespace

Examination examine(const PolygonSoup& soup, const DoctorOptions& options, const Progress& progress)
{
    DoctorReport report;
    if (!readable(soup, report)) {
        locate(soup, report);
        Examination nothing;
        nothing.report = std::move(report);
        nothing.same_as.resize(size_t(soup.vertices()));
        std::iota(nothing.same_as.begin(), nothing.same_as.end(), 0);
        return nothing;
    }

    SurfaceTriangles split = surface_triangles(soup, options, report, progress.part(0, 0.6));
    MendedSurface s{soup, std::move(split.triangle), std::move(split.number), {}, {}};
    const Tally dropped = drop_flat_at_crowded_edges(s);
    if (options.keep_largest)
        keep_largest(s, report);
    check_edges(s, options.keep_largest, report);
    progress.checkpoint(0.7, "orienting faces");
    orient(s, report);
    mend_flat_triangles(s, dropped, report);
    progress.checkpoint(0.8, "checking vertices");
    separate_fans(s, report);
    report_strays(s, report);
    Examination result = number_vertices(s, std::move(report));
    result.same_as = std::move(split.same_as);
    progress.checkpoint(0.9, "counting loops and handles");
    check_topology(s, result.mesh.vertices(), result.report);
    note_slivers(s, options.sliver_angle_deg, result.report);
    locate(soup, result.report);
    return result;
}

} // namespace spia
