#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/file_content.h"
#include "engine/pipeline/session.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/support/family.h"
#include "tests/support/seeded_random.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

/// Bends of solids whose file has few digits of its corners.
namespace spia::rounded_bends_test {
namespace {

namespace fs = std::filesystem;
using shapes::BentSolid;
constexpr double degree = std::numbers::pi / 180;

/// As a file of few digits has it.
struct Digits {
    int decimals;    ///< of an ASCII STL; 0: a binary one
    double away = 0; ///< mm, of a binary one from the origin
    double step() const { return decimals > 0 ? std::pow(10., -decimals) : std::pow(2., -10); }
    /// mm, how far a corner may be moved
    double rounding() const { return std::sqrt(3.) / 2 * step(); }
};

using Facet = std::array<float, 12>; ///< its normal and its corners

std::vector<Facet> facets_of(const fs::path& binary)
{
    constexpr size_t header = 84, record = 50;
    const std::string content = file_content(binary);
    std::vector<Facet> facets((content.size() - header) / record);
    for (size_t i = 0; i < facets.size(); ++i)
        std::memcpy(facets[i].data(), content.data() + header + record * i, sizeof(Facet));
    return facets;
}

void write_decimals(const fs::path& file, const std::vector<Facet>& facets, int decimals)
{
    std::ofstream out(file);
    out << "solid part\n";
    for (const Facet& f : facets) {
        out << "facet normal 0 0 0\nouter loop\n";
        for (size_t c = 3; c < f.size(); c += 3)
            out << fmt::format("vertex {:.{}f} {:.{}f} {:.{}f}\n", f[c], decimals, f[c + 1], decimals, f[c + 2],
                               decimals);
        out << "endloop\nendfacet\n";
    }
    out << "endsolid part\n";
}

void write_away(const fs::path& file, std::vector<Facet> facets, double away)
{
    std::ofstream out(file, std::ios::binary);
    const std::string header(80, ' ');
    const auto count = std::uint32_t(facets.size());
    const std::uint16_t attribute = 0;
    out.write(header.data(), long(header.size()));
    out.write(reinterpret_cast<const char*>(&count), sizeof count);
    for (Facet& f : facets) {
        for (size_t c = 3; c < f.size(); ++c)
            f[c] = float(f[c] + away);
        out.write(reinterpret_cast<const char*>(f.data()), sizeof f);
        out.write(reinterpret_cast<const char*>(&attribute), sizeof attribute);
    }
}

/// A bracket or a Z, turned in space: sheet of 0.3 to 3 mm, R/t of 0.5 to 5, 30 to 120 degrees.
BentSolid random_solid(shapes::SeededRandom& random)
{
    BentSolid solid;
    solid.thickness = random.between(0.3, 3);
    const int bends = random.between(0, 1) < 0.6 ? 1 : 2;
    solid.kind = bends == 1 ? "bracket" : "Z";
    for (int b = 0; b < bends; ++b)
        solid.bend.push_back(
            {solid.thickness * random.between(0.5, 5), (b % 2 ? -1 : 1) * random.between(30, 120) * degree});
    for (int b = 0; b <= bends; ++b)
        solid.leg.push_back(random.between(10, 30));
    solid.width = random.between(10, 40);
    solid.pose = std::uint64_t(1 + random.between(0, 1e6));
    solid.away = 20;
    return solid;
}

std::string describe(const BentSolid& solid, const Digits& digits, double chord)
{
    std::string text = digits.decimals ? fmt::format("{} decimals", digits.decimals) : "single precision far away";
    text +=
        fmt::format(", t {:.4g}, width {:.4g}, chords of {:.3g} degrees", solid.thickness, solid.width, chord / degree);
    for (const shapes::SolidBend& bend : solid.bend)
        text += fmt::format("; R {:.4g}, {:.4g} degrees", bend.inner_radius, bend.angle / degree);
    return text;
}

std::string describe(const std::vector<SheetBend>& bends)
{
    std::string rows = fmt::format("among {}:", bends.size());
    for (const SheetBend& bend : bends)
        rows += fmt::format(" R {:.4g}, {:.5g} degrees;", bend.inner_radius, bend.angle / degree);
    return rows;
}

/// What keeps a table from being that of the solid, within what the digits of the file permit;
/// empty: it is.
std::string wrong_row(const Session& session, const BentSolid& solid, const Digits& digits)
{
    const auto& bends = session.bends->bends;
    if (bends.size() != solid.bend.size())
        return describe(bends);
    const double rounding = digits.rounding();
    for (const shapes::SolidBend& made : solid.bend) {
        const double angle = std::abs(made.angle), shortest = *std::ranges::min_element(solid.leg);
        // Flats turn by what both ends of the shorter leg are moved; a radius is told by how far
        // the arc is off its chord.
        const double most_turn = 4 * rounding / shortest + 1e-4;
        const double most_radius = 2 * rounding / (1 - std::cos(angle / 2)) + 1e-4 * made.inner_radius;
        if (std::ranges::none_of(bends, [&](const SheetBend& bend) {
                return std::abs(bend.inner_radius - made.inner_radius) < most_radius &&
                       std::abs(bend.angle - angle) < most_turn;
            }))
            return fmt::format("no R {:.4g} +- {:.2g}, {:.5g} +- {:.2g} degrees {}", made.inner_radius, most_radius,
                               angle / degree, most_turn / degree, describe(bends));
    }
    return {};
}

class RoundedBends : public testing::TestWithParam<std::uint64_t> {
protected:
    void expect(const Digits& digits)
    {
        shapes::SeededRandom random(GetParam());
        const BentSolid solid = random_solid(random);
        const double chord = degree * random.between(3, 20);
        SCOPED_TRACE(describe(solid, digits, chord));
        const fs::path fine = folder_ / "fine.stl", file = folder_ / "part.stl";
        shapes::write_bent_stl(fine, solid, chord);
        if (digits.decimals > 0)
            write_decimals(file, facets_of(fine), digits.decimals);
        else
            write_away(file, facets_of(fine), digits.away);
        try {
            const Session session = solved_part(file);
            const std::string wrong = wrong_row(session, solid, digits);
            // Of the radius and the thickness: finer digits are enough.
            constexpr double of_radius = 0.01, of_thickness = 0.02;
            const double enough = std::ranges::min(solid.bend, {}, &shapes::SolidBend::inner_radius).inner_radius;
            if (2 * digits.rounding() < std::min(of_radius * enough, of_thickness * solid.thickness)) {
                EXPECT_EQ(wrong, "");
            } else if (!wrong.empty()) {
                EXPECT_FALSE(shortcomings(session).empty()) << wrong;
            }
        } catch (const Error& error) {
            EXPECT_EQ(digits.decimals, 2) << error.what();
        }
    }

private:
    ScratchFolder folder_;
};

} // namespace

TEST_P(RoundedBends, OfTwoDecimalsAreRightOrSaid) { expect({2}); }

TEST_P(RoundedBends, OfThreeDecimalsAreRightOrSaid) { expect({3}); }

TEST_P(RoundedBends, OfFourDecimalsAreRight) { expect({4}); }

TEST_P(RoundedBends, OfSinglePrecisionFarFromTheOriginAreRightOrSaid) { expect({0, 1e4}); }

INSTANTIATE_TEST_SUITE_P(Family, RoundedBends, testing::Range<std::uint64_t>(1, 1 + shapes::family_size(90)));

} // namespace spia::rounded_bends_test
