#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <numbers>

#include "engine/core/error.h"
#include "engine/layout/matching.h"
#include "engine/layout/plane_graph.h"
#include "engine/layout/plane_lines.h"
#include "engine/options/surface_options.h"

namespace spia {

namespace {

using std::numbers::pi;

/// How good a face of four sides is: the sine of its worst corner; 0 if one is not convex.
double quality(const PlaneGraph& graph, const Face& face)
{
    double worst = 1;
    for (size_t k = 0; k < face.size(); ++k) {
        const double angle = corner_angle(graph, face, k);
        worst = std::min(worst, angle < pi ? std::sin(angle) : 0);
    }
    return worst;
}

/// Two faces with a common curve as one, or nothing.
Face united_faces(const Face& a, const Face& b, int curve)
{
    const auto at = [&](const Face& face) {
        return size_t(std::find_if(face.begin(), face.end(), [&](CurveUse u) { return u.curve == curve; }) -
                      face.begin());
    };
    Face result;
    for (size_t k = 1; k < a.size(); ++k)
        result.push_back(a[(at(a) + k) % a.size()]);
    for (size_t k = 1; k < b.size(); ++k)
        result.push_back(b[(at(b) + k) % b.size()]);
    return result;
}

void keep_used_curves(PlaneGraph& graph, std::vector<Face>& faces)
{
    std::vector<int> number(graph.curve.size(), -1);
    std::vector<LayoutCurve> kept;
    for (Face& face : faces)
        for (CurveUse& use : face) {
            int& n = number[size_t(use.curve)];
            if (n < 0) {
                n = int(kept.size());
                kept.push_back(graph.curve[size_t(use.curve)]);
            }
            use.curve = n;
        }
    graph.curve = std::move(kept);
}

} // namespace

CurveUse turned(CurveUse use) { return {use.curve, !use.reversed}; }

Eigen::Vector2d leaving(const PlaneGraph& graph, CurveUse use, double share)
{
    const LayoutCurve& curve = graph.curve[size_t(use.curve)];
    const Eigen::Index n = curve.plane.cols();
    if (share == 0)
        return use.reversed ? Eigen::Vector2d(curve.plane.col(n - 2) - curve.plane.col(n - 1))
                            : Eigen::Vector2d(curve.plane.col(1) - curve.plane.col(0));
    const Eigen::Matrix2Xd p =
        points_on(curve, use.reversed ? std::vector<double>{1, 1 - share} : std::vector<double>{0, share});
    return p.col(1) - p.col(0);
}

std::vector<Eigen::Vector2d> polygon(const PlaneGraph& graph, const Face& face)
{
    std::vector<Eigen::Vector2d> points;
    for (const CurveUse use : face) {
        const Eigen::Matrix2Xd& p = graph.curve[size_t(use.curve)].plane;
        for (Eigen::Index i = 0; i + 1 < p.cols(); ++i)
            points.push_back(p.col(use.reversed ? p.cols() - 1 - i : i));
    }
    return points;
}

int start_of(const PlaneGraph& graph, CurveUse use)
{
    return graph.curve[size_t(use.curve)].vertex[use.reversed ? 1 : 0];
}

double corner_angle(const PlaneGraph& graph, const Face& face, size_t k)
{
    const CurveUse before = turned(face[(k + face.size() - 1) % face.size()]);
    return turn_to(leaving(graph, face[k], corner_share), leaving(graph, before, corner_share));
}

std::vector<Face> faces_of(const PlaneGraph& graph)
{
    std::vector<std::vector<CurveUse>> leaves(graph.vertex.size()); // per vertex, counter-clockwise
    for (int c = 0; c < int(graph.curve.size()); ++c)
        for (const bool reversed : {false, true})
            leaves[size_t(start_of(graph, {c, reversed}))].push_back({c, reversed});
    for (auto& around : leaves)
        std::sort(around.begin(), around.end(), [&](CurveUse a, CurveUse b) {
            const Eigen::Vector2d p = leaving(graph, a, 0), q = leaving(graph, b, 0);
            return std::atan2(p.y(), p.x()) < std::atan2(q.y(), q.x());
        });
    std::map<std::pair<int, bool>, bool> seen;
    std::vector<Face> faces;
    for (int c = 0; c < int(graph.curve.size()); ++c)
        for (const bool reversed : {false, true}) {
            if ((reversed && graph.curve[size_t(c)].on_border()) || seen[{c, reversed}])
                continue;
            Face face;
            for (CurveUse use{c, reversed}; !seen[{use.curve, use.reversed}];) {
                seen[{use.curve, use.reversed}] = true;
                face.push_back(use);
                const CurveUse back = turned(use);
                const auto& around = leaves[size_t(start_of(graph, back))];
                const size_t at = size_t(std::find(around.begin(), around.end(), back) - around.begin());
                use = around[(at + around.size() - 1) % around.size()]; // the next one clockwise
            }
            faces.push_back(std::move(face));
        }
    for (const Face& face : faces) {
        const auto points = polygon(graph, face);
        double twice = 0;
        for (size_t i = 0, j = points.size() - 1; i < points.size(); j = i++)
            twice += points[j].x() * points[i].y() - points[j].y() * points[i].x();
        if (!(twice > 0))
            throw InputError("a hole of the blank is joined to the rest by no line of the layout; give cuts from it (" +
                             mention(option::patches, "FILE") + ")");
    }
    return faces;
}

void join_arcs(PlaneGraph& graph, std::vector<Face>& faces)
{
    std::vector<int> curves_at(graph.vertex.size(), 0);
    for (const LayoutCurve& curve : graph.curve)
        for (const int v : curve.vertex)
            ++curves_at[size_t(v)];
    for (Face& face : faces)
        for (size_t k = 0; k < face.size() && face.size() > 3;) {
            const size_t before = (k + face.size() - 1) % face.size();
            LayoutCurve &first = graph.curve[size_t(face[before].curve)], &second = graph.curve[size_t(face[k].curve)];
            if (curves_at[size_t(start_of(graph, face[k]))] > 2 || !first.on_border() || !second.on_border() ||
                std::abs(corner_angle(graph, face, k) - pi) > pi / 6) {
                ++k;
                continue;
            }
            const auto join = [](auto& one, const auto& other) {
                auto both = one;
                both.resize(one.rows(), one.cols() + other.cols() - 1);
                both << one, other.rightCols(other.cols() - 1);
                one = std::move(both);
            };
            join(first.plane, second.plane);
            join(first.part, second.part);
            first.vertex[1] = second.vertex[1];
            face.erase(face.begin() + long(k));
        }
    keep_used_curves(graph, faces);
}

bool pair_triangles(PlaneGraph& graph, std::vector<Face>& faces, double worst_angle)
{
    std::map<int, std::vector<int>> sides_of; // per inner curve its faces
    for (int f = 0; f < int(faces.size()); ++f)
        for (const CurveUse use : faces[size_t(f)])
            if (const LayoutCurve& curve = graph.curve[size_t(use.curve)]; !curve.on_border() && !curve.kept)
                sides_of[use.curve].push_back(f);
    struct Pair {
        std::array<int, 2> face;
        int curve;
        double quality;
    };
    std::vector<Pair> pairs;
    for (const auto& [curve, two] : sides_of) {
        if (two.size() != 2 || two[0] == two[1] || faces[size_t(two[0])].size() != 3 ||
            faces[size_t(two[1])].size() != 3)
            continue;
        const double q = quality(graph, united_faces(faces[size_t(two[0])], faces[size_t(two[1])], curve));
        if (q > std::sin(worst_angle))
            pairs.push_back({{two[0], two[1]}, curve, q});
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.quality > b.quality; });
    std::vector<std::array<int, 2>> edges;
    for (const Pair& pair : pairs)
        edges.push_back(pair.face);
    const std::vector<int> partner = largest_matching(int(faces.size()), edges);
    std::vector<Face> result;
    bool all = true;
    for (int f = 0; f < int(faces.size()); ++f) {
        const int other = partner[size_t(f)];
        if (other < 0) {
            all = all && faces[size_t(f)].size() == 4;
            result.push_back(faces[size_t(f)]);
        } else if (f < other) {
            const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const Pair& p) {
                return (p.face == std::array{f, other}) || (p.face == std::array{other, f});
            });
            result.push_back(united_faces(faces[size_t(f)], faces[size_t(other)], pair->curve));
        }
    }
    faces = std::move(result);
    keep_used_curves(graph, faces);
    return all;
}

} // namespace spia
