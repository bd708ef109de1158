#include "app/viewer/model/jobs/file_writer.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>

#include "tests/unit/exchange/scratch_folder.h"

namespace spia::viewer {

TEST(FileWriter, WritesInOrderOnAnotherThreadAndTellsWhatBecameOfEach)
{
    ScratchFolder folder;
    std::atomic<bool> open = false;
    std::thread::id there;
    FileWriter writer;
    writer.later(folder / "first", [&, file = folder / "first"] {
        open.wait(false);
        there = std::this_thread::get_id();
        put(file, "1");
    });
    writer.later(folder / "second", [] { throw std::runtime_error("the disk is full"); });
    EXPECT_TRUE(writer.busy());
    EXPECT_TRUE(writer.take_ended().empty()) << "the first one is held up";
    open = true;
    open.notify_all();
    writer.wait();
    const auto ended = writer.take_ended();
    ASSERT_EQ(ended.size(), 2u);
    EXPECT_EQ(ended[0].file, folder / "first");
    EXPECT_EQ(ended[0].error, "");
    EXPECT_EQ(ended[1].error, "the disk is full");
    EXPECT_FALSE(writer.busy());
    EXPECT_NE(there, std::this_thread::get_id());
}

TEST(FileWriter, EndsWithAllFilesWritten)
{
    ScratchFolder folder;
    {
        FileWriter writer;
        for (const char* name : {"a", "b", "c"})
            writer.later(folder / name, [file = folder / name] { put(file, "x"); });
    }
    EXPECT_EQ(folder.names().size(), 3u);
}

} // namespace spia::viewer
