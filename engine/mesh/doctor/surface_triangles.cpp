#include "engine/mesh/doctor/surface_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/core.h>
#include <numeric>
#include <optional>

#include "engine/core/text.h"
#include "engine/mesh/doctor/edge_vertices.h"
#include "engine/mesh/doctor/split_polygon.h"
#include "engine/mesh/doctor/weld.h"
#include "engine/options/part_options.h"

namespace spia {
namespace {

/// Polygons that went through the first repairs.
struct Polygons {
    PolygonSoup soup;        ///< corners only
    std::vector<int> number; ///< per polygon: its number in the file
    void add(std::span<const int> corners, int file_number)
    {
        soup.add_polygon(corners);
        number.push_back(file_number);
    }
};

/// Only what faces use: a stray vertex far away must not widen the tolerance.
double diagonal_of_faces(const PolygonSoup& soup)
{
    Eigen::AlignedBox3d box;
    for (const int v : soup.corner)
        box.extend(soup.position[size_t(v)]);
    return box.isEmpty() ? 0 : box.diagonal().norm();
}

void note_cracks(const PolygonSoup& soup, const std::vector<int>& same_as, DoctorReport& report)
{
    const auto cracks = find_cracks(soup, same_as);
    if (!cracks)
        return;
    Tally vertices;
    for (const int v : cracks->vertex)
        vertices.add(v);
    report.add(Fault::crack, Severity::note, vertices,
               fmt::format("open edges lie up to {:.3g} mm off others and seem to be the same: a crack along {} "
                           "vertices (first: vertex {})",
                           cracks->widest, vertices.count, vertices.first),
               fmt::format("close the crack if the sheet is whole there ({})",
                           mention(option::weld, fmt::format("{:.2g}", cracks->tolerance))));
    report.findings.back().weld_gap = cracks->tolerance;
}

/// mm, up to which gaps are closed
double widest_gap(const PolygonSoup& soup, const DoctorOptions& options)
{
    return options.weld ? options.weld_gap.value_or(options.weld_tolerance * diagonal_of_faces(soup)) : 0;
}

/// Faces on both sides of a line need not have their vertices at the same places of it.
/// @returns nothing where all are joined as they are
std::optional<PolygonSoup> join_edges(const PolygonSoup& soup, const std::vector<int>& same_as, double gap,
                                      DoctorReport& report)
{
    const std::vector<EdgeVertex> vertices_on_edges = edge_vertices(soup, same_as, gap);
    if (vertices_on_edges.empty())
        return std::nullopt;
    std::vector<EdgeVertex> taken;
    PolygonSoup result = with_corners(soup, same_as, vertices_on_edges, taken);
    if (taken.empty())
        return std::nullopt;
    Tally vertices;
    double widest = 0;
    std::sort(taken.begin(), taken.end(), [](const auto& v, const auto& w) { return v.vertex < w.vertex; });
    for (const EdgeVertex& v : taken) {
        vertices.add(v.vertex);
        widest = std::max(widest, v.gap);
    }
    report.add(Fault::coincident_vertex, Severity::repaired, vertices,
               fmt::format("{} on an edge of another face{} (first: vertex {}); that face was divided there",
                           counted(vertices.count, "vertex lies", "vertices lie"),
                           widest > 0 ? fmt::format(", up to {:.3g} mm off it", widest) : "", vertices.first),
               "");
    return result;
}

/// Per vertex the one that stands for it.
std::vector<int> join_vertices(const PolygonSoup& soup, const DoctorOptions& options, double gap, DoctorReport& report)
{
    const Weld found = weld(soup, gap);
    Tally joined;
    for (int v = 0; v < soup.vertices(); ++v)
        if (found.same_as[size_t(v)] != v)
            joined.add(v);
    if (joined.count > 0 && options.weld) {
        std::string text = fmt::format("{} welded to an earlier one{} (first: vertex {})",
                                       counted(joined.count, "vertex was", "vertices were"),
                                       found.near == 0 ? " at the same place" : "", joined.first);
        if (found.near > 0)
            text += fmt::format(", {} across gaps of up to {:.3g} mm{}",
                                found.near < joined.count ? fmt::format("{} of them", found.near) : "all", found.widest,
                                found.near < joined.count ? " and the others at the same place" : "");
        report.add(Fault::coincident_vertex, Severity::repaired, joined, text, "");
    }
    if (options.weld)
        return found.same_as;
    if (joined.count > 0)
        report.add(Fault::coincident_vertex, Severity::note, joined,
                   fmt::format("{} at the place of another (first: vertex {}) and {} left there",
                               counted(joined.count, "vertex lies", "vertices lie"), joined.first,
                               joined.count == 1 ? "was" : "were"),
                   "if faces that should be connected are not, weld vertices at the same place (" +
                       mention(option::weld) + ")");
    std::vector<int> themselves(size_t(soup.vertices()));
    std::iota(themselves.begin(), themselves.end(), 0);
    return themselves;
}

Polygons without_repeated_corners(const PolygonSoup& soup, const std::vector<int>& same_as, DoctorReport& report)
{
    Polygons kept;
    Tally repeated, twisted;
    std::vector<int> corners, sorted;
    for (int p = 0; p < soup.polygons(); ++p) {
        corners.clear();
        for (const int v : soup.polygon(p))
            if (const int w = same_as[size_t(v)]; corners.empty() || corners.back() != w)
                corners.push_back(w);
        while (corners.size() > 1 && corners.back() == corners.front())
            corners.pop_back();
        if (corners.size() < std::max<size_t>(soup.polygon(p).size(), 3))
            repeated.add(p);
        if (corners.size() < 3)
            continue;
        sorted = corners;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
            twisted.add(p);
        else
            kept.add(corners, p);
    }
    if (repeated.count > 0)
        report.add(
            Fault::repeated_corner, Severity::repaired, repeated,
            fmt::format("{} one vertex at neighbouring corners or fewer than three corners (first: face {}); those "
                        "with three different corners were kept without the repetition, the others left out",
                        counted(repeated.count, "face has", "faces have"), repeated.first),
            "");
    if (twisted.count > 0)
        report.add(Fault::repeated_corner, Severity::fatal, twisted,
                   fmt::format("{} through one vertex twice (first: face {})",
                               counted(twisted.count, "face goes", "faces go"), twisted.first),
                   "split such faces into simple ones in the program that made them");
    return kept;
}

/// The corners from the smallest on, in the direction of its smaller neighbour: equal for equal
/// faces of either side.
std::vector<int> face_key(std::span<const int> corners)
{
    std::vector<int> key(corners.begin(), corners.end());
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    if (key[1] > key.back())
        std::reverse(key.begin() + 1, key.end());
    return key;
}

Polygons without_duplicates(const Polygons& polygons, DoctorReport& report)
{
    const size_t n = polygons.number.size();
    std::vector<std::vector<int>> key(n);
    for (size_t p = 0; p < n; ++p)
        key[p] = face_key(polygons.soup.polygon(int(p)));
    std::vector<size_t> order(n);
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key[a] < key[b]; });
    std::vector<char> again(n, 0);
    for (size_t i = 1; i < n; ++i)
        again[order[i]] = key[order[i]] == key[order[i - 1]];

    Polygons kept;
    Tally duplicates;
    for (size_t p = 0; p < n; ++p)
        if (again[p])
            duplicates.add(polygons.number[p]);
        else
            kept.add(polygons.soup.polygon(int(p)), polygons.number[p]);
    if (duplicates.count > 0)
        report.add(Fault::duplicate_face, Severity::repaired, duplicates,
                   fmt::format("{} on the corners of an earlier one (first: face {}); left out",
                               counted(duplicates.count, "face lies", "faces lie"), duplicates.first),
                   "");
    return kept;
}

/// @param soup  as the file has it
SurfaceTriangles split(const Polygons& polygons, const PolygonSoup& soup, DoctorReport& report,
                       const Progress& progress)
{
    constexpr size_t most_corners = 1000; // splitting takes time with the square of it
    SurfaceTriangles result;
    Tally many_corners, crossing;
    std::vector<Eigen::Vector3d> points;
    for (size_t p = 0; p < polygons.number.size(); ++p) {
        const auto corners = polygons.soup.polygon(int(p));
        if (corners.size() > 3)
            progress.checkpoint(double(p) / double(polygons.number.size()), "splitting polygons");
        points.clear();
        for (const int v : corners)
            points.push_back(soup.position[size_t(v)]);
        const auto parts = corners.size() > most_corners ? std::vector<Triangle>{} : split_polygon(points);
        if (parts.empty()) {
            crossing.add(polygons.number[p]);
            continue;
        }
        if (parts.size() > 1 && soup.polygon(polygons.number[p]).size() > 3)
            many_corners.add(polygons.number[p]);
        for (const Triangle& t : parts) {
            result.triangle.push_back({corners[size_t(t[0])], corners[size_t(t[1])], corners[size_t(t[2])]});
            result.number.push_back(polygons.number[p]);
        }
    }
    if (many_corners.count > 0)
        report.add(Fault::polygon, Severity::repaired, many_corners,
                   fmt::format("{} more than three corners (first: face {}); split into triangles",
                               counted(many_corners.count, "face has", "faces have"), many_corners.first),
                   "");
    if (crossing.count > 0)
        report.add(Fault::crossing_polygon, Severity::fatal, crossing,
                   fmt::format("{} or more than {} corners (first: face {})",
                               counted(crossing.count, "face crosses itself or has", "faces cross themselves or have"),
                               most_corners, crossing.first),
                   "split such faces into triangles in the program that made them");
    return result;
}

} // namespace

SurfaceTriangles surface_triangles(const PolygonSoup& soup, const DoctorOptions& options, DoctorReport& report,
                                   const Progress& progress)
{
    progress.checkpoint(0, "joining vertices");
    const double gap = widest_gap(soup, options);
    const std::vector<int> same_as = join_vertices(soup, options, gap, report);
    std::optional<PolygonSoup> divided;
    if (gap > 0)
        divided = join_edges(soup, same_as, gap, report);
    const PolygonSoup& joined = divided ? *divided : soup;
    if (options.weld || !report.find(Fault::coincident_vertex)) // else welding comes first
        note_cracks(joined, same_as, report);
    progress.checkpoint(0.4, "looking for duplicates");
    const Polygons polygons = without_duplicates(without_repeated_corners(joined, same_as, report), report);
    SurfaceTriangles result = split(polygons, soup, report, progress.part(0.6, 1));
    result.same_as = same_as;
    return result;
}

} // namespace spia
