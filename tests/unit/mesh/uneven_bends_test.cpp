// Bends whose arcs on both skins have not one axis.
#include <gtest/gtest.h>

#include "engine/mesh/solid/bends/uneven_bends.h"

namespace spia {
namespace {

StatedSurface cylinder(double x, double y, double radius)
{
    StatedSurface surface;
    surface.kind = StatedSurface::Kind::cylinder;
    surface.point = {x, y, 0};
    surface.direction = Eigen::Vector3d::UnitZ();
    surface.radius = radius;
    return surface;
}

/// A triangle on each arc of a right-angled bend of sheet 2 mm thick, inner radius 3: both arcs
/// touch the legs, wherever their axes are.
std::vector<UnevenBend> bends_with(double outer)
{
    ThinSolid sheet;
    sheet.thickness = 2;
    sheet.side = {SheetSide::outer, SheetSide::inner};
    const double axis = 3 + sheet.thickness - outer;
    return uneven_bends(sheet, {cylinder(axis, axis, outer), cylinder(0, 0, 3)});
}

} // namespace

TEST(UnevenBends, AreThoseWhoseArcsHaveNotOneAxis)
{
    for (const double share : {0.5, 0.7, 0.9, 1.1, 1.3, 1.6, 2.}) {
        const auto bends = bends_with(3 + 2 * share);
        ASSERT_EQ(bends.size(), 1u) << share;
        EXPECT_EQ(bends[0].outer, 3 + 2 * share);
        EXPECT_EQ(bends[0].inner, 3);
        EXPECT_EQ(bends[0].face, 0);
    }
    EXPECT_TRUE(bends_with(5).empty());
    EXPECT_TRUE(bends_with(5.01).empty()) << "rounded to hundredths of a millimetre";
}

TEST(UnevenBends, ArcsFarFromEachOtherAreNotOneBend)
{
    ThinSolid sheet;
    sheet.thickness = 2;
    sheet.side = {SheetSide::outer, SheetSide::inner};
    EXPECT_TRUE(uneven_bends(sheet, {cylinder(40, 0, 5), cylinder(0, 0, 3)}).empty());
}

} // namespace spia
