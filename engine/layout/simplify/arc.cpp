#include "engine/layout/simplify/arc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include "engine/mesh/flat/outline.h"
#include "engine/mesh/topology.h"

namespace spia {

namespace {

size_t piece_at(const std::vector<double>& length, double s)
{
    const auto next = std::upper_bound(length.begin(), length.end(), s) - length.begin();
    return size_t(std::clamp<long>(next, 1, long(length.size()) - 1));
}

double share_of(const std::vector<double>& length, size_t next, double s)
{
    const double piece = length[next] - length[next - 1];
    return piece > 0 ? std::clamp((s - length[next - 1]) / piece, 0.0, 1.0) : 0;
}

/// Curves of a layout, one behind the other; each from its beginning unless it is turned.
struct Chain {
    std::vector<CurveUse> curve;
    bool closed = false;
};

int first_vertex(const Layout& layout, CurveUse use)
{
    return layout.curve[size_t(use.curve)].vertex[use.reversed ? 1 : 0];
}
int last_vertex(const Layout& layout, CurveUse use)
{
    return layout.curve[size_t(use.curve)].vertex[use.reversed ? 0 : 1];
}

/// The curves that begin or end at each vertex, as uses that leave it.
std::vector<std::vector<CurveUse>> leaving_curves(const Layout& layout, bool border)
{
    std::vector<std::vector<CurveUse>> result(size_t(layout.vertex.cols()));
    for (int c = 0; c < int(layout.curve.size()); ++c) {
        const LayoutCurve& curve = layout.curve[size_t(c)];
        if (border ? !curve.on_border() : !curve.kept)
            continue;
        result[size_t(curve.vertex[0])].push_back({c, false});
        if (!border)
            result[size_t(curve.vertex[1])].push_back({c, true});
    }
    return result;
}

/// From one vertex at which the line stops to the next, then closed lines without such a vertex.
std::vector<Chain> chains_of(const Layout& layout, const std::vector<std::vector<CurveUse>>& leaving,
                             const std::vector<char>& stop)
{
    std::vector<Chain> result;
    std::vector<char> used(layout.curve.size(), 0);
    const auto follow = [&](CurveUse use) {
        Chain& chain = result.emplace_back();
        const int start = first_vertex(layout, use);
        for (;;) {
            chain.curve.push_back(use);
            used[size_t(use.curve)] = 1;
            const int v = last_vertex(layout, use);
            chain.closed = v == start && !stop[size_t(v)];
            if (stop[size_t(v)] || chain.closed)
                return;
            for (const CurveUse next : leaving[size_t(v)])
                if (!used[size_t(next.curve)])
                    use = next;
        }
    };
    for (const bool at_stops : {true, false})
        for (size_t v = 0; v < leaving.size(); ++v)
            for (const CurveUse use : leaving[v])
                if (!used[size_t(use.curve)] && (!at_stops || stop[v]))
                    follow(use);
    return result;
}

template <class Points> void append(Points& to, const Points& points)
{
    const Eigen::Index before = to.cols(), skip = before > 0 ? 1 : 0;
    to.conservativeResize(points.rows(), before + points.cols() - skip);
    to.rightCols(points.cols() - skip) = points.rightCols(points.cols() - skip);
}

std::vector<double> lengths_of(const Eigen::Matrix2Xd& points)
{
    std::vector<double> result = {0};
    for (Eigen::Index i = 1; i < points.cols(); ++i)
        result.push_back(result.back() + (points.col(i) - points.col(i - 1)).norm());
    return result;
}

/// Places within an arc at which it turns so much, at once or since the last such place, that a
/// face beside it has to see them.
std::vector<double> kinks_of(const Arc& arc)
{
    constexpr double at_once = 5 * std::numbers::pi / 180; // of a facet; even places see what is finer
    constexpr double in_all = 15 * std::numbers::pi / 180; // so that fillets of many facets are seen
    std::vector<double> result;
    double since = 0;
    const Eigen::Index n = arc.plane.cols() - 1;
    for (Eigen::Index i = arc.closed() ? 0 : 1; i < n; ++i) {
        const Eigen::Vector2d in = arc.plane.col(i) - arc.plane.col(i > 0 ? i - 1 : n - 1),
                              out = arc.plane.col(i + 1) - arc.plane.col(i);
        const double turn = std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)));
        since += turn;
        if (turn > at_once || since > in_all) {
            result.push_back(arc.length[size_t(i)]);
            since = 0;
        }
    }
    return result;
}

/// @param[out] starts  index of the point where each curve of the chain begins
Arc arc_of(const Layout& layout, const Chain& chain, std::vector<Eigen::Index>& starts)
{
    Arc arc;
    for (const CurveUse use : chain.curve) {
        const LayoutCurve& curve = layout.curve[size_t(use.curve)];
        starts.push_back(std::max<Eigen::Index>(0, arc.plane.cols() - 1));
        append<Eigen::Matrix2Xd>(arc.plane, use.reversed ? curve.plane.rowwise().reverse().eval() : curve.plane);
        if (curve.on_border())
            append<Eigen::Matrix3Xd>(arc.part, use.reversed ? curve.part.rowwise().reverse().eval() : curve.part);
    }
    arc.length = lengths_of(arc.plane);
    if (!chain.closed)
        arc.end = {first_vertex(layout, chain.curve.front()), last_vertex(layout, chain.curve.back())};
    return arc;
}

double median(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// mm of border to both sides of a place over which its turn is measured: less than a side of a
/// patch is long, more than the notches of a mesh, and no more than finds corners rounded by the
/// given radius [measured on brackets and panels of solver decks and on drawn CAD parts: smaller
/// ones see corners in the facets of round holes, greater ones miss fillets].
double corner_reach(const Arc& loop, double diagonal, const CornerOptions& options)
{
    constexpr int many = 30; // points; loops of fewer have edges as long as their sides
    double notch = 0;
    if (loop.plane.cols() - 1 > many) {
        std::vector<double> edge;
        for (size_t i = 1; i < loop.length.size(); ++i)
            edge.push_back(loop.length[i] - loop.length[i - 1]);
        notch = 1.2 * median(std::move(edge));
    }
    const double small = std::min({0.012 * loop.whole(), diagonal / 120, options.angle * options.radius});
    return std::min(loop.whole() / 12, std::max(notch, small));
}

/// A place of a loop that is the sharpest of a stretch.
struct Corner {
    double s = 0;    ///< mm along the loop
    double turn = 0; ///< radians, without sign
};

/// Those of stretches that turn by an angle and more, the sharpest first.
std::vector<Corner> corners_of(const Arc& loop, double angle, double reach)
{
    const int n = int(loop.plane.cols()) - 1;
    std::vector<int> index(static_cast<size_t>(n));
    std::iota(index.begin(), index.end(), 0);
    const Outline outline(index, loop.plane);
    std::vector<double> turn(static_cast<size_t>(n));
    for (int i = 0; i < n; ++i)
        turn[size_t(i)] = std::abs(outline.turning(i, reach, reach));
    std::vector<Corner> result;
    for (int i = 0; i < n; ++i) {
        bool sharpest = turn[size_t(i)] >= angle;
        for (int j = 0; j < n && sharpest; ++j)
            if (j != i && loop.distance(loop.length[size_t(i)], loop.length[size_t(j)]) < 1.5 * reach)
                sharpest = turn[size_t(j)] < turn[size_t(i)] || (turn[size_t(j)] == turn[size_t(i)] && j > i);
        if (sharpest)
            result.push_back({loop.length[size_t(i)], turn[size_t(i)]});
    }
    std::stable_sort(result.begin(), result.end(), [](const Corner& a, const Corner& b) { return a.turn > b.turn; });
    constexpr int few_points = 12; // a round hole in a coarse mesh
    constexpr double clear = 75 * std::numbers::pi / 180;
    if (n <= few_points && !result.empty() && result.front().turn < clear)
        return {};
    return result;
}

/// A vertex of the layout on a loop of the border.
struct OnLoop {
    int vertex = -1;
    double s = 0; ///< mm along the loop
};

/// Fixes the vertex at every corner of a loop; where there is none, the nearer one of those before
/// and behind it comes there, unless it is fixed elsewhere.
void fix_corners(const Arc& loop, const CornerOptions& options, double diagonal, std::vector<OnLoop>& row,
                 std::vector<char>& fixed)
{
    const double reach = corner_reach(loop, diagonal, options);
    const size_t n = row.size();
    for (const Corner& place : corners_of(loop, options.angle, reach)) {
        if (std::any_of(row.begin(), row.end(), [&](const OnLoop& own) {
                return fixed[size_t(own.vertex)] && loop.distance(own.s, place.s) < reach;
            }))
            continue;
        size_t after = 0;
        while (after < n && row[after].s < place.s)
            ++after;
        OnLoop *next = &row[after % n], *previous = &row[(after + n - 1) % n];
        if (loop.distance(previous->s, place.s) < loop.distance(next->s, place.s))
            std::swap(next, previous);
        for (OnLoop* own : {next, previous})
            if (!fixed[size_t(own->vertex)]) {
                own->s = place.s;
                fixed[size_t(own->vertex)] = 1;
                break;
            }
        // One that came from behind the seam is the first now, or the last.
        std::stable_sort(row.begin(), row.end(), [](const OnLoop& a, const OnLoop& b) { return a.s < b.s; });
    }
}

/// Radians by which kept curves turn at a vertex where two of them meet.
double turn_at(const Layout& layout, CurveUse a, CurveUse b)
{
    constexpr double share = 0.2; // of a curve, as its direction
    const auto direction = [&](CurveUse use) -> Eigen::Vector2d {
        const LayoutCurve& curve = layout.curve[size_t(use.curve)];
        const Eigen::Matrix2Xd p = points_on(curve, use.reversed ? std::vector{1.0, 1 - share} : std::vector{0, share});
        return p.col(1) - p.col(0);
    };
    const Eigen::Vector2d in = -direction(a), out = direction(b);
    return std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)));
}

/// Marks the vertices at which kept curves end, meet, leave the border or turn.
void fix_ends(const Layout& layout, const std::vector<std::vector<CurveUse>>& kept, double corner,
              const std::vector<std::vector<CurveUse>>& border, std::vector<char>& fixed)
{
    for (size_t v = 0; v < kept.size(); ++v)
        if (kept[v].size() == 1 || kept[v].size() > 2 || (!kept[v].empty() && !border[v].empty()) ||
            (kept[v].size() == 2 && turn_at(layout, kept[v][0], kept[v][1]) >= corner))
            fixed[v] = 1;
}

/// Adds the arcs of kept curves and says which vertices lie within them.
void add_kept(const Layout& layout, const std::vector<Chain>& chains, Arcs& arcs)
{
    for (const Chain& chain : chains) {
        std::vector<Eigen::Index> start;
        Arc arc = arc_of(layout, chain, start);
        for (size_t k = chain.closed ? 0 : 1; k < chain.curve.size(); ++k) {
            OnArcs& own = arcs.vertex[size_t(first_vertex(layout, chain.curve[k]))];
            own.arc = int(arcs.arc.size());
            own.s = arc.length[size_t(start[k])];
        }
        if (arc.closed() || arc.end[0] == arc.end[1])
            arc.line = arcs.lines++;
        arcs.arc.push_back(std::move(arc));
    }
}

/// Adds a loop of the border: whole, or cut at its fixed vertices.
void add_loop(const Arc& loop, const std::vector<OnLoop>& row, Arcs& arcs)
{
    const auto fixed = [&](size_t k) { return arcs.vertex[size_t(row[k % row.size()].vertex)].fixed; };
    size_t first = 0;
    while (first < row.size() && !fixed(first))
        ++first;
    if (first == row.size()) {
        for (const OnLoop& own : row)
            arcs.vertex[size_t(own.vertex)] = {false, int(arcs.arc.size()), own.s, loop.at(own.s)};
        arcs.arc.push_back(loop);
        arcs.arc.back().line = arcs.lines++;
        return;
    }
    for (size_t k = first; k < first + row.size();) {
        const OnLoop& from = row[k % row.size()];
        arcs.vertex[size_t(from.vertex)].position = loop.at(from.s);
        std::vector<OnLoop> within;
        for (++k; !fixed(k); ++k)
            within.push_back(row[k % row.size()]);
        const OnLoop& to = row[k % row.size()];
        Arc arc;
        std::tie(arc.plane, arc.part) = loop.piece(from.s, to.s > from.s ? to.s : to.s + loop.whole());
        arc.length = lengths_of(arc.plane);
        arc.end = {from.vertex, to.vertex};
        arc.line = arcs.lines;
        for (const OnLoop& own : within) {
            const double s = own.s > from.s ? own.s - from.s : own.s + loop.whole() - from.s;
            arcs.vertex[size_t(own.vertex)] = {false, int(arcs.arc.size()), s, arc.at(s)};
        }
        arcs.arc.push_back(std::move(arc));
    }
    ++arcs.lines;
}

/// Of the box around the border, mm.
double border_diagonal(const Layout& layout)
{
    constexpr double inf = std::numeric_limits<double>::infinity();
    Eigen::Vector2d low = Eigen::Vector2d::Constant(inf), high = -low;
    for (const LayoutCurve& curve : layout.curve)
        if (curve.on_border()) {
            low = low.cwiseMin(curve.plane.rowwise().minCoeff());
            high = high.cwiseMax(curve.plane.rowwise().maxCoeff());
        }
    return (high - low).norm();
}

} // namespace

Eigen::Vector2d Arc::at(double s) const
{
    if (closed() && s >= whole())
        s -= whole();
    const size_t next = piece_at(length, s);
    const double share = share_of(length, next, s);
    return (1 - share) * plane.col(Eigen::Index(next) - 1) + share * plane.col(Eigen::Index(next));
}

std::pair<Eigen::Matrix2Xd, Eigen::Matrix3Xd> Arc::piece(double from, double to) const
{
    std::vector<std::pair<Eigen::Index, double>> place; // behind a point, with the share of the way
                                                        // to the next
    const auto add_at = [&](double s) {
        if (closed() && s >= whole())
            s -= whole();
        const size_t next = piece_at(length, s);
        const double share = share_of(length, next, s);
        if (s - length[next - 1] <= same_place * whole())
            place.emplace_back(Eigen::Index(next) - 1, 0);
        else if (length[next] - s <= same_place * whole())
            place.emplace_back(Eigen::Index(next), 0);
        else
            place.emplace_back(Eigen::Index(next) - 1, share);
    };
    add_at(from);
    for (const double around : {0.0, whole()})
        for (size_t i = closed() ? 0 : 1; i + 1 < length.size(); ++i) {
            const double s = length[i] + around;
            if (s > from + same_place * whole() && s < to - same_place * whole() && (around == 0 || closed()))
                place.emplace_back(Eigen::Index(i), 0);
        }
    add_at(to);
    std::pair<Eigen::Matrix2Xd, Eigen::Matrix3Xd> result;
    result.first.resize(2, Eigen::Index(place.size()));
    result.second.resize(3, border() ? Eigen::Index(place.size()) : 0);
    for (size_t k = 0; k < place.size(); ++k) {
        const auto [i, share] = place[k];
        const Eigen::Index j = share > 0 ? i + 1 : i;
        result.first.col(Eigen::Index(k)) =
            share > 0 ? ((1 - share) * plane.col(i) + share * plane.col(j)).eval() : plane.col(i).eval();
        if (border())
            result.second.col(Eigen::Index(k)) =
                share > 0 ? ((1 - share) * part.col(i) + share * part.col(j)).eval() : part.col(i).eval();
    }
    return result;
}

double Arc::distance(double a, double b) const
{
    const double away = std::abs(a - b);
    return end[0] == end[1] ? std::min(away, whole() - away) : away;
}

std::vector<int> border_corners(const TriMesh& part, const Blank& blank, const CornerOptions& options)
{
    std::vector<int> result;
    const auto loops = boundary_loops(part);
    std::vector<int> border;
    for (const auto& loop : loops)
        border.insert(border.end(), loop.begin(), loop.end());
    const Eigen::Matrix2Xd place = blank.position(Eigen::all, border);
    const double diagonal = (place.rowwise().maxCoeff() - place.rowwise().minCoeff()).norm();
    for (const auto& loop : loops) {
        std::vector<int> closed = loop;
        closed.push_back(loop.front());
        Arc arc;
        arc.plane = blank.position(Eigen::all, closed);
        arc.length = lengths_of(arc.plane);
        for (const Corner& found : corners_of(arc, options.angle, corner_reach(arc, diagonal, options)))
            result.push_back(
                loop[size_t(std::find(arc.length.begin(), arc.length.end(), found.s) - arc.length.begin())]);
    }
    return result;
}

Arcs arcs_of(const Layout& layout, const CornerOptions& options)
{
    const auto border = leaving_curves(layout, true), kept = leaving_curves(layout, false);
    const double diagonal = border_diagonal(layout);
    const std::vector<char> none(size_t(layout.vertex.cols()), 0);
    std::vector<char> fixed = none;
    fix_ends(layout, kept, options.angle, border, fixed);
    std::vector<Arc> loops;
    std::vector<std::vector<OnLoop>> rows;
    for (const Chain& chain : chains_of(layout, border, none)) {
        std::vector<Eigen::Index> start;
        loops.push_back(arc_of(layout, chain, start));
        rows.emplace_back();
        for (size_t k = 0; k < start.size(); ++k)
            rows.back().push_back({first_vertex(layout, chain.curve[k]), loops.back().length[size_t(start[k])]});
        fix_corners(loops.back(), options, diagonal, rows.back(), fixed);
    }
    Arcs arcs;
    for (size_t v = 0; v < fixed.size(); ++v)
        arcs.vertex.push_back({bool(fixed[v]), -1, 0, layout.vertex.col(Eigen::Index(v))});
    for (size_t l = 0; l < loops.size(); ++l)
        add_loop(loops[l], rows[l], arcs);
    add_kept(layout, chains_of(layout, kept, fixed), arcs);
    for (Arc& arc : arcs.arc)
        arc.kink = kinks_of(arc);
    return arcs;
}

} // namespace spia
