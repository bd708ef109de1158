#include "engine/pipeline/shortcomings/unsuited_surface.h"

#include <gtest/gtest.h>

#include "engine/forming/material/material_library.h"
#include "engine/pipeline/outputs/iga_outputs.h"
#include "engine/pipeline/run_chain.h"
#include "engine/report/json/certificate_json.h"
#include "engine/report/json/report_json.h"
#include "tests/support/joined_patches.h"

namespace spia {
namespace {

nlohmann::json report_of(const char* file)
{
    Session session;
    session.file = std::filesystem::path(SPIA_SOURCE_DIR "/assets/parts") / file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return nlohmann::json::parse(report_json(completed(run_chain(std::move(session))), {}, 0))["certificate"];
}

TEST(CertificateReport, OfAChannelIsClean)
{
    const auto json = report_of("lipped-channel.obj");
    EXPECT_TRUE(json["suited"]);
    EXPECT_TRUE(json["watertight"]);
    const auto& patch = json["patches"].at(0);
    EXPECT_TRUE(patch["positive_jacobian"]);
    EXPECT_TRUE(patch["refused"].is_null());
    EXPECT_GT(patch["proved_jacobian_mm2"], 0);
    EXPECT_LE(patch["proved_jacobian_mm2"], patch["jacobian_min_mm2"]);
    EXPECT_GT(patch["scaled_jacobian_min"], 0.99);
    EXPECT_TRUE(json["interfaces"].empty());
}

TEST(CertificateReport, SaysWhereTheSquareCupFolds)
{
    // Its outline is smooth where a corner of the grid lies: the two directions are nearly one
    // there.
    const auto json = report_of("square-cup.obj");
    EXPECT_FALSE(json["suited"]);
    const auto& patch = json["patches"].at(0);
    EXPECT_FALSE(patch["positive_jacobian"]);
    EXPECT_EQ(patch["proved_jacobian_mm2"], 0);
    EXPECT_NE(patch["refused"]["why"].get<std::string>().find("folds at u = "), std::string::npos);
    EXPECT_EQ(patch["refused"]["at_mm"].size(), 3u);
}

TEST(CertificateReport, TellsOfInterfacesAndLeaks)
{
    const NurbsSurface left = patches::curved(100, true);
    MultiPatch two{{left, patches::beyond(left)}, {{{0, Side::u1}, {1, Side::u0}, false}}};
    const auto json = certificate_json(certify(two));
    ASSERT_EQ(json["interfaces"].size(), 1u);
    EXPECT_EQ(json["interfaces"][0]["first"], "side u = 1 of patch 1");
    EXPECT_GT(json["interfaces"][0]["angle_max_deg"], 1);
    EXPECT_FALSE(unsuited(certify(two)));
    two.interfaces[0].reversed = true;
    EXPECT_FALSE(certificate_json(certify(two))["watertight"]);
    EXPECT_EQ(unsuited(certify(two))->find("the patches leak"), 0u);
}

} // namespace
} // namespace spia
