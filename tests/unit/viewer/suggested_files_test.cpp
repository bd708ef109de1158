#include "app/viewer/model/document/suggested_files.h"

#include "tests/unit/exchange/scratch_folder.h"

namespace spia::viewer {

TEST(SuggestedFiles, LieBesideTheProjectElseThePartElseWhatWasOpenedLast)
{
    const ScratchFolder scratch;
    namespace fs = std::filesystem;
    for (const char* folder : {"projects", "parts", "old", "assets/parts"})
        fs::create_directories(scratch / folder);
    const fs::path assets = scratch / "assets", sample = assets / "parts" / "inner-panel.obj";
    const std::vector<fs::path> recent = {scratch / "gone" / "a.stl", scratch / "old" / "b.stl"};

    ViewerState state;
    EXPECT_EQ(working_folder(state, {}, assets), fs::current_path());
    EXPECT_EQ(working_folder(state, recent, assets), scratch / "old") << "the newest that is still there";
    state.document.session.file = sample;
    EXPECT_EQ(suggested_file(state, recent, assets, ".html"), scratch / "old" / "inner-panel.html")
        << "nobody works where the samples are";
    state.document.session.file = scratch / "parts" / "door.left.stl";
    EXPECT_EQ(suggested_file(state, recent, assets, ".spia"), scratch / "parts" / "door.left.spia");
    state.project = scratch / "projects" / "try 2.spia";
    EXPECT_EQ(suggested_file(state, recent, assets, "-part.png"), scratch / "projects" / "try 2-part.png");
}

} // namespace spia::viewer
