#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/layout/plane_graph.h"
#include "engine/layout/plane_lines.h"
#include "engine/mesh/flat/inside_polygon.h"
#include "engine/mesh/vectors.h"

namespace spia {

namespace {

using Point = Eigen::Vector2d;

using std::numbers::pi;
constexpr double bulge = 0.02;                   ///< over its chord: an arc that is so far from
                                                 ///< straight gets a layer
constexpr double most_arc_turn = 100 * pi / 180; ///< of an arc
constexpr double sharp = 40 * pi / 180;          ///< a place at which an arc is divided first
constexpr double share_of_gap = 0.35;            ///< of the way to the border across: leaves room for
                                                 ///< the layer over there
constexpr double share_of_arc = 0.8;             ///< of the length of the arcs beside it: deepest
constexpr double least_clearance = 0.3;          ///< of the layer's depth, left between the arc and
                                                 ///< the layer's inner line
constexpr double least_beside = 0.6;             ///< of the depth: distance of the inner line from
                                                 ///< all of the border
constexpr double least_corner = 25 * pi / 180;   ///< of a layer's patches, and its complement
constexpr double thinner = 0.7;
constexpr int most_rounds = 200;
constexpr double longest_arc = 4; ///< over its distance from the rest of the border
constexpr double least_piece =
    1. / 40; ///< of the blank's size, of cuts and edges: they may run as close to others as they
             ///< like

/// How far a ray goes until it meets a segment, over the length of `way`; infinite if it does not.
double reach_of(const Point& from, const Point& way, const Point& a, const Point& b)
{
    const double across = cross(way, b - a);
    if (across == 0)
        return std::numeric_limits<double>::infinity();
    const double t = cross(a - from, b - a) / across, s = cross(a - from, way) / across;
    return t > 0 && s >= 0 && s <= 1 ? t : std::numeric_limits<double>::infinity();
}

struct Segment {
    Point a, b;
};

class Layers {
public:
    Layers(PlaneGraph& graph, const Progress& progress) : graph_(graph), progress_(progress) {}

    void add()
    {
        for (const LayoutCurve& curve : graph_.curve)
            for (Eigen::Index i = 0; i + 1 < curve.plane.cols(); ++i)
                border_.push_back({curve.plane.col(i), curve.plane.col(i + 1)});
        std::vector<char> on_edge(graph_.vertex.size(), 0); // of the part: patches end there, and
                                                            // so do layers
        for (const LayoutCurve& curve : graph_.curve)
            if (!curve.on_border())
                on_edge[size_t(curve.vertex[0])] = on_edge[size_t(curve.vertex[1])] = 1;
        for (const LayoutCurve& curve : graph_.curve) // as a whole: straight pieces of a bent arc
                                                      // meet at flat corners
            layered_.push_back(curve.on_border() && !on_edge[size_t(curve.vertex[0])] &&
                               !on_edge[size_t(curve.vertex[1])] && is_bent(curve));
        divide_arcs();
        look_around();
        for (int round = 0; round < most_rounds && adjust(); ++round)
            progress_.checkpoint(double(round) / most_rounds, "laying patches along the border");
        draw();
    }

private:
    static bool is_bent(const LayoutCurve& curve)
    {
        const Point from = curve.plane.col(0), chord = curve.plane.col(curve.plane.cols() - 1) - from;
        double off = 0;
        for (Eigen::Index i = 1; i + 1 < curve.plane.cols(); ++i)
            off = std::max(off, std::abs(cross(chord, curve.plane.col(i) - from)));
        return off > bulge * chord.squaredNorm();
    }

    /// Which arcs meet in each vertex; where a layer has its vertices.
    void look_around()
    {
        const size_t n = graph_.vertex.size();
        in_.assign(n, -1);
        out_.assign(n, -1);
        for (int c = 0; c < int(graph_.curve.size()); ++c) {
            if (!graph_.curve[size_t(c)].on_border())
                continue;
            out_[size_t(graph_.curve[size_t(c)].vertex[0])] = c;
            in_[size_t(graph_.curve[size_t(c)].vertex[1])] = c;
        }
        way_.resize(n, Point::Zero());
        depth_.resize(n, 0);
        for (int v = 0; v < int(n); ++v)
            if (has_layer(v) && depth_[size_t(v)] == 0)
                look_inwards(v);
    }

    bool has_layer(int v) const
    {
        return in_[size_t(v)] >= 0 && (layered_[size_t(in_[size_t(v)])] || layered_[size_t(out_[size_t(v)])]);
    }

    Point leaving(int v, bool forwards) const
    {
        constexpr double share = 0.1;
        const int c = forwards ? out_[size_t(v)] : in_[size_t(v)];
        const Eigen::Matrix2Xd p = points_on(graph_.curve[size_t(c)], {forwards ? share : 1 - share});
        return p.col(0) - graph_.vertex[size_t(v)];
    }

    /// The direction into the sheet, and how deep the layer may be there.
    void look_inwards(int v)
    {
        const Point ahead = leaving(v, true), at = graph_.vertex[size_t(v)];
        const double inner = turn_to(ahead, leaving(v, false)), upright = std::min(pi / 2, inner - pi / 3);
        double angle = inner / 2; // from the arc ahead
        if (inner > 5 * pi / 6 && !layered_[size_t(in_[size_t(v)])])
            angle = upright;
        if (inner > 5 * pi / 6 && !layered_[size_t(out_[size_t(v)])])
            angle = inner - upright;
        way_[size_t(v)] = Eigen::Rotation2Dd(angle) * ahead.normalized();
        double gap = std::numeric_limits<double>::infinity();
        for (const Segment& s : border_)
            if (s.a != at && s.b != at)
                gap = std::min(gap, reach_of(at, way_[size_t(v)], s.a, s.b));
        double arcs = std::numeric_limits<double>::infinity();
        for (const int c : {in_[size_t(v)], out_[size_t(v)]})
            if (layered_[size_t(c)])
                arcs = std::min(arcs, length(graph_.curve[size_t(c)]));
        depth_[size_t(v)] = std::min(share_of_gap * gap, share_of_arc * arcs);
    }

    Point inner(int v) const { return graph_.vertex[size_t(v)] + depth_[size_t(v)] * way_[size_t(v)]; }

    double clearance(int v) const
    {
        double least = std::numeric_limits<double>::infinity();
        for (const Segment& s : border_)
            least = std::min(least, distance_to_segment(inner(v), s.a, s.b));
        return least;
    }

    /// One round towards layers that cross nothing and have room for cells. @returns false if there
    /// was nothing to do
    bool adjust()
    {
        std::vector<char> too_deep(graph_.vertex.size(), 0);
        std::vector<int> too_bent;
        for (int v = 0; v < int(graph_.vertex.size()); ++v)
            if (has_layer(v) && clearance(v) < least_beside * depth_[size_t(v)] * std::sin(corner_of(v)))
                too_deep[size_t(v)] = 1;
        for (int c = 0; c < int(graph_.curve.size()); ++c)
            if (layered_[size_t(c)])
                look_at(c, too_deep, too_bent);
        look_for_crossings(too_deep);
        bool changed = !too_bent.empty();
        for (size_t v = 0; v < too_deep.size(); ++v)
            if (too_deep[v]) {
                depth_[v] *= thinner;
                changed = true;
            }
        for (const int c : too_bent)
            split(c);
        if (!too_bent.empty())
            look_around();
        return changed;
    }

    /// The smaller angle between the way inwards and the border.
    double corner_of(int v) const
    {
        const Point& way = way_[size_t(v)];
        const auto angle = [&](const Point& d) { return std::abs(std::atan2(cross(d, way), d.dot(way))); };
        return std::min({angle(leaving(v, true)), angle(leaving(v, false)), pi / 2});
    }

    void look_at(int c, std::vector<char>& too_deep, std::vector<int>& too_bent) const
    {
        const LayoutCurve& arc = graph_.curve[size_t(c)];
        const int v = arc.vertex[0], w = arc.vertex[1];
        const Point p = inner(v), q = inner(w), along = (q - p).normalized();
        const double room = least_clearance * std::min(depth_[size_t(v)], depth_[size_t(w)]);
        for (Eigen::Index i = 1; i + 1 < arc.plane.cols(); ++i)
            if (cross(arc.plane.col(i) - p, along) < room) {
                too_bent.push_back(c);
                return;
            }
        if (holds_border(arc, p, q)) {
            too_deep[size_t(v)] = too_deep[size_t(w)] = 1;
            return;
        }
        const double at_v = turn_to(graph_.vertex[size_t(v)] - p, q - p),
                     at_w = turn_to(p - q, graph_.vertex[size_t(w)] - q);
        const auto flat = [](double angle) { return angle < least_corner || angle > pi - least_corner; };
        if (flat(at_v) || flat(at_w)) // the deeper end comes back
            too_deep[size_t(depth_[size_t(v)] > depth_[size_t(w)] ? v : w)] = 1;
    }

    /// Whether some of the border lies between an arc and the layer's inner line.
    bool holds_border(const LayoutCurve& arc, const Point& p, const Point& q) const
    {
        Eigen::Matrix2Xd polygon(2, arc.plane.cols() + 2);
        polygon << arc.plane, q, p;
        const Point low = polygon.rowwise().minCoeff(), high = polygon.rowwise().maxCoeff();
        return std::any_of(border_.begin(), border_.end(), [&](const Segment& s) {
            return (s.a.array() >= low.array()).all() && (s.a.array() <= high.array()).all() &&
                   (arc.plane.colwise() - s.a).colwise().squaredNorm().minCoeff() > 0 && inside_polygon(polygon, s.a);
        });
    }

    void look_for_crossings(std::vector<char>& too_deep) const
    {
        struct Line {
            Point a, b;
            int v, w; ///< whose depths it hangs on
        };
        std::vector<Line> lines;
        for (int v = 0; v < int(graph_.vertex.size()); ++v)
            if (has_layer(v))
                lines.push_back({graph_.vertex[size_t(v)], inner(v), v, v});
        for (size_t c = 0; c < graph_.curve.size(); ++c)
            if (layered_[c]) {
                const auto [v, w] = graph_.curve[c].vertex;
                lines.push_back({inner(v), inner(w), v, w});
            }
        const auto mark = [&](const Line& line) { too_deep[size_t(line.v)] = too_deep[size_t(line.w)] = 1; };
        for (size_t i = 0; i < lines.size(); ++i) {
            const Line& line = lines[i];
            for (const Segment& s : border_)
                if (s.a != line.a && s.b != line.a && segments_meet(line.a, line.b, s.a, s.b)) {
                    mark(line);
                    break;
                }
            for (size_t j = 0; j < i; ++j) {
                const Line& other = lines[j];
                const bool joined = line.a == other.a || line.a == other.b || line.b == other.a || line.b == other.b;
                if (!joined && segments_meet(line.a, line.b, other.a, other.b)) {
                    mark(line);
                    mark(other);
                }
            }
        }
    }

    /// Radians, with sign, that an arc turns at an inner point.
    static double turn_at(const LayoutCurve& arc, Eigen::Index i)
    {
        const Point in = arc.plane.col(i) - arc.plane.col(i - 1), out = arc.plane.col(i + 1) - arc.plane.col(i);
        return std::atan2(cross(in, out), in.dot(out));
    }

    /// Between the farthest directions that an arc takes.
    static double range_of_turns(const LayoutCurve& arc)
    {
        double turn = 0, least = 0, most = 0;
        for (Eigen::Index i = 1; i + 1 < arc.plane.cols(); ++i) {
            turn += turn_at(arc, i);
            least = std::min(least, turn);
            most = std::max(most, turn);
        }
        return most - least;
    }

    /// Where an arc becomes two: at its sharpest point, or at the one next to the middle of its
    /// length if none is sharp.
    static Eigen::Index place_to_split(const LayoutCurve& arc)
    {
        Eigen::Index sharpest = 1;
        for (Eigen::Index i = 2; i + 1 < arc.plane.cols(); ++i)
            if (std::abs(turn_at(arc, i)) > std::abs(turn_at(arc, sharpest)))
                sharpest = i;
        return std::abs(turn_at(arc, sharpest)) > sharp ? sharpest : next_to_middle(arc);
    }

    void split(int c)
    {
        LayoutCurve& curve = graph_.curve[size_t(c)];
        if (curve.plane.cols() == 2) { // a cut
            const Point middle = points_on(curve, {0.5}).col(0);
            curve.plane = (Eigen::Matrix2Xd(2, 3) << curve.plane.col(0), middle, curve.plane.col(1)).finished();
        }
        split_curve(graph_, c, place_to_split(curve));
        layered_.push_back(layered_[size_t(c)]);
    }

    /// Divides arcs that wind, and those that are long beside their distance from the rest of the
    /// border, so that patches grow step by step; cuts and edges likewise.
    void divide_arcs()
    {
        double low = border_[0].a.sum(), high = low; // the blank's size, roughly
        for (const Segment& s : border_) {
            low = std::min(low, s.a.sum());
            high = std::max(high, s.a.sum());
        }
        for (int c = 0; c < int(graph_.curve.size()); ++c) {
            progress_.checkpoint(0, "dividing the border");
            while ((graph_.curve[size_t(c)].kept || graph_.curve[size_t(c)].plane.cols() > 2) &&
                   (range_of_turns(graph_.curve[size_t(c)]) > most_arc_turn ||
                    length(graph_.curve[size_t(c)]) >
                        std::max(longest_arc * distance_to_rest(c),
                                 graph_.curve[size_t(c)].kept ? least_piece * (high - low) : 0)))
                split(c);
        }
    }

    /// From an arc to the border but for itself and the arcs beside it.
    double distance_to_rest(int c) const
    {
        const LayoutCurve& arc = graph_.curve[size_t(c)];
        double least = std::numeric_limits<double>::infinity();
        for (const LayoutCurve& other : graph_.curve) {
            if (other.vertex[0] == arc.vertex[0] || other.vertex[0] == arc.vertex[1] ||
                other.vertex[1] == arc.vertex[0] || other.vertex[1] == arc.vertex[1])
                continue;
            for (Eigen::Index i = 0; i < arc.plane.cols(); ++i)
                for (Eigen::Index k = 0; k + 1 < other.plane.cols(); ++k)
                    least = std::min(least,
                                     distance_to_segment(arc.plane.col(i), other.plane.col(k), other.plane.col(k + 1)));
            // it may be long between its points
            for (Eigen::Index i = 0; arc.kept && i + 1 < arc.plane.cols(); ++i)
                for (Eigen::Index k = 0; k < other.plane.cols(); ++k)
                    least = std::min(least,
                                     distance_to_segment(other.plane.col(k), arc.plane.col(i), arc.plane.col(i + 1)));
        }
        return least;
    }

    void draw()
    {
        const int n = int(graph_.vertex.size());
        const std::vector<LayoutCurve> arcs = graph_.curve;
        std::vector<int> number(size_t(n), -1); // of the inner vertex
        graph_.closed.assign(size_t(n), 0);
        for (int v = 0; v < n; ++v)
            if (has_layer(v)) {
                number[size_t(v)] = int(graph_.vertex.size());
                graph_.vertex.push_back(inner(v));
                graph_.border.push_back(std::nullopt);
                graph_.closed.push_back(0);
                line(v, number[size_t(v)]);
            }
        for (int v = 0; v < n; ++v) {
            if (number[size_t(v)] < 0)
                continue;
            const int in = in_[size_t(v)], out = out_[size_t(v)], own = number[size_t(v)];
            BorderTurn turn{graph_.vertex[size_t(v)],
                            graph_.vertex[size_t(v)]}; // at an end the border of the rest comes
                                                       // down to v
            if (layered_[size_t(in)])
                turn.before = graph_.vertex[size_t(number[size_t(arcs[size_t(in)].vertex[0])])];
            else
                graph_.border[size_t(v)]->after = graph_.vertex[size_t(own)];
            if (layered_[size_t(out)])
                turn.after = graph_.vertex[size_t(number[size_t(arcs[size_t(out)].vertex[1])])];
            else
                graph_.border[size_t(v)]->before = graph_.vertex[size_t(own)];
            graph_.border[size_t(own)] = turn;
            graph_.closed[size_t(v)] = layered_[size_t(in)] && layered_[size_t(out)];
        }
        for (size_t c = 0; c < arcs.size(); ++c)
            if (layered_[c])
                line(number[size_t(arcs[c].vertex[0])], number[size_t(arcs[c].vertex[1])]);
    }

    void line(int a, int b)
    {
        LayoutCurve curve;
        curve.vertex = {a, b};
        curve.plane.resize(2, 2);
        curve.plane << graph_.vertex[size_t(a)], graph_.vertex[size_t(b)];
        graph_.curve.push_back(std::move(curve));
    }

    PlaneGraph& graph_;
    const Progress& progress_;
    std::vector<Segment> border_;
    std::vector<char> layered_; // per curve
    std::vector<int> in_, out_; // per vertex: the arcs of the border that end and begin there
    std::vector<Point> way_;    // per vertex: into the sheet, of unit length
    std::vector<double> depth_; // per vertex, mm
};

} // namespace

void add_layers(PlaneGraph& graph, const Progress& progress) { Layers(graph, progress).add(); }

} // namespace spia
