#include "engine/mesh/mended_surface.h"

#include <fmt/core.h>
#include <numeric>

#include "engine/mesh/disjoint_sets.h"

namespace spia {
namespace {

/// Corner 3 f + k of triangle f; corners at one vertex that an edge of two faces links are one fan.
DisjointSets fans(const std::vector<Triangle>& triangles)
{
    DisjointSets sets(3 * triangles.size());
    const auto corner_at = [&](int f, int v) {
        const Triangle& t = triangles[size_t(f)];
        return 3 * f + (t[0] == v ? 0 : t[1] == v ? 1 : 2);
    };
    const auto uses = edge_uses(triangles);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin == 2)
            for (const int v : {uses[begin].low, uses[begin].high})
                sets.join(corner_at(uses[begin].face, v), corner_at(uses[begin + 1].face, v));
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

    DisjointSets sets = fans(s.triangle);
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
