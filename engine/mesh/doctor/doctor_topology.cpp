#include "engine/mesh/doctor/doctor_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/core.h>
#include <numeric>
#include <utility>

#include "engine/core/text.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/options/part_options.h"

namespace spia {
namespace {

void count_pieces(const MendedSurface& s, DoctorReport& report)
{
    // area and triangles
    std::vector<std::pair<double, int>> size(size_t(report.components), {0, 0});
    for (size_t f = 0; f < s.piece.size(); ++f) {
        const auto corner = [&](int k) { return s.soup.position[size_t(s.home[size_t(s.triangle[f][k])])]; };
        auto& [area, triangles] = size[size_t(s.piece[f])];
        area += (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
        ++triangles;
    }
    const int largest = int(std::max_element(size.begin(), size.end()) - size.begin());
    std::vector<char> seen(size.size(), 0);
    seen[size_t(largest)] = 1;
    Tally others; // the first face of each
    for (size_t f = 0; f < s.piece.size(); ++f)
        if (!std::exchange(seen[size_t(s.piece[f])], char(1)))
            others.add(s.number[f]);
    std::erase_if(size, [](const auto& piece) { return piece.second == 0; });
    report.components = int(size.size());
    if (report.components < 2)
        return;
    others.count = report.components;
    std::stable_sort(size.begin(), size.end(), std::greater());
    std::string sizes;
    for (size_t i = 0; i < std::min<size_t>(size.size(), 5); ++i)
        sizes += fmt::format("{}{}", i > 0 ? ", " : "", size[i].second);
    const Finding* coincident = report.find(Fault::coincident_vertex);
    const bool unjoined = coincident && coincident->severity == Severity::note;
    const Finding* crack = report.find(Fault::crack);
    report.add(
        Fault::several_components, Severity::fatal, others,
        fmt::format(
            "there are {} separate pieces, the largest by area first: of {}{} triangles (first face outside it: {})",
            report.components, sizes, size.size() > 5 ? ", ..." : "", others.first),
        fmt::format("{}keep the largest ({}), or save each piece as a separate file",
                    unjoined ? fmt::format("weld vertices at the same place ({}) if the pieces touch; otherwise ",
                                           mention(option::weld))
                    : crack  ? crack->advice + "; otherwise "
                             : "",
                    mention(option::keep_largest)));
}

/// Edges of the surface, and boundary loops of each piece.
struct Outline {
    int edges = 0;
    std::vector<int> loops;
};

Outline outline(const MendedSurface& s, int pieces)
{
    // Every vertex has one fan now, so at most two boundary edges meet there and a loop is a
    // connected set of them.
    DisjointSets sets(s.home.size());
    std::vector<int> piece_of(s.home.size(), -1);
    Outline result;
    const auto uses = edge_uses(s.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        ++result.edges;
        if (end - begin > 1)
            return;
        sets.join(uses[begin].low, uses[begin].high);
        piece_of[size_t(uses[begin].low)] = piece_of[size_t(uses[begin].high)] = s.piece[size_t(uses[begin].face)];
    });
    result.loops.assign(size_t(pieces), 0);
    for (size_t v = 0; v < piece_of.size(); ++v)
        if (piece_of[v] >= 0 && sets.root(int(v)) == int(v))
            ++result.loops[size_t(piece_of[v])];
    return result;
}

} // namespace

void check_topology(const MendedSurface& s, int vertices, DoctorReport& report)
{
    if (s.triangle.empty()) {
        report.add(Fault::nothing_there, Severity::fatal, Tally{}, "no face is left after the repairs",
                   "the faces of the file have no area: export it again");
        return;
    }
    const int pieces = report.components;
    count_pieces(s, report);
    if (!s.two_faces_per_edge)
        return; // boundary and genus mean nothing

    Outline around = outline(s, pieces);
    const int loops = std::accumulate(around.loops.begin(), around.loops.end(), 0);
    report.boundary_loops = loops;
    report.euler_characteristic = vertices - around.edges + int(s.triangle.size());
    if (s.two_sided) // chi = 2 components - 2 genus - loops
        report.genus = (2 * report.components - *report.euler_characteristic - loops) / 2;

    Tally closed;
    for (size_t f = 0; f < s.piece.size(); ++f)
        if (int& n = around.loops[size_t(s.piece[f])]; n == 0) {
            n = -1; // this piece is counted
            closed.add(s.number[f]);
        }
    if (closed.count > 0)
        report.add(
            Fault::closed_surface, Severity::fatal, closed,
            report.components == 1 ? std::string("the surface is closed, it has no boundary")
                                   : fmt::format("{} closed, without a boundary (first: the one of face {})",
                                                 counted(closed.count, "piece is", "pieces are"), closed.first),
            report.components == 1
                ? "a sheet is described by one of its skins: delete the other side and the faces across the thickness"
                : "take one of the pieces alone: if it is a solid of sheet, one surface of it is laid flat");
    if (report.genus.value_or(0) > 0)
        report.add(Fault::handle, Severity::fatal, Tally{*report.genus, -1, {}},
                   fmt::format("the surface has {} (genus {}), like the ear of a cup: it cannot be flattened as it is",
                               counted(*report.genus, "handle", "handles"), *report.genus),
                   "cut each handle open");
}

} // namespace spia
