#include "engine/core/progress.h"

#include <gtest/gtest.h>
#include <vector>

#include "engine/core/error.h"

namespace spia {

TEST(Progress, PartsFillTheirShareOfTheWhole)
{
    std::vector<double> seen;
    const Progress whole([&](double fraction, std::string_view) { seen.push_back(fraction); });
    whole.part(0, 0.5).checkpoint(1, "first half");
    whole.part(0.5, 1).part(0.5, 1).checkpoint(0.5, "last eighth");
    whole.checkpoint(7, "beyond the end");
    EXPECT_EQ(seen, (std::vector<double>{0.5, 0.875, 1}));
}

TEST(Progress, CancelTakesEffectAtTheNextCheckpoint)
{
    auto cancel = std::make_shared<std::atomic<bool>>(false);
    const Progress progress({}, cancel);
    EXPECT_NO_THROW(progress.checkpoint(0, ""));
    *cancel = true;
    EXPECT_THROW(progress.part(0, 0.1).checkpoint(0, ""), Cancelled);
}

} // namespace spia
