#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <numbers>
#include <optional>

#include "engine/core/error.h"
#include "engine/layout/plane_graph.h"
#include "engine/layout/plane_lines.h"
#include "engine/layout/spokes.h"
#include "engine/mesh/flat/inside_polygon.h"
#include "engine/options/surface_options.h"

namespace spia {

namespace {

using std::numbers::pi;

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
    LayoutCurve first{{whole.vertex[0], vertex}, {}, {}, whole.kept},
        second{{vertex, whole.vertex[1]}, {}, {}, whole.kept};
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

/// The sine of the worst corner of the faces around a place that is joined to the middles of the
/// sides by straight lines.
double worst_corner(const Eigen::Vector2d& place, const std::vector<Eigen::Vector2d>& middles,
                    const std::vector<Eigen::Vector2d>& ahead, const std::vector<Eigen::Vector2d>& behind)
{
    const auto sine = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return (a.x() * b.y() - a.y() * b.x()) / std::sqrt(a.squaredNorm() * b.squaredNorm());
    };
    double worst = 1;
    for (size_t k = 0; k < middles.size(); ++k) {
        const Eigen::Vector2d spoke = middles[k] - place;
        worst = std::min({worst, sine(spoke, middles[(k + 1) % middles.size()] - place), sine(ahead[k], -spoke),
                          sine(-spoke, behind[k])});
    }
    return worst;
}

/// A place from which all middles are seen, with good corners: the mean of corners and middles,
/// else found step by step from the best of it and places around it. Nothing if there is none.
std::optional<Eigen::Vector2d> middle_of(const std::vector<Eigen::Vector2d>& corners,
                                         const std::vector<Eigen::Vector2d>& middles,
                                         const std::vector<Eigen::Vector2d>& ahead,
                                         const std::vector<Eigen::Vector2d>& behind,
                                         const std::vector<Eigen::Vector2d>& polygon, double good_sine)
{
    constexpr double least_sine = 0.01; // half a degree: below it bent lines are better
    constexpr int most_steps = 40;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (size_t k = 0; k < corners.size(); ++k)
        mean += (corners[k] + 2 * middles[k]) / (3. * double(corners.size()));
    const auto quality = [&](const Eigen::Vector2d& place) {
        const double sine = worst_corner(place, middles, ahead, behind);
        if (!(sine > least_sine) || !sees(place, middles, polygon))
            return 0.;
        double shortest = std::numeric_limits<double>::infinity(), longest = 0;
        for (const Eigen::Vector2d& middle : middles) {
            shortest = std::min(shortest, (middle - place).norm());
            longest = std::max(longest, (middle - place).norm());
        }
        return std::min(sine, 5 * shortest / longest); // patches of 1 to 10 as bad as corners of 30
                                                       // degrees
    };
    Eigen::Vector2d best = mean;
    double best_quality = quality(mean);
    if (best_quality > good_sine || (good_sine == 0 && sees(mean, middles, polygon)))
        return mean;
    const auto take = [&](const Eigen::Vector2d& place) {
        const double here = quality(place);
        if (here <= best_quality)
            return false;
        best = place;
        best_quality = here;
        return true;
    };
    if (best_quality == 0)
        for (const double share : {0.3, 0.6, 0.85})
            for (const auto* towards : {&middles, &corners})
                for (const Eigen::Vector2d& to : *towards)
                    take(mean + share * (to - mean));
    double size = 0;
    for (const Eigen::Vector2d& middle : middles)
        size = std::max(size, (middle - mean).norm());
    double stride = size / 4;
    for (int step = 0; step < most_steps && stride > size / 200; ++step) {
        bool better = false;
        for (int k = 0; k < 8; ++k)
            better = take(best + stride * Eigen::Vector2d(std::cos(k * pi / 4), std::sin(k * pi / 4))) || better;
        if (!better)
            stride /= 2;
    }
    if (best_quality == 0)
        return std::nullopt;
    return best;
}

[[noreturn]] void throw_too_narrow(const Eigen::Matrix2Xd& points)
{
    const Eigen::Vector2d where = points.rowwise().mean();
    throw InputError(fmt::format(
        "the blank cannot be divided into four-sided patches near {:.6g}, {:.6g} mm of its plane: it is too narrow "
        "there beside its arcs; give cuts ({})",
        where.x(), where.y(), mention(option::patches, "FILE")));
}

/// From the middles of the sides to one place: straight lines where they can be, else bent around
/// what is in their way.
Spokes divided(const std::vector<Eigen::Vector2d>& corners, const std::vector<Eigen::Vector2d>& middles,
               const std::vector<Eigen::Vector2d>& ahead, const std::vector<Eigen::Vector2d>& behind,
               const std::vector<Eigen::Vector2d>& polygon, double good_sine)
{
    Spokes result;
    if (const auto straight = middle_of(corners, middles, ahead, behind, polygon, good_sine)) {
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
    throw_too_narrow(points);
}

/// The curves that have to be halved: all sides of faces that have not four, and what is across
/// from a side that is halved.
std::vector<char> halved_curves(const PlaneGraph& graph, const std::vector<Face>& faces, bool all)
{
    std::vector<char> halved(graph.curve.size(), char(all));
    for (const Face& face : faces)
        if (face.size() != 4)
            for (const CurveUse use : face)
                halved[size_t(use.curve)] = 1;
    for (bool more = true; more;) {
        more = false;
        for (const Face& face : faces)
            for (size_t k = 0; k < 4 && face.size() == 4; ++k)
                if (halved[size_t(face[k].curve)] && !halved[size_t(face[(k + 2) % 4].curve)]) {
                    halved[size_t(face[(k + 2) % 4].curve)] = 1;
                    more = true;
                }
    }
    return halved;
}

/// The curves of the graph before as they are in the one after.
class Halves {
public:
    Halves(const PlaneGraph& old, const std::vector<char>& halved, PlaneGraph& graph) : graph_(graph), halved_(halved)
    {
        for (int c = 0; c < int(old.curve.size()); ++c) {
            number_.push_back(int(graph.curve.size()));
            if (halved[size_t(c)])
                halve(old, c, graph);
            else
                graph.curve.push_back(old.curve[size_t(c)]);
        }
    }

    bool halved(CurveUse use) const { return halved_[size_t(use.curve)]; }
    CurveUse whole(CurveUse use) const { return {number_[size_t(use.curve)], use.reversed}; }
    CurveUse first(CurveUse use) const { return {number_[size_t(use.curve)] + int(use.reversed), use.reversed}; }
    CurveUse second(CurveUse use) const { return {number_[size_t(use.curve)] + int(!use.reversed), use.reversed}; }
    int middle(CurveUse use) const { return graph_.curve[size_t(number_[size_t(use.curve)])].vertex[1]; }

private:
    const PlaneGraph& graph_;
    const std::vector<char>& halved_;
    std::vector<int> number_; // of the whole or of its first half
};

int add_line(PlaneGraph& graph, int from, int to, Eigen::Matrix2Xd points)
{
    LayoutCurve line;
    line.vertex = {from, to};
    line.plane = std::move(points);
    graph.curve.push_back(std::move(line));
    return int(graph.curve.size()) - 1;
}

/// From a place within to the middles of all sides.
void divide_from_middle(const PlaneGraph& old, const Face& face, const Halves& halves, double good_sine,
                        PlaneGraph& graph, std::vector<Face>& result)
{
    // these: how the sides leave their middles
    std::vector<Eigen::Vector2d> corners, middles, ahead, behind;
    Face border;
    for (const CurveUse use : face) {
        border.insert(border.end(), {halves.first(use), halves.second(use)});
        corners.push_back(graph.vertex[size_t(start_of(old, use))]);
        middles.push_back(graph.vertex[size_t(halves.middle(use))]);
        ahead.push_back(leaving(graph, halves.second(use), corner_share));
        behind.push_back(leaving(graph, turned(halves.first(use)), corner_share));
    }
    const int centre = int(graph.vertex.size());
    const Spokes from_middle = divided(corners, middles, ahead, behind, polygon(graph, border), good_sine);
    graph.vertex.push_back(from_middle.centre);
    graph.border.push_back(std::nullopt);
    std::vector<int> spoke;
    for (size_t k = 0; k < face.size(); ++k)
        spoke.push_back(add_line(graph, halves.middle(face[k]), centre, from_middle.line[k]));
    for (size_t k = 0; k < face.size(); ++k) { // around the corner at the start of side k
        const size_t before = (k + face.size() - 1) % face.size();
        result.push_back(
            {halves.first(face[k]), {spoke[k], false}, {spoke[before], true}, halves.second(face[before])});
    }
}

/// From the middle of side k of four to the middle of the side across.
void divide_across(const Face& face, size_t k, const Halves& halves, PlaneGraph& graph, std::vector<Face>& result)
{
    const CurveUse low = face[k], right = face[(k + 1) % 4], high = face[(k + 2) % 4], left = face[(k + 3) % 4];
    const int from = halves.middle(low), to = halves.middle(high);
    const Eigen::Vector2d a = graph.vertex[size_t(from)], b = graph.vertex[size_t(to)];
    const auto border = polygon(graph, {halves.first(low), halves.second(low), halves.whole(right), halves.first(high),
                                        halves.second(high), halves.whole(left)});
    Eigen::Matrix2Xd line(2, 2);
    line << a, b;
    const auto sine = [&](CurveUse use, const Eigen::Vector2d& way) {
        const Eigen::Vector2d d = leaving(graph, use, corner_share);
        return (d.x() * way.y() - d.y() * way.x()) / std::sqrt(d.squaredNorm() * way.squaredNorm());
    };
    constexpr double least_sine = 0.2; // flatter ones are better bent
    const bool upright =
        std::min({sine(halves.second(low), b - a), -sine(turned(halves.first(low)), b - a),
                  sine(halves.second(high), a - b), -sine(turned(halves.first(high)), a - b)}) > least_sine;
    if (!upright || !sees((a + b) / 2, {a, b}, border)) {
        Eigen::Matrix2Xd points(2, Eigen::Index(border.size()));
        for (size_t i = 0; i < border.size(); ++i)
            points.col(Eigen::Index(i)) = border[i];
        const auto at = [&](const Eigen::Vector2d& p) {
            return int(std::find(border.begin(), border.end(), p) - border.begin());
        };
        if (const auto bent = spokes(points, {at(a), at(b)})) {
            const Eigen::Index n = bent->line[0].cols(), m = bent->line[1].cols();
            line.resize(2, n + m - 1);
            line << bent->line[0], bent->line[1].leftCols(m - 1).rowwise().reverse();
        } else if (!sees((a + b) / 2, {a, b}, border))
            throw_too_narrow(points);
    }
    const int cut = add_line(graph, from, to, std::move(line));
    result.push_back({{cut, false}, halves.second(high), halves.whole(left), halves.first(low)});
    result.push_back({{cut, true}, halves.second(low), halves.whole(right), halves.first(high)});
}

} // namespace

void divide_faces(PlaneGraph& graph, std::vector<Face>& faces, bool all)
{
    const PlaneGraph old = std::move(graph);
    graph = {old.vertex, old.border, {}, {}};
    const std::vector<char> halved = halved_curves(old, faces, all);
    const Halves halves(old, halved, graph);
    // Where all are divided the mean will do if it sees the middles: patches of even size are worth
    // more there (measured on a bracket with 11 holes, which has no fold so).
    const double good_sine = all ? 0 : 0.3;
    std::vector<Face> result;
    for (const Face& face : faces) {
        const auto cut = [&](size_t k) { return halves.halved(face[k]); };
        if (face.size() != 4 || (cut(0) && cut(1)))
            divide_from_middle(old, face, halves, good_sine, graph, result);
        else if (cut(0) || cut(1))
            divide_across(face, cut(0) ? 0 : 1, halves, graph, result);
        else
            result.push_back(
                {halves.whole(face[0]), halves.whole(face[1]), halves.whole(face[2]), halves.whole(face[3])});
    }
    faces = std::move(result);
}

} // namespace spia
