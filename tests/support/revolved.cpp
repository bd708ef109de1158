#include "tests/support/revolved.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include "engine/core/error.h"
#include "tests/support/profile.h"
#include "tests/support/rings.h"

namespace spia::shapes {
namespace {

using std::numbers::pi;

constexpr double radians(double degrees) { return degrees * pi / 180; }

/// A meridian of any kind: a point (r, z) for every arc length, and the arc lengths that must
/// become rows of vertices.
struct Meridian {
    std::function<Eigen::Vector2d(double s)> at;
    std::vector<double> rows; ///< ascending, first and last included
};

std::vector<double> row_positions(const Meridian& meridian, double edge)
{
    const double height = edge * std::sqrt(3.0) / 2; // of an equilateral triangle
    std::vector<double> s = {meridian.rows.front()};
    for (size_t k = 1; k < meridian.rows.size(); ++k) {
        const double from = meridian.rows[k - 1], to = meridian.rows[k];
        const int n = std::max(1, int(std::lround((to - from) / height)));
        for (int i = 1; i <= n; ++i)
            s.push_back(from + (to - from) * i / n);
    }
    return s;
}

AxisymmetricPart revolve(const Meridian& meridian, int triangles)
{
    const double length = meridian.rows.back() - meridian.rows.front();
    double area = 0; // only roughly
    for (int i = 0; i < 1000; ++i)
        area += 2 * pi * length / 1000 * meridian.at(meridian.rows.front() + (i + 0.5) / 1000 * length).x();
    // of equilateral triangles
    const double edge = std::sqrt(4 / std::sqrt(3.0) * area / triangles);
    const std::vector<RingPlan> plan =
        plan_rings(row_positions(meridian, edge), edge, 1, meridian.at, [](double r) { return 2 * pi * r; });

    std::vector<Eigen::Matrix3Xd> rings;
    std::vector<double> arc_length;
    for (const RingPlan& row : plan) {
        const Eigen::Vector2d rz = meridian.at(row.s);
        const double r = row.points > 1 ? rz.x() : 0; // files write the pole as 3e-15
        Eigen::Matrix3Xd ring(3, row.points);
        for (int i = 0; i < row.points; ++i) {
            const double angle = 2 * pi * (i + row.phase) / row.points;
            ring.col(i) << r * std::cos(angle), r * std::sin(angle), rz.y();
        }
        rings.push_back(std::move(ring));
        arc_length.insert(arc_length.end(), row.points, row.s);
    }
    AxisymmetricPart part{stitch_rings(rings), Eigen::VectorXd::Map(arc_length.data(), arc_length.size()), {}};
    for (int i = int(rings.back().cols()); i > 0; --i)
        part.rim.push_back(part.mesh.vertices() - i);
    return part;
}

Meridian meridian_of(const Profile& profile)
{
    Meridian meridian{[profile](double s) { return profile.at(s); }, {0}};
    for (const Profile::Piece& piece : profile.pieces())
        meridian.rows.push_back(piece.to);
    return meridian;
}

Profile profile_of(const Dome& shape)
{
    const double angle = radians(shape.wall_angle_deg);
    const double height = (shape.radius + shape.die_radius) * (1 - std::cos(angle));
    return Profile({0, height}, 0)
        .bend(shape.radius, -angle)
        .bend(shape.die_radius, angle)
        .straight(shape.flange_width);
}

} // namespace

AxisymmetricPart axisymmetric(const Eigen::Matrix2Xd& points, int triangles)
{
    std::vector<double> s = {0};
    Meridian meridian;
    meridian.rows = {0};
    for (int i = 1; i < points.cols(); ++i) {
        const Eigen::Vector2d step = points.col(i) - points.col(i - 1);
        s.push_back(s.back() + step.norm());
        if (i + 1 < points.cols()) {
            const Eigen::Vector2d next = points.col(i + 1) - points.col(i);
            if (step.normalized().dot(next.normalized()) < std::cos(radians(20)))
                meridian.rows.push_back(s.back());
        }
    }
    meridian.rows.push_back(s.back());
    meridian.at = [&](double where) -> Eigen::Vector2d {
        const auto above = std::upper_bound(s.begin() + 1, s.end() - 1, where);
        const auto i = above - s.begin();
        const double t = (where - s[i - 1]) / (s[i] - s[i - 1]);
        return (1 - t) * points.col(i - 1) + t * points.col(i);
    };
    return revolve(meridian, triangles);
}

Eigen::Matrix2Xd read_meridian(const std::filesystem::path& file)
{
    std::ifstream in(file);
    if (!in)
        throw InputError(fmt::format("{} cannot be opened", file.string()));
    std::string line;
    std::getline(in, line); // the names of the columns
    std::vector<double> values;
    for (int number = 2; std::getline(in, line); ++number) {
        double r = 0, z = 0;
        if (std::sscanf(line.c_str(), "%lf,%lf", &r, &z) != 2)
            throw InputError(fmt::format("{} line {}: expected two numbers r,z", file.string(), number));
        values.insert(values.end(), {r, z});
    }
    return Eigen::Matrix2Xd::Map(values.data(), 2, Eigen::Index(values.size() / 2));
}

double SharpCup::area() const { return pi * radius * radius + 2 * pi * radius * height; }

AxisymmetricPart sharp_cup(const SharpCup& shape)
{
    Eigen::Matrix2Xd meridian(2, 3);
    meridian << 0, shape.radius, shape.radius, /**/ 0, 0, -shape.height;
    return axisymmetric(meridian, shape.triangles);
}

double Dome::area() const
{
    const double angle = radians(wall_angle_deg), s = std::sin(angle), c = std::cos(angle);
    const double foot = (radius + die_radius) * s; // where the flange begins
    const double cap = 2 * pi * radius * radius * (1 - c);
    const double die = 2 * pi * die_radius * (foot * angle - die_radius * (1 - c)); // Pappus
    return cap + die + pi * flange_width * (2 * foot + flange_width);
}

AxisymmetricPart dome(const Dome& shape) { return revolve(meridian_of(profile_of(shape)), shape.triangles); }

double SphereCap::area() const { return 2 * pi * radius * radius * (1 - std::cos(radians(half_angle_deg))); }

AxisymmetricPart sphere_cap(const SphereCap& shape)
{
    const double angle = radians(shape.half_angle_deg);
    const double height = shape.radius * (1 - std::cos(angle));
    return revolve(meridian_of(Profile({0, height}, 0).bend(shape.radius, -angle)), shape.triangles);
}

} // namespace spia::shapes
