#include "tests/support/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "tests/support/mesh_tools.h"
#include "tests/support/parametric_mesh.h"

namespace spia::shapes {
namespace {

using std::numbers::pi;

/// Two triangles for each of columns x rows cells between vertices vertex(i, j).
template <class Vertex> Eigen::Matrix3Xi cells_in_two(int columns, int rows, const Vertex& vertex)
{
    Eigen::Matrix3Xi triangle(3, 2 * columns * rows);
    int f = 0;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            triangle.col(f++) << a, b, c;
            triangle.col(f++) << a, c, d;
        }
    return triangle;
}

} // namespace

TriMesh rectangle(double width, double height, int columns, int rows)
{
    TriMesh mesh;
    mesh.position.resize(3, (columns + 1) * (rows + 1));
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            mesh.position.col(i + j * (columns + 1)) << width * i / columns, height * j / rows, 0;
    mesh.triangle = cells_in_two(columns, rows, [&](int i, int j) { return i + j * (columns + 1); });
    return mesh;
}

double Plate::area() const
{
    double area = width * height;
    for (const Circle& hole : holes)
        area -= pi * hole.radius * hole.radius;
    return area;
}

TriMesh plate(const Plate& shape)
{
    const auto plane = [](const Eigen::Vector2d& p) { return Eigen::Vector3d(p.x(), p.y(), 0); };
    return mesh_surface(perforated({0, 0}, {shape.width, shape.height}, shape.holes), plane, shape.triangles,
                        edges_around(shape.holes))
        .mesh;
}

TriMesh saddle(const Saddle& shape)
{
    const int n = std::max(1, int(std::lround(std::sqrt(shape.triangles / 2.0))));
    TriMesh mesh = rectangle(shape.side, shape.side, n, n);
    for (auto x : mesh.position.colwise()) {
        x.head<2>().array() -= shape.side / 2;
        x.z() = (x.x() * x.x() - x.y() * x.y()) / (2 * shape.radius);
    }
    return mesh;
}

TriMesh closed_sphere(double radius, int triangles)
{
    // The octahedron |x| + |y| + |z| = n, each face n^2 triangles between whole-numbered points,
    // pushed onto the sphere.
    const int n = std::max(1, int(std::lround(std::sqrt(triangles / 8.0))));
    std::map<std::array<int, 3>, int> index;
    std::vector<Eigen::Vector3d> position;
    std::vector<Eigen::Vector3i> faces;
    const auto vertex = [&](int x, int y, int z) {
        const auto [entry, is_new] = index.try_emplace({x, y, z}, int(position.size()));
        if (is_new)
            position.push_back(radius * Eigen::Vector3d(x, y, z).normalized());
        return entry->second;
    };
    for (int sx : {1, -1})
        for (int sy : {1, -1})
            for (int sz : {1, -1})
                for (int i = 0; i < n; ++i)
                    for (int j = 0; i + j < n; ++j) {
                        const auto at = [&](int p, int q) { return vertex(sx * p, sy * q, sz * (n - p - q)); };
                        const bool mirrored_octant = sx * sy * sz < 0;
                        const auto add = [&](int a, int b, int c) {
                            faces.emplace_back(a, mirrored_octant ? c : b, mirrored_octant ? b : c);
                        };
                        add(at(i, j), at(i + 1, j), at(i, j + 1));
                        if (i + j + 1 < n)
                            add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                    }
    TriMesh mesh;
    mesh.position = Eigen::Matrix3Xd::Map(position.data()->data(), 3, Eigen::Index(position.size()));
    mesh.triangle = Eigen::Matrix3Xi::Map(faces.data()->data(), 3, Eigen::Index(faces.size()));
    return mesh;
}

TriMesh torus(double radius, double tube_radius, int triangles)
{
    const double cells = triangles / 2.0, ratio = radius / tube_radius;
    const int columns = std::max(3, int(std::lround(std::sqrt(cells * ratio))));
    const int rows = std::max(3, int(std::lround(cells / columns)));
    TriMesh mesh;
    mesh.position.resize(3, columns * rows);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const double a = 2 * pi * i / columns, b = 2 * pi * j / rows;
            const double r = radius + tube_radius * std::cos(b);
            mesh.position.col(i + j * columns) << r * std::cos(a), r * std::sin(a), tube_radius * std::sin(b);
        }
    mesh.triangle = cells_in_two(columns, rows, [&](int i, int j) { return i % columns + j % rows * columns; });
    return mesh;
}

TriMesh moebius_strip(double radius, double width, int triangles)
{
    const double cells = triangles / 2.0, ratio = 2 * pi * radius / width;
    const int columns = std::max(5, int(std::lround(std::sqrt(cells * ratio))));
    const int rows = std::max(1, int(std::lround(cells / columns)));
    TriMesh mesh;
    mesh.position.resize(3, columns * (rows + 1));
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const double a = 2 * pi * i / columns, t = width * (double(j) / rows - 0.5);
            const double r = radius + t * std::cos(a / 2);
            mesh.position.col(i + j * columns) << r * std::cos(a), r * std::sin(a), t * std::sin(a / 2);
        }
    // After one turn around, the strip arrives upside down.
    mesh.triangle =
        cells_in_two(columns, rows, [&](int i, int j) { return i < columns ? i + j * columns : (rows - j) * columns; });
    return mesh;
}

TriMesh two_rectangles()
{
    const TriMesh one = rectangle(30, 20, 6, 4);
    return joined(one, transformed(one, Eigen::Matrix3d::Identity(), {50, 0, 0}));
}

} // namespace spia::shapes
