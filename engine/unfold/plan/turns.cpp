#include "engine/unfold/plan/turns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Lists of numbers, one list after the other.
struct Rows {
    std::vector<int> first, at;
};

Rows faces_of_vertices(const TriMesh& mesh)
{
    Rows rows;
    rows.first.assign(size_t(mesh.vertices()) + 1, 0);
    for (const int v : mesh.triangle.reshaped())
        ++rows.first[size_t(v) + 1];
    for (size_t v = 0; v < size_t(mesh.vertices()); ++v)
        rows.first[v + 1] += rows.first[v];
    rows.at.resize(size_t(mesh.triangle.size()));
    std::vector<int> next(rows.first.begin(), rows.first.end() - 1);
    for (int f = 0; f < mesh.triangles(); ++f)
        for (const int v : mesh.triangle.col(f))
            rows.at[size_t(next[size_t(v)]++)] = f;
    return rows;
}

/// A vertex' height above the mean of its ring, over its mean edge, less the mean of the same of
/// the ring: zero on a sheet of even curvature whatever its triangles, of the order of the slope of
/// noise on a scan.
double roughness(const TriMesh& mesh, const std::vector<EdgeUse>& uses)
{
    const auto count = size_t(mesh.vertices());
    std::vector<Eigen::Vector3d> ring(count, Eigen::Vector3d::Zero());
    std::vector<double> length(count, 0), off(count, 0), around(count, 0);
    std::vector<int> valence(count, 0);
    std::vector<char> rim(count, 0);
    const auto each = [&](const auto& visit) {
        for_each_edge(uses, [&](size_t begin, size_t end) {
            visit(size_t(uses[begin].low), size_t(uses[begin].high), end - begin);
        });
    };
    each([&](size_t a, size_t b, size_t faces) {
        const Eigen::Vector3d p = mesh.position.col(Eigen::Index(a)), q = mesh.position.col(Eigen::Index(b));
        ring[a] += q, ring[b] += p;
        ++valence[a], ++valence[b];
        length[a] += (p - q).norm(), length[b] += (p - q).norm();
        rim[a] |= char(faces == 1), rim[b] |= char(faces == 1);
    });
    const Eigen::Matrix3Xd normal = vertex_normals(mesh);
    for (size_t v = 0; v < count; ++v)
        if (valence[v])
            off[v] = normal.col(Eigen::Index(v)).dot(ring[v] / valence[v] - mesh.position.col(Eigen::Index(v))) /
                     (length[v] / valence[v]);
    each([&](size_t a, size_t b, size_t) {
        around[a] += off[b], around[b] += off[a];
        // beside the rim: its ring is half a one
        rim[a] |= char(2 * (rim[b] & 1)), rim[b] |= char(2 * (rim[a] & 1));
    });
    std::vector<double> unlike;
    for (size_t v = 0; v < count; ++v)
        if (valence[v] && !rim[v])
            unlike.push_back(std::abs(off[v] - around[v] / valence[v]));
    if (unlike.empty())
        return 0;
    const auto middle = unlike.begin() + Eigen::Index(unlike.size() / 2);
    std::nth_element(unlike.begin(), middle, unlike.end());
    return *middle;
}

/// Whether a quarter of the edges turn by nearly nothing, as those within flat strips do on a mesh
/// without noise. However coarse that is at its bends: on a scan every edge turns a little.
bool strips(const Eigen::Matrix3Xd& normal, const std::vector<EdgeUse>& uses, double nothing)
{
    size_t inner = 0, straight = 0;
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin != 2)
            return;
        ++inner;
        straight += (normal.col(uses[begin].face) - normal.col(uses[end - 1].face)).norm() < nothing;
    });
    return 4 * straight >= inner && inner > 0;
}

Eigen::Matrix3Xd smoothed(const TriMesh& mesh, Eigen::Matrix3Xd normal, const Eigen::VectorXd& area, double alike)
{
    constexpr int passes = 10;
    const Rows around = faces_of_vertices(mesh);
    for (int pass = 0; pass < passes; ++pass) {
        Eigen::Matrix3Xd next(3, normal.cols());
        parallel_for(mesh.triangles(), [&](int f) {
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            for (const int v : mesh.triangle.col(f))
                for (int k = around.first[size_t(v)]; k < around.first[size_t(v) + 1]; ++k) {
                    const int g = around.at[size_t(k)];
                    const double unlike = (normal.col(f) - normal.col(g)).norm() / alike;
                    sum += area[g] * std::exp(-unlike * unlike / 2) * normal.col(g);
                }
            next.col(f) = sum.normalized();
        });
        normal = std::move(next);
    }
    return normal;
}

} // namespace

SheetTurns sheet_turns(const TriMesh& mesh, double rough)
{
    SheetTurns result;
    const Eigen::Matrix3Xd vectors = area_vectors(mesh);
    result.area = vectors.colwise().norm().transpose();
    result.normal = vectors.colwise().normalized();
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    result.roughness = roughness(mesh, uses);
    result.smoothed = result.roughness > rough && !strips(result.normal, uses, rough / 10);
    if (result.smoothed)
        result.normal = smoothed(mesh, std::move(result.normal), result.area, std::max(0.25, 6 * result.roughness));
    result.first.assign(size_t(mesh.triangles()) + 1, 0);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const EdgeUse &a = uses[begin], &b = uses[end - 1];
        const Eigen::Vector3d along = mesh.position.col(mesh.triangle((a.corner + 1) % 3, a.face)) -
                                      mesh.position.col(mesh.triangle(a.corner, a.face));
        EdgeTurn edge{a.face, b.face, along.norm(), 0, false, along.normalized()};
        if (end - begin != 2) {
            result.rim.push_back(edge);
            return;
        }
        const Eigen::Vector3d n = result.normal.col(a.face), m = result.normal.col(b.face), across = n.cross(m);
        edge.turn = std::atan2(across.norm(), n.dot(m));
        edge.bulging = across.dot(along) > 0;
        if (!edge.bulging)
            edge.axis = -edge.axis;
        result.edge.push_back(edge);
        ++result.first[size_t(a.face) + 1];
        ++result.first[size_t(b.face) + 1];
    });
    for (size_t f = 0; f < size_t(mesh.triangles()); ++f)
        result.first[f + 1] += result.first[f];
    result.at.resize(2 * result.edge.size());
    std::vector<int> next(result.first.begin(), result.first.end() - 1);
    for (size_t e = 0; e < result.edge.size(); ++e)
        for (const int f : {result.edge[e].face, result.edge[e].twin})
            result.at[size_t(next[size_t(f)]++)] = int(e);
    return result;
}

} // namespace spia
