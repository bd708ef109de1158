#include "engine/mesh/doctor/edge_vertices.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "engine/mesh/box_tree.h"
#include "engine/mesh/doctor/split_polygon.h"
#include "engine/mesh/nearest_share.h"

namespace spia {
namespace {

using SoupEdge = std::array<int, 2>;

SoupEdge edge_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// An open edge as its polygon has it.
struct SoupSide {
    int polygon, corner;
};

int end_of(const PolygonSoup& soup, const std::vector<int>& same_as, const SoupSide& side, int which)
{
    const auto corners = soup.polygon(side.polygon);
    return same_as[size_t(corners[size_t(side.corner + which) % corners.size()])];
}

/// In the order of polygons and corners.
std::vector<SoupSide> open_sides(const PolygonSoup& soup, const std::vector<int>& same_as)
{
    const std::vector<SoupEdge> open = open_edges(soup, same_as);
    std::vector<SoupSide> sides;
    for (int p = 0; p < soup.polygons(); ++p)
        for (int k = 0; k < int(soup.polygon(p).size()); ++k) {
            const SoupSide side{p, k};
            if (std::binary_search(open.begin(), open.end(),
                                   edge_of(end_of(soup, same_as, side, 0), end_of(soup, same_as, side, 1))))
                sides.push_back(side);
        }
    return sides;
}

/// Boxes around edges, as triangles without area.
BoxTree tree_of(const PolygonSoup& soup, const std::vector<int>& same_as, const std::vector<SoupSide>& sides)
{
    TriMesh mesh;
    mesh.position.resize(3, soup.vertices());
    for (int v = 0; v < soup.vertices(); ++v)
        mesh.position.col(v) = soup.position[size_t(v)];
    mesh.triangle.resize(3, Eigen::Index(sides.size()));
    for (size_t s = 0; s < sides.size(); ++s) {
        const int a = end_of(soup, same_as, sides[s], 0), b = end_of(soup, same_as, sides[s], 1);
        mesh.triangle.col(Eigen::Index(s)) << a, b, b;
    }
    return BoxTree(mesh);
}

/// Calls visit(i) with the places in the tree that may be nearer to the point than within(), which
/// may shrink.
template <class Within, class Visit>
void visit_near(const BoxTree& tree, const Eigen::Vector3d& point, const Within& within, const Visit& visit)
{
    std::vector<int> open{0};
    while (!open.empty()) {
        const BoxTree::Node& node = tree.node[size_t(open.back())];
        const int self = open.back();
        open.pop_back();
        if (node.box.squaredExteriorDistance(point) > within() * within())
            continue;
        for (int i = node.first; i < node.first + node.count; ++i)
            visit(i);
        if (node.count == 0) {
            open.push_back(node.second);
            open.push_back(self + 1);
        }
    }
}

bool has_corner(const PolygonSoup& soup, const std::vector<int>& same_as, int polygon, int vertex)
{
    const auto corners = soup.polygon(polygon);
    return std::any_of(corners.begin(), corners.end(), [&](int v) { return same_as[size_t(v)] == vertex; });
}

/// By the edges and along them.
std::map<std::pair<int, int>, std::vector<EdgeVertex>> by_edges(const std::vector<EdgeVertex>& vertices)
{
    std::map<std::pair<int, int>, std::vector<EdgeVertex>> result;
    for (const EdgeVertex& v : vertices)
        result[{v.polygon, v.corner}].push_back(v);
    for (auto& [edge, on] : result)
        std::sort(on.begin(), on.end(), [](const EdgeVertex& v, const EdgeVertex& w) {
            return std::tie(v.along, v.vertex) < std::tie(w.along, w.vertex);
        });
    return result;
}

/// The corners of one polygon with those in its edges.
std::vector<int> corners_with(const PolygonSoup& soup, int polygon,
                              const std::map<std::pair<int, int>, std::vector<EdgeVertex>>& on)
{
    std::vector<int> corners;
    for (int k = 0; k < int(soup.polygon(polygon).size()); ++k) {
        corners.push_back(soup.polygon(polygon)[size_t(k)]);
        if (const auto found = on.find({polygon, k}); found != on.end())
            for (const EdgeVertex& v : found->second)
                corners.push_back(v.vertex);
    }
    return corners;
}

bool can_be_split(const PolygonSoup& soup, const std::vector<int>& corners)
{
    std::vector<Eigen::Vector3d> points;
    points.reserve(corners.size());
    for (const int v : corners)
        points.push_back(soup.position[size_t(v)]);
    return !split_polygon(points).empty();
}

} // namespace

std::vector<std::array<int, 2>> open_edges(const PolygonSoup& soup, const std::vector<int>& same_as)
{
    std::vector<SoupEdge> edges;
    for (int p = 0; p < soup.polygons(); ++p) {
        const auto corners = soup.polygon(p);
        for (size_t k = 0; k < corners.size(); ++k) {
            const int a = same_as[size_t(corners[k])], b = same_as[size_t(corners[(k + 1) % corners.size()])];
            if (a != b)
                edges.push_back(edge_of(a, b));
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<SoupEdge> open;
    for (size_t i = 0; i < edges.size(); ++i)
        if ((i == 0 || edges[i] != edges[i - 1]) && (i + 1 == edges.size() || edges[i] != edges[i + 1]))
            open.push_back(edges[i]);
    return open;
}

std::vector<EdgeVertex> edge_vertices(const PolygonSoup& soup, const std::vector<int>& same_as, double tolerance)
{
    const std::vector<SoupSide> sides = open_sides(soup, same_as);
    std::vector<EdgeVertex> result;
    if (sides.empty())
        return result;
    const BoxTree tree = tree_of(soup, same_as, sides);
    std::vector<int> vertices;
    for (const SoupSide& side : sides)
        for (const int which : {0, 1})
            vertices.push_back(end_of(soup, same_as, side, which));
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const int v : vertices) {
        const Eigen::Vector3d& point = soup.position[size_t(v)];
        std::optional<EdgeVertex> best;
        const auto within = [&] { return best ? best->gap : tolerance; };
        visit_near(tree, point, within, [&](int i) {
            const SoupSide& side = sides[size_t(tree.face[size_t(i)])];
            const Eigen::Vector3d a = tree.triangle[size_t(i)].col(0), along = tree.triangle[size_t(i)].col(1) - a;
            const double t = nearest_share(point, a, along);
            const double gap = (point - a - t * along).norm(), length = along.norm();
            // Places as far away are taken in the order of polygons, whatever the tree's is.
            const auto key = [](double width, int p, int k) { return std::tuple(width, p, k); };
            if (!(gap <= tolerance) || !(t * length > tolerance) || !((1 - t) * length > tolerance) ||
                (best && key(gap, side.polygon, side.corner) > key(best->gap, best->polygon, best->corner)) ||
                has_corner(soup, same_as, side.polygon, v))
                return;
            best = EdgeVertex{v, side.polygon, side.corner, t, gap};
        });
        if (best)
            result.push_back(*best);
    }
    return result;
}

PolygonSoup with_corners(const PolygonSoup& soup, const std::vector<int>& same_as,
                         const std::vector<EdgeVertex>& vertices, std::vector<EdgeVertex>& taken)
{
    auto on = by_edges(vertices);
    for (auto edge = on.begin(); edge != on.end();) { // all edges of one polygon follow each other
        const int polygon = edge->first.first;
        const auto next = on.lower_bound({polygon + 1, 0});
        edge = can_be_split(soup, corners_with(soup, polygon, on)) ? next : on.erase(edge, next);
    }
    std::map<SoupEdge, int> parts; // how many open edges or parts of them lie there
    const auto each_part = [&](const SoupSide& side, const auto& visit) {
        int before = end_of(soup, same_as, side, 0);
        if (const auto found = on.find({side.polygon, side.corner}); found != on.end())
            for (const EdgeVertex& v : found->second) {
                visit(edge_of(before, v.vertex));
                before = v.vertex;
            }
        visit(edge_of(before, end_of(soup, same_as, side, 1)));
    };
    for (const SoupSide& side : open_sides(soup, same_as))
        each_part(side, [&](const SoupEdge& part) { ++parts[part]; });
    std::erase_if(on, [&](const auto& edge) {
        bool meets = false;
        each_part(SoupSide{edge.first.first, edge.first.second},
                  [&](const SoupEdge& part) { meets = meets || parts.at(part) > 1; });
        return !meets;
    });
    taken.clear();
    for (const auto& [edge, list] : on)
        taken.insert(taken.end(), list.begin(), list.end());
    PolygonSoup result;
    result.position = soup.position;
    for (int p = 0; p < soup.polygons(); ++p)
        result.add_polygon(corners_with(soup, p, on));
    return result;
}

} // namespace spia
