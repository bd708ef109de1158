// Whether a closed surface with two skins stands for a sheet or for a hollow body.
#include <gtest/gtest.h>

#include "engine/mesh/solid/sheet_or_hollow.h"

namespace spia {
namespace {

/// Round edges all around, 0.1 times as thick as wide.
ThinSolid rounded_plate()
{
    ThinSolid sheet;
    sheet.outer = sheet.inner = 1000;
    sheet.rim = 400;
    sheet.outlines = 1;
    sheet.rounded = 1;
    return sheet;
}

} // namespace

TEST(SheetOrHollow, APlateWithRoundEdgesMayBeABox)
{
    EXPECT_EQ(sheet_or_hollow(rounded_plate()), ClosedSurface::perhaps_hollow);
}

TEST(SheetOrHollow, WhatIsBentOrHasHolesIsASheetWithRoundEdgesAsWell)
{
    ThinSolid bent = rounded_plate(), holed = bent;
    bent.bent = true;
    holed.outlines = 3;
    EXPECT_EQ(sheet_or_hollow(bent), ClosedSurface::sheet);
    EXPECT_EQ(sheet_or_hollow(holed), ClosedSurface::sheet);
}

} // namespace spia
