#include "engine/exchange/cad/cad_lost.h"

#include <gtest/gtest.h>
#include <vector>

namespace spia {

TEST(CadLost, MayBeMissingUnlessItIsKnownToBeElsewhere)
{
    const std::vector<int> chosen = {2, 3, 7};
    EXPECT_TRUE(may_lack(chosen, {"#1", {}}));
    EXPECT_TRUE(may_lack(chosen, {"#1", {}, true}));
    EXPECT_TRUE(may_lack(chosen, {"#1", {7, 8, 9}}));
    EXPECT_FALSE(may_lack(chosen, {"#1", {4, 5, 6}}));
    EXPECT_TRUE(may_lack(chosen, {"#1", {2, 3}, true})) << "all that is left of the assembly";
    EXPECT_FALSE(may_lack(chosen, {"#1", {7, 8}, true})) << "another body than the one chosen";
}

} // namespace spia
