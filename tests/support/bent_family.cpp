#include "tests/support/bent_family.h"

#include <cmath>
#include <numbers>

#include "tests/support/bent_parts.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/seeded_random.h"

namespace spia::shapes {
namespace {

using std::numbers::pi;

BentPart bent(const Profile& profile, double length, int triangles)
{
    DevelopablePart part = extruded(profile, length, triangles);
    return {std::move(part.mesh), std::move(part.flat), true};
}

// Each maker draws its measures at random, one after the other (not as arguments of one call, whose
// order is not set), and makes one part of about n triangles.

BentPart hem(SeededRandom& random, int n)
{
    const double length = random.between(40, 120);
    const double wall = random.between(15, 40);
    return bent(Profile({0, 0}, 0)
                    .straight(random.between(30, 80))
                    .bend(random.between(2, 6), pi / 2)
                    .straight(wall)
                    .bend(random.between(0.3, 1.5), pi)
                    .straight(random.between(0.3, 0.8) * wall),
                length, n);
}

/// Folded to and fro, flat upon itself, as an S or with one fold within the other.
BentPart double_return(SeededRandom& random, int n)
{
    const double length = random.between(40, 120);
    const double first = random.between(30, 60), radius = random.between(0.6, 2);
    const double sense = random.coin() ? 1 : -1;
    return bent(Profile({0, 0}, 0)
                    .straight(first)
                    .bend(2.5 * radius, pi)
                    .straight(random.between(0.6, 0.9) * first)
                    .bend(radius, sense * pi)
                    .straight(random.between(0.3, 0.5) * first),
                length, n);
}

/// Rolled up in right angles, neighbouring turns a gap apart.
BentPart angular_spiral(SeededRandom& random, int n)
{
    const double length = random.between(40, 100);
    const double radius = random.between(1, 3), gap = random.between(6, 10);
    double side = random.between(60, 80);
    Profile profile({0, 0}, 0);
    const int sides = random.whole(7, 11);
    for (int k = 0; k < sides; ++k) {
        profile.straight(side);
        if (k + 1 < sides)
            profile.bend(radius, pi / 2);
        side -= k % 2 == 1 ? gap : 0;
    }
    return bent(profile, length, n);
}

/// Rolled up in quarters of circles that get smaller.
BentPart round_spiral(SeededRandom& random, int n)
{
    const double length = random.between(40, 100);
    double radius = random.between(30, 45);
    Profile profile({0, 0}, 0);
    profile.straight(random.between(10, 40));
    for (int k = random.whole(6, 10); k > 0; --k, radius *= 0.85)
        profile.bend(radius, pi / 2);
    return bent(profile, length, n);
}

BentPart box(SeededRandom& random, int n, bool joined)
{
    const double width = random.between(70, 120), depth = random.between(50, 90), height = random.between(15, 40),
                 lip = random.between(6, 12);
    const double area = width * depth + 2 * (width + depth) * (height + lip);
    return {lipped_box({.width = width,
                        .depth = depth,
                        .height = height,
                        .lip = lip,
                        .gap = random.between(11, 14), // walls and lips do not meet when they are
                                                       // laid flat
                        .edge = std::sqrt(2 * area / n),
                        .joined = joined}),
            {},
            !joined};
}

BentPart open_box(SeededRandom& random, int n) { return box(random, n, false); }
BentPart closed_box(SeededRandom& random, int n) { return box(random, n, true); }

BentPart z_section(SeededRandom& random, int n)
{
    const double length = random.between(60, 150);
    const double radius = random.between(2, 6), angle = random.between(1.4, 2.4);
    return bent(Profile({0, 0}, 0)
                    .straight(random.between(20, 50))
                    .bend(radius, angle)
                    .straight(random.between(20, 50))
                    .bend(radius, -angle)
                    .straight(random.between(20, 50))
                    .bend(0.5, -pi)
                    .straight(random.between(8, 15)),
                length, n);
}

/// Its walls lean inwards: seen from above it hides them.
BentPart hat_section(SeededRandom& random, int n)
{
    DevelopablePart part = hat_channel({.top = random.between(60, 90),
                                        .wall = random.between(20, 40),
                                        .flange = random.between(10, 25),
                                        .radius = random.between(2, 6),
                                        .angle_deg = random.between(95, 115),
                                        .length = random.between(60, 200),
                                        .triangles = n});
    return {std::move(part.mesh), std::move(part.flat), true};
}

BentPart channel_with_lips(SeededRandom& random, int n)
{
    DevelopablePart part = lipped_channel({.top = random.between(40, 90),
                                           .wall = random.between(15, 60),
                                           .flange = random.between(8, 18),
                                           .lip = random.between(4, 12),
                                           .radius = random.between(1, 6),
                                           .length = random.between(40, 200),
                                           .triangles = n});
    return {std::move(part.mesh), std::move(part.flat), true};
}

BentPart swept_part(const Profile& profile, double angle, int n)
{
    const double middle = profile.at(profile.length() / 2).x();
    return {swept(profile, angle, std::sqrt(2 * profile.length() * middle * angle / n))};
}

/// A wall along an arc, and a flange on its edge that goes on outwards or returns inwards.
BentPart curved_double_flange(SeededRandom& random, int n)
{
    const double angle = random.between(0.4, 0.9);
    const double radius = random.between(2, 5), sense = random.coin() ? 1 : -1;
    return swept_part(Profile({random.between(120, 250), 0}, 0)
                          .straight(random.between(30, 50))
                          .bend(radius, pi / 2)
                          .straight(random.between(6, 15))
                          .bend(radius, sense * pi / 2)
                          .straight(random.between(6, 12)),
                      angle, n);
}

/// The same on the inner side of the arc: the wall's edge was stretched.
BentPart curved_stretch_flange(SeededRandom& random, int n)
{
    const double angle = random.between(0.4, 0.9);
    const double radius = random.between(2, 5), sense = random.coin() ? 1 : -1, arc = random.between(120, 250);
    // From the free edge to the base, outwards.
    const double wall = random.between(6, 15), flange = random.between(6, 12), base = random.between(30, 50);
    Profile profile = sense > 0 ? Profile({arc - flange, wall}, 0) : Profile({arc + flange, wall}, pi);
    profile.straight(flange).bend(radius, -sense * pi / 2);
    return swept_part(profile.straight(wall).bend(radius, pi / 2).straight(base), angle, n);
}

BentPart curved_hem(SeededRandom& random, int n)
{
    const double angle = random.between(0.4, 0.9);
    const double wall = random.between(12, 20);
    return swept_part(Profile({random.between(120, 250), 0}, 0)
                          .straight(random.between(30, 50))
                          .bend(random.between(2, 4), pi / 2)
                          .straight(wall)
                          .bend(random.between(0.6, 1.2), pi)
                          .straight(random.between(0.4, 0.6) * wall),
                      angle, n);
}

} // namespace

std::vector<BentShape> bent_family(int triangles, std::uint64_t seed)
{
    struct Maker {
        const char* family;
        BentPart (*make)(SeededRandom&, int);
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
                SeededRandom random(own);
                BentPart part = maker(random, triangles);
                part.mesh = transformed(part.mesh, random_rotation(own), Eigen::Vector3d(30, -20, 50));
                return part;
            };
            shapes.push_back({makers[m].family, k, make});
        }
    return shapes;
}

} // namespace spia::shapes
