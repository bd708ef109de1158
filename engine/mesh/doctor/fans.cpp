#include "engine/mesh/doctor/mended_surface.h"

#include <fmt/core.h>
#include <numeric>
#include <span>

#include "engine/core/text.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/doctor/touching_edge.h"

namespace spia {
namespace {

/// Corner 3 f + k of triangle f; corners at one vertex that an edge of two faces links are one fan.
DisjointSets fans(const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& position)
{
    DisjointSets sets(3 * triangles.size());
    const auto corner_at = [&](int f, int v) {
        const Triangle& t = triangles[size_t(f)];
        return 3 * f + (t[0] == v ? 0 : t[1] == v ? 1 : 2);
    };
    const auto uses = edge_uses(triangles);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const auto join = [&](size_t one, size_t other) {
            for (const int v : {uses[begin].low, uses[begin].high})
                sets.join(corner_at(uses[one].face, v), corner_at(uses[other].face, v));
        };
        if (end - begin == 2)
            join(begin, begin + 1);
        else if (const auto pairs = touching_edge(std::span(uses).subspan(begin, end - begin), triangles, position)) {
            join(begin + size_t((*pairs)[0]), begin + size_t((*pairs)[1]));
            join(begin + size_t((*pairs)[2]), begin + size_t((*pairs)[3]));
        }
    });
    return sets;
}

} // namespace

void separate_fans(MendedSurface& s, DoctorReport& report)
{
    s.home.resize(size_t(s.soup.vertices()));
    std::iota(s.home.begin(), s.home.end(), 0);
    if (!s.two_faces_per_edge)
        return; // around an edge of three faces there is no fan

    DisjointSets sets = fans(s.triangle, s.soup.position);
    std::vector<int> first_fan(s.home.size(), -1), copy(3 * s.triangle.size(), -1);
    std::vector<char> doubled(s.home.size(), 0);
    for (size_t c = 0; c < copy.size(); ++c) {
        int& v = s.triangle[c / 3][c % 3];
        const int fan = sets.root(int(c));
        int& keeper = first_fan[size_t(v)];
        keeper = keeper < 0 ? fan : keeper;
        if (keeper == fan)
            continue;
        if (copy[size_t(fan)] < 0) {
            copy[size_t(fan)] = int(s.home.size());
            s.home.push_back(v);
            doubled[size_t(v)] = 1;
        }
        v = copy[size_t(fan)];
    }
    Tally touching;
    for (size_t v = 0; v < doubled.size(); ++v)
        if (doubled[v])
            touching.add(int(v));
    if (touching.count > 0)
        report.add(
            Fault::touching_fans, Severity::repaired, touching,
            fmt::format(
                "at {} parts of the sheet touched without a common edge (first: vertex {}); separated by duplicating the vertex",
                counted(touching.count, "vertex", "vertices"), touching.first),
            "if they should be connected there, give them a common edge");
}

} // namespace spia
