#include "engine/mesh/doctor/split_polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/mesh/doctor/least_triangulation.h"

namespace spia {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using Triangles = std::vector<std::array<int, 3>>;

/// Twice the area vector of a closed polygon, whether it is plane or not.
Vector3d newell_normal(std::span<const Vector3d> corners)
{
    Vector3d sum = Vector3d::Zero();
    for (size_t i = 1; i + 1 < corners.size(); ++i)
        sum += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
    return sum;
}

double longest_edge(std::span<const Vector3d> corners)
{
    double longest = 0;
    for (size_t i = 0; i < corners.size(); ++i)
        longest = std::max(longest, (corners[(i + 1) % corners.size()] - corners[i]).norm());
    return longest;
}

std::vector<Vector2d> project(std::span<const Vector3d> corners, const Vector3d& unit_normal)
{
    const Vector3d x = unit_normal.unitOrthogonal(), y = unit_normal.cross(x);
    std::vector<Vector2d> plane;
    for (const Vector3d& p : corners)
        plane.emplace_back(x.dot(p - corners[0]), y.dot(p - corners[0]));
    return plane;
}

double doubled_area(const Vector2d& a, const Vector2d& b, const Vector2d& c)
{
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// The sine of the least angle of a triangle, negative if it is turned over.
double quality(const Vector2d& a, const Vector2d& b, const Vector2d& c)
{
    std::array<double, 3> edge = {(b - a).norm(), (c - b).norm(), (a - c).norm()};
    std::sort(edge.begin(), edge.end());
    return edge[1] > 0 ? doubled_area(a, b, c) / (edge[1] * edge[2]) : 0;
}

constexpr double flat = 1e-9; // sine of an angle that counts as zero; far above rounding, far below
                              // a usable triangle

constexpr double needle = 0.0175; // of 1 degree: below it the doctor warns
                                  // (DoctorOptions::sliver_angle_deg)

Triangles split_quad(std::span<const Vector3d> corners, const std::vector<Vector2d>& p)
{
    const Triangles by02 = {{0, 1, 2}, {0, 2, 3}}, by13 = {{0, 1, 3}, {1, 2, 3}};
    const auto better_than = [&](double least, const Triangles& triangles) {
        return std::all_of(triangles.begin(), triangles.end(), [&](const auto& t) {
            return quality(p[size_t(t[0])], p[size_t(t[1])], p[size_t(t[2])]) > least;
        });
    };
    const bool shorter02 = (corners[2] - corners[0]).norm() <= (corners[3] - corners[1]).norm();
    for (const double least : {needle, flat})
        for (const Triangles& choice : {shorter02 ? by02 : by13, shorter02 ? by13 : by02})
            if (better_than(least, choice))
                return choice;
    return {};
}

/// Quality of the ear whose tip is corner i of the rest, or at most `flat` if it may not be cut
/// off.
double ear_quality(const std::vector<Vector2d>& p, const std::vector<int>& rest, size_t i)
{
    const size_t n = rest.size();
    const int before = rest[(i + n - 1) % n], tip = rest[i], after = rest[(i + 1) % n];
    const Vector2d &a = p[size_t(before)], &b = p[size_t(tip)], &c = p[size_t(after)];
    const double value = quality(a, b, c);
    if (value <= flat)
        return value;
    const double slack = -flat * (c - a).squaredNorm(); // a corner on the cut blocks it as well
    for (const int other : rest) {
        if (other == before || other == tip || other == after)
            continue;
        const Vector2d& q = p[size_t(other)];
        if (doubled_area(a, b, q) >= 0 && doubled_area(b, c, q) >= 0 && doubled_area(c, a, q) >= slack)
            return 0;
    }
    return value;
}

Triangles clip_ears(const std::vector<Vector2d>& p)
{
    std::vector<int> rest(p.size());
    for (size_t i = 0; i < rest.size(); ++i)
        rest[i] = int(i);
    std::vector<double> value(rest.size());
    for (size_t i = 0; i < rest.size(); ++i)
        value[i] = ear_quality(p, rest, i);

    Triangles triangles;
    while (rest.size() > 3) {
        const size_t n = rest.size(), i = size_t(std::max_element(value.begin(), value.end()) - value.begin());
        if (!(value[i] > flat))
            return {};
        triangles.push_back({rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]});
        rest.erase(rest.begin() + long(i));
        value.erase(value.begin() + long(i));
        for (const size_t j : {(i + n - 2) % (n - 1), i % (n - 1)})
            value[j] = ear_quality(p, rest, j);
        // A corner stops blocking others only when it is cut off, and then only ears near it: look
        // again at those at 0.
        for (size_t j = 0; j < rest.size(); ++j)
            if (value[j] == 0)
                value[j] = ear_quality(p, rest, j);
    }
    if (doubled_area(p[size_t(rest[0])], p[size_t(rest[1])], p[size_t(rest[2])]) < 0)
        return {};
    triangles.push_back({rest[0], rest[1], rest[2]});
    return triangles;
}

/// Of a polygon that does not cross itself, those whose least angle is largest. Triangles none of
/// which is turned over do not overlap then.
Triangles best_triangles(const std::vector<Vector2d>& p)
{
    const Triangulation best = least_triangulation(
        p.size(), -1, [](size_t, size_t) { return true; },
        [&](size_t i, size_t k, size_t j) { return -quality(p[i], p[k], p[j]); },
        [](double a, double b, double c) {
            return std::max({a, b, c});
        });
    return -best.cost > flat ? best.triangles : Triangles{};
}

} // namespace

std::vector<std::array<int, 3>> split_polygon(std::span<const Eigen::Vector3d> corners)
{
    const int n = int(corners.size());
    const Vector3d normal = newell_normal(corners);
    const double no_area = flat * std::pow(longest_edge(corners), 2);
    if (n == 3)
        return {{0, 1, 2}};
    if (!(normal.norm() > no_area)) {
        Triangles fan;
        for (int i = 1; i + 1 < n; ++i) {
            const std::array<Vector3d, 3> part = {corners[0], corners[size_t(i)], corners[size_t(i) + 1]};
            if (newell_normal(part).norm() > no_area)
                return {}; // a figure of eight: its two halves cancel
            fan.push_back({0, i, i + 1});
        }
        return fan;
    }
    const std::vector<Vector2d> plane = project(corners, normal.normalized());
    if (n == 4)
        return split_quad(corners, plane);
    const Triangles ears = clip_ears(plane); // none if it crosses itself
    constexpr int few = 32;                  // corners; the work grows with their third power, here
                                             // to 0.1 ms
    const Triangles best = !ears.empty() && n <= few ? best_triangles(plane) : Triangles{};
    return best.empty() ? ears : best;
}

} // namespace spia
