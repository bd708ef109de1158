#include "engine/mesh/doctor/mended_surface.h"

#include <Eigen/Geometry>
#include <fmt/core.h>
#include <utility>

#include "engine/core/text.h"

namespace spia {
namespace {

using Eigen::Vector3d;

/// A neighbour over an edge of two faces.
struct Step {
    int to;
    bool same_side; ///< the two run through the edge in opposite directions
};

std::vector<std::vector<Step>> neighbours(const std::vector<Triangle>& triangles)
{
    std::vector<std::vector<Step>> steps(triangles.size());
    const auto uses = edge_uses(triangles);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin != 2)
            return;
        const EdgeUse &a = uses[begin], &b = uses[begin + 1];
        steps[size_t(a.face)].push_back({b.face, a.forward != b.forward});
        steps[size_t(b.face)].push_back({a.face, a.forward != b.forward});
    });
    return steps;
}

double area(const Triangle& t, const std::vector<Vector3d>& position)
{
    const Vector3d& a = position[size_t(t[0])];
    return 0.5 * (position[size_t(t[1])] - a).cross(position[size_t(t[2])] - a).norm();
}

} // namespace

/// Floods each piece from its first triangle and turns over whatever shows the other side; then the
/// piece as a whole if that was the smaller area.
void orient(MendedSurface& s, DoctorReport& report)
{
    const auto steps = neighbours(s.triangle);
    s.piece.assign(s.triangle.size(), -1);
    std::vector<char> turned(s.triangle.size(), 0);
    int clash = -1;
    for (size_t seed = 0; seed < s.triangle.size(); ++seed) {
        if (s.piece[seed] >= 0)
            continue;
        const int piece = report.components++;
        s.piece[seed] = piece;
        std::vector<size_t> reached = {seed};
        double kept_area = 0, turned_area = 0;
        for (size_t i = 0; i < reached.size(); ++i) {
            const size_t f = reached[i];
            (turned[f] ? turned_area : kept_area) += area(s.triangle[f], s.soup.position);
            for (const Step& step : steps[f]) {
                const size_t g = size_t(step.to);
                const char side = char(step.same_side ? turned[f] : !turned[f]);
                if (s.piece[g] < 0) {
                    s.piece[g] = piece;
                    turned[g] = side;
                    reached.push_back(g);
                } else if (turned[g] != side && (clash < 0 || step.to < clash)) {
                    clash = step.to;
                }
            }
        }
        if (turned_area > kept_area)
            for (const size_t f : reached)
                turned[f] = !turned[f];
    }
    if (clash >= 0) {
        s.two_sided = false;
        Tally strip;
        strip.add(s.number[size_t(clash)]);
        report.add(
            Fault::one_sided, Severity::fatal, strip,
            fmt::format(
                "the surface has one side only, like a Moebius strip: a path around it returns to face {} from behind",
                s.number[size_t(clash)]),
            "cut it open, or look for a wrongly connected strip of faces");
        return;
    }
    Tally turns;
    for (size_t f = 0; f < s.triangle.size(); ++f)
        if (turned[f]) {
            std::swap(s.triangle[f][1], s.triangle[f][2]);
            turns.add(s.number[f]);
        }
    if (turns.count > 0)
        report.add(
            Fault::flipped_face, Severity::repaired, turns,
            fmt::format("{} oriented against the others (first: face {}); flipped, the larger area kept its side",
                        counted(turns.count, "triangle was", "triangles were"), turns.first),
            "");
}

} // namespace spia
