#include "tests/support/cad/random_bent_solid.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "engine/core/angle.h"
#include "tests/support/seeded_random.h"

namespace spia::shapes {
namespace {

/// Whether the section keeps clear of itself: by a tenth of its thickness at least.
bool clear(const BentSolid& solid)
{
    const Profile profile = middle_line(solid);
    const double t = solid.thickness, step = t / 4;
    std::vector<Eigen::Vector2d> at;
    for (double s = 0; s < profile.length(); s += step)
        at.push_back(profile.at(s));
    at.push_back(profile.at(profile.length()));
    if (at.size() > 4000)
        return false;
    for (size_t i = 0; i < at.size(); ++i)
        for (size_t j = i + size_t(2 * t / step); j < at.size(); ++j)
            if ((at[i] - at[j]).norm() < 1.1 * t)
                return false;
    return true;
}

double even_in_logarithm(SeededRandom& random, double low, double high)
{
    return low * std::pow(high / low, random.between(0, 1));
}

BentSolid drawn(SeededRandom& random)
{
    static const char* const kinds[] = {"bracket", "Z", "channel", "hat", "hem", "knuckle"};
    BentSolid solid;
    solid.kind = kinds[random.whole(0, 5)];
    solid.thickness = even_in_logarithm(random, 0.4, 6);
    const double t = solid.thickness;
    const auto radius = [&] { return t * even_in_logarithm(random, 0.1, 20); };
    const auto angle = [&](double low, double high) { return radians_per_degree * random.between(low, high); };
    const auto leg = [&] { return t * even_in_logarithm(random, 4, 40); };
    const double way = random.coin() ? 1 : -1;
    const auto bends = [&](std::initializer_list<double> signs, double low, double high) {
        for (const double sign : signs)
            solid.bend.push_back({radius(), way * sign * angle(low, high)});
    };
    if (solid.kind == "bracket")
        bends({1}, 1, 150);
    else if (solid.kind == "Z")
        bends({1, -1}, 20, 120);
    else if (solid.kind == "channel")
        bends({1, 1}, 45, 100);
    else if (solid.kind == "hat")
        bends({1, -1, -1, 1}, 45, 100);
    else if (solid.kind == "hem") {
        if (random.coin())
            bends({1}, 30, 90);
        solid.bend.push_back({t * even_in_logarithm(random, 0.1, 3), way * std::numbers::pi});
    } else { // a knuckle: curled on one after the other
        const int count = random.whole(3, 8);
        for (int b = 0; b < count; ++b)
            solid.bend.push_back({radius(), way * angle(1, 180. / count + 25)});
    }
    for (size_t b = 0; b <= solid.bend.size(); ++b)
        solid.leg.push_back(leg());
    solid.width = t * even_in_logarithm(random, 15, 60);
    // Drilled after bending; through a sharper bend it would be a slit along the sheet.
    solid.hole = random.whole(0, 2) == 0 && std::abs(solid.bend[0].angle) < 80 * radians_per_degree;
    return solid;
}

/// Small enough for the prism to leave the legs' ends and the other bends alone.
BendCut drawn_cut(SeededRandom& random, const BentSolid& solid, int bend)
{
    const SolidBend& at = solid.bend[size_t(bend)];
    const double t = solid.thickness, width = solid.width, outer = at.inner_radius + t;
    const double most = std::min(0.25 * width, 0.6 * outer + t);
    BendCut cut;
    cut.bend = bend;
    cut.share = random.coin()   ? random.between(0, 1)
                : random.coin() ? random.between(-0.1, 0.1)
                                : random.between(0.9, 1.1);
    cut.y = random.between(0.3, 0.7) * width;
    const double size = even_in_logarithm(random, 0.3 * most, most);
    const auto outlined = [&](double length, double across, double radius) {
        cut.outline.length = length;
        cut.outline.width = across;
        cut.outline.radius = radius;
    };
    switch (random.whole(0, 5)) {
    case 0: outlined(size, size, size / 2); break;
    case 1: outlined(size, 1.8 * size, size / 2); break; // along the bend
    case 2: outlined(1.5 * size, 0.8 * size, 0.4 * size); break;
    case 3:
        outlined(size, size, size / 2);
        cut.lean = random.between(-0.5, 0.5);
        break;
    case 4:
        outlined(size, size, 0);
        cut.y = random.coin() ? 0 : width;
        break;
    default:
        outlined(size, size, 0);
        cut.outline.turn = 45 * radians_per_degree;
        cut.y = random.coin() ? 0 : width;
    }
    return cut;
}

/// The first that is clear of itself.
template <class Draw> BentSolid first_clear(std::uint64_t seed, const Draw& draw)
{
    SeededRandom random(seed);
    for (;;)
        if (BentSolid solid = draw(random); clear(solid))
            return solid;
}

BentSolid drawn_with_cut_bends(SeededRandom& random)
{
    BentSolid solid;
    solid.kind = "cut bends";
    solid.thickness = even_in_logarithm(random, 0.5, 4);
    const int bends = random.whole(1, 3);
    double way = random.coin() ? 1 : -1, largest = 0;
    for (int b = 0; b < bends; ++b) {
        solid.bend.push_back(
            {solid.thickness * even_in_logarithm(random, 0.3, 10), way * radians_per_degree * random.between(20, 110)});
        largest = std::max(largest, solid.bend.back().inner_radius + solid.thickness);
        way = random.coin() ? way : -way;
    }
    for (int b = 0; b <= bends; ++b) // clear of the prisms through the bends beside it
        solid.leg.push_back(largest * random.between(3, 6));
    solid.width = largest * random.between(4, 10);
    for (int b = 0; b < bends; ++b)
        solid.bend_cut.push_back(drawn_cut(random, solid, b));
    return solid;
}

BentSolid drawn_with_a_wide_hole(SeededRandom& random)
{
    BentSolid solid;
    solid.kind = "wide hole";
    const double t = solid.thickness = even_in_logarithm(random, 0.5, 4);
    solid.bend.push_back({t * even_in_logarithm(random, 0.2, 1),
                          (random.coin() ? 1 : -1) * radians_per_degree * random.between(30, 125)});
    const double radius = solid.bend[0].inner_radius + t / 2,
                 chord = 2 * radius * std::sin(std::abs(solid.bend[0].angle) / 2), d = chord * random.between(0.6, 1.6);
    for (int leg = 0; leg < 2; ++leg)
        solid.leg.push_back((d + 2 * t) * random.between(3, 6));
    solid.width = (d + t) * random.between(3, 8);
    BendCut cut;
    cut.share = random.between(0.35, 0.65);
    cut.y = random.between(0.35, 0.65) * solid.width;
    cut.outline.length = cut.outline.width = d;
    cut.outline.radius = d / 2;
    solid.bend_cut.push_back(cut);
    return solid;
}

} // namespace

BentSolid random_bent_solid(std::uint64_t seed) { return first_clear(seed, drawn); }

BentSolid random_cut_bends(std::uint64_t seed)
{
    BentSolid solid = first_clear(seed, drawn_with_cut_bends);
    solid.pose = seed;
    return solid;
}

BentSolid random_wide_hole(std::uint64_t seed)
{
    BentSolid solid = first_clear(seed, drawn_with_a_wide_hole);
    solid.pose = seed;
    return solid;
}

BentSolid random_embossed_bracket(std::uint64_t seed)
{
    SeededRandom random(seed);
    for (;;) {
        BentSolid solid;
        const double t = solid.thickness = even_in_logarithm(random, 0.6, 3);
        const int kind = random.whole(0, 2); // a bracket, a channel or Z, a joggle
        static const char* const kinds[] = {"bracket", "two bends", "joggle"};
        solid.kind = kinds[kind];
        const double way = random.coin() ? 1 : -1, same = random.coin() ? 1 : -1,
                     angle = radians_per_degree * random.between(kind == 2 ? 25 : 30, kind == 2 ? 60 : 110);
        solid.bend.push_back({t * even_in_logarithm(random, 0.5, 5), way * angle});
        if (kind > 0)
            solid.bend.push_back(
                {t * even_in_logarithm(random, 0.5, 5),
                 kind == 2 ? -way * angle : way * same * radians_per_degree * random.between(30, 100)});
        const double size = t * random.between(36, 50); // an emboss reaches 13 thicknesses
        for (size_t b = 0; b <= solid.bend.size(); ++b)
            solid.leg.push_back(kind == 2 && b == 1 ? t * random.between(2, 5) : size * random.between(1, 1.5));
        solid.width = size * random.between(1.2, 2);
        for (size_t b = 0; b <= solid.bend.size(); ++b) {
            if ((kind == 2 && b == 1) || (b > 0 && random.coin()))
                continue;
            Emboss emboss;
            emboss.leg = int(b);
            emboss.radius = t * random.between(1.2, 2.5);
            emboss.slope = radians_per_degree * random.between(20, 50);
            emboss.flat = t * random.between(1.5, 4);
            emboss.ramp = t * random.between(0.3, 1.5);
            emboss.left = random.coin();
            emboss.length = random.coin() ? t * random.between(4, 8) : 0;
            emboss.turn = radians_per_degree * random.between(-90, 90);
            emboss.centre = {solid.leg[b] * random.between(0.48, 0.52), solid.width * random.between(0.45, 0.55)};
            solid.emboss.push_back(emboss);
        }
        solid.pose = seed;
        if (clear(solid))
            return solid;
    }
}

} // namespace spia::shapes
