#include "engine/mesh/flat/outline.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/mesh/orient2d.h"

namespace spia {
namespace {

struct OutlineEdge {
    int a, b;             ///< vertices
    int place_a, place_b; ///< the first vertices at their places
    int before;           ///< the vertex before a on the loop
    double left, right;
};

/// Per vertex of the loops the first one with the same coordinates.
std::vector<int> places(const std::vector<std::vector<int>>& loops, const Eigen::Matrix2Xd& position)
{
    std::vector<int> vertex, place(size_t(position.cols()), -1);
    for (const auto& loop : loops)
        vertex.insert(vertex.end(), loop.begin(), loop.end());
    const auto key = [&](int v) { return std::tuple(position(0, v), position(1, v), v); };
    std::sort(vertex.begin(), vertex.end(), [&](int v, int w) { return key(v) < key(w); });
    for (size_t i = 0; i < vertex.size(); ++i)
        place[size_t(vertex[i])] =
            i > 0 && position.col(vertex[i]) == position.col(vertex[i - 1]) ? place[size_t(vertex[i - 1])] : vertex[i];
    return place;
}

/// Whether edges a -> v and v -> c, which have the vertex v in common, lie on each other.
bool folded_back(const Eigen::Vector2d& a, const Eigen::Vector2d& v, const Eigen::Vector2d& c)
{
    if (orient2d(a, v, c) != 0)
        return false;
    const int axis = a[0] != v[0] ? 0 : 1;
    return a[axis] != v[axis] && c[axis] != v[axis] && (a[axis] > v[axis]) == (c[axis] > v[axis]);
}

/// A way along an outline through the place v.
struct Passage {
    Eigen::Vector2d from, v, to;

    bool runs_towards(const Eigen::Vector2d& x) const { return folded_back(x, v, from) || folded_back(x, v, to); }
    /// Whether the direction to x lies to the left of it.
    bool has_left(const Eigen::Vector2d& x) const
    {
        const int turn = orient2d(v, to, from);
        if (turn > 0)
            return orient2d(v, to, x) > 0 && orient2d(v, x, from) > 0;
        if (turn < 0)
            return !(orient2d(v, from, x) >= 0 && orient2d(v, x, to) >= 0);
        return orient2d(v, to, x) > 0;
    }
    /// Whether another way through v changes from one side of this one to the other. Where they
    /// share a direction their edges lie on each other, which is looked at there.
    bool crossed_by(const Passage& other) const
    {
        return !runs_towards(other.from) && !runs_towards(other.to) && has_left(other.from) != has_left(other.to);
    }
};

/// Whether edges cross, or lie on each other with the sheet on the same side.
bool meet(const OutlineEdge& e, const OutlineEdge& f, const Eigen::Matrix2Xd& x)
{
    if (e.place_a == f.place_b && e.place_b == f.place_a)
        return false; // the lips of a slit, a loop of two edges
    if (e.place_a == f.place_a && e.place_b == f.place_b)
        return true;
    const Eigen::Vector2d a = x.col(e.a), b = x.col(e.b), c = x.col(f.a), d = x.col(f.b);
    if (e.place_b == f.place_a || e.place_a == f.place_a) {
        // One of the two stands for the place: the ways through it are compared there.
        if (folded_back(e.place_b == f.place_a ? a : b, c, d))
            return true;
        const bool both_begin = e.place_a == f.place_a;
        return both_begin && e.a != f.a && Passage{x.col(e.before), a, b}.crossed_by({x.col(f.before), c, d});
    }
    if (e.place_a == f.place_b || e.place_b == f.place_b)
        return folded_back(e.place_a == f.place_b ? b : a, d, c);
    if (std::max(c[1], d[1]) < std::min(a[1], b[1]) || std::max(a[1], b[1]) < std::min(c[1], d[1]))
        return false;
    const int ec = orient2d(a, b, c), ed = orient2d(a, b, d), fa = orient2d(c, d, a), fb = orient2d(c, d, b);
    if (ec * ed > 0 || fa * fb > 0)
        return false;
    if (ec != 0 && ed != 0 && fa != 0 && fb != 0)
        return true;
    // A vertex on the other edge: the way through it crosses, or only touches. Seen from the edge
    // that begins there.
    const auto crossed_at = [&](const OutlineEdge& through, const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
        const int comes = orient2d(p, q, x.col(through.before)), goes = orient2d(p, q, x.col(through.b));
        return comes * goes < 0 || comes == 0 || goes == 0;
    };
    if (ec == 0 && ed == 0)
        return true; // on one line
    if (ec == 0)
        return crossed_at(f, a, b);
    if (fa == 0)
        return crossed_at(e, c, d);
    return false; // one ends on the other: the next edge begins there
}

} // namespace

std::vector<OutlineCrossing> outline_crossings(const std::vector<std::vector<int>>& loops,
                                               const Eigen::Matrix2Xd& position)
{
    const std::vector<int> place = places(loops, position);
    std::vector<OutlineEdge> edges;
    for (const auto& loop : loops) {
        const size_t n = loop.size();
        for (size_t i = 0; i < n; ++i) {
            const int a = loop[i], b = loop[(i + 1) % n];
            edges.push_back({a, b, place[size_t(a)], place[size_t(b)], loop[(i + n - 1) % n],
                             std::min(position(0, a), position(0, b)), std::max(position(0, a), position(0, b))});
        }
    }
    // Sweep from left to right: only edges that overlap in x are compared.
    std::stable_sort(edges.begin(), edges.end(),
                     [](const OutlineEdge& e, const OutlineEdge& f) { return e.left < f.left; });
    std::vector<const OutlineEdge*> open;
    std::vector<OutlineCrossing> found;
    for (const OutlineEdge& edge : edges) {
        std::erase_if(open, [&](const OutlineEdge* other) { return other->right < edge.left; });
        for (const OutlineEdge* other : open)
            if (meet(edge, *other, position))
                found.push_back({{other->a, other->b}, {edge.a, edge.b}});
        open.push_back(&edge);
    }
    return found;
}

int crossings(const std::vector<std::vector<int>>& loops, const Eigen::Matrix2Xd& position)
{
    return int(outline_crossings(loops, position).size());
}

double length(const std::vector<int>& loop, const Eigen::Matrix2Xd& position)
{
    double sum = 0;
    for (size_t i = 0; i < loop.size(); ++i)
        sum += (position.col(loop[(i + 1) % loop.size()]) - position.col(loop[i])).norm();
    return sum;
}

Outline::Outline(const std::vector<int>& loop, const Eigen::Matrix2Xd& position)
{
    start_.push_back(0);
    for (size_t i = 0; i < loop.size(); ++i) {
        point_.push_back(position.col(loop[i]));
        start_.push_back(start_.back() + (position.col(loop[(i + 1) % loop.size()]) - position.col(loop[i])).norm());
    }
}

double Outline::turning(int i, double before, double after) const
{
    const Eigen::Vector2d here = point_[size_t(i)];
    const Eigen::Vector2d in = here - at(length_at(i) - before), out = at(length_at(i) + after) - here;
    return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
}

Eigen::Vector2d Outline::at(double length) const
{
    length -= perimeter() * std::floor(length / perimeter());
    const auto next = std::upper_bound(start_.begin() + 1, start_.end() - 1, length);
    const size_t i = size_t(next - start_.begin()) - 1;
    const double edge = start_[i + 1] - start_[i];
    const double t = edge > 0 ? std::clamp((length - start_[i]) / edge, 0.0, 1.0) : 0;
    return (1 - t) * point_[i] + t * point_[(i + 1) % point_.size()];
}

} // namespace spia
