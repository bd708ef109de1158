#include "engine/core/job.h"

#include <chrono>
#include <gtest/gtest.h>

#include "engine/core/mailbox.h"

namespace spia {
namespace {

void wait_for(const auto& condition)
{
    while (!condition())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(Job, GivesItsResultAndWakesItsOwner)
{
    std::atomic<int> woken = 0;
    Job<int> job(
        [](const Progress& progress) {
            progress.checkpoint(0.25, "counting");
            return 42;
        },
        [&] { ++woken; });
    wait_for([&] { return job.finished() && woken == 2; });
    EXPECT_EQ(job.fraction(), 0.25);
    EXPECT_EQ(job.step(), "counting");
    EXPECT_EQ(job.take(), 42);
}

TEST(Job, CarriesAnErrorToItsOwner)
{
    Job<int> job([](const Progress&) -> int { throw InputError("no part"); });
    EXPECT_THROW(job.take(), InputError);
}

TEST(Job, StopsAtTheNextCheckpointWhenCancelled)
{
    Job<int> job([](const Progress& progress) {
        for (;;)
            progress.checkpoint(0.5, "for ever");
        return 0;
    });
    wait_for([&] { return job.step() == "for ever"; });
    EXPECT_FALSE(job.finished());
    job.cancel();
    EXPECT_THROW(job.take(), Cancelled);
}

TEST(Job, EndsWithItsOwner)
{
    std::atomic<bool> ended = false;
    struct AtExit {
        std::atomic<bool>& flag;
        ~AtExit() { flag = true; }
    };
    {
        Job<int> job([&](const Progress& progress) {
            const AtExit at_exit{ended};
            for (;;)
                progress.checkpoint(0.5, "for ever");
            return 0;
        });
        wait_for([&] { return job.step() == "for ever"; });
    }
    EXPECT_TRUE(ended);
}

TEST(Mailbox, KeepsTheNewestOnly)
{
    Mailbox<int> box;
    EXPECT_FALSE(box.fetch());
    box.post(1);
    box.post(2);
    EXPECT_EQ(box.fetch(), 2);
    EXPECT_FALSE(box.fetch());
}

} // namespace
} // namespace spia
