#pragma once
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "engine/forming/blank.h"
#include "engine/mesh/tri_mesh.h"
#include "tests/support/random_outlines.h"
#include "tests/support/shapes.h"

/// Flat parts with difficult outlines. They are their own blank.
namespace spia::outlines {

using Points = std::vector<Eigen::Vector2d>;
using std::numbers::pi;

inline Eigen::Vector2d polar(double radius, double angle)
{
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// The closed polygon with points added on its edges, none farther apart than `spacing`.
inline Points divided(const Points& corners, double spacing)
{
    Points result;
    for (size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector2d a = corners[i], b = corners[(i + 1) % corners.size()];
        const int pieces = std::max(1, int(std::ceil((b - a).norm() / spacing - 1e-9)));
        for (int k = 0; k < pieces; ++k)
            result.push_back(a + (b - a) * k / pieces);
    }
    return result;
}

inline TriMesh part(const Points& outline) { return shapes::meshed_outline(outline); }

/// A band that winds around by 8 radians: its ends lie on top of each other, but belong to
/// different ends of the strip.
struct WoundBand {
    TriMesh strip = shapes::rectangle(0.5, 8, 8, 128);
    Blank blank;

    WoundBand()
    {
        blank.position.resize(2, strip.vertices());
        for (int v = 0; v < strip.vertices(); ++v) {
            const auto w = std::exp(std::complex<double>(strip.position(0, v), strip.position(1, v)));
            blank.position.col(v) << w.real(), w.imag();
        }
    }
};

inline Blank as_blank(const TriMesh& part) { return {part.position.topRows(2)}; }

inline int nearest_vertex(const TriMesh& part, const Eigen::Vector2d& point)
{
    Eigen::Index found = 0;
    (part.position.topRows(2).colwise() - point).colwise().squaredNorm().minCoeff(&found);
    return int(found);
}

inline Points circle(double radius, int n)
{
    Points points;
    for (int i = 0; i < n; ++i)
        points.push_back(polar(radius, 2 * pi * i / n));
    return points;
}

inline Points l_shape(double size, double arm, double spacing)
{
    return divided({{0, 0}, {size, 0}, {size, arm}, {arm, arm}, {arm, size}, {0, size}}, spacing);
}

inline Points u_shape(double size, double arm, double spacing)
{
    return divided(
        {{0, 0}, {size, 0}, {size, size}, {size - arm, size}, {size - arm, arm}, {arm, arm}, {arm, size}, {0, size}},
        spacing);
}

inline Points star(double inner, double outer, int points, double spacing)
{
    Points corners;
    for (int i = 0; i < 2 * points; ++i)
        corners.push_back(polar(i % 2 ? inner : outer, pi * i / points));
    return divided(corners, spacing);
}

/// A band of the given width around a curve, e.g. a C, an annulus cut open, a spiral.
inline Points band(const std::function<Eigen::Vector2d(double)>& curve, double width, int n, int across)
{
    Points left, right;
    for (int i = 0; i <= n; ++i) {
        const double t = double(i) / n, d = 1e-5;
        const Eigen::Vector2d tangent = (curve(t + d) - curve(t - d)).normalized();
        const Eigen::Vector2d normal(-tangent.y(), tangent.x());
        left.push_back(curve(t) + width / 2 * normal);
        right.push_back(curve(t) - width / 2 * normal);
    }
    Points points = right;
    for (int k = 1; k < across; ++k)
        points.push_back(right.back() + (left.back() - right.back()) * k / across);
    points.insert(points.end(), left.rbegin(), left.rend());
    for (int k = 1; k < across; ++k)
        points.push_back(left.front() + (right.front() - left.front()) * k / across);
    return points;
}

inline Points arc(double radius, double width, double angle, int n, int across)
{
    return band([=](double t) { return polar(radius, angle * t); }, width, n, across);
}

inline Points spiral(double windings, double pitch, double width, int n, int across)
{
    return band([=](double t) { return polar(pitch * (0.7 + windings * t), 2 * pi * windings * t); }, width, n, across);
}

/// A square with teeth on every side, as meshes of scans have them.
inline Points saw(double size, double depth, int teeth)
{
    Points points;
    const std::vector<Eigen::Vector2d> corners = {{0, 0}, {size, 0}, {size, size}, {0, size}};
    for (size_t k = 0; k < 4; ++k) {
        const Eigen::Vector2d a = corners[k], b = corners[(k + 1) % 4], along = (b - a) / teeth;
        const Eigen::Vector2d outwards = Eigen::Vector2d(along.y(), -along.x()).normalized() * depth;
        for (int i = 0; i < teeth; ++i) {
            points.push_back(a + i * along);
            points.push_back(a + (i + 0.5) * along + outwards);
        }
    }
    return points;
}

/// A rectangle with deep narrow slots and with tabs on its long sides.
inline Points slotted(double width, double height, int slots, double slot, double depth, double spacing)
{
    Points corners;
    corners.push_back({0, 0});
    for (int i = 1; i <= slots; ++i) {
        const double x = width * i / (slots + 1);
        corners.insert(corners.end(),
                       {{x - slot / 2, 0}, {x - slot / 2, depth}, {x + slot / 2, depth}, {x + slot / 2, 0}});
    }
    corners.push_back({width, 0});
    corners.push_back({width, height});
    for (int i = slots; i >= 1; --i) {
        const double x = width * i / (slots + 1);
        corners.insert(corners.end(), {{x + slot / 2, height},
                                       {x + slot / 2, height + depth},
                                       {x - slot / 2, height + depth},
                                       {x - slot / 2, height}});
    }
    corners.push_back({0, height});
    return divided(corners, spacing);
}

} // namespace spia::outlines
