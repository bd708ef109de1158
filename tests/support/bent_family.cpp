#include "tests/support/bent_family.h"

#include <cmath>
#include <numbers>

#include "tests/support/bent_parts.h"
#include "tests/support/lots.h"
#include "tests/support/mesh_tools.h"

namespace spia::shapes {
namespace {

using std::numbers::pi;

BentPart bent(const Profile& profile, double length, int triangles)
{
    DevelopablePart part = extruded(profile, length, triangles);
    return {std::move(part.mesh), std::move(part.flat), true};
}

// Each maker draws its measures from the lots, one after the other (not as arguments of one call, whose order is not set), and
// makes one part of about n triangles.

BentPart hem(Lots& lots, int n)
{
    const double length = lots.between(40, 120);
    const double wall = lots.between(15, 40);
    return bent(Profile({0, 0}, 0)
                    .straight(lots.between(30, 80))
                    .bend(lots.between(2, 6), pi / 2)
                    .straight(wall)
                    .bend(lots.between(0.3, 1.5), pi)
                    .straight(lots.between(0.3, 0.8) * wall),
                length, n);
}

/// Folded to and fro, flat upon itself, as an S or with one fold within the other.
BentPart double_return(Lots& lots, int n)
{
    const double length = lots.between(40, 120);
    const double first = lots.between(30, 60), radius = lots.between(0.6, 2);
    const double sense = lots.coin() ? 1 : -1;
    return bent(Profile({0, 0}, 0)
                    .straight(first)
                    .bend(2.5 * radius, pi)
                    .straight(lots.between(0.6, 0.9) * first)
                    .bend(radius, sense * pi)
                    .straight(lots.between(0.3, 0.5) * first),
                length, n);
}

/// Rolled up in right angles, neighbouring turns a gap apart.
BentPart angular_spiral(Lots& lots, int n)
{
    const double length = lots.between(40, 100);
    const double radius = lots.between(1, 3), gap = lots.between(6, 10);
    double side = lots.between(60, 80);
    Profile profile({0, 0}, 0);
    const int sides = lots.whole(7, 11);
    for (int k = 0; k < sides; ++k) {
        profile.straight(side);
        if (k + 1 < sides)
            profile.bend(radius, pi / 2);
        side -= k % 2 == 1 ? gap : 0;
    }
    return bent(profile, length, n);
}

/// Rolled up in quarters of circles that get smaller.
BentPart round_spiral(Lots& lots, int n)
{
    const double length = lots.between(40, 100);
    double radius = lots.between(30, 45);
    Profile profile({0, 0}, 0);
    profile.straight(lots.between(10, 40));
    for (int k = lots.whole(6, 10); k > 0; --k, radius *= 0.85)
        profile.bend(radius, pi / 2);
    return bent(profile, length, n);
}

BentPart box(Lots& lots, int n, bool joined)
{
    const double width = lots.between(70, 120), depth = lots.between(50, 90), height = lots.between(15, 40),
                 lip = lots.between(6, 12);
    const double area = width * depth + 2 * (width + depth) * (height + lip);
    return {lipped_box({.width = width,
                        .depth = depth,
                        .height = height,
                        .lip = lip,
                        .gap = lots.between(11, 14), // walls and lips do not meet when they are laid flat
                        .edge = std::sqrt(2 * area / n),
                        .joined = joined}),
            {},
            !joined};
}

BentPart open_box(Lots& lots, int n) { return box(lots, n, false); }
BentPart closed_box(Lots& lots, int n) { return box(lots, n, true); }

BentPart z_section(Lots& lots, int n)
{
    const double length = lots.between(60, 150);
    const double radius = lots.between(2, 6), angle = lots.between(1.4, 2.4);
    return bent(Profile({0, 0}, 0)
                    .straight(lots.between(20, 50))
                    .bend(radius, angle)
                    .straight(lots.between(20, 50))
                    .bend(radius, -angle)
                    .straight(lots.between(20, 50))
                    .bend(0.5, -pi)
                    .straight(lots.between(8, 15)),
                length, n);
}

/// Its walls lean inwards: seen from above it hides them.
BentPart hat_section(Lots& lots, int n)
{
    DevelopablePart part = hat_channel({.top = lots.between(60, 90),
                                        .wall = lots.between(20, 40),
                                        .flange = lots.between(10, 25),
                                        .radius = lots.between(2, 6),
                                        .angle_deg = lots.between(95, 115),
                                        .length = lots.between(60, 200),
                                        .triangles = n});
    return {std::move(part.mesh), std::move(part.flat), true};
}

BentPart channel_with_lips(Lots& lots, int n)
{
    DevelopablePart part = lipped_channel({.top = lots.between(40, 90),
                                           .wall = lots.between(15, 60),
                                           .flange = lots.between(8, 18),
                                           .lip = lots.between(4, 12),
                                           .radius = lots.between(1, 6),
                                           .length = lots.between(40, 200),
                                           .triangles = n});
    return {std::move(part.mesh), std::move(part.flat), true};
}

BentPart swept_part(const Profile& profile, double angle, int n)
{
    const double middle = profile.at(profile.length() / 2).x();
    return {swept(profile, angle, std::sqrt(2 * profile.length() * middle * angle / n))};
}

/// A wall along an arc, and a flange on its edge that goes on outwards or returns inwards.
BentPart curved_double_flange(Lots& lots, int n)
{
    const double angle = lots.between(0.4, 0.9);
    const double radius = lots.between(2, 5), sense = lots.coin() ? 1 : -1;
    return swept_part(Profile({lots.between(120, 250), 0}, 0)
                          .straight(lots.between(30, 50))
                          .bend(radius, pi / 2)
                          .straight(lots.between(6, 15))
                          .bend(radius, sense * pi / 2)
                          .straight(lots.between(6, 12)),
                      angle, n);
}

/// The same on the inner side of the arc: the wall's edge was stretched.
BentPart curved_stretch_flange(Lots& lots, int n)
{
    const double angle = lots.between(0.4, 0.9);
    const double radius = lots.between(2, 5), sense = lots.coin() ? 1 : -1, arc = lots.between(120, 250);
    // From the free edge to the base, outwards.
    const double wall = lots.between(6, 15), flange = lots.between(6, 12), base = lots.between(30, 50);
    Profile profile = sense > 0 ? Profile({arc - flange, wall}, 0) : Profile({arc + flange, wall}, pi);
    profile.straight(flange).bend(radius, -sense * pi / 2);
    return swept_part(profile.straight(wall).bend(radius, pi / 2).straight(base), angle, n);
}

BentPart curved_hem(Lots& lots, int n)
{
    const double angle = lots.between(0.4, 0.9);
    const double wall = lots.between(12, 20);
    return swept_part(Profile({lots.between(120, 250), 0}, 0)
                          .straight(lots.between(30, 50))
                          .bend(lots.between(2, 4), pi / 2)
                          .straight(wall)
                          .bend(lots.between(0.6, 1.2), pi)
                          .straight(lots.between(0.4, 0.6) * wall),
                      angle, n);
}

} // namespace

std::vector<BentShape> bent_family(int triangles, std::uint64_t seed)
{
    struct Maker {
        const char* family;
        BentPart (*make)(Lots&, int);
        int count;
    };
    constexpr Maker makers[] = {{"hem", hem, 4},
                                {"double return", double_return, 4},
                                {"angular spiral", angular_spiral, 3},
                                {"round spiral", round_spiral, 3},
                                {"open box with lips", open_box, 3},
                                {"closed box with lips", closed_box, 3},
                                {"Z section, hemmed", z_section, 4},
                                {"hat section, undercut", hat_section, 3},
                                {"channel with lips", channel_with_lips, 3},
                                {"curved double flange", curved_double_flange, 4},
                                {"curved stretch flange", curved_stretch_flange, 4},
                                {"curved hem", curved_hem, 3}};
    std::vector<BentShape> shapes;
    for (size_t m = 0; m < std::size(makers); ++m)
        for (int k = 0; k < makers[m].count; ++k) {
            const std::uint64_t own = (seed * 1000 + m) * 1000 + std::uint64_t(k);
            const auto make = [own, triangles, maker = makers[m].make] {
                Lots lots(own);
                BentPart part = maker(lots, triangles);
                part.mesh = transformed(part.mesh, random_rotation(own), Eigen::Vector3d(30, -20, 50));
                return part;
            };
            shapes.push_back({makers[m].family, k, make});
        }
    return shapes;
}

} // namespace spia::shapes
