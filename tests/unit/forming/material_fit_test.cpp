#include "engine/forming/material/material_fit.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

/// A bar of Voce's law: true stress over true strain, elastic up to its first stress.
std::string bar()
{
    const Voce law{130, 290, 12};
    std::string rows = "true strain, true stress MPa\n";
    for (int k = 1; k <= 20; ++k)
        rows += fmt::format("{:.9g}, {:.9g}\n", 6.5 * k / 70'000, 6.5 * k);
    for (int k = 1; k <= 200; ++k) {
        const double plastic = 0.3 * k / 200, stress = flow_stress(law, plastic).stress;
        rows += fmt::format("{:.9g}, {:.9g}\n", plastic + stress / 70'000, stress);
    }
    return rows;
}

struct MaterialFitted : testing::Test {
    ScratchFolder folder;
    const std::filesystem::path table = folder / "bar.csv";
    void SetUp() override { put(table, bar()); }
};

} // namespace

TEST_F(MaterialFitted, HoldsWhatTheTestSaysAndWhatWasGiven)
{
    const MaterialFit fit = fit_material(table, {.test = {},
                                                 .law = "voce",
                                                 .name = "sheet A",
                                                 .poisson = 0.33,
                                                 .density_kg_m3 = 2700,
                                                 .r0 = 0.7,
                                                 .r45 = 0.5,
                                                 .r90 = 0.6});
    EXPECT_EQ(fit.fits[fit.taken].name, "voce");
    EXPECT_EQ(fit.material.hardening, *fit.fits[fit.taken].law);
    EXPECT_NEAR(std::get<Voce>(fit.material.hardening).sigma_sat_MPa, 290, 1);
    EXPECT_NEAR(fit.material.young_MPa, 70'000, 200);
    EXPECT_EQ(fit.material.name, "sheet A");
    EXPECT_EQ(fit.material.poisson, 0.33);
    EXPECT_EQ(fit.material.density_kg_m3, 2700);
    EXPECT_EQ(fit.material.r0, 0.7);
    EXPECT_EQ(fit.material.r45, 0.5);
    EXPECT_EQ(fit.material.r90, 0.6);
    EXPECT_THAT(fit.material.source, testing::HasSubstr("bar.csv: voce with an rms error of 0."));
}

TEST_F(MaterialFitted, TakesTheBestLawOrTheWantedOneThoughAnotherIsCloser)
{
    const MaterialFit best = fit_material(table, {});
    EXPECT_EQ(&best.fits[best.taken], &best_fit(best.fits));
    EXPECT_EQ(best.material.hardening, *best_fit(best.fits).law);
    const MaterialFit fit = fit_material(table, {.test = {}, .law = "ludwik", .name = ""});
    EXPECT_EQ(fit.fits[fit.taken].name, "ludwik");
    EXPECT_TRUE(std::holds_alternative<Ludwik>(fit.material.hardening));
    EXPECT_GT(fit.fits[fit.taken].rms_MPa, 0.5);
    EXPECT_THROW(fit_material(table, {.test = {}, .law = "hooke", .name = ""}), InputError);
    EXPECT_THROW(fit_material(folder / "none.csv", {}), InputError);
}

} // namespace spia
