#include "tests/support/developable.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/parametric_mesh.h"
#include "tests/support/profile.h"

namespace spia::shapes {
namespace {

using std::numbers::pi;

/// Parameters along the generators of a strip mesh: 0, 1, ..., rows on every other one, 0, 1/2,
/// 3/2, ..., rows on the ones between, so that inner triangles can be equilateral.
std::vector<double> generator_points(int column, int rows)
{
    std::vector<double> t = {0};
    for (int i = 0; i < rows; ++i)
        t.push_back(column % 2 ? i + 0.5 : i + 1);
    if (column % 2)
        t.push_back(rows);
    return t;
}

/// Triangles between `columns` + 1 generators, each with its generator_points. Turning from the
/// direction of growing column to that of growing t is counter-clockwise.
/// @param place  place(column, t, x, flat) sets the position in space and in the plane
template <class Place> DevelopablePart strips(int columns, int rows, const Place& place)
{
    std::vector<std::vector<double>> t;
    std::vector<int> first = {0};
    for (int c = 0; c <= columns; ++c) {
        t.push_back(generator_points(c, rows));
        first.push_back(first.back() + int(t.back().size()));
    }
    DevelopablePart part;
    part.mesh.position.resize(3, first.back());
    part.flat.resize(2, first.back());
    for (int c = 0; c <= columns; ++c)
        for (size_t i = 0; i < t[c].size(); ++i) {
            const int v = first[c] + int(i);
            place(c, t[c][i], part.mesh.position.col(v), part.flat.col(v));
        }
    part.mesh.triangle.resize(3, columns * (2 * rows + 1));
    int f = 0;
    for (int c = 0; c < columns; ++c) {
        int i = 0, j = 0; // walk along both generators, and always cut off the corner that lies
                          // behind
        const int last_i = int(t[c].size()) - 1, last_j = int(t[c + 1].size()) - 1;
        while (i < last_i || j < last_j) {
            const int a = first[c] + i, b = first[c + 1] + j;
            if (j == last_j || (i < last_i && t[c][i] + t[c][i + 1] < t[c + 1][j] + t[c + 1][j + 1])) {
                part.mesh.triangle.col(f++) << a, b, a + 1;
                ++i;
            } else {
                part.mesh.triangle.col(f++) << a, b, b + 1;
                ++j;
            }
        }
    }
    return part;
}

Profile profile_of(const HatChannel& shape)
{
    const double angle = shape.angle_deg * pi / 180;
    return Profile({0, 0}, 0)
        .straight(shape.flange)
        .bend(shape.radius, angle)
        .straight(shape.wall)
        .bend(shape.radius, -angle)
        .straight(shape.top)
        .bend(shape.radius, -angle)
        .straight(shape.wall)
        .bend(shape.radius, angle)
        .straight(shape.flange);
}

} // namespace

DevelopablePart extruded(const Profile& profile, double length, int triangles)
{
    const double edge = std::sqrt(4 / std::sqrt(3.0) * profile.length() * length / triangles);
    const std::vector<double> s = even_spacing(profile, edge * std::sqrt(3.0) / 2);
    const int columns = int(s.size()) - 1;
    const int rows = std::max(1, int(std::lround((double(triangles) / columns - 1) / 2)));
    std::vector<Eigen::Vector2d> point;
    std::vector<double> chords = {0};
    for (double where : s) {
        point.push_back(profile.at(where));
        if (point.size() > 1)
            chords.push_back(chords.back() + (point.back() - point[point.size() - 2]).norm());
    }
    return strips(columns, rows, [&](int c, double t, auto x, auto flat) {
        const double y = length * t / rows;
        x << point[c].x(), y, point[c].y();
        flat << chords[c], y;
    });
}

DevelopablePart quarter_cylinder(const QuarterCylinder& shape)
{
    return extruded(Profile({0, shape.radius}, 0).bend(shape.radius, -pi / 2), shape.length, shape.triangles);
}

DevelopablePart cone_sector(const ConeSector& shape)
{
    const double sector = shape.sector_deg * pi / 180, half_angle = shape.half_angle_deg * pi / 180;
    const double ratio = shape.far / shape.near;
    // Rows at geometric distances keep the triangles similar: `columns` strips of the angle sqrt(3)
    // / 2 ln(ratio) / rows.
    const double columns_per_row = sector * std::sin(half_angle) / (std::sqrt(3.0) / 2 * std::log(ratio));
    const int columns = std::max(2, int(std::lround(std::sqrt(shape.triangles * columns_per_row / 2))));
    const int rows = std::max(1, int(std::lround((double(shape.triangles) / columns - 1) / 2)));
    const auto generator = [&](int c) {
        const double azimuth = sector * (columns - c) / columns;
        return Eigen::Vector3d(std::sin(half_angle) * std::cos(azimuth), std::sin(half_angle) * std::sin(azimuth),
                               -std::cos(half_angle));
    };
    const double strip_angle = 2 * std::asin((generator(1) - generator(0)).norm() / 2);
    return strips(columns, rows, [&](int c, double t, auto x, auto flat) {
        const double s = shape.near * std::pow(ratio, t / rows);
        x = s * generator(c);
        flat << s * std::cos(strip_angle * (columns - c)), s * std::sin(strip_angle * (columns - c));
    });
}

DevelopablePart hat_channel(const HatChannel& shape)
{
    return extruded(profile_of(shape), shape.length, shape.triangles);
}

DevelopablePart bent_flange(const BentFlange& shape)
{
    return extruded(
        Profile({0, 0}, 0).straight(shape.base).bend(shape.radius, shape.angle_deg * pi / 180).straight(shape.flange),
        shape.length, shape.triangles);
}

DevelopablePart hemmed_flange(const HemmedFlange& shape)
{
    return extruded(Profile({0, 0}, 0)
                        .straight(shape.base)
                        .bend(shape.radius, pi / 2)
                        .straight(shape.wall)
                        .bend(shape.hem_radius, pi)
                        .straight(shape.lip),
                    shape.length, shape.triangles);
}

DevelopablePart lipped_channel(const LippedChannel& shape)
{
    Profile profile({0, 0}, -pi / 2);
    for (double flat : {shape.lip, shape.flange, shape.wall, shape.top, shape.wall, shape.flange})
        profile.straight(flat).bend(shape.radius, -pi / 2);
    return extruded(profile.straight(shape.lip), shape.length, shape.triangles);
}

DevelopablePart perforated_channel(const PerforatedChannel& shape)
{
    const Profile profile = profile_of(shape.channel);
    const auto middle = [&](int piece) { return (profile.pieces()[piece].from + profile.pieces()[piece].to) / 2; };
    std::vector<Circle> holes;
    for (int i = 0; i < shape.holes_per_row; ++i)
        for (int piece : {4, 6, 3}) // top, right wall, left upper bend
            holes.push_back(
                {{middle(piece), shape.channel.length * (i + (piece == 3 ? 0.35 : 0.6)) / shape.holes_per_row},
                 shape.hole_radius});
    const Eigen::Vector2d size(profile.length(), shape.channel.length);
    ParametricMesh rolled = mesh_surface(
        perforated({0, 0}, size, holes),
        [&](const Eigen::Vector2d& p) {
            const Eigen::Vector2d xz = profile.at(p.x());
            return Eigen::Vector3d(xz.x(), p.y(), xz.y());
        },
        shape.channel.triangles, edges_around(holes));
    return {std::move(rolled.mesh), std::move(rolled.parameter)};
}

} // namespace spia::shapes
