#include "engine/mesh/orient2d.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace spia {
namespace {

using Wide = __int128;

/// The sign of the determinant of whole-numbered coordinates below 2^60, in 128 bits: nothing is
/// rounded.
int whole_sign(const std::array<long, 6>& p)
{
    const Wide det = (Wide(p[0]) - p[4]) * (Wide(p[3]) - p[5]) - (Wide(p[1]) - p[5]) * (Wide(p[2]) - p[4]);
    return det > 0 ? 1 : det < 0 ? -1 : 0;
}

int sign_of(const std::array<long, 6>& p, double scale)
{
    const auto at = [&](size_t i) -> Eigen::Vector2d {
        return scale * Eigen::Vector2d(double(p[i]), double(p[i + 1]));
    };
    return orient2d(at(0), at(2), at(4));
}

int rounded_sign(const std::array<long, 6>& p, double scale)
{
    const auto at = [&](size_t i) { return scale * double(p[i]); };
    const double det = (at(0) - at(4)) * (at(3) - at(5)) - (at(1) - at(5)) * (at(2) - at(4));
    return det > 0 ? 1 : det < 0 ? -1 : 0;
}

} // namespace

TEST(Orient2d, IsLeftRightAndOnTheLine)
{
    EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0.5, 1e-300}), 1);
    EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0.5, -1e-300}), -1);
    EXPECT_EQ(orient2d({0, 0}, {1, 0}, {7, 0}), 0);
    EXPECT_EQ(orient2d({3, 4}, {3, 4}, {7, 0}), 0);
    EXPECT_EQ(orient2d({0, 0}, {1, 0}, {std::numeric_limits<double>::quiet_NaN(), 1}), 0);
    EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, std::numeric_limits<double>::infinity()}), 0);
}

TEST(Orient2d, OfWholeNumbersIsTheSignIn128Bits)
{
    // Points on and beside a line of 52 bits: the determinant is a few units among products of 104
    // bits.
    std::mt19937_64 random(7);
    int corrected = 0;
    for (int i = 0; i < 200000; ++i) {
        const auto number = [&](int bits) { return long(random() >> (64 - bits)) - (1L << (bits - 1)); };
        const long ax = number(52), ay = number(52), dx = number(24), dy = number(24);
        const long s = number(26), t = number(26);
        std::array<long, 6> p = {ax, ay, ax + s * dx, ay + s * dy, ax + t * dx, ay + t * dy};
        p[random() % 6] += long(random() % 3) - 1;
        for (const double scale : {1.0, 0x1p-60, 0x1p200}) {
            ASSERT_EQ(sign_of(p, scale), whole_sign(p)) << i;
            corrected += rounded_sign(p, scale) != whole_sign(p);
        }
        const std::array<long, 6> turned = {p[2], p[3], p[4], p[5], p[0], p[1]};
        const std::array<long, 6> mirrored = {p[2], p[3], p[0], p[1], p[4], p[5]};
        ASSERT_EQ(sign_of(turned, 1), whole_sign(p));
        ASSERT_EQ(sign_of(mirrored, 1), -whole_sign(p));
    }
    EXPECT_GT(corrected, 300); // else the test tests nothing
}

TEST(Orient2d, OfNeighbouringDoublesIsTheOneOfTheirIntegers)
{
    // The example of Kettner et al. (Classroom examples of robustness problems in geometric
    // computations, 2008): points one unit in the last place apart around (0.5, 0.5), against a
    // line from (12, 12) to (24, 24). Times 2^53 all are whole.
    int corrected = 0;
    for (int i = 0; i < 256; ++i)
        for (int j = 0; j < 256; ++j) {
            const Eigen::Vector2d p(0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53);
            const int exact = i < j ? 1 : i > j ? -1 : 0; // above or below the diagonal
            ASSERT_EQ(orient2d(Eigen::Vector2d(12, 12), Eigen::Vector2d(24, 24), p), exact);
            const double det = (12 - p[0]) * (24 - p[1]) - (12 - p[1]) * (24 - p[0]);
            corrected += (det > 0) - (det < 0) != exact;
        }
    EXPECT_GT(corrected, 1000);
}

TEST(Orient2d, OfOrdersOfMagnitudeApartIsExact)
{
    // (1, 1) against the line through (0, 0) and (1 + e, 1): only the last bit decides, at any
    // scale of the point a.
    const double e = std::numeric_limits<double>::epsilon();
    EXPECT_EQ(orient2d({0, 0}, {1 + e, 1}, {1, 1}), 1);
    EXPECT_EQ(orient2d({0, 0}, {1, 1 + e}, {1, 1}), -1);
    EXPECT_EQ(orient2d({-1e30, -1e30}, {1, 1}, {1, 1 + e}), 1);
    EXPECT_EQ(orient2d({-1e30, -1e30}, {1, 1}, {1e-30, 0}), -1);
    EXPECT_EQ(orient2d({-1e30, -1e30}, {1, 1}, {-1e-30, 0}), 1);
    EXPECT_EQ(orient2d({-1e30, -1e30}, {1e30, 1e30}, {1e-100, 1e-100}), 0);
}

} // namespace spia
