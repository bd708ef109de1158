#include "engine/forming/material/material_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

Material grade(const Hardening& law)
{
    return {"A \"grade\" of \u00fc", 206000, 0.3, 7850, law, 1.79, 1.51, 2.27, "a test"};
}

} // namespace

TEST(MaterialText, ReadsBackAsTheSameGradeForEveryLaw)
{
    const ScratchFolder folder;
    const double third = 1.0 / 3; // no short decimal
    const std::vector<Hardening> laws = {Swift{500 + third, 0.007, 0.2 * third},
                                         Hollomon{530 + third, 0.23},
                                         Voce{130 + third, 290, 12 * third},
                                         HardeningTable{{0, third, 0.5}, {200, 300 + third, 380}},
                                         Ludwik{150 + third, 420, 0.45},
                                         HockettSherby{140 + third, 420, 4 * third, 0.7},
                                         SwiftVoce{third, {565, 0.007, 0.26}, {130, 290, 12 * third}}};
    for (const Hardening& law : laws) {
        put(folder / "grade.json", material_text(grade(law)));
        EXPECT_EQ(read_material(folder / "grade.json"), grade(law)) << describe(law);
    }
}

TEST(MaterialText, NamesTheLawAsTheFilesDo)
{
    EXPECT_THAT(hardening_text(Ludwik{150, 420, 0.45}), testing::HasSubstr("\"law\":\"ludwik\""));
    EXPECT_THAT(describe(HockettSherby{140, 420, 4, 0.7}),
                testing::HasSubstr("420 MPa - (420 - 140) MPa exp(-4 eps^0.7)"));
}

} // namespace spia
