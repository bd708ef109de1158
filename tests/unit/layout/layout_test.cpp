#include "engine/layout/layout.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace spia {

TEST(Layout, PlateWithOneHoleIsFourPatches)
{
    const TriMesh part = shapes::plate({100, 80, {{{50, 40}, 15}}, 3000});
    const Layout layout = make_layout(part, Blank{part.position.topRows(2)});
    EXPECT_EQ(layout.patch.size(), 4u);
    EXPECT_FALSE(layout.split);
}

} // namespace spia
