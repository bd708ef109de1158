#include "engine/core/attempts.h"

#include <gtest/gtest.h>
#include <stdexcept>

#include "engine/core/error.h"

namespace spia {
namespace {

/// A result that is a number: the greater, the better, and 3 will do.
struct Search {
    int kept = 0;
    std::vector<int> run = {}; ///< in the order in which they were tried

    PlannedAttempt give(int value, std::function<bool()> when = {})
    {
        return {"give " + std::to_string(value), std::move(when),
                [this, value](AttemptReport& report) {
                    run.push_back(value);
                    report.reason = value > kept ? "better" : "no better";
                    const bool better = value > kept;
                    if (better)
                        kept = value;
                    return better;
                },
                [this] { return kept >= 3; }};
    }
};

} // namespace

TEST(Attempts, AreMadeInTheirOrderUntilOneIsAccepted)
{
    Search search;
    const auto made = try_in_order({search.give(1), search.give(3), search.give(5)});
    EXPECT_EQ(search.run, (std::vector{1, 3}));
    EXPECT_EQ(search.kept, 3);
    ASSERT_EQ(made.size(), 2u);
    EXPECT_EQ(made[0].name, "give 1");
    EXPECT_FALSE(made[0].won);
    EXPECT_TRUE(made[1].won);
}

TEST(Attempts, WithoutAnAcceptedOneTheLastThatWasKeptHasWon)
{
    Search search;
    const auto made = try_in_order({search.give(1), search.give(2), search.give(2)});
    ASSERT_EQ(made.size(), 3u);
    EXPECT_EQ(search.kept, 2);
    EXPECT_FALSE(made[0].won);
    EXPECT_TRUE(made[1].won);
    EXPECT_FALSE(made[2].won);
    EXPECT_EQ(made[2].reason, "no better");
}

TEST(Attempts, ThatAreNotWorthTryingAreNeitherMadeNorReported)
{
    Search search;
    const auto made = try_in_order({search.give(2), search.give(1, [&] { return search.kept < 2; }),
                                    search.give(3, [&] { return search.kept == 2; })});
    EXPECT_EQ(search.run, (std::vector{2, 3}));
    ASSERT_EQ(made.size(), 2u);
    EXPECT_TRUE(made[1].won);
}

TEST(Attempts, ThatKeepSomethingWillDoWhereNothingElseIsAskedFor)
{
    const auto keep = [](AttemptReport&) { return true; };
    const auto keep_nothing = [](AttemptReport&) { return false; };
    const auto made = try_in_order({{"a", {}, keep_nothing}, {"b", {}, keep}, {"c", {}, keep}});
    ASSERT_EQ(made.size(), 2u);
    EXPECT_FALSE(made[0].won);
    EXPECT_TRUE(made[1].won);
}

TEST(Attempts, CostWhatThoseWithinCostAndEndAsTheWinnerOfThem)
{
    Search inner;
    const auto outer = [&](AttemptReport& report) {
        report.within = try_in_order({inner.give(1), inner.give(2), inner.give(3)});
        return true;
    };
    const auto made = try_in_order({{"outer", {}, outer}});
    ASSERT_EQ(made.size(), 1u);
    ASSERT_EQ(made[0].within.size(), 3u);
    EXPECT_TRUE(made[0].won && made[0].within[2].won);
    EXPECT_EQ(made[0].reason, "better");
    double within = 0;
    for (const AttemptReport& each : made[0].within)
        within += each.seconds;
    EXPECT_GE(within, 0);
    EXPECT_GE(made[0].seconds, within);
}

TEST(Attempts, ThatKeepNothingHaveNoWinner)
{
    Search search;
    search.kept = 2;
    for (const AttemptReport& each : try_in_order({search.give(1), search.give(2)}))
        EXPECT_FALSE(each.won);
    EXPECT_TRUE(try_in_order({}).empty());
}

TEST(Attempts, PassOnWhatIsThrown)
{
    const std::vector<PlannedAttempt> broken = {
        {"broken", {}, [](AttemptReport&) -> bool { throw std::runtime_error("no way"); }}};
    EXPECT_THROW(try_in_order(broken), std::runtime_error);
}

TEST(Attempts, ThatMayRefuseGiveTheErrorAsTheirReason)
{
    Search search;
    PlannedAttempt refuses{"refuses", {}, [](AttemptReport&) -> bool { throw SolveError("no way on"); }};
    EXPECT_THROW(try_in_order({refuses, search.give(3)}), SolveError);
    EXPECT_TRUE(search.run.empty());
    refuses.may_refuse = true;
    const auto made = try_in_order({refuses, search.give(3)});
    ASSERT_EQ(made.size(), 2u);
    ASSERT_TRUE(made[0].refusal);
    EXPECT_THROW(std::rethrow_exception(made[0].refusal), SolveError);
    EXPECT_FALSE(made[0].won);
    EXPECT_EQ(made[0].reason, "no way on");
    EXPECT_FALSE(made[1].refusal);
    EXPECT_TRUE(made[1].won);
    EXPECT_EQ(try_in_order({refuses}).size(), 1u); // whose caller sees that nothing was kept
}

TEST(Attempts, AreNotGoneOnWithOnceTheUserHasCancelled)
{
    Search search;
    PlannedAttempt cancelled{"cancelled", {}, [](AttemptReport&) -> bool { throw Cancelled(); }};
    cancelled.may_refuse = true;
    EXPECT_THROW(try_in_order({cancelled, search.give(3)}), Cancelled);
    EXPECT_TRUE(search.run.empty());
}

} // namespace spia
