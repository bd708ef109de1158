#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/part/part_file.h"
#include "engine/part/read_options.h"
#include "tests/support/mesh_tools.h"

namespace spia {
namespace {

constexpr double degrees = std::numbers::pi / 180;

/// Two triangles: one with angles of 90, 45 and 45 degrees, one with edges of 1, 3 and sqrt(10).
PartFile two_triangles()
{
    PartFile part;
    part.mesh.position.resize(3, 4);
    part.mesh.position << 0, 3, 0, 3, 0, 0, 3, -1, 0, 0, 0, 0;
    part.mesh.triangle.resize(3, 2);
    part.mesh.triangle << 0, 0, 1, 3, 2, 1;
    part.source_face = {7, 9};
    return part;
}

std::vector<std::string> doubts(const MeshTargets& targets)
{
    const Remarks remarks = on_targets(targets, two_triangles());
    EXPECT_EQ(remarks.notes, remarks.doubts);
    return remarks.doubts;
}

} // namespace

TEST(MeshTargets, NameTheWorstTriangleThatMissesThem)
{
    const double least = std::atan2(1, 3); // of the second one
    EXPECT_TRUE(doubts({}).empty());
    EXPECT_TRUE(doubts({least - 1e-9, std::sqrt(10) + 1e-9}).empty());
    const auto angle = doubts({.least_angle = least + 1e-9});
    ASSERT_EQ(angle.size(), 1u);
    EXPECT_NE(angle[0].find("1 triangle has an angle below 18.4 degrees, the least 18.4 (worst: face 9)"),
              std::string::npos)
        << angle[0];
    EXPECT_NE(doubts({.least_angle = 46 * degrees})[0].find("2 triangles have"), std::string::npos);
    EXPECT_NE(doubts({.least_angle = 46 * degrees})[0].find("face 9"), std::string::npos);
    const auto ratio = doubts({.edge_ratio = 1.42});
    ASSERT_EQ(ratio.size(), 1u);
    EXPECT_NE(ratio[0].find("more than 1.42 times, the most 3.16 (worst: face 9)"), std::string::npos) << ratio[0];
    EXPECT_NE(doubts({.edge_ratio = 1.41})[0].find("2 triangles have"), std::string::npos);
}

TEST(MeshTargets, WithoutSenseAreRefused)
{
    for (const double angle : {0.0, -1.0, 60 * degrees, std::nan("")})
        EXPECT_THROW(doubts({.least_angle = angle}), InputError) << angle;
    for (const double ratio : {1.0, 0.0, std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_THROW(doubts({.edge_ratio = ratio}), InputError) << ratio;
}

} // namespace spia
