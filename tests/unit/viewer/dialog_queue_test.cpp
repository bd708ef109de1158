#include <gtest/gtest.h>

#include "app/viewer/panels/dialogs/dialog_queue.h"

namespace spia::viewer {
namespace {

/// A frame of a window in which these dialogs are drawn, as begin_modal() does it. @returns what
/// was opened
std::string frame(DialogQueue& queue, const std::vector<std::string>& drawn,
                  const std::vector<std::string>& appear = {}, const std::string& urgent = "")
{
    std::string opened;
    for (const std::string& title : drawn) {
        queue.seen(title);
        if (title == urgent || std::find(appear.begin(), appear.end(), title) != appear.end())
            queue.want(title, title == urgent);
        if (queue.shows(title) && !queue.opened(title)) {
            queue.open(title);
            opened = title;
        }
    }
    queue.end_frame();
    return opened;
}

TEST(DialogQueue, TheSecondComesWhenTheFirstHasBeenAnswered)
{
    DialogQueue queue;
    EXPECT_TRUE(queue.empty());
    EXPECT_EQ(frame(queue, {"recovery", "import"}, {"recovery", "import"}), "recovery");
    EXPECT_EQ(frame(queue, {"recovery", "import"}), "") << "one is open, the other one waits";
    EXPECT_TRUE(queue.shows("recovery"));
    EXPECT_FALSE(queue.shows("import"));
    EXPECT_TRUE(queue.wants("import"));
    queue.leave("recovery");
    EXPECT_EQ(frame(queue, {"recovery", "import"}), "import");
    queue.leave("import");
    frame(queue, {"recovery", "import"});
    EXPECT_TRUE(queue.empty());
}

TEST(DialogQueue, AnUrgentOneGoesBeforeAndTheOtherComesBack)
{
    DialogQueue queue;
    frame(queue, {"export", "unsaved"}, {"export"});
    frame(queue, {"export", "unsaved"}, {}, "unsaved");
    EXPECT_TRUE(queue.shows("unsaved"));
    EXPECT_TRUE(queue.wants("export"));
    queue.leave("unsaved");
    EXPECT_EQ(frame(queue, {"export", "unsaved"}), "export") << "ImGui closed it when the other one opened";
}

TEST(DialogQueue, OneThatIsNotDrawnAnyMoreBlocksNothing)
{
    DialogQueue queue;
    frame(queue, {"import", "export"}, {"import", "export"});
    queue.seen("export"); // the file of the import is gone, and with it its dialog
    EXPECT_TRUE(queue.end_frame()) << "what ImGui still has open is to be closed";
    EXPECT_FALSE(queue.end_frame()) << "once";
    DialogQueue other;
    frame(other, {"import", "export"}, {"import", "export"});
    EXPECT_EQ(frame(other, {"export"}), "") << "not yet: it was waiting when its turn was over";
    EXPECT_EQ(frame(other, {"export"}), "export");
}

} // namespace
} // namespace spia::viewer
