#include "tests/support/bent_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "tests/support/grid_surface.h"
#include "tests/support/revolved.h"

namespace spia::shapes {

TriMesh patchwork(const std::vector<Patch>& patches)
{
    std::map<std::array<long, 3>, int> index;
    std::vector<Eigen::Vector3d> position;
    std::vector<Eigen::Vector3i> triangle;
    for (const Patch& patch : patches) {
        const TriMesh grid = grid_surface({patch.columns, patch.rows}, [&](double u, double v) {
            const auto& c = patch.corner;
            return Eigen::Vector3d((1 - u) * (1 - v) * c[0] + u * (1 - v) * c[1] + u * v * c[2] + (1 - u) * v * c[3]);
        });
        std::vector<int> number;
        for (const auto& p : grid.position.colwise()) {
            const auto key = [&](int k) { return std::lround(p[k] * 1e6); };
            const auto [entry, is_new] = index.try_emplace({key(0), key(1), key(2)}, int(position.size()));
            if (is_new)
                position.push_back(p);
            number.push_back(entry->second);
        }
        for (const auto& t : grid.triangle.colwise())
            triangle.emplace_back(number[size_t(t[0])], number[size_t(t[1])], number[size_t(t[2])]);
    }
    TriMesh mesh;
    mesh.position.resize(3, Eigen::Index(position.size()));
    mesh.triangle.resize(3, Eigen::Index(triangle.size()));
    for (size_t v = 0; v < position.size(); ++v)
        mesh.position.col(Eigen::Index(v)) = position[v];
    for (size_t f = 0; f < triangle.size(); ++f)
        mesh.triangle.col(Eigen::Index(f)) = triangle[f];
    return mesh;
}

TriMesh lipped_box(const LippedBox& shape)
{
    const auto cells = [&](double length) { return std::max(1, int(std::lround(length / shape.edge))); };
    const double x = shape.width / 2, y = shape.depth / 2, h = shape.height;
    const std::array<Eigen::Vector3d, 4> corner =
        {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}}; // the inner side is up, the outer one
                                                            // down
    std::vector<Patch> patches = {
        {{corner[0], corner[3], corner[2], corner[1]}, cells(shape.depth), cells(shape.width)}};
    for (size_t k = 0; k < 4; ++k) {
        const Eigen::Vector3d a = corner[k], b = corner[(k + 1) % 4], along = (b - a).normalized(),
                              inwards = Eigen::Vector3d::UnitZ().cross(along), up = h * Eigen::Vector3d::UnitZ();
        const int n = cells((b - a).norm());
        // at a vertex of the wall
        const double cell = (b - a).norm() / n, gap = std::ceil(shape.gap / cell) * cell;
        const Eigen::Vector3d apart = shape.joined ? Eigen::Vector3d::Zero() : Eigen::Vector3d(gap * along);
        const int fewer = shape.joined ? 0 : 2 * int(std::lround(gap / cell));
        patches.push_back({{a + apart, b - apart, b - apart + up, a + apart + up}, n - fewer, cells(h)});
        const Eigen::Vector3d p = a + gap * along + up, q = b - gap * along + up;
        patches.push_back({{p, q, q + shape.lip * inwards, p + shape.lip * inwards},
                           n - 2 * int(std::lround(gap / cell)),
                           std::max(2, cells(shape.lip))});
    }
    return patchwork(patches);
}

TriMesh swept(const Profile& profile, double angle, double edge)
{
    const std::vector<double> s = even_spacing(profile, edge);
    double middle = 0;
    for (const double where : s)
        middle += profile.at(where).x() / double(s.size());
    const int around = std::max(3, int(std::lround(middle * angle / edge)));
    return grid_surface({int(s.size()) - 1, around}, [&](double u, double v) {
        const Eigen::Vector2d p = profile.at(s[size_t(std::lround(u * double(s.size() - 1)))]);
        return Eigen::Vector3d(p.x() * std::cos(angle * v), p.x() * std::sin(angle * v), p.y());
    });
}

TriMesh round_cup(const RoundCup& shape)
{
    using std::numbers::pi;
    const Profile profile = Profile({0, 0}, 0)
                                .straight(shape.radius - shape.bend)
                                .bend(shape.bend, -pi / 2)
                                .straight(shape.height - 2 * shape.bend)
                                .bend(shape.bend, pi / 2)
                                .straight(shape.flange);
    const std::vector<double> s = even_spacing(profile, shape.bend * pi / 16);
    Eigen::Matrix2Xd meridian(2, Eigen::Index(s.size()));
    for (size_t i = 0; i < s.size(); ++i)
        meridian.col(Eigen::Index(i)) = profile.at(s[i]);
    meridian(0, 0) = 0;
    return axisymmetric(meridian, shape.triangles).mesh;
}

TriMesh noisy(TriMesh mesh, double most_mm, unsigned seed)
{
    std::mt19937 random(seed);
    for (double& x : mesh.position.reshaped())
        x += most_mm * (2 * double(random()) / double(std::mt19937::max()) - 1);
    return mesh;
}

} // namespace spia::shapes
