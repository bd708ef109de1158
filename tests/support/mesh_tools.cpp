#include "tests/support/mesh_tools.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

namespace spia::shapes {
namespace {

/// new_place[i] for every i: a permutation that is the same on every platform, unlike
/// std::shuffle's.
std::vector<int> shuffled(int count, std::mt19937_64& random)
{
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    for (int i = count - 1; i > 0; --i)
        std::swap(order[i], order[random() % std::uint64_t(i + 1)]);
    return order;
}

double corner_angle(const TriMesh& mesh, int face, int corner)
{
    const auto x = [&](int k) { return mesh.position.col(mesh.triangle((corner + k) % 3, face)); };
    const Eigen::Vector3d a = x(1) - x(0), b = x(2) - x(0);
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace

TriMesh transformed(const TriMesh& mesh, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
{
    return {(rotation * mesh.position).colwise() + translation, mesh.triangle};
}

TriMesh scaled(const TriMesh& mesh, double factor) { return {mesh.position * factor, mesh.triangle}; }

TriMesh mirrored(const TriMesh& mesh)
{
    TriMesh image = mesh;
    image.position.row(0) *= -1;
    image.triangle.row(1).swap(image.triangle.row(2));
    return image;
}

Permuted permuted(const TriMesh& mesh, std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    Permuted result{mesh, shuffled(mesh.vertices(), random), shuffled(mesh.triangles(), random)};
    for (int v = 0; v < mesh.vertices(); ++v)
        result.mesh.position.col(result.vertex[v]) = mesh.position.col(v);
    for (int f = 0; f < mesh.triangles(); ++f) {
        const int turn = int(random() % 3);
        for (int k = 0; k < 3; ++k)
            result.mesh.triangle(k, result.face[f]) = result.vertex[mesh.triangle((k + turn) % 3, f)];
    }
    return result;
}

Eigen::Matrix3d random_rotation(std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
    const double u = uniform(), a = 2 * std::numbers::pi * uniform(), b = 2 * std::numbers::pi * uniform();
    const double p = std::sqrt(1 - u),
                 q = std::sqrt(u); // Shoemake 1992: an even distribution of unit quaternions
    return Eigen::Quaterniond(p * std::sin(a), p * std::cos(a), q * std::sin(b), q * std::cos(b)).toRotationMatrix();
}

TriMesh joined(const TriMesh& a, const TriMesh& b)
{
    TriMesh mesh;
    mesh.position.resize(3, a.vertices() + b.vertices());
    mesh.position << a.position, b.position;
    mesh.triangle.resize(3, a.triangles() + b.triangles());
    mesh.triangle << a.triangle, b.triangle.array() + a.vertices();
    return mesh;
}

Eigen::VectorXd edge_lengths(const TriMesh& mesh)
{
    std::vector<std::pair<int, int>> edges;
    edges.reserve(3 * size_t(mesh.triangles()));
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            edges.push_back(std::minmax({mesh.triangle(k, f), mesh.triangle((k + 1) % 3, f)}));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    Eigen::VectorXd length(Eigen::Index(edges.size()));
    for (size_t e = 0; e < edges.size(); ++e)
        length[Eigen::Index(e)] = (mesh.position.col(edges[e].first) - mesh.position.col(edges[e].second)).norm();
    return length;
}

PolygonSoup soup_of(const TriMesh& mesh)
{
    PolygonSoup soup;
    for (int v = 0; v < mesh.vertices(); ++v)
        soup.position.push_back(mesh.position.col(v));
    for (int f = 0; f < mesh.triangles(); ++f)
        soup.add_polygon(std::array{mesh.triangle(0, f), mesh.triangle(1, f), mesh.triangle(2, f)});
    return soup;
}

double mean_edge(const TriMesh& mesh) { return edge_lengths(mesh).mean(); }

Eigen::VectorXd least_angles(const TriMesh& mesh)
{
    Eigen::VectorXd least(mesh.triangles());
    for (int f = 0; f < mesh.triangles(); ++f)
        least[f] = std::min({corner_angle(mesh, f, 0), corner_angle(mesh, f, 1), corner_angle(mesh, f, 2)});
    return least;
}

Eigen::VectorXd angle_sums(const TriMesh& mesh)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(mesh.vertices());
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            sum[mesh.triangle(k, f)] += corner_angle(mesh, f, k);
    return sum;
}

double share_below(const Eigen::VectorXd& values, double limit)
{
    return double((values.array() < limit).count()) / double(values.size());
}

double convergence_order(const std::vector<double>& h, const std::vector<double>& error)
{
    const Eigen::ArrayXd x = Eigen::ArrayXd::Map(h.data(), Eigen::Index(h.size())).log();
    const Eigen::ArrayXd y = Eigen::ArrayXd::Map(error.data(), Eigen::Index(error.size())).log();
    const Eigen::ArrayXd dx = x - x.mean();
    return (dx * (y - y.mean())).sum() / dx.square().sum();
}

} // namespace spia::shapes
