#include "tests/support/region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace spia::shapes {
namespace {

using Eigen::Vector2d;

/// The lattice, with the signed distance at every vertex. Vertices close to the boundary are moved
/// onto it, so that no sliver is cut off beside them.
struct Lattice {
    std::vector<Vector2d> position;
    std::vector<double> distance;
    std::vector<Eigen::Vector3i> triangle;
};

Lattice lattice(const Region& region, double spacing)
{
    constexpr double snap = 0.3; // of the spacing
    const double height = spacing * std::sqrt(3.0) / 2;
    const int columns = int(std::ceil((region.high.x() - region.low.x()) / spacing)) + 3;
    const int rows = int(std::ceil((region.high.y() - region.low.y()) / height)) + 3;
    Lattice result;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            Vector2d p(region.low.x() + spacing * (i - 1 - 0.5 * (j % 2)), region.low.y() + height * (j - 1));
            double d = region.distance(p);
            if (std::abs(d) < snap * spacing) {
                const Vector2d q = on_boundary_of(region, p);
                if ((q - p).norm() < 1.2 * snap * spacing) {
                    p = q;
                    d = 0;
                }
            }
            result.position.push_back(p);
            result.distance.push_back(d);
        }
    for (int j = 0; j + 1 < rows; ++j)
        for (int i = 0; i + 1 < columns; ++i) {
            const int a = i + j * columns, b = a + 1, c = a + columns, d = c + 1;
            if (j % 2 == 0) { // the row above is shifted to the left
                result.triangle.emplace_back(a, b, d);
                result.triangle.emplace_back(a, d, c);
            } else {
                result.triangle.emplace_back(a, b, c);
                result.triangle.emplace_back(b, d, c);
            }
        }
    return result;
}

Vector2d crossing(const Region& region, Vector2d inside, Vector2d outside)
{
    for (int i = 0; i < 40; ++i) {
        const Vector2d middle = (inside + outside) / 2;
        (region.distance(middle) < 0 ? inside : outside) = middle;
    }
    return (inside + outside) / 2;
}

/// Keeps what lies inside. A triangle that the boundary crosses leaves a triangle or a quadrangle.
PlaneMesh clip(Lattice all, const Region& region)
{
    std::vector<Eigen::Vector3i> kept;
    std::map<std::pair<int, int>, int> cut; // the new vertex on an edge
    const auto cut_vertex = [&](int a, int b) {
        const auto [entry, is_new] = cut.try_emplace(std::minmax(a, b), int(all.position.size()));
        if (is_new) {
            if (all.distance[a] > 0)
                std::swap(a, b);
            all.position.push_back(crossing(region, all.position[a], all.position[b]));
            all.distance.push_back(0);
        }
        return entry->second;
    };
    for (const Eigen::Vector3i& t : all.triangle) {
        std::vector<int> polygon;
        int inside = 0;
        for (int k = 0; k < 3; ++k) {
            const int a = t[k], b = t[(k + 1) % 3];
            inside += all.distance[a] < 0;
            if (all.distance[a] <= 0)
                polygon.push_back(a);
            if (all.distance[a] * all.distance[b] < 0)
                polygon.push_back(cut_vertex(a, b));
        }
        if (inside == 0 && polygon.size() == 3) {
            const Vector2d centre = (all.position[t[0]] + all.position[t[1]] + all.position[t[2]]) / 3;
            inside = region.distance(centre) < 0;
        }
        if (inside == 0 || polygon.size() < 3)
            continue;
        const auto x = [&](int k) { return all.position[polygon[k]]; };
        if (polygon.size() == 4 && (x(1) - x(3)).norm() < (x(0) - x(2)).norm())
            std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
        for (size_t k = 2; k < polygon.size(); ++k)
            kept.emplace_back(polygon[0], polygon[k - 1], polygon[k]);
    }
    PlaneMesh mesh;
    mesh.triangle = Eigen::Matrix3Xi::Map(kept.data()->data(), 3, Eigen::Index(kept.size()));
    std::vector<int> renamed(all.position.size(), -1);
    for (int& v : mesh.triangle.reshaped()) {
        if (renamed[v] < 0) {
            renamed[v] = int(mesh.position.size());
            mesh.position.push_back(all.position[v]);
        }
        v = renamed[v];
    }
    return mesh;
}

/// Moves the nearest vertices of the boundary into the corners.
void take_corners(PlaneMesh& mesh, const Region& region, double spacing)
{
    for (const Vector2d& corner : region.corners) {
        int best = -1;
        double least = 1e30;
        for (size_t v = 0; v < mesh.position.size(); ++v)
            if (std::abs(region.distance(mesh.position[v])) < 1e-6 * spacing) {
                const double away = (mesh.position[v] - corner).norm();
                if (away < least) {
                    least = away;
                    best = int(v);
                }
            }
        mesh.position[best] = corner;
        mesh.corner.push_back(best);
    }
}

} // namespace

double box_distance(const Vector2d& p, const Vector2d& centre, const Vector2d& half_size, double corner_radius)
{
    const Eigen::Array2d q = (p - centre).array().abs() - half_size.array() + corner_radius;
    return q.max(0).matrix().norm() + std::min(0.0, q.maxCoeff()) - corner_radius;
}

double capsule_distance(const Vector2d& p, const Vector2d& a, const Vector2d& b, double radius)
{
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - t * (b - a)).norm() - radius;
}

double rounded_intersection(double a, double b, double radius)
{
    const Eigen::Array2d q(a + radius, b + radius);
    return q.max(0).matrix().norm() + std::min(0.0, q.maxCoeff()) - radius;
}

Vector2d on_boundary_of(const Region& region, Vector2d p)
{
    constexpr double step = 1e-5; // mm, for the gradient
    for (int i = 0; i < 20; ++i) {
        const double d = region.distance(p);
        if (std::abs(d) < 1e-11)
            break;
        const Vector2d ex(step, 0), ey(0, step);
        const Vector2d gradient = Vector2d(region.distance(p + ex) - region.distance(p - ex),
                                           region.distance(p + ey) - region.distance(p - ey)) /
                                  (2 * step);
        p -= d * gradient / gradient.squaredNorm();
    }
    return p;
}

Region perforated(const Vector2d& low, const Vector2d& high, const std::vector<Circle>& holes)
{
    Region region;
    region.distance = [=](const Vector2d& p) {
        double d = box_distance(p, (low + high) / 2, (high - low) / 2, 0);
        for (const Circle& hole : holes)
            d = std::max(d, -hole.distance(p));
        return d;
    };
    region.low = low;
    region.high = high;
    region.corners = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
    for (const Circle& hole : holes)
        region.smallest_feature = std::min(region.smallest_feature, hole.radius);
    return region;
}

std::function<double(const Vector2d&)> edges_around(const std::vector<Circle>& holes)
{
    return [=](const Vector2d& p) {
        double longest = 1e30;
        for (const Circle& hole : holes) {
            const double at_hole = 2 * std::numbers::pi / 8 * hole.radius;
            longest = std::min(longest, at_hole + 0.6 * std::max(0.0, hole.distance(p)));
        }
        return longest;
    };
}

PlaneMesh cut_lattice(const Region& region, double spacing)
{
    PlaneMesh mesh = clip(lattice(region, spacing), region);
    take_corners(mesh, region, spacing);
    return mesh;
}

} // namespace spia::shapes
