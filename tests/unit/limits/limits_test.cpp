#include "engine/limits/limits.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

#include "engine/core/error.h"
#include "engine/forming/material/material_check.h"

namespace spia {
namespace {

using testing::HasSubstr;

/// Triangles in a row, each sharing an edge with the next: vertices 0 2 4 ... below, 1 3 5 ...
/// above, 1 mm apart.
TriMesh row_of(int triangles)
{
    TriMesh mesh;
    mesh.position.resize(3, triangles + 2);
    for (int v = 0; v < triangles + 2; ++v)
        mesh.position.col(v) = Eigen::Vector3d(v / 2, v % 2, 0);
    mesh.triangle.resize(3, triangles);
    for (int f = 0; f < triangles; ++f)
        mesh.triangle.col(f) = Eigen::Vector3i(f, f % 2 ? f + 1 : f + 2, f % 2 ? f + 2 : f + 1);
    return mesh;
}

/// Fields of given logarithmic strains; the thickness follows from the volume.
SheetFields fields_of(const std::vector<std::pair<double, double>>& major_minor)
{
    SheetFields face;
    const auto n = Eigen::Index(major_minor.size());
    face.strain_major.resize(n);
    face.strain_minor.resize(n);
    for (Eigen::Index f = 0; f < n; ++f)
        std::tie(face.strain_major[f], face.strain_minor[f]) = major_minor[size_t(f)];
    face.thinning = 1 - (-face.strain_major - face.strain_minor).array().exp();
    return face;
}

const FormingLimitCurve curve = keeler_brazier(1, 0.21); // FLC0 37.43 %, ln 0.31794

Zone zone_at(double engineering_major, double engineering_minor, const ZoneOptions& options = {})
{
    const SheetFields face = fields_of({{std::log1p(engineering_major), std::log1p(engineering_minor)}});
    return zones(row_of(1), face, &curve, options).zone[0];
}

Material steel() { return {"steel", 206000, 0.3, 7850, Hollomon{530, 0.2}, 1, 1, 1, ""}; }
Material soft_steel() { return {"soft", 206000, 0.3, 7850, Hollomon{530, 0.15}, 1, 1, 1, ""}; }
Material aluminium_of(double density) { return {"alu", 70000, 0.33, density, Hollomon{400, 0.2}, 1, 1, 1, ""}; }

/// Strains all over the plane, of `faces` faces.
SheetFields mixed_fields(int faces)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> of_minor(-0.4, 0.3), further(0, 0.6);
    std::vector<std::pair<double, double>> strains;
    for (int f = 0; f < faces; ++f) {
        const double minor = of_minor(random);
        strains.emplace_back(minor + further(random), minor);
    }
    return fields_of(strains);
}

std::vector<int> first_faces(int count)
{
    std::vector<int> faces(size_t(count), 0);
    std::iota(faces.begin(), faces.end(), 0);
    return faces;
}

} // namespace

TEST(Zones, EveryOneIsReachedAsItIsWritten)
{
    EXPECT_EQ(zone_at(0.40, 0), Zone::crack);
    EXPECT_EQ(zone_at(0.3744, 0), Zone::crack); // 37.43 %
    EXPECT_EQ(zone_at(0.3742, 0), Zone::risk);
    EXPECT_EQ(zone_at(0.3244, 0), Zone::risk); // 5 points below
    EXPECT_EQ(zone_at(0.3242, 0), Zone::marginal);
    EXPECT_EQ(zone_at(0.2744, 0), Zone::marginal); // 10 points below
    EXPECT_EQ(zone_at(0.2744, 0, {.max_thinning = 0.2}), Zone::marginal);
    EXPECT_EQ(zone_at(0.2742, 0), Zone::safe); // thinning 21.5 %
    EXPECT_EQ(zone_at(0.2742, 0, {.max_thinning = 0.2}), Zone::excessive_thinning);
    EXPECT_EQ(zone_at(0.30, 0.15), Zone::excessive_thinning);  // curve at 46.4 %, thinning 33 %
    EXPECT_EQ(zone_at(0.10, -0.20), Zone::strong_thickening);  // 1 / 0.88: 13.6 % thicker
    EXPECT_EQ(zone_at(0.10, -0.15), Zone::wrinkling_tendency); // 1 / 0.935: 7 %
    EXPECT_EQ(zone_at(0.10, -0.15, {.max_thickening = 0.05}), Zone::strong_thickening);
    // 1.1 * 0.9091 = 1.00001: thins a hair
    EXPECT_EQ(zone_at(0.10, -0.0909), Zone::safe);
    EXPECT_EQ(zone_at(0.10, -0.0910), Zone::wrinkling_tendency); // and thickens a hair
    EXPECT_EQ(zone_at(0.019, 0), Zone::low_strain);
    EXPECT_EQ(zone_at(0.019, -0.019), Zone::low_strain);
    EXPECT_EQ(zone_at(0.021, 0), Zone::safe);
    EXPECT_EQ(zone_at(0.010, -0.021), Zone::wrinkling_tendency);
    EXPECT_EQ(zone_at(0.021, 0, {.low_strain = 0.03}), Zone::low_strain);
    EXPECT_EQ(zone_at(0.15, 0), Zone::safe);
}

TEST(Zones, TheMarginIsInPointsOfEngineeringStrainOnBothBranches)
{
    for (const double e2 : {-0.15, 0.0, 0.1}) {
        const double limit = engineering_strain(curve(std::log1p(e2)));
        for (const double margin : {0.05, 0.08, 0.2}) {
            const ZoneOptions options{.margin = margin, .max_thinning = 0.9};
            EXPECT_EQ(zone_at(limit - 1e-6, e2, options), Zone::risk) << e2;
            EXPECT_EQ(zone_at(limit - margin / 2 + 1e-6, e2, options), Zone::risk) << e2;
            EXPECT_EQ(zone_at(limit - margin / 2 - 1e-6, e2, options), Zone::marginal) << e2;
            EXPECT_EQ(zone_at(limit - margin + 1e-6, e2, options), Zone::marginal) << e2;
            EXPECT_EQ(zone_at(limit - margin - 1e-6, e2, options), Zone::safe) << e2;
        }
        // no band
        EXPECT_EQ(zone_at(limit - 1e-6, e2, {.margin = 0, .max_thinning = 0.9}), Zone::safe);
    }
}

TEST(Zones, DistanceIsWhatIsLeftOfTheMajorStrain)
{
    const SheetFields face = fields_of({{std::log(1.3), 0}, {std::log(1.5), 0}, {std::log(1.6), std::log(0.8)}});
    const Zones found = zones(row_of(3), face, &curve);
    EXPECT_NEAR(found.distance[0], 0.0743, 1e-12);
    EXPECT_NEAR(found.distance[1], -0.1257, 1e-12);
    EXPECT_NEAR(found.distance[2], 0.717875 - 0.6, 1e-12);
    const Zones without = zones(row_of(3), face, nullptr);
    EXPECT_EQ(without.distance.size(), 0);
    EXPECT_EQ(without.share[size_t(Zone::crack)].faces + without.share[size_t(Zone::risk)].faces, 0);
    EXPECT_EQ(without.zone[1], Zone::excessive_thinning);
}

TEST(Zones, CountsAndAreasAddUpToThePart)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> of_minor(-0.4, 0.3), further(0, 0.6);
    std::vector<std::pair<double, double>> strains;
    for (int f = 0; f < 4000; ++f) {
        const double minor = f % 5 ? of_minor(random) : 0.03 * of_minor(random);
        strains.emplace_back(minor + (f % 5 ? further(random) : 0), minor);
    }
    const SheetFields face = fields_of(strains);
    const Zones found = zones(row_of(4000), face, &curve);
    int faces = 0;
    double area = 0, share = 0;
    for (const Zone zone : all_zones) {
        const ZoneShare& s = found.share[size_t(zone)];
        EXPECT_EQ(s.faces, std::count(found.zone.begin(), found.zone.end(), zone));
        EXPECT_GT(s.faces, 0) << name(zone);
        EXPECT_NEAR(s.area_mm2, 0.5 * s.faces, 1e-9);
        faces += s.faces;
        area += s.area_mm2;
        share += s.share;
    }
    EXPECT_EQ(faces, 4000);
    EXPECT_NEAR(area, 2000, 1e-9);
    EXPECT_NEAR(share, 1, 1e-12);
}

TEST(Zones, WorstSpotsAreTheWorstFacesOfConnectedRegionsInOrder)
{
    const double l = std::log(1.15); // safe
    // crack at 2..4 (worst 3), crack at 7, risk at 9..10 (worst 9), thinner than allowed at 12,
    // marginal at 14
    std::vector<std::pair<double, double>> strains(15, {l, 0});
    for (const auto& [f, major] : {std::pair{2, 1.40}, {3, 1.50}, {4, 1.45}, {7, 1.60}, {9, 1.36}, {10, 1.33}})
        strains[size_t(f)].first = std::log(major);
    strains[12] = {std::log(1.3), std::log(1.15)};
    strains[14].first = std::log(1.30);
    const TriMesh part = row_of(15);
    const SheetFields face = fields_of(strains);
    const Zones found = zones(part, face, &curve);
    ASSERT_EQ(found.spots.size(), 5u);
    const auto expect = [&](size_t i, Zone zone, int f, int region, double value) {
        EXPECT_EQ(found.spots[i].zone, zone);
        EXPECT_EQ(found.spots[i].face, f);
        EXPECT_EQ(found.spots[i].region_faces, region);
        EXPECT_NEAR(found.spots[i].region_area_mm2, 0.5 * region, 1e-12);
        EXPECT_NEAR(found.spots[i].value, value, 1e-12);
        EXPECT_EQ(found.spots[i].strain_major, face.strain_major[f]);
        const Eigen::Vector3d middle = part.position(Eigen::all, part.triangle.col(f)).rowwise().mean();
        EXPECT_EQ(found.spots[i].position, middle);
    };
    expect(0, Zone::crack, 7, 1, 0.3743 - 0.60);
    expect(1, Zone::crack, 3, 3, 0.3743 - 0.50);
    expect(2, Zone::risk, 9, 2, 0.3743 - 0.36);
    expect(3, Zone::marginal, 14, 1, 0.3743 - 0.30);
    expect(4, Zone::excessive_thinning, 12, 1, 1 - 1 / (1.3 * 1.15));
    EXPECT_EQ(zones(part, face, &curve, {.most_spots = 2}).spots.size(), 2u);
}

TEST(Zones, AVertexHasTheWorstZoneAroundIt)
{
    std::vector<std::pair<double, double>> strains(6, {std::log(1.15), 0});
    strains[2].first = std::log(1.5);
    const TriMesh part = row_of(6);
    const auto at = zones_at_vertices(part, zones(part, fields_of(strains), &curve).zone);
    for (int v = 0; v < part.vertices(); ++v)
        EXPECT_EQ(at[size_t(v)], v >= 2 && v <= 4 ? Zone::crack : Zone::safe) << v;
}

TEST(Zones, NamesDiffer)
{
    std::set<std::string_view> names;
    std::set<std::string> texts;
    for (const Zone zone : all_zones) {
        names.insert(name(zone));
        texts.insert(definition(zone, {}));
    }
    EXPECT_EQ(names.size(), size_t(zone_count));
    EXPECT_EQ(texts.size(), size_t(zone_count));
    EXPECT_THAT(definition(Zone::marginal, {.margin = 0.08}), HasSubstr("8 percentage points"));
    EXPECT_THAT(definition(Zone::risk, {.margin = 0.08}), HasSubstr("4 percentage points"));
}

TEST(Zones, WhatDoesNotBelongTogetherIsRefused)
{
    SheetFields face = fields_of({{0.1, 0}, {0.2, 0}});
    EXPECT_THROW(zones(row_of(3), face, &curve), InputError);
    EXPECT_THROW(zones(row_of(2), face, &curve, {.margin = -0.1}), InputError);
    EXPECT_THROW(zones(row_of(2), face, &curve, {.max_thinning = 1.5}), InputError);
    EXPECT_THROW(zones(row_of(2), face, &curve, {.max_thickening = std::nan("")}), InputError);
    face.strain_minor[1] = std::nan("");
    EXPECT_THROW(zones(row_of(2), face, &curve), InputError);
}

TEST(FormingLimits, TheSheetChoosesCurveAndMargin)
{
    const TriMesh part = row_of(1);
    const SheetFields face = fields_of({{0.1, 0}});
    const LimitsResult of_steel = forming_limits(part, face, steel(), 1);
    ASSERT_TRUE(of_steel.curve);
    EXPECT_EQ(of_steel.settings.margin, 0.10);
    // Hollomon: its n
    EXPECT_NEAR(engineering_strain(of_steel.curve->at_plane_strain()), 0.3743 * 0.2 / 0.21, 1e-9);
    EXPECT_TRUE(of_steel.notes.empty());
    LimitsOptions options;
    options.n = 0.1;
    EXPECT_NEAR(engineering_strain(forming_limits(part, face, steel(), 1, options).curve->at_plane_strain()),
                0.3743 * 0.1 / 0.21, 1e-9);

    const Material aluminium = aluminium_of(2700);
    const LimitsResult of_aluminium = forming_limits(part, face, aluminium, 1);
    EXPECT_FALSE(of_aluminium.curve);
    EXPECT_EQ(of_aluminium.settings.margin, 0.08);
    EXPECT_THAT(of_aluminium.notes, testing::ElementsAre(HasSubstr("alu")));
    options = {};
    options.source = LimitsOptions::Source::keeler_brazier;
    const LimitsResult asked = forming_limits(part, face, aluminium, 1, options);
    EXPECT_TRUE(asked.curve);
    EXPECT_THAT(asked.notes, testing::ElementsAre(HasSubstr("guess")));
    options.source = LimitsOptions::Source::none;
    EXPECT_FALSE(forming_limits(part, face, steel(), 1, options).curve);
    options.source = LimitsOptions::Source::points;
    options.curve = curve_through({-0.1, 0.1}, {0.3, 0.3}, false, "mine");
    options.margin = 0.05;
    const LimitsResult mine = forming_limits(part, face, steel(), 1, options);
    EXPECT_EQ(*mine.curve, options.curve);
    EXPECT_EQ(mine.settings.margin, 0.05);
    EXPECT_EQ(mine.beyond_curve, 0);
    EXPECT_EQ(forming_limits(part, fields_of({{0.1, -0.2}}), steel(), 1, options).beyond_curve, 1);
}

TEST(FormingLimits, APieceThatIsTheWholePartIsJudgedAsIfItWereTheSheet)
{
    constexpr int faces = 3000;
    const TriMesh part = row_of(faces);
    const SheetFields face = mixed_fields(faces);
    for (const Material& material : {soft_steel(), aluminium_of(2700)})
        for (const double thickness : {0.7, 2.5}) {
            const TailoredPiece whole{"whole", first_faces(faces), material, thickness};
            const LimitsResult piece = forming_limits(part, face, steel(), 1, {}, std::array{whole}),
                               sheet = forming_limits(part, face, material, thickness);
            EXPECT_EQ(piece.zones.zone, sheet.zones.zone);
            ASSERT_EQ(piece.zones.distance.size(), sheet.zones.distance.size()) << "none where no face has a curve";
            EXPECT_EQ(piece.zones.distance, sheet.zones.distance);
            EXPECT_EQ(piece.beyond_curve, sheet.beyond_curve);
            ASSERT_EQ(piece.pieces.size(), 1u);
            EXPECT_EQ(piece.pieces[0].curve, sheet.curve);
            EXPECT_EQ(piece.pieces[0].margin, sheet.settings.margin);
            EXPECT_EQ(piece.pieces[0].faces, faces);
            EXPECT_EQ(piece.curve, forming_limits(part, face, steel(), 1).curve); // the diagram's
            EXPECT_EQ(piece.settings.margin, 0.10);
        }
}

TEST(FormingLimits, AnAluminiumPieceOnSteelHasItsOwnMarginAndNoCurveUnlessAskedFor)
{
    constexpr int faces = 2000, own = 600;
    const TriMesh part = row_of(faces);
    const SheetFields face = mixed_fields(faces);
    const std::array piece{TailoredPiece{"patch", first_faces(own), aluminium_of(2700), 1.2}};
    const LimitsResult both = forming_limits(part, face, steel(), 1, {}, piece),
                       all_steel = forming_limits(part, face, steel(), 1);
    for (int f = 0; f < faces; ++f) {
        const Zone zone = both.zones.zone[size_t(f)];
        EXPECT_EQ(std::isnan(both.zones.distance[f]), f < own);
        if (f < own)
            EXPECT_LT(zone, Zone::marginal);
        else
            EXPECT_EQ(zone, all_steel.zones.zone[size_t(f)]);
    }
    EXPECT_THAT(both.notes, testing::Contains(testing::AllOf(HasSubstr("patch"), HasSubstr("no forming limit"))));
    for (const WorstSpot& spot : both.zones.spots)
        EXPECT_TRUE(std::isfinite(spot.value));

    LimitsOptions points;
    points.source = LimitsOptions::Source::points;
    points.curve = curve_through({-0.4, 0.4}, {0.4, 0.4}, false, "level");
    // 9 points are left
    std::vector<std::pair<double, double>> strains(4, {std::log(std::exp(0.4) - 0.09), 0});
    const LimitsResult level = forming_limits(row_of(4), fields_of(strains), steel(), 1, points,
                                              std::array{TailoredPiece{"patch", {1, 2}, aluminium_of(2700), 1.2}});
    using enum Zone;
    EXPECT_THAT(level.zones.zone, testing::ElementsAre(marginal, excessive_thinning, excessive_thinning, marginal));
}

TEST(FormingLimits, OfTwoPiecesTheLaterCountsAndEachHasItsOwnNote)
{
    const TriMesh part = row_of(6);
    const SheetFields face = fields_of(std::vector<std::pair<double, double>>(6, {std::log(1.3), 0}));
    const std::array pieces{TailoredPiece{"thin", {0, 1, 2, 3}, steel(), 0.5},
                            TailoredPiece{"soft", {2, 3, 4}, soft_steel(), 1}};
    const LimitsResult found = forming_limits(part, face, steel(), 1, {}, pieces);
    const double flc0[] = {(23.3 + 14.13 * 0.5) * 0.2 / 0.21, (23.3 + 14.13) * 0.15 / 0.21,
                           (23.3 + 14.13) * 0.2 / 0.21};
    const int sheet[] = {0, 0, 1, 1, 1, 2};
    for (int f = 0; f < 6; ++f)
        EXPECT_NEAR(found.zones.distance[f], flc0[sheet[f]] / 100 - 0.3, 1e-9) << f;
    EXPECT_EQ(found.pieces[0].faces, 2);
    EXPECT_EQ(found.pieces[1].faces, 3);
    EXPECT_THAT(found.notes, testing::ElementsAre(HasSubstr("\"thin\" (steel, 0.5 mm)"), HasSubstr("\"soft\"")));
    LimitsOptions with_n; // of the base grade
    with_n.n = 0.1;
    const LimitsResult told = forming_limits(part, face, steel(), 1, with_n, pieces);
    EXPECT_NEAR(told.zones.distance[5], (23.3 + 14.13) * 0.1 / 21 - 0.3, 1e-9);
    EXPECT_NEAR(told.zones.distance[0], (23.3 + 14.13 * 0.5) * 0.1 / 21 - 0.3, 1e-9);
    EXPECT_EQ(told.zones.distance[2], found.zones.distance[2]);
    EXPECT_THROW(forming_limits(part, face, steel(), 1, {}, std::array{TailoredPiece{"x", {6}, steel(), 1}}),
                 InputError);
}

TEST(FormingLimits, WhatAGradeBringsCountsUnlessItIsChosenOtherwise)
{
    const TriMesh part = row_of(1);
    const SheetFields face = fields_of({{0.1, 0}});
    Material grade = aluminium_of(2700);
    grade.limit.minor = {-0.2, 0, 0.2};
    grade.limit.major = {0.4, 0.25, 0.35};
    const LimitsResult by_points = forming_limits(part, face, grade, 1);
    ASSERT_TRUE(by_points.curve) << "also for a metal that no formula is made for";
    EXPECT_NEAR(engineering_strain(by_points.curve->at_plane_strain()), 0.25, 1e-12);
    EXPECT_NEAR(engineering_strain((*by_points.curve)(logarithmic_strain(-0.2))), 0.4, 1e-12);
    LimitsOptions options;
    options.source = LimitsOptions::Source::keeler_brazier;
    EXPECT_FALSE(forming_limits(part, face, grade, 1, options).curve->measured) << "asked for the formula";
    options.source = LimitsOptions::Source::none;
    EXPECT_FALSE(forming_limits(part, face, grade, 1, options).curve);

    Material with_n = steel();
    with_n.limit.n = 0.1;
    EXPECT_NEAR(engineering_strain(forming_limits(part, face, with_n, 1).curve->at_plane_strain()), 0.3743 * 0.1 / 0.21,
                1e-9);
    options = {};
    options.n = 0.15;
    EXPECT_NEAR(engineering_strain(forming_limits(part, face, with_n, 1, options).curve->at_plane_strain()),
                0.3743 * 0.15 / 0.21, 1e-9)
        << "what is given for this part goes before the grade";
}

TEST(FormingLimits, FacesBeyondMeasuredPointsAreToldOfEachSheetByItsOwnCurve)
{
    const TriMesh part = row_of(6);
    const SheetFields far = fields_of(std::vector<std::pair<double, double>>(6, {0.5, -0.4}));
    Material measured = soft_steel();
    measured.limit.minor = {-0.1, 0.1};
    measured.limit.major = {0.4, 0.4};
    const auto told = [&](const Material& base, const Material& piece) {
        const std::array pieces{TailoredPiece{"piece", {0, 1}, piece, 1}};
        const LimitsResult found = forming_limits(part, far, base, 1, {}, pieces);
        std::string note;
        for (const std::string& each : found.notes)
            if (each.find("beyond the ends") != std::string::npos)
                note = each;
        return note;
    };
    EXPECT_EQ(told(steel(), steel()), "") << "a formula is no measurement";
    EXPECT_THAT(told(steel(), measured), HasSubstr("2 faces (100 %)"));
    EXPECT_THAT(told(measured, steel()), HasSubstr("4 faces (100 %)"));
    EXPECT_THAT(told(measured, measured), HasSubstr("6 faces (100 %)"));
}

TEST(FormingLimits, EveryGradeWithoutFaultsHasACurveThatCanBeDrawn)
{
    std::mt19937 random(17);
    std::uniform_real_distribution<double> strain(-1.2, 3.5), rising(-1.2, 2.5);
    int sound = 0;
    for (int k = 0; k < 20000; ++k) {
        Material grade = steel();
        for (int i = 0; i < 2 + k % 3; ++i) {
            grade.limit.minor.push_back(rising(random));
            grade.limit.major.push_back(strain(random));
        }
        if (k % 2)
            std::sort(grade.limit.minor.begin(), grade.limit.minor.end());
        if (!faults_of(grade).empty())
            continue;
        ++sound;
        EXPECT_NO_THROW(curve_through(grade.limit.minor, grade.limit.major, true, "lot"));
    }
    EXPECT_GT(sound, 100) << "or this shows little";
}

TEST(FormingLimits, MetalsAreToldApartByDensityAndModulus)
{
    const TriMesh part = row_of(1);
    const SheetFields face = fields_of({{0.1, 0}});
    const auto judged = [&](double young, double density, double n) {
        return forming_limits(part, face, {"x", young, 0.3, density, Hollomon{500, n}, 1, 1, 1, ""}, 1);
    };
    EXPECT_TRUE(judged(206000, 7850, 0.2).curve);
    EXPECT_FALSE(judged(206000, 8900, 0.2).curve); // nickel
    EXPECT_FALSE(judged(206000, 7300, 0.2).curve);
    // a fitted grade with the density of steel
    EXPECT_EQ(judged(70000, 7850, 0.2).settings.margin, 0.08);
    EXPECT_FALSE(judged(70000, 7850, 0.2).curve);
    EXPECT_EQ(judged(110000, 4500, 0.2).settings.margin, 0.10); // titanium
    const auto for_austenite = testing::Contains(HasSubstr("austenitic"));
    EXPECT_THAT(judged(200000, 7900, 0.4).notes, for_austenite);
    EXPECT_THAT(judged(206000, 7850, 0.25).notes, testing::Not(for_austenite));
}

TEST(FormingLimits, ManyFacesBeyondTheEndsOfMeasuredPointsAreNoted)
{
    LimitsOptions options;
    options.source = LimitsOptions::Source::points;
    options.curve = curve_through({-0.1, 0.1}, {0.3, 0.3}, false, "mine");
    const auto notes = [&](int beyond) {
        std::vector<std::pair<double, double>> strains(100, {0.1, 0});
        for (int f = 0; f < beyond; ++f)
            strains[size_t(f)] = {0.1, -0.2};
        return forming_limits(row_of(100), fields_of(strains), steel(), 1, options).notes;
    };
    EXPECT_THAT(notes(6), testing::ElementsAre(testing::AllOf(HasSubstr("6 faces (6 %)"), HasSubstr("-0.20 to 0.00"))));
    EXPECT_TRUE(notes(5).empty());
}

} // namespace spia
