// Awkward shapes, drawn at random: each ends with a valid blank or is refused with words that help.
#include <gtest/gtest.h>
#include <set>

#include "engine/forming/material/material_library.h"
#include "tests/robustness/shape_run.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shape_family.h"

namespace spia {
namespace {

using shapes::Expected;
using shapes::FamilyShape;

/// The first shapes of each family: all of them are run by the program spia-robustness.
std::vector<FamilyShape> quick_share()
{
    std::vector<FamilyShape> share;
    for (const FamilyShape& shape : shapes::shape_family(450))
        if (shape.number < 2)
            share.push_back(shape);
    return share;
}

} // namespace

class Family : public testing::TestWithParam<FamilyShape> {};

TEST_P(Family, EndsWithAValidBlankOrAHelpfulRefusal)
{
    const FamilyShape& shape = GetParam();
    ReadOptions options;
    options.doctor.keep_largest = shape.keep_largest;
    FlattenOptions flattening;
    flattening.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    const ShapeRun run = run_shape(shapes::soup_of(shape.make()), options, flattening);
    ASSERT_NE(run.end, ShapeRun::End::failure) << run.why;
    if (shape.expected != Expected::either) {
        EXPECT_EQ(run.end == ShapeRun::End::blank, shape.expected == Expected::blank) << run.why;
    }
}

INSTANTIATE_TEST_SUITE_P(Quick, Family, testing::ValuesIn(quick_share()), [](const auto& param) {
    std::string name = param.param.name();
    for (char& c : name)
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
});

TEST(ShapeFamily, HasTwoHundredShapesThatAreTheSameEveryTime)
{
    const auto shapes = shapes::shape_family(200), again = shapes::shape_family(200),
               others = shapes::shape_family(200, 2);
    EXPECT_GE(shapes.size(), 200u);
    std::set<std::string> names;
    int different = 0;
    for (size_t i = 0; i < shapes.size(); ++i) {
        names.insert(shapes[i].name());
        if (shapes[i].number > 0)
            continue;
        const TriMesh mesh = shapes[i].make(), twin = again[i].make(), other = others[i].make();
        EXPECT_EQ(mesh.position, twin.position) << shapes[i].name();
        EXPECT_EQ(mesh.triangle, twin.triangle) << shapes[i].name();
        different += mesh.position.cols() != other.position.cols() || mesh.position != other.position;
    }
    EXPECT_EQ(names.size(), shapes.size());
    EXPECT_GT(different, 25);
}

} // namespace spia
