#include "engine/mesh/outline.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/orient2d.h"

namespace spia {
namespace {

struct Edge {
    int a, b;
    double left, right;
};

/// Whether edges a -> v and v -> c, which have the vertex v in common, lie on each other.
bool folded_back(const Eigen::Vector2d& a, const Eigen::Vector2d& v, const Eigen::Vector2d& c)
{
    if (orient2d(a, v, c) != 0)
        return false;
    const int axis = a[0] != v[0] ? 0 : 1;
    return a[axis] != v[axis] && c[axis] != v[axis] && (a[axis] > v[axis]) == (c[axis] > v[axis]);
}

bool meet(const Edge& e, const Edge& f, const Eigen::Matrix2Xd& x)
{
    if ((e.a == f.a && e.b == f.b) || (e.a == f.b && e.b == f.a))
        return false; // a loop of two edges
    if (e.b == f.a || e.a == f.a)
        return folded_back(x.col(e.b == f.a ? e.a : e.b), x.col(f.a), x.col(f.b));
    if (e.a == f.b || e.b == f.b)
        return folded_back(x.col(e.a == f.b ? e.b : e.a), x.col(f.b), x.col(f.a));
    const Eigen::Vector2d a = x.col(e.a), b = x.col(e.b), c = x.col(f.a), d = x.col(f.b);
    if (std::max(c[1], d[1]) < std::min(a[1], b[1]) || std::max(a[1], b[1]) < std::min(c[1], d[1]))
        return false;
    return orient2d(a, b, c) * orient2d(a, b, d) <= 0 && orient2d(c, d, a) * orient2d(c, d, b) <= 0;
}

} // namespace

std::vector<OutlineCrossing> outline_crossings(const std::vector<std::vector<int>>& loops,
                                               const Eigen::Matrix2Xd& position)
{
    std::vector<Edge> edges;
    for (const auto& loop : loops)
        for (size_t i = 0; i < loop.size(); ++i) {
            const int a = loop[i], b = loop[(i + 1) % loop.size()];
            edges.push_back({a, b, std::min(position(0, a), position(0, b)), std::max(position(0, a), position(0, b))});
        }
    // Sweep from left to right: only edges that overlap in x are compared.
    std::stable_sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) { return e.left < f.left; });
    std::vector<const Edge*> open;
    std::vector<OutlineCrossing> found;
    for (const Edge& edge : edges) {
        std::erase_if(open, [&](const Edge* other) { return other->right < edge.left; });
        for (const Edge* other : open)
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
