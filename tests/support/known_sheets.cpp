#include "tests/support/known_sheets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/mesh/topology.h"
#include "tests/support/shapes.h"

namespace spia::shapes {

namespace {

using Eigen::Vector3d;

/// A height field; the vertical distance times the cosine of the slope is the distance to first
/// order.
KnownSheet height_field(std::string name, double side, std::function<double(double, double)> z)
{
    KnownSheet sheet;
    sheet.name = std::move(name);
    sheet.place = [side, z](double s, double t) {
        const double x = side * (s - 0.5), y = side * (t - 0.5);
        return Vector3d(x, y, z(x, y));
    };
    sheet.distance = [z](const Vector3d& p) {
        const double e = 1e-4;
        const double zx = (z(p.x() + e, p.y()) - z(p.x() - e, p.y())) / (2 * e);
        const double zy = (z(p.x(), p.y() + e) - z(p.x(), p.y() - e)) / (2 * e);
        return std::abs(p.z() - z(p.x(), p.y())) / std::sqrt(1 + zx * zx + zy * zy);
    };
    return sheet;
}

} // namespace

std::vector<KnownSheet> known_sheets()
{
    const double quarter = std::numbers::pi / 2;
    std::vector<KnownSheet> sheets;
    const Vector3d normal = Vector3d(0.3, -0.2, 1).normalized();
    sheets.push_back({"plane",
                      [=](double s, double t) {
                          const double x = 100 * (s + 0.1 * s * (1 - s)), y = 80 * t + 10 * s * t;
                          return Vector3d(x, y, -(normal.x() * x + normal.y() * y) / normal.z());
                      },
                      [=](const Vector3d& p) { return std::abs(p.dot(normal)); }, 0});
    sheets.push_back(
        {"cylinder",
         [=](double s, double t) { return Vector3d(60 * std::cos(quarter * s), 60 * std::sin(quarter * s), 100 * t); },
         [](const Vector3d& p) { return std::abs(p.head<2>().norm() - 60); }, 0});
    sheets.push_back({"torus piece",
                      [=](double s, double t) {
                          const double a = quarter * s, b = 1.5 * quarter * (t - 0.5);
                          const double r = 60 + 25 * std::cos(b);
                          return Vector3d(r * std::cos(a), r * std::sin(a), 25 * std::sin(b));
                      },
                      [](const Vector3d& p) { return std::abs(std::hypot(p.head<2>().norm() - 60, p.z()) - 25); }, 0});
    sheets.push_back(height_field("saddle", 100, [](double x, double y) { return (x * x - y * y) / 120; }));
    sheets.push_back(
        height_field("bump", 100, [](double x, double y) { return 5 / (1 + (x * x + (y - 7) * (y - 7)) / 36); }));
    for (KnownSheet& sheet : sheets)
        sheet.size = bounding_diagonal(mesh_of(sheet, 20));
    return sheets;
}

TriMesh mesh_of(const KnownSheet& sheet, int cells)
{
    TriMesh mesh;
    const int n = cells + 1;
    mesh.position.resize(3, n * n);
    mesh.triangle.resize(3, 2 * cells * cells);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            mesh.position.col(i + j * n) = sheet.place(double(i) / cells, double(j) / cells);
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const int a = i + j * n;
            mesh.triangle.col(2 * (i + j * cells)) << a, a + 1, a + n + 1;
            mesh.triangle.col(2 * (i + j * cells) + 1) << a, a + n + 1, a + n;
        }
    return mesh;
}

Eigen::Vector3d on_mesh(const TriMesh& mesh, int cells, double s, double t)
{
    const int i = std::clamp(int(s * cells), 0, cells - 1), j = std::clamp(int(t * cells), 0, cells - 1);
    const double x = s * cells - i, y = t * cells - j;
    const auto at = [&](int a, int b) -> Vector3d { return mesh.position.col(i + a + (j + b) * (cells + 1)); };
    return x >= y ? Vector3d(at(0, 0) + x * (at(1, 0) - at(0, 0)) + y * (at(1, 1) - at(1, 0)))
                  : Vector3d(at(0, 0) + y * (at(0, 1) - at(0, 0)) + x * (at(1, 1) - at(0, 1)));
}

double chord_error(const KnownSheet& sheet, const TriMesh& mesh)
{
    double largest = 0;
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Vector3d a = mesh.position.col(mesh.triangle(0, f)), b = mesh.position.col(mesh.triangle(1, f)),
                       c = mesh.position.col(mesh.triangle(2, f));
        for (const Vector3d& p :
             {Vector3d((a + b + c) / 3), Vector3d((a + b) / 2), Vector3d((b + c) / 2), Vector3d((c + a) / 2)})
            largest = std::max(largest, sheet.distance(p));
    }
    return largest;
}

} // namespace spia::shapes
