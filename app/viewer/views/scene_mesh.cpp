#include "app/viewer/views/scene_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <tuple>

#include "engine/core/parallel.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

using Edges = Eigen::Matrix<uint32_t, 2, Eigen::Dynamic>;

/// One side of one face, sorted into the bucket of its smaller vertex. Corner 3 f + k is where side
/// k of face f starts.
struct Side {
    int high, corner;
};

/// Sides of all faces by edge: those of vertex v, ordered by their other vertex, start at first[v].
struct Sides {
    std::vector<int> first;
    std::vector<Side> side;
};

int start(const TriMesh& mesh, int corner) { return mesh.triangle(corner % 3, corner / 3); }
int next(int corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

/// Buckets instead of one sort of all sides: a million triangles shall not make anybody wait.
Sides sides_of(const TriMesh& mesh)
{
    Sides result;
    result.first.assign(size_t(mesh.vertices()) + 1, 0);
    const int corners = 3 * mesh.triangles();
    const auto low = [&](int corner) { return std::min(start(mesh, corner), start(mesh, next(corner))); };
    for (int c = 0; c < corners; ++c)
        ++result.first[size_t(low(c)) + 1];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    result.side.resize(size_t(corners));
    std::vector<int> end = result.first;
    for (int c = 0; c < corners; ++c)
        result.side[size_t(end[size_t(low(c))]++)] = {std::max(start(mesh, c), start(mesh, next(c))), c};
    parallel_for(mesh.vertices(), [&](int v) {
        std::sort(result.side.begin() + result.first[size_t(v)], result.side.begin() + result.first[size_t(v) + 1],
                  [](const Side& a, const Side& b) { return std::tie(a.high, a.corner) < std::tie(b.high, b.corner); });
    });
    return result;
}

/// Calls visit(low vertex, sides of the edge) for each edge.
template <class Visit> void for_each_edge(const Sides& sides, const Visit& visit)
{
    for (size_t v = 0; v + 1 < sides.first.size(); ++v)
        for (int begin = sides.first[v], end = begin; begin < sides.first[v + 1]; begin = end) {
            while (end < sides.first[v + 1] && sides.side[size_t(end)].high == sides.side[size_t(begin)].high)
                ++end;
            visit(int(v), std::span(sides.side).subspan(size_t(begin), size_t(end - begin)));
        }
}

Edges as_matrix(const std::vector<std::array<uint32_t, 2>>& edges)
{
    Edges result(2, Eigen::Index(edges.size()));
    for (size_t i = 0; i < edges.size(); ++i)
        result.col(Eigen::Index(i)) << edges[i][0], edges[i][1];
    return result;
}

/// Things that belong together, by number; the smallest of them is their root.
class Groups {
public:
    explicit Groups(int count) : parent_(size_t(count)) { std::iota(parent_.begin(), parent_.end(), 0); }
    int root(int i)
    {
        while (parent_[size_t(i)] != i)
            i = parent_[size_t(i)] = parent_[size_t(parent_[size_t(i)])];
        return i;
    }
    void join(int a, int b)
    {
        a = root(a), b = root(b);
        parent_[size_t(std::max(a, b))] = std::min(a, b);
    }

private:
    std::vector<int> parent_;
};

/// Boundary edges, and sharp ones in connected rows that are long enough to mean something.
Edges features(const TriMesh& mesh, const std::vector<std::array<uint32_t, 2>>& boundary,
               const std::vector<std::array<uint32_t, 2>>& sharp)
{
    Groups rows(mesh.vertices());
    for (const auto& [a, b] : sharp)
        rows.join(int(a), int(b));
    std::vector<double> length(size_t(mesh.vertices()), 0);
    for (const auto& [a, b] : sharp)
        length[size_t(rows.root(int(a)))] += (mesh.position.col(a) - mesh.position.col(b)).norm();
    const double least = shortest_feature * bounding_diagonal(mesh);
    std::vector<std::array<uint32_t, 2>> result = boundary;
    std::copy_if(sharp.begin(), sharp.end(), std::back_inserter(result),
                 [&](const auto& edge) { return length[size_t(rows.root(int(edge[0])))] >= least; });
    return as_matrix(result);
}

Eigen::Vector3d middle_of(const Eigen::Matrix3Xd& position)
{
    if (position.cols() == 0)
        return Eigen::Vector3d::Zero();
    return (position.rowwise().minCoeff() + position.rowwise().maxCoeff()) / 2;
}

} // namespace

SceneMesh scene_mesh(const TriMesh& mesh)
{
    const Eigen::Matrix3Xd area = area_vectors(mesh);
    const Sides sides = sides_of(mesh);
    Groups smooth(3 * mesh.triangles());
    std::vector<std::array<uint32_t, 2>> edge, boundary, sharp;
    for_each_edge(sides, [&](int low, std::span<const Side> uses) {
        const std::array<uint32_t, 2> ends = {uint32_t(low), uint32_t(uses[0].high)};
        edge.push_back(ends);
        const auto is_smooth = [&] {
            if (uses.size() != 2)
                return false;
            const Eigen::Vector3d a = area.col(uses[0].corner / 3), b = area.col(uses[1].corner / 3);
            return std::atan2(a.cross(b).norm(), a.dot(b)) <= sharp_angle;
        };
        if (!is_smooth()) {
            (uses.size() == 1 ? boundary : sharp).push_back(ends);
            return;
        }
        // The corners of the two faces at each end of the edge; one face may run along it the other
        // way.
        int a = uses[0].corner, b = next(a), c = uses[1].corner, d = next(c);
        if (start(mesh, a) != start(mesh, c))
            std::swap(c, d);
        smooth.join(a, c);
        smooth.join(b, d);
    });

    SceneMesh result;
    result.origin = middle_of(mesh.position);
    result.edge = as_matrix(edge);
    result.feature = features(mesh, boundary, sharp);

    // The first smooth side of a vertex keeps its number; each other one gets a new vertex.
    std::vector<int> number(size_t(3) * size_t(mesh.triangles()), -1);
    std::vector<char> taken(size_t(mesh.vertices()), 0);
    result.triangle.resize(3, mesh.triangles());
    for (int c = 0; c < 3 * mesh.triangles(); ++c) {
        const int root = smooth.root(c), v = start(mesh, c);
        int& vertex = number[size_t(root)];
        if (vertex < 0 && !taken[size_t(v)]) {
            taken[size_t(v)] = 1;
            vertex = v;
        } else if (vertex < 0) {
            vertex = mesh.vertices() + int(result.repeated.size());
            result.repeated.push_back(uint32_t(v));
        }
        result.triangle(c % 3, c / 3) = uint32_t(vertex);
    }

    const Eigen::Index vertices = mesh.vertices() + Eigen::Index(result.repeated.size());
    result.position.resize(3, vertices);
    result.position.leftCols(mesh.vertices()) = (mesh.position.colwise() - result.origin).cast<float>();
    for (size_t i = 0; i < result.repeated.size(); ++i)
        result.position.col(mesh.vertices() + Eigen::Index(i)) = result.position.col(result.repeated[i]);
    Eigen::Matrix3Xd normal = Eigen::Matrix3Xd::Zero(3, vertices);
    for (int c = 0; c < 3 * mesh.triangles(); ++c)
        normal.col(result.triangle(c % 3, c / 3)) += area.col(c / 3);
    result.normal = normal.colwise().normalized().cast<float>(); // where it is zero, it stays so
    return result;
}

SceneMesh flat_scene_mesh(const TriMesh& part, const SceneMesh& part_scene, const Eigen::Matrix2Xd& position)
{
    SceneMesh result;
    Eigen::Matrix3Xd place = Eigen::Matrix3Xd::Zero(3, position.cols());
    place.topRows<2>() = position;
    result.origin = middle_of(place);
    result.position = (place.colwise() - result.origin).cast<float>();
    result.normal = Eigen::Vector3f::UnitZ().replicate(1, position.cols());
    result.triangle = part.triangle.cast<uint32_t>();
    result.edge = part_scene.edge;
    result.feature = part_scene.feature;
    return result;
}

Edges boundary_edges(const TriMesh& mesh)
{
    std::vector<std::array<uint32_t, 2>> boundary;
    for_each_edge(sides_of(mesh), [&](int, std::span<const Side> uses) {
        const int corner = uses[0].corner;
        if (uses.size() == 1)
            boundary.push_back({uint32_t(start(mesh, corner)), uint32_t(start(mesh, next(corner)))});
    });
    return as_matrix(boundary);
}

std::shared_ptr<const SceneField> scene_field(const SceneMesh& mesh, const Eigen::VectorXd& values, bool per_face)
{
    auto field = std::make_shared<SceneField>();
    field->per_face = per_face;
    if (per_face) {
        field->value = values.cast<float>();
        return field;
    }
    field->value.resize(mesh.position.cols());
    field->value.head(values.size()) = values.cast<float>();
    for (size_t i = 0; i < mesh.repeated.size(); ++i)
        field->value[values.size() + Eigen::Index(i)] = float(values[mesh.repeated[i]]);
    return field;
}

std::shared_ptr<ScenePoints> scene_points(const Eigen::Matrix3Xd& position)
{
    auto points = std::make_shared<ScenePoints>();
    points->origin = middle_of(position);
    points->point = (position.colwise() - points->origin).cast<float>();
    return points;
}

} // namespace spia::viewer
