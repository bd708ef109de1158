#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <memory>
#include <poll.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "engine/core/error.h"
#include "engine/exchange/cad/child_process.h"

namespace spia::child_process_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

void ignore_reports(std::string_view) {}

std::string fault_of(const std::function<std::string(const Progress&, const ChildLog&)>& work,
                     const ChildLimits& limits)
{
    try {
        in_child(work, ignore_reports, {}, limits);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(ChildProcess, GivesTheResultOrTheErrorAndOutlivesACrash)
{
    std::vector<std::string> logged;
    const ChildLog log = [&](std::string_view text) { logged.emplace_back(text); };
    const std::string large(5'000'000, 'x');
    EXPECT_EQ(in_child([&](const Progress&, const ChildLog& say) { return say("hello"), large; }, log, {}), large);
    EXPECT_EQ(logged, std::vector<std::string>{"hello"});
    try {
        in_child([](const Progress&, const ChildLog&) -> std::string { throw InputError("no good"); }, log, {});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "no good");
    }
    const auto crash = [](const Progress&, const ChildLog&) -> std::string {
        std::raise(SIGKILL);
        return "";
    };
    EXPECT_THROW(in_child(crash, log, {}), InputError);
    const auto hog = [](const Progress&, const ChildLog&) { return std::string(size_t(20) << 30, 'x'); };
    EXPECT_THROW(in_child(hog, log, {}), InputError);
}

TEST(ChildProcess, IsStoppedEvenIfItSaysNothing)
{
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    pid_t child = 0;
    const auto sleep = [](const Progress&, const ChildLog& say) {
        say(std::to_string(::getpid()));
        return ::sleep(100), std::string();
    };
    const auto start = Clock::now();
    std::thread person([&] {
        std::this_thread::sleep_for(300ms);
        *stop = true;
    });
    EXPECT_THROW(in_child(
                     sleep, [&](std::string_view text) { child = std::stoi(std::string(text)); }, Progress({}, stop)),
                 Cancelled);
    person.join();
    EXPECT_GE(Clock::now() - start, 300ms);
    EXPECT_LT(Clock::now() - start, 10s);
    ASSERT_GT(child, 0);
    EXPECT_EQ(::kill(child, 0), -1);
    EXPECT_EQ(errno, ESRCH);
}

TEST(ChildProcess, IsGivenUpWhenItComputesTooLongOrNotAtAll)
{
    const auto wait = [](const Progress&, const ChildLog&) { return ::sleep(100), std::string(); };
    const auto compute = [](const Progress&, const ChildLog&) -> std::string {
        for (const auto start = Clock::now(); Clock::now() - start < 100s;) {
        }
        return "";
    };
    const auto start = Clock::now();
    EXPECT_NE(fault_of(wait, {.busy = 600s, .idle = 1s}).find("has made no progress"), std::string::npos);
    EXPECT_NE(fault_of(compute, {.busy = 1s, .idle = 60s}).find("1 seconds of computing"), std::string::npos);
    EXPECT_LT(Clock::now() - start, 60s);
    // each shorter than the limit, together longer
    const auto pauses = [](const Progress&, const ChildLog&) {
        for (int k = 0; k < 4; ++k) {
            ::usleep(700'000);
            for (const auto from = Clock::now(); Clock::now() - from < 50ms;) {
            }
        }
        return std::string("done");
    };
    EXPECT_EQ(in_child(pauses, ignore_reports, {}, {.busy = 600s, .idle = 2s}), "done");
}

TEST(ChildProcess, DoesNotOutliveItsParent)
{
    std::array<int, 2> alive{}; // open for as long as one of both lives
    ASSERT_EQ(::pipe(alive.data()), 0);
    const pid_t parent = ::fork();
    if (parent == 0) {
        const auto work = [&](const Progress&, const ChildLog&) {
            const ssize_t written = ::write(alive[1], "x", 1);
            return ::sleep(20), std::string(size_t(written), ' ');
        };
        in_child(work, ignore_reports, {});
        ::_exit(0);
    }
    ::close(alive[1]);
    char begun = 0;
    ASSERT_EQ(::read(alive[0], &begun, 1), 1);
    ::kill(parent, SIGKILL);
    ASSERT_EQ(::waitpid(parent, nullptr, 0), parent);
    pollfd end{alive[0], POLLIN, 0};
    EXPECT_EQ(::poll(&end, 1, 10'000), 1) << "the child still runs";
    EXPECT_EQ(::read(alive[0], &begun, 1), 0);
    ::close(alive[0]);
}

} // namespace spia::child_process_test
