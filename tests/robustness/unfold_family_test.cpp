// Bent parts, drawn at random, that no single stroke would make: all unfold without help, without a
// flip and with no distortion where there need be none.
#include <gtest/gtest.h>

#include "engine/forming/material/material_library.h"
#include "tests/robustness/unfold_run.h"

namespace spia {

class BentFamily : public testing::TestWithParam<shapes::BentShape> {};

TEST_P(BentFamily, UnfoldsByItselfWithLessDistortionThanMethodsThatKnowNoMetal)
{
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    const shapes::BentPart part = GetParam().make();
    const BentRun run = run_bent(part, options);
    ASSERT_EQ(run.local.failure, "");
    EXPECT_EQ(run.local.quality.flips, 0);
    EXPECT_EQ(run.converged, run.steps);
    EXPECT_EQ(run.overlaps, 0);
    const bool formable = run.necking == 0;
    // corners without a radius
    EXPECT_EQ(formable, GetParam().family != "closed box with lips") << run.strain;

    constexpr double rounding = 1e-10; // ABF++ has no error but rounding, either, on sheet that is
                                       // only bent
    if (part.developable) {
        EXPECT_LT(run.strain, 1e-8);
        for (const MethodRun* other : {&run.abf, &run.arap}) {
            EXPECT_LE(run.local.quality.angular_rms, other->quality.angular_rms + rounding) << other->failure;
            EXPECT_LE(run.local.quality.area_rms, other->quality.area_rms + rounding) << other->failure;
        }
        if (part.flat) {
            EXPECT_LT(*run.local.off_exact, 1e-7);
        }
    } else if (formable) { // thickness follows the area; the angles alone are what ABF++ is made
                           // for
        EXPECT_LT(run.local.quality.area_rms, run.abf.quality.area_rms);
        EXPECT_LT(run.local.quality.area_rms, run.arap.quality.area_rms);
    }
}

INSTANTIATE_TEST_SUITE_P(Bent, BentFamily, testing::ValuesIn(shapes::bent_family()), [](const auto& shape) {
    std::string name = shape.param.name();
    for (char& c : name)
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
});

/// Seeds whose root is a cylinder around which their sheet goes more than once before it is
/// unrolled.
TEST(BentFamilyList, LotsThatWindAroundTheirRootUnfoldToo)
{
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    for (const auto& [seed, name] : {std::pair(3, "round spiral 1"), {6, "channel with lips 2"}, {7, "round spiral 0"}})
        for (const shapes::BentShape& shape : shapes::bent_family(800, std::uint64_t(seed)))
            if (shape.name() == name) {
                const BentRun run = run_bent(shape.make(), options, false);
                EXPECT_EQ(run.local.failure, "") << name;
                EXPECT_EQ(run.local.quality.flips, 0) << name;
                EXPECT_EQ(run.overlaps, 0) << name;
            }
}

TEST(BentFamilyList, HasThirtyPartsThatAreTheSameEveryTime)
{
    const auto parts = shapes::bent_family(), others = shapes::bent_family(800, 2);
    EXPECT_GE(parts.size(), 30u);
    for (size_t i = 0; i < parts.size(); ++i) {
        const TriMesh mesh = parts[i].make().mesh, other = others[i].make().mesh;
        EXPECT_EQ(mesh.position, parts[i].make().mesh.position);
        EXPECT_TRUE(mesh.position.cols() != other.position.cols() || mesh.position != other.position);
    }
}

} // namespace spia
