#include "tests/support/grid_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

namespace spia::shapes {

TriMesh grid_surface(const GridPlan& plan, const std::function<Eigen::Vector3d(double u, double v)>& place)
{
    const int across = plan.columns + (plan.around ? 0 : 1), up = plan.rows + (plan.along ? 0 : 1);
    TriMesh mesh;
    mesh.position.resize(3, across * up);
    for (int j = 0; j < up; ++j)
        for (int i = 0; i < across; ++i)
            mesh.position.col(i + j * across) = place(double(i) / plan.columns, double(j) / plan.rows);
    mesh.triangle.resize(3, 2 * plan.columns * plan.rows);
    int f = 0;
    for (int j = 0; j < plan.rows; ++j)
        for (int i = 0; i < plan.columns; ++i) {
            const auto vertex = [&](int p, int q) { return p % across + q % up * across; };
            const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            const bool rising = (i + j) % 2 == 0;
            mesh.triangle.col(f++) << a, b, (rising ? c : d);
            mesh.triangle.col(f++) << (rising ? a : b), c, d;
        }
    return mesh;
}

TriMesh pipe(double radius, double top, double height, int around, int rows)
{
    return grid_surface({around, rows, true, false}, [&](double u, double v) {
        const double angle = 2 * std::numbers::pi * u, r = radius + (top - radius) * v;
        return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), height * v);
    });
}

TriMesh body_surface(const std::set<Cell>& cubes, double edge, int n,
                     const std::function<bool(const Cell&, const Eigen::Vector3i&)>& open)
{
    std::map<Cell, int> index; // of points counted in n-ths of a cube
    std::vector<Eigen::Vector3d> position;
    std::vector<Eigen::Vector3i> faces;
    const auto vertex = [&](const Eigen::Vector3i& p) {
        const auto [entry, is_new] = index.try_emplace({p[0], p[1], p[2]}, int(position.size()));
        if (is_new)
            position.push_back(p.cast<double>() * edge / n);
        return entry->second;
    };
    for (const Cell& cube : cubes)
        for (int axis = 0; axis < 3; ++axis)
            for (const int side : {-1, 1}) {
                Eigen::Vector3i outwards = Eigen::Vector3i::Zero(), u = outwards, v = outwards;
                outwards[axis] = side;
                u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
                if (side < 0)
                    std::swap(u, v);
                const Cell beyond{cube[0] + outwards[0], cube[1] + outwards[1], cube[2] + outwards[2]};
                if (cubes.contains(beyond) || (open && open(cube, outwards)))
                    continue;
                Eigen::Vector3i corner = n * Eigen::Vector3i(cube[0], cube[1], cube[2]);
                corner[axis] += side > 0 ? n : 0;
                for (int i = 0; i < n; ++i)
                    for (int j = 0; j < n; ++j) {
                        const auto at = [&](int p, int q) { return vertex(corner + (i + p) * u + (j + q) * v); };
                        const int a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
                        const bool rising = (i + j) % 2 == 0;
                        faces.emplace_back(a, b, rising ? c : d);
                        faces.emplace_back(rising ? a : b, c, d);
                    }
            }
    TriMesh mesh;
    mesh.position = Eigen::Matrix3Xd::Map(position.data()->data(), 3, Eigen::Index(position.size()));
    mesh.triangle = Eigen::Matrix3Xi::Map(faces.data()->data(), 3, Eigen::Index(faces.size()));
    return mesh;
}

TriMesh without_strays(const TriMesh& mesh)
{
    std::vector<int> number(size_t(mesh.vertices()), -1);
    TriMesh result;
    result.triangle.resizeLike(mesh.triangle);
    for (const int v : mesh.triangle.reshaped())
        number[size_t(v)] = 0;
    int count = 0;
    for (int& n : number)
        n = n == 0 ? count++ : -1;
    result.position.resize(3, count);
    for (int v = 0; v < mesh.vertices(); ++v)
        if (number[size_t(v)] >= 0)
            result.position.col(number[size_t(v)]) = mesh.position.col(v);
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            result.triangle(k, f) = number[size_t(mesh.triangle(k, f))];
    return result;
}

TriMesh without_faces(const TriMesh& mesh, const std::function<bool(const Eigen::Vector3d&)>& left_out)
{
    TriMesh kept{mesh.position, {}};
    kept.triangle.resize(3, mesh.triangles());
    int count = 0;
    for (int f = 0; f < mesh.triangles(); ++f)
        if (!left_out(mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean()))
            kept.triangle.col(count++) = mesh.triangle.col(f);
    kept.triangle.conservativeResize(3, count);
    return without_strays(kept);
}

} // namespace spia::shapes
