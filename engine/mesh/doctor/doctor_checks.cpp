#include "engine/mesh/doctor/doctor_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>
#include <span>

#include "engine/core/text.h"
#include "engine/mesh/doctor/touching_edge.h"
#include "engine/options/part_options.h"

namespace spia {
namespace {

using Eigen::Vector3d;

void check_coordinates(const PolygonSoup& soup, DoctorReport& report)
{
    constexpr double beyond_any_part = 1e9; // mm, a thousand kilometres
    Tally bad;
    for (int v = 0; v < soup.vertices(); ++v) {
        const Vector3d& p = soup.position[size_t(v)];
        if (!p.allFinite() || p.cwiseAbs().maxCoeff() > beyond_any_part)
            bad.add(v);
    }
    if (bad.count == 0)
        return;
    const Vector3d& p = soup.position[size_t(bad.first)];
    report.add(Fault::bad_coordinate, Severity::fatal, bad,
               fmt::format("{} a coordinate that is no number or beyond {} mm (first: vertex {} at {}, {}, {})",
                           counted(bad.count, "vertex has", "vertices have"), beyond_any_part, bad.first, p.x(), p.y(),
                           p.z()),
               "export the file again and check its length unit");
}

void check_indices(const PolygonSoup& soup, DoctorReport& report)
{
    Tally bad;
    int wrong = 0;
    for (int p = 0; p < soup.polygons(); ++p)
        for (const int v : soup.polygon(p))
            if (v < 0 || v >= soup.vertices()) {
                wrong = bad.count == 0 ? v : wrong;
                bad.add(p);
                break;
            }
    if (bad.count > 0)
        report.add(Fault::bad_index, Severity::fatal, bad,
                   fmt::format("{} a vertex that does not exist (first: face {}, vertex {} where there are {})",
                               counted(bad.count, "face names", "faces name"), bad.first, wrong, soup.vertices()),
                   "the file is damaged or cut off: export it again");
}

double least_angle(const Triangle& t, const std::vector<Vector3d>& position)
{
    double least = std::numbers::pi;
    for (size_t k = 0; k < 3; ++k) {
        const Vector3d& at = position[size_t(t[k])];
        const Vector3d a = position[size_t(t[(k + 1) % 3])] - at, b = position[size_t(t[(k + 2) % 3])] - at;
        least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
    return least;
}

} // namespace

bool readable(const PolygonSoup& soup, DoctorReport& report)
{
    if (soup.polygons() == 0)
        report.add(Fault::nothing_there, Severity::fatal, Tally{}, "there are no faces",
                   "give a surface mesh: points or curves alone cannot be flattened");
    check_coordinates(soup, report);
    check_indices(soup, report);
    return report.healthy();
}

void check_edges(MendedSurface& s, bool kept_largest, DoctorReport& report)
{
    int most = 0;
    std::vector<EdgeUse> crowded; ///< the first face of each
    const auto uses = edge_uses(s.triangle);
    bool closed = true; // and seen from one side
    for_each_edge(uses, [&](size_t begin, size_t end) {
        closed &= (end - begin) % 2 == 0;
        if (end == begin + 2)
            closed &= uses[begin].forward != uses[begin + 1].forward;
    });
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin <= 2 ||
            (closed && touching_edge(std::span(uses).subspan(begin, end - begin), s.triangle, s.soup.position)))
            return;
        crowded.push_back(uses[begin]); // the uses of an edge are in the order of the faces
        most = std::max(most, int(end - begin));
    });
    s.two_faces_per_edge = crowded.empty();
    if (crowded.empty())
        return;
    std::stable_sort(crowded.begin(), crowded.end(),
                     [](const EdgeUse& a, const EdgeUse& b) { return a.face < b.face; });
    Tally faces;
    for (const EdgeUse& use : crowded)
        faces.add(s.number[size_t(use.face)]);
    const EdgeUse& first = crowded[0];
    report.add(
        Fault::crowded_edge, Severity::fatal, faces,
        fmt::format("{} to three or more faces, up to {} (first: the edge between the vertices {} and "
                    "{}, at face "
                    "{})",
                    counted(faces.count, "edge belongs", "edges belong"), most, first.low, first.high, faces.first),
        kept_largest
            ? "an edge of a sheet joins two faces at most, and those that meet here are connected elsewhere too: "
              "remove duplicate layers, keep one skin of the part"
            : fmt::format("an edge of a sheet joins two faces at most: remove ribs and duplicate layers, keep one "
                          "skin of the part, or leave out what is attached at such edges ({})",
                          mention(option::keep_largest)));
}

void report_strays(const MendedSurface& s, DoctorReport& report)
{
    std::vector<char> named(size_t(s.soup.vertices()), 0);
    for (const int v : s.soup.corner)
        named[size_t(v)] = 1;
    Tally strays;
    for (int v = 0; v < s.soup.vertices(); ++v)
        if (!named[size_t(v)])
            strays.add(v);
    if (strays.count > 0)
        report.add(Fault::stray_vertex, Severity::repaired, strays,
                   fmt::format("{} to no face (first: vertex {}); left out",
                               counted(strays.count, "vertex belongs", "vertices belong"), strays.first),
                   "");
}

void note_slivers(const MendedSurface& s, double angle_deg, DoctorReport& report)
{
    Tally slivers;
    double least = std::numbers::pi;
    for (size_t f = 0; f < s.triangle.size(); ++f) {
        Triangle t = s.triangle[f];
        for (int& v : t)
            v = s.home[size_t(v)];
        const double angle = least_angle(t, s.soup.position);
        least = std::min(least, angle);
        if (angle < angle_deg * std::numbers::pi / 180)
            slivers.add(s.number[f]);
    }
    if (slivers.count > 0)
        report.add(Fault::sliver, Severity::note, slivers,
                   fmt::format("{} an angle below {:.3g} degrees (first: face {}); the smallest is {:.3g} degrees",
                               counted(slivers.count, "triangle has", "triangles have"), angle_deg, slivers.first,
                               least * 180 / std::numbers::pi),
                   "strains there are unreliable; use a more even mesh (" + mention(option::remesh) + ")");
}

} // namespace spia
