#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <numbers>

#include "engine/core/error.h"
#include "engine/layout/matching.h"
#include "engine/layout/plane_graph.h"
#include "engine/layout/plane_lines.h"
#include "engine/layout/spokes.h"

namespace spia {

namespace {

constexpr double pi = std::numbers::pi;

/// The direction in which a curve leaves its beginning, taken at once or over a share of its length.
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

CurveUse turned(CurveUse use) { return {use.curve, !use.reversed}; }

/// Radians from a to b, counter-clockwise: 0 to 2 pi.
double turn_to(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
    const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    return angle < 0 ? angle + 2 * pi : angle;
}

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
Face united(const Face& a, const Face& b, int curve)
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

/// Both halves of a curve, at half its length. The second one's number follows the first one's.
int halve(const PlaneGraph& old, int curve, PlaneGraph& graph)
{
    const LayoutCurve& whole = old.curve[size_t(curve)];
    const Eigen::Vector2d middle = points_on(whole, {0.5}).col(0);
    double reached = 0;
    const double half = length(whole) / 2;
    Eigen::Index before = 0; // the last point of the first half
    for (Eigen::Index i = 1; i < whole.plane.cols(); ++i) {
        reached += (whole.plane.col(i) - whole.plane.col(i - 1)).norm();
        if (reached >= half * (1 - 1e-9))
            break;
        before = i;
    }
    Eigen::Index after = before + 1;
    while (after + 1 < whole.plane.cols() && (whole.plane.col(after) - middle).norm() <= 1e-6 * half)
        ++after; // a point of the curve is the middle
    while (before > 0 && (whole.plane.col(before) - middle).norm() <= 1e-6 * half)
        --before;
    const int vertex = int(graph.vertex.size());
    graph.vertex.push_back(middle);
    graph.border.push_back(std::nullopt); // all lines to it are drawn already
    LayoutCurve first{{whole.vertex[0], vertex}, {}, {}}, second{{vertex, whole.vertex[1]}, {}, {}};
    const auto split = [&](const auto& points, const auto& at, auto& one, auto& other) {
        one.resize(points.rows(), before + 2);
        one << points.leftCols(before + 1), at;
        other.resize(points.rows(), points.cols() - after + 1);
        other << at, points.rightCols(points.cols() - after);
    };
    split(whole.plane, middle, first.plane, second.plane);
    if (whole.on_border())
        split(whole.part, Eigen::Vector3d(part_points_on(whole, {0.5}).col(0)), first.part, second.part);
    const int number = int(graph.curve.size());
    graph.curve.push_back(std::move(first));
    graph.curve.push_back(std::move(second));
    return number;
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

/// Whether straight lines from a place to all of these points meet the polygon nowhere else.
bool sees(const Eigen::Vector2d& from, const std::vector<Eigen::Vector2d>& points,
          const std::vector<Eigen::Vector2d>& polygon)
{
    Eigen::Matrix2Xd closed(2, Eigen::Index(polygon.size()));
    for (size_t i = 0; i < polygon.size(); ++i)
        closed.col(Eigen::Index(i)) = polygon[i];
    if (!inside_polygon(closed, from))
        return false;
    for (const Eigen::Vector2d& to : points)
        for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
            if (polygon[i] != to && polygon[j] != to && segments_meet(from, to, polygon[j], polygon[i]))
                return false;
    return true;
}

/// A place from which all middles are seen: the mean of corners and middles, else the best of places around it. Nothing if there is none.
std::optional<Eigen::Vector2d> middle_of(const std::vector<Eigen::Vector2d>& corners,
                                         const std::vector<Eigen::Vector2d>& middles,
                                         const std::vector<Eigen::Vector2d>& polygon)
{
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (size_t k = 0; k < corners.size(); ++k)
        mean += (corners[k] + 2 * middles[k]) / (3. * double(corners.size()));
    if (sees(mean, middles, polygon))
        return mean;
    for (const double share : {0.3, 0.6, 0.85})
        for (const auto* towards : {&middles, &corners})
            for (const Eigen::Vector2d& to : *towards) {
                const Eigen::Vector2d place = mean + share * (to - mean);
                if (sees(place, middles, polygon))
                    return place;
            }
    return std::nullopt;
}

/// From the middles of the sides to one place: straight lines where they can be, else bent around what is in their way.
Spokes divided(const std::vector<Eigen::Vector2d>& corners, const std::vector<Eigen::Vector2d>& middles,
               const std::vector<Eigen::Vector2d>& polygon)
{
    Spokes result;
    if (const auto straight = middle_of(corners, middles, polygon)) {
        result.centre = *straight;
        for (const Eigen::Vector2d& middle : middles)
            result.line.push_back((Eigen::Matrix2Xd(2, 2) << middle, *straight).finished());
        return result;
    }
    Eigen::Matrix2Xd points(2, Eigen::Index(polygon.size()));
    for (size_t i = 0; i < polygon.size(); ++i)
        points.col(Eigen::Index(i)) = polygon[i];
    std::vector<int> start;
    for (const Eigen::Vector2d& middle : middles)
        start.push_back(int(std::find(polygon.begin(), polygon.end(), middle) - polygon.begin()));
    if (auto bent = spokes(points, start))
        return std::move(*bent);
    const Eigen::Vector2d where = points.rowwise().mean();
    throw InputError(fmt::format(
        "the blank cannot be divided into four-sided patches near ({:.6g}, {:.6g}) of its plane: it is too narrow "
        "there beside its arcs; give cuts (--patches FILE)",
        where.x(), where.y()));
}

} // namespace

int start_of(const PlaneGraph& graph, CurveUse use)
{
    return graph.curve[size_t(use.curve)].vertex[use.reversed ? 1 : 0];
}

double corner_angle(const PlaneGraph& graph, const Face& face, size_t k)
{
    constexpr double share = 0.1;
    const CurveUse before = turned(face[(k + face.size() - 1) % face.size()]);
    return turn_to(leaving(graph, face[k], share), leaving(graph, before, share));
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
            throw InputError(
                "a hole of the blank is joined to the rest by no line of the layout; give cuts from it (--patches FILE)");
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
        for (size_t k = 0; k < face.size() && face.size() > 2;) {
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
            if (!graph.curve[size_t(use.curve)].on_border())
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
        const double q = quality(graph, united(faces[size_t(two[0])], faces[size_t(two[1])], curve));
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
            result.push_back(united(faces[size_t(f)], faces[size_t(other)], pair->curve));
        }
    }
    faces = std::move(result);
    keep_used_curves(graph, faces);
    return all;
}

void divide_faces(PlaneGraph& graph, std::vector<Face>& faces)
{
    const PlaneGraph old = std::move(graph);
    graph = {old.vertex, old.border, {}, {}};
    std::vector<int> first_half;
    for (int c = 0; c < int(old.curve.size()); ++c)
        first_half.push_back(halve(old, c, graph));
    std::vector<Face> result;
    for (const Face& face : faces) {
        std::vector<Eigen::Vector2d> corners, middles;
        std::vector<int> spoke;
        Face halves;
        for (const CurveUse use : face) {
            const int half = first_half[size_t(use.curve)];
            halves.push_back({use.reversed ? half + 1 : half, use.reversed});
            halves.push_back({use.reversed ? half : half + 1, use.reversed});
            corners.push_back(graph.vertex[size_t(start_of(old, use))]);
            middles.push_back(graph.vertex[size_t(graph.curve[size_t(half)].vertex[1])]);
        }
        const int centre = int(graph.vertex.size());
        const Spokes from_middle = divided(corners, middles, polygon(graph, halves));
        graph.vertex.push_back(from_middle.centre);
        graph.border.push_back(std::nullopt);
        for (size_t k = 0; k < face.size(); ++k) {
            LayoutCurve line;
            line.vertex = {graph.curve[size_t(first_half[size_t(face[k].curve)])].vertex[1], centre};
            line.plane = from_middle.line[k];
            spoke.push_back(int(graph.curve.size()));
            graph.curve.push_back(std::move(line));
        }
        for (size_t k = 0; k < face.size(); ++k) { // around the corner at the start of side k
            const size_t before = (k + face.size() - 1) % face.size();
            result.push_back({halves[2 * k], {spoke[k], false}, {spoke[before], true}, halves[2 * before + 1]});
        }
    }
    faces = std::move(result);
}

} // namespace spia
