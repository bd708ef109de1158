#include "engine/core/worker.h"

#include <chrono>
#include <gtest/gtest.h>
#include <vector>

#include "engine/core/error.h"

namespace spia {
namespace {

/// Holds a worker up until it is opened.
struct Gate {
    std::atomic<bool> open = false;
    void pass() { open.wait(false); }
    void let_pass()
    {
        open = true;
        open.notify_all();
    }
};

} // namespace

TEST(Worker, MakesThingsInOrderOnAThreadOfItsOwnAndTellsWhenTheyAreReady)
{
    std::atomic<int> woken = 0;
    std::vector<int> order;
    std::thread::id there;
    Gate gate;
    Worker worker([&] { ++woken; });
    auto first = worker.later([&] {
        gate.pass();
        there = std::this_thread::get_id();
        order.push_back(1);
        return 10;
    });
    auto second = worker.later([&] {
        order.push_back(2);
        return std::vector<int>{7, 8};
    });
    EXPECT_FALSE(first.ready());
    EXPECT_EQ(second.peek(), nullptr);
    gate.let_pass();
    EXPECT_EQ(second.get(), (std::vector<int>{7, 8}));
    EXPECT_EQ(*first.peek(), 10);
    EXPECT_EQ(order, (std::vector<int>{1, 2}));
    EXPECT_NE(there, std::this_thread::get_id());
    EXPECT_GE(woken, 1);
}

TEST(Worker, PassesOnWhatWentWrongToEveryoneWhoAsks)
{
    Worker worker;
    const auto broken = worker.later([]() -> int { throw InputError("no outline"); });
    EXPECT_THROW(broken.get(), InputError);
    EXPECT_THROW(broken.peek(), InputError);
    EXPECT_EQ(worker.later([] { return 3; }).get(), 3);
}

TEST(Worker, LeavesOutWhatNobodyWaitsForAndEndsWithWorkLeft)
{
    Gate gate;
    bool made = false;
    {
        Worker worker;
        const auto busy = worker.later([&] {
            gate.pass();
            return 0;
        });
        worker.later([&] { return made = true; }); // forgotten at once
        const auto after = worker.later([] { return 1; });
        gate.let_pass();
        EXPECT_EQ(after.get(), 1);
        EXPECT_FALSE(made);
        (void)busy;
    }
}

TEST(Worker, EndsAfterWhatItIsMakingAndLeavesOutTheRest)
{
    Gate begun, gate;
    std::atomic<bool> made = false, also = false;
    std::optional<Worker> worker(std::in_place);
    const auto busy = worker->later([&] {
        begun.let_pass();
        gate.pass();
        // the destructor has to wait meanwhile
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return made = true;
    });
    const auto left = worker->later([&] { return also = true; });
    begun.pass();
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50)); // the destructor runs by now
        gate.let_pass();
    });
    worker.reset();
    EXPECT_TRUE(made) << "it has waited for what was being made";
    EXPECT_TRUE(busy.ready());
    EXPECT_TRUE(left.wanted());
    EXPECT_FALSE(left.ready());
    EXPECT_FALSE(also);
    later.join();
}

} // namespace spia
