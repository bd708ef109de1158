#include "engine/core/atomic_file.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/core/error.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

/// As long as it lives, the superuser, who may write anywhere, is a user without rights.
class OrdinaryUser {
public:
    OrdinaryUser()
    {
        constexpr uid_t nobody = 65534;
        if (super_)
            changed_ = ::seteuid(nobody) == 0;
    }
    ~OrdinaryUser()
    {
        if (changed_)
            changed_ = ::seteuid(0) != 0;
    }

private:
    bool super_ = ::geteuid() == 0, changed_ = false;
};

/// As long as it lives, no file may grow beyond a few bytes: a full disk that needs no disk.
class TinyDisk {
public:
    explicit TinyDisk(rlim_t bytes)
    {
        ::getrlimit(RLIMIT_FSIZE, &old_);
        old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit small{bytes, old_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
    }
    ~TinyDisk()
    {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, old_handler_);
    }

private:
    rlimit old_;
    void (*old_handler_)(int);
};

} // namespace

TEST(AtomicFile, WhatWasWrittenIsReadAndNothingElseIsLeft)
{
    const ScratchFolder folder;
    const std::string content("a\0b\r\nc", 6);
    write_atomically(folder / "x.bin", content);
    EXPECT_EQ(content_of(folder / "x.bin"), content);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"x.bin"});
}

TEST(AtomicFile, ReplacesAnOlderFileAndKeepsItsPermissionsAndLinks)
{
    const ScratchFolder folder;
    put(folder / "x", "old");
    ::chmod((folder / "x").c_str(), 0640);
    std::filesystem::create_symlink(folder / "x", folder / "link");
    write_atomically(folder / "link", "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(content_of(folder / "x"), "new");
    EXPECT_EQ(int(std::filesystem::status(folder / "x").permissions()), 0640);
}

TEST(AtomicFile, FullDiskLeavesTheOldFileAndNoHalfOne)
{
    const ScratchFolder folder;
    put(folder / "x", "old");
    try {
        const TinyDisk disk(100);
        write_atomically(folder / "x", std::string(10'000, '.'));
        FAIL() << "10 kB fitted in 100 bytes";
    } catch (const ExchangeError& error) {
        EXPECT_NE(std::string(error.what()).find((folder / "x").string()), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("free some space"), std::string::npos) << error.what();
    }
    EXPECT_EQ(content_of(folder / "x"), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"x"});
}

TEST(AtomicFile, MissingFolderIsNamedAndNotMade)
{
    const ScratchFolder folder;
    try {
        write_atomically(folder / "no/such/x", "content");
        FAIL() << "wrote into a folder that is not there";
    } catch (const ExchangeError& error) {
        EXPECT_NE(std::string(error.what()).find("no/such/x"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("create the folder"), std::string::npos) << error.what();
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(AtomicFile, FolderWithoutPermissionIsRefused)
{
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "locked");
    ::chmod((folder / "locked").c_str(), 0555);
    {
        const OrdinaryUser user;
        ASSERT_NE(::geteuid(), 0u);
        EXPECT_THROW(write_atomically(folder / "locked/x", "content"), ExchangeError);
    }
    ::chmod((folder / "locked").c_str(), 0755);
    EXPECT_TRUE(std::filesystem::is_empty(folder / "locked"));
}

TEST(AtomicFile, FoldersAndDevicesAreNotReplaced)
{
    const ScratchFolder folder;
    EXPECT_THROW(write_atomically(folder / "", "content"), ExchangeError);
    EXPECT_THROW(write_atomically("/dev/null", "content"), ExchangeError);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, OfAJobThatIsCancelledIsNotWrittenHoweverLateAndTheOldOneStays)
{
    const ScratchFolder folder;
    write_atomically(folder / "file", "old");
    const auto cancel = std::make_shared<std::atomic<bool>>(false);
    const std::string content(20 << 20, 'x');
    for (const double when : {0.4, 0.6, 1.0}) { // before it is begun, half written, all but there
        *cancel = false;
        const WritingJob job(
            Progress([&](double fraction, std::string_view) { *cancel = *cancel || fraction >= when; }, cancel));
        EXPECT_THROW(write_atomically(folder / "file", content), Cancelled) << when;
        EXPECT_EQ(content_of(folder / "file"), "old") << when;
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / ""), {}), 1) << "nothing else is left";
    }
    write_atomically(folder / "file", "new"); // the job is no more
    EXPECT_EQ(content_of(folder / "file"), "new");
}

TEST(AtomicFile, TellsItsJobHowFarItIsAndWhatIsThere)
{
    const ScratchFolder folder;
    std::vector<double> fractions;
    std::vector<std::string> steps;
    std::vector<std::filesystem::path> there;
    {
        const WritingJob job(Progress([&](double fraction, std::string_view step) {
                                 fractions.push_back(fraction);
                                 steps.emplace_back(step);
                             }).part(0.2, 1),
                             2, [&](const std::filesystem::path& file) {
                                 EXPECT_TRUE(std::filesystem::exists(file));
                                 there.push_back(file);
                             });
        write_atomically(folder / "a", std::string(9 << 20, 'a'));
        write_atomically(folder / "b", "b");
    }
    EXPECT_EQ(there, (std::vector<std::filesystem::path>{folder / "a", folder / "b"}));
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_NEAR(fractions.front(), 0.2 + 0.8 * 0.25, 1e-12) << "the content is there: half of the first of two";
    EXPECT_NEAR(fractions.back(), 1, 1e-12);
    EXPECT_EQ(steps.front(), "writing a");
    EXPECT_EQ(steps.back(), "writing b");
}

} // namespace spia
