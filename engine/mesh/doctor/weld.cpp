#include "engine/mesh/doctor/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "engine/mesh/doctor/edge_vertices.h"

namespace spia {
namespace {

using Eigen::Vector3d;

/// same_as for equal coordinates; -0 equals 0.
std::vector<int> join_equal(const std::vector<Vector3d>& position)
{
    std::vector<int> order(position.size());
    std::iota(order.begin(), order.end(), 0);
    const auto before = [&](int a, int b) {
        const Vector3d &p = position[size_t(a)], &q = position[size_t(b)];
        return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
    };
    std::sort(order.begin(), order.end(), [&](int a, int b) { return before(a, b) || (!before(b, a) && a < b); });
    std::vector<int> same_as(position.size());
    for (size_t i = 0; i < order.size(); ++i) {
        const bool joins = i > 0 && position[size_t(order[i])] == position[size_t(order[i - 1])];
        same_as[size_t(order[i])] = joins ? same_as[size_t(order[i - 1])] : order[i];
    }
    return same_as;
}

/// The ends of open edges, in increasing order.
std::vector<int> open_vertices(const PolygonSoup& soup, const std::vector<int>& same_as)
{
    std::vector<int> open;
    for (const auto& edge : open_edges(soup, same_as))
        open.insert(open.end(), edge.begin(), edge.end());
    std::sort(open.begin(), open.end());
    open.erase(std::unique(open.begin(), open.end()), open.end());
    return open;
}

/// A grid of cubes of one tolerance: whatever is closer than that lies in the same cube or one of
/// its 26 neighbours.
class NearGrid {
public:
    explicit NearGrid(double cell) : cell_(cell) {}

    void add(int i, const Vector3d& p)
    {
        constexpr size_t crowded =
            256; // so many places within one tolerance are no gaps; looking at all of them is slow
        auto& places = cubes_[key(cube(p))];
        if (places.size() < crowded)
            places.push_back(i);
    }

    /// Calls visit(i) for what was added and may be near p.
    template <class Visit> void around(const Vector3d& p, const Visit& visit) const
    {
        const auto centre = cube(p);
        for (int64_t i = -1; i <= 1; ++i)
            for (int64_t j = -1; j <= 1; ++j)
                for (int64_t k = -1; k <= 1; ++k)
                    if (const auto found = cubes_.find(key({centre[0] + i, centre[1] + j, centre[2] + k}));
                        found != cubes_.end())
                        for (const int other : found->second)
                            visit(other);
    }

private:
    std::array<int64_t, 3> cube(const Vector3d& p) const
    {
        const auto along = [&](double x) { // where that many do not fit into a number, doubles do
                                           // not tell them apart either
            constexpr double most = 1e18;
            return int64_t(std::clamp(std::floor(x / cell_), -most, most));
        };
        return {along(p.x()), along(p.y()), along(p.z())};
    }
    static uint64_t key(const std::array<int64_t, 3>& c) // cubes that collide only cost a
                                                         // comparison
    {
        return uint64_t(c[0]) * 73856093u ^ uint64_t(c[1]) * 19349663u ^ uint64_t(c[2]) * 83492791u;
    }

    double cell_;
    std::unordered_map<uint64_t, std::vector<int>> cubes_;
};

/// Two open vertices with a gap between them, given by their places in the list of open vertices.
struct Gap {
    double width;
    int a, b; ///< a < b
};

/// Gaps up to the tolerance, the narrowest first.
std::vector<Gap> gaps(const std::vector<Vector3d>& position, const std::vector<int>& open, double tolerance)
{
    constexpr size_t most = 16; // per vertex; its nearest ones are enough to connect what lies at
                                // one place
    NearGrid grid(tolerance);
    std::vector<Gap> result, here;
    for (size_t i = 0; i < open.size(); ++i) {
        const Vector3d& p = position[size_t(open[i])];
        here.clear();
        grid.around(p, [&](int other) {
            const double width = (position[size_t(open[size_t(other)])] - p).norm();
            if (width <= tolerance)
                here.push_back({width, other, int(i)});
        });
        const auto narrower = [](const Gap& g, const Gap& h) {
            return std::tie(g.width, g.a, g.b) < std::tie(h.width, h.a, h.b);
        };
        std::sort(here.begin(), here.end(), narrower);
        result.insert(result.end(), here.begin(), here.begin() + long(std::min(most, here.size())));
        grid.add(int(i), p);
    }
    std::sort(result.begin(), result.end(),
              [](const Gap& g, const Gap& h) { return std::tie(g.width, g.a, g.b) < std::tie(h.width, h.a, h.b); });
    return result;
}

/// Per open vertex the polygons at it, increasing.
std::vector<std::vector<int>> polygons_at(const PolygonSoup& soup, const std::vector<int>& same_as,
                                          const std::vector<int>& open)
{
    std::vector<int> place(size_t(soup.vertices()), -1);
    for (size_t i = 0; i < open.size(); ++i)
        place[size_t(open[i])] = int(i);
    std::vector<std::vector<int>> at(open.size());
    for (int p = 0; p < soup.polygons(); ++p)
        for (const int v : soup.polygon(p))
            if (const int i = place[size_t(same_as[size_t(v)])];
                i >= 0 && (at[size_t(i)].empty() || at[size_t(i)].back() != p))
                at[size_t(i)].push_back(p);
    return at;
}

bool have_common(const std::vector<int>& a, const std::vector<int>& b)
{
    for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end(); *i < *j ? ++i : ++j)
        if (*i == *j)
            return true;
    return false;
}

/// Closes the narrowest gaps first, unless that would bring two corners of one polygon together.
void close_gaps(const PolygonSoup& soup, double tolerance, Weld& result)
{
    const std::vector<int> open = open_vertices(soup, result.same_as);
    auto at = polygons_at(soup, result.same_as, open);
    std::vector<int> group(open.size()); // the first open vertex of the same place
    std::iota(group.begin(), group.end(), 0);
    const auto root = [&](int i) {
        while (group[size_t(i)] != i)
            i = group[size_t(i)] = group[size_t(group[size_t(i)])];
        return i;
    };
    for (const Gap& gap : gaps(soup.position, open, tolerance)) {
        const size_t a = size_t(std::min(root(gap.a), root(gap.b))), b = size_t(std::max(root(gap.a), root(gap.b)));
        if (a == b || have_common(at[a], at[b]))
            continue;
        std::vector<int> both;
        std::merge(at[a].begin(), at[a].end(), at[b].begin(), at[b].end(), std::back_inserter(both));
        at[a] = std::move(both);
        at[b].clear();
        group[b] = int(a);
        ++result.near;
        result.widest = std::max(result.widest, gap.width);
    }
    std::vector<int> moved(size_t(soup.vertices()), -1);
    for (size_t i = 0; i < open.size(); ++i)
        moved[size_t(open[i])] = open[size_t(root(int(i)))];
    for (int& v : result.same_as)
        v = moved[size_t(v)] >= 0 ? moved[size_t(v)] : v;
}

} // namespace

Weld weld(const PolygonSoup& soup, double tolerance)
{
    Weld result;
    result.same_as = join_equal(soup.position);
    for (int v = 0; v < soup.vertices(); ++v)
        result.exact += result.same_as[size_t(v)] != v;
    if (tolerance > 0)
        close_gaps(soup, tolerance, result);
    return result;
}

std::optional<Cracks> find_cracks(const PolygonSoup& soup, const std::vector<int>& same_as)
{
    const auto edges = open_edges(soup, same_as);
    std::vector<int> open;
    std::vector<double> lengths;
    std::unordered_map<int, double> shortest; // of the open edges at a vertex
    for (const auto& edge : edges) {
        const double length = (soup.position[size_t(edge[1])] - soup.position[size_t(edge[0])]).norm();
        lengths.push_back(length);
        for (const int v : edge) {
            const auto [found, is_new] = shortest.try_emplace(v, length);
            found->second = std::min(found->second, length);
            if (is_new)
                open.push_back(v);
        }
    }
    if (open.empty())
        return std::nullopt;
    std::sort(open.begin(), open.end());
    std::nth_element(lengths.begin(), lengths.begin() + long(lengths.size() / 2), lengths.end());
    constexpr double narrow = 0.02; // of an edge: a slit that was cut is wider, digits that were
                                    // cut off are not
    Cracks cracks;
    const double widest = narrow * lengths[lengths.size() / 2];
    if (!(widest > 0)) // most open edges have no length
        return std::nullopt;
    for (const Gap& gap : gaps(soup.position, open, widest)) {
        const int a = open[size_t(gap.a)], b = open[size_t(gap.b)];
        if (gap.width > narrow * std::min(shortest.at(a), shortest.at(b)))
            continue;
        cracks.vertex.push_back(a);
        cracks.vertex.push_back(b);
        cracks.widest = std::max(cracks.widest, gap.width);
    }
    for (const EdgeVertex& v : edge_vertices(soup, same_as, widest)) {
        const auto corners = soup.polygon(v.polygon);
        const Vector3d& from = soup.position[size_t(same_as[size_t(corners[size_t(v.corner)])])];
        const Vector3d& to = soup.position[size_t(same_as[size_t(corners[size_t(v.corner + 1) % corners.size()])])];
        if (v.gap > narrow * std::min(shortest.at(v.vertex), (to - from).norm()))
            continue;
        cracks.vertex.push_back(v.vertex);
        cracks.widest = std::max(cracks.widest, v.gap);
    }
    if (cracks.vertex.empty())
        return std::nullopt;
    std::sort(cracks.vertex.begin(), cracks.vertex.end());
    cracks.vertex.erase(std::unique(cracks.vertex.begin(), cracks.vertex.end()), cracks.vertex.end());
    const double digit = std::pow(10, std::floor(std::log10(std::max(cracks.widest, 1e-300))) - 1);
    cracks.tolerance = std::ceil(cracks.widest / digit * (1 + 1e-9)) * digit;
    const std::vector<int> closed = weld(soup, cracks.tolerance).same_as;
    std::vector<EdgeVertex> taken;
    const PolygonSoup whole = with_corners(soup, closed, edge_vertices(soup, closed, cracks.tolerance), taken);
    if (open_edges(whole, closed).size() + 1 >= edges.size()) // two edges become one
        return std::nullopt;
    return cracks;
}

} // namespace spia
