#include "engine/compare/compare.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/global_control.h>

#include "engine/compare/abf.h"
#include "engine/compare/arap.h"
#include "engine/compare/comparison_report.h"
#include "engine/compare/lscm.h"
#include "engine/compare/peak_memory.h"
#include "engine/compare/slim.h"
#include "engine/core/error.h"
#include "tests/support/developable.h"
#include "tests/unit/compare/layouts.h"

namespace spia {
namespace {

CompareOptions mild_steel()
{
    CompareOptions options;
    options.flatten.material = {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""};
    return options;
}

} // namespace

TEST(Compare, EveryMethodFlattensADevelopablePartWithoutDistortion)
{
    const auto rows = compare(shapes::quarter_cylinder({.triangles = 600}).mesh, mild_steel());
    ASSERT_EQ(rows.size(), 5u);
    for (size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].method, flat_methods[i]);
        EXPECT_EQ(rows[i].failure, "");
        EXPECT_GT(rows[i].seconds, 0);
        EXPECT_GT(rows[i].cpu_seconds, 0);
        EXPECT_LT(rows[i].quality.angular_rms, 1e-5) << title(rows[i].method);
        EXPECT_LT(rows[i].quality.area_rms, 1e-5) << title(rows[i].method);
    }
}

TEST(Compare, EachMethodIsBestInWhatItMinimises)
{
    const auto rows = compare(bumpy_disk(), mild_steel());
    const MapQuality &spia = rows[0].quality, &abf = rows[1].quality, &arap = rows[2].quality, &lscm = rows[3].quality,
                     &slim = rows[4].quality;
    for (const MapQuality* other : {&spia, &arap, &lscm, &slim})
        EXPECT_LT(abf.angular_rms, other->angular_rms);
    for (const MapQuality* other : {&spia, &arap, &abf, &lscm})
        EXPECT_LE(slim.symmetric_dirichlet, other->symmetric_dirichlet + 1e-6);
    for (const MapQuality* conformal : {&abf, &lscm}) // what keeping angles costs
        EXPECT_GT(conformal->area_rms, 1.5 * arap.area_rms);
}

TEST(Compare, AMethodThatCannotDoThePartSaysWhyInItsRow)
{
    for (const TriMesh& part : {shapes::two_rectangles(), shapes::closed_sphere(20, 300), TriMesh{}})
        for (const ComparisonRow& row : compare(part, mild_steel()))
            EXPECT_NE(row.failure, "") << title(row.method);
}

TEST(Compare, StopsWhenAskedTo)
{
    const auto stop = std::make_shared<std::atomic<bool>>(true);
    for (const FlatMethod method : flat_methods) {
        CompareOptions options = mild_steel();
        options.methods = {method};
        EXPECT_THROW(compare(bumpy_disk(), options, Progress({}, stop)), Cancelled) << title(method);
    }
}

TEST(Compare, ReportsProgressThatNeverFalls)
{
    double last = 0;
    int reports = 0;
    const Progress progress([&](double fraction, std::string_view) {
        EXPECT_GE(fraction, last - 1e-12);
        last = fraction;
        ++reports;
    });
    CompareOptions options = mild_steel();
    options.methods = {FlatMethod::abf, FlatMethod::arap, FlatMethod::lscm, FlatMethod::slim};
    compare(bumpy_plate(), options, progress);
    EXPECT_GT(reports, 30);
    EXPECT_GT(last, 0.75);
}

TEST(Compare, GivesTheSameBitsOnOneThreadAndOnMore)
{
    const TriMesh part = bumpy_plate();
    const auto maps = [&] {
        return std::vector{abf(part).position, arap(part).position, lscm(part).position, slim(part).position};
    };
    const auto many = maps();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const auto one = maps();
    for (size_t i = 0; i < one.size(); ++i)
        EXPECT_TRUE((one[i].array() == many[i].array()).all()) << i;
}

TEST(Compare, KnowsItsMethodsByName)
{
    for (const FlatMethod method : flat_methods)
        EXPECT_EQ(flat_method(name(method)), method);
    try {
        flat_method("bff");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "there is no method \"bff\"; choose from spia, abf, arap, lscm, slim");
    }
}

TEST(ComparisonReport, HasARowPerMethodAndNullForInfinity)
{
    ComparisonRow good{FlatMethod::slim}, flipped{FlatMethod::arap}, failed{FlatMethod::lscm};
    good.seconds = 1.25;
    good.cpu_seconds = 1.5;
    good.added_mb = 12;
    good.quality = {0.0123456, 0.2, 1.5, 4.25, 0, 0};
    good.ended = "converged";
    flipped.quality = {0.1, 0.2, INFINITY, INFINITY, 3, 2};
    failed.failure = "the part is closed";
    const std::vector<ComparisonRow> rows = {good, flipped, failed};
    const std::string markdown = comparison_table(rows, TableStyle::markdown);
    EXPECT_NE(markdown.find("| SLIM | 1.25 | 1.50 | 12 | 0.01235 | 0.20000 | 1.5000 | 4.2500 | 0 | 0 | 0 |\n"),
              std::string::npos);
    EXPECT_NE(markdown.find("| ARAP | 0.00 | 0.00 | - | 0.10000 | 0.20000 | inf | inf | 3 | 2 | 0 |\n"),
              std::string::npos);
    EXPECT_NE(markdown.find("| LSCM | - | - |"), std::string::npos);
    EXPECT_NE(markdown.find("- LSCM: no map: the part is closed\n"), std::string::npos);
    const std::string text = comparison_table(rows, TableStyle::text);
    EXPECT_NE(text.find("\nSLIM"), std::string::npos);

    const auto json = nlohmann::json::parse(comparison_json("part.obj", bumpy_disk(), rows, {"cut"}));
    EXPECT_EQ(json["schema"], "spia.compare/1");
    EXPECT_EQ(json["part"]["notes"], nlohmann::json({"cut"}));
    ASSERT_EQ(json["methods"].size(), 3u);
    EXPECT_EQ(json["methods"][0]["method"], "slim");
    EXPECT_EQ(json["methods"][0]["symmetric_dirichlet"], 4.25);
    EXPECT_TRUE(json["methods"][1]["l2_stretch"].is_null());
    EXPECT_EQ(json["methods"][1]["flips"], 3);
    EXPECT_EQ(json["methods"][2]["failure"], "the part is closed");
    EXPECT_FALSE(json["methods"][2].contains("flips"));
}

TEST(PeakMemory, SeesABlockThatIsGoneAgain)
{
    const PeakMemory memory;
    if (!memory.most_mb())
        GTEST_SKIP() << "the kernel does not tell";
    {
        std::vector<char> block(size_t(80) << 20, 1);
        EXPECT_EQ(block[12345], 1);
    }
#ifdef __SANITIZE_ADDRESS__
    constexpr double shadow = 1. / 8; // a byte for each eight
#else
    constexpr double shadow = 0;
#endif
    EXPECT_NEAR(*memory.added_mb(), 80 * (1 + shadow), 5);
    const PeakMemory later;
    EXPECT_LT(*later.added_mb(), 5);
}

} // namespace spia
