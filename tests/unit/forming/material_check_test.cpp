#include "engine/forming/material/material_check.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/forming/material/material_text.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

using testing::HasSubstr;

Material sound() { return {"own", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.79, 1.51, 2.27, "a test"}; }

/// The one fault that there is.
MaterialFault only_fault(const Material& material)
{
    const std::vector<MaterialFault> faults = faults_of(material);
    EXPECT_EQ(faults.size(), 1u);
    return faults.empty() ? MaterialFault{} : faults.front();
}

} // namespace

TEST(MaterialCheck, ASoundGradeHasNoFaultAndEachWrongNumberIsNamedByItsKey)
{
    EXPECT_TRUE(faults_of(sound()).empty());
    const std::vector<std::pair<double Material::*, const char*>> numbers = {
        {&Material::young_MPa, "young_MPa"},
        {&Material::poisson, "poisson"},
        {&Material::density_kg_m3, "density_kg_m3"},
        {&Material::r0, "r0"},
        {&Material::r45, "r45"},
        {&Material::r90, "r90"}};
    for (const auto& [member, key] : numbers) {
        Material material = sound();
        material.*member = -2;
        const MaterialFault fault = only_fault(material);
        EXPECT_EQ(fault.key, key);
        EXPECT_THAT(fault.what, HasSubstr(std::string(key) == "poisson" ? "must be above -1" : "must be above 0"));
        EXPECT_EQ(fault.value, -2);
        material.*member = std::nan("");
        EXPECT_EQ(only_fault(material).what, "must be a number");
    }
    Material nameless = sound();
    nameless.name = " ";
    EXPECT_EQ(only_fault(nameless).key, "name");
}

TEST(MaterialCheck, TheEndsOfRangesThatAreAllowedAre)
{
    Material material = sound();
    material.poisson = 0.5;
    EXPECT_TRUE(faults_of(material).empty());
    material.poisson = 0.5001;
    EXPECT_EQ(only_fault(material).key, "poisson");
    material = sound();
    material.hardening = HockettSherby{140, 420, 4, 1};
    EXPECT_TRUE(faults_of(material).empty());
    material.hardening = HockettSherby{140, 420, 4, 1.01};
    EXPECT_EQ(only_fault(material).key, "hardening/p");
    material.hardening = HockettSherby{140, 420, 4, 0.04};
    EXPECT_EQ(only_fault(material).key, "hardening/p");
    material.hardening = Voce{200, 150, 10};
    EXPECT_EQ(only_fault(material).key, "hardening/sigma_sat_MPa");
}

TEST(MaterialCheck, AFallingCurveIsToldWithItsStrain)
{
    Material material = sound();
    material.hardening = HardeningTable{{0, 0.05, 0.12, 0.3}, {200, 300, 290, 400}};
    const MaterialFault falling = only_fault(material);
    EXPECT_EQ(falling.key, "hardening/stress_MPa");
    EXPECT_EQ(falling.what, "the curve falls at strain 0.12");
    EXPECT_EQ(falling.entry, 2);
    material.hardening = HardeningTable{{0, 0.05, 0.05, 0.3}, {200, 300, 310, 400}};
    EXPECT_EQ(only_fault(material).key, "hardening/strain");
    material.hardening = HardeningTable{{0.1, 0.2}, {100, 300}}; // would begin at -100 MPa
    EXPECT_THAT(only_fault(material).what, HasSubstr("-100 MPa at strain 0"));
    material.hardening = Swift{99000, 0.9, 0.99}; // far above Hooke's line of lead
    material.young_MPa = 100;
    EXPECT_THAT(only_fault(material).what, HasSubstr("elastic line"));
}

TEST(MaterialCheck, PointsOfAForminglimitAreCheckedOneByOne)
{
    Material material = sound();
    material.limit = {{}, {-0.2, 0, 0.2}, {0.5, 0.35, 0.45}};
    EXPECT_TRUE(faults_of(material).empty());
    material.limit.minor[2] = -0.1;
    EXPECT_EQ(only_fault(material).entry, 2);
    EXPECT_EQ(only_fault(material).key, "forming_limit/minor");
    material.limit = {{}, {-0.2, 0, 0.2}, {0.5, 0, 0.1}};
    ASSERT_EQ(faults_of(material).size(), 2u);
    EXPECT_EQ(faults_of(material)[0].what, "must be above 0");
    EXPECT_EQ(faults_of(material)[1].what, "must not be below the minor strain");
    material.limit = {1.5, {}, {}};
    EXPECT_EQ(only_fault(material).key, "forming_limit/n");
}

TEST(MaterialCheck, TheFormingLimitOfAGradeIsReadBackAndAFaultInItIsNamed)
{
    const ScratchFolder folder;
    const auto file = folder / "own.json";
    for (const GradeLimit& limit :
         {GradeLimit{}, GradeLimit{0.19, {}, {}}, GradeLimit{{}, {-0.2, 0, 1. / 3}, {0.5, 0.35, 0.45}}}) {
        Material material = sound();
        material.limit = limit;
        put(file, material_text(material));
        EXPECT_EQ(read_material(file), material);
    }
    Material material = sound();
    material.limit = {{}, {-0.2, 0}, {0.5, -0.35}};
    put(file, material_text(material));
    try {
        read_material(file);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::AllOf(HasSubstr(file.string()), HasSubstr("\"forming_limit\""),
                                                 HasSubstr("\"major\""), HasSubstr("entry 1"), HasSubstr("-0.35")));
    }
}

TEST(MaterialCheck, AnotherNameOrFormingLimitFormsAlikeAnotherModulusDoesNot)
{
    Material other = sound();
    other.name = "another";
    other.source.clear();
    other.limit.n = 0.2;
    EXPECT_TRUE(formed_alike(sound(), other));
    EXPECT_NE(sound(), other);
    other.r45 += 0.01;
    EXPECT_FALSE(formed_alike(sound(), other));
}

} // namespace spia
