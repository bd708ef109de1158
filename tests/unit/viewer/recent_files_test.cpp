#include "app/viewer/model/document/recent_files.h"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/viewer/model/document/project_file.h"
#include "app/viewer/model/jobs/viewer_model.h"
#include "engine/core/error.h"
#include "engine/pipeline/run_stage.h"
#include "tests/unit/viewer/own_home.h"
#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

/// With parts in it.
class RecentFiles : public OwnHome {
protected:
    fs::path part(const std::string& name)
    {
        put(folder / name, "v 0 0 0\n");
        return folder / name;
    }
};
using UnfinishedWork = RecentFiles;

/// What happens in a program that ends without a word. @returns its exit status
template <class Work> int in_a_program_that_crashes(const Work& work)
{
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            work();
        } catch (...) {
            ::_exit(1);
        }
        ::_exit(0); // no destructor runs
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    return status;
}

} // namespace

TEST_F(RecentFiles, TheFoldersFollowTheStandard)
{
    EXPECT_EQ(config_folder(), folder / ".config/spia");
    EXPECT_EQ(state_folder(), folder / ".local/state/spia");
    ::setenv("XDG_CONFIG_HOME", (folder / "c").c_str(), 1);
    ::setenv("XDG_STATE_HOME", "relative/does/not/count", 1);
    EXPECT_EQ(config_folder(), folder / "c/spia");
    EXPECT_EQ(state_folder(), folder / ".local/state/spia");
}

TEST_F(RecentFiles, AreTheTenNewestOnceEach)
{
    EXPECT_TRUE(recent_files().empty());
    for (int i = 0; i < 12; ++i)
        remember_recent(part(fmt::format("p{}", i)));
    remember_recent(folder / "p5");
    const auto files = recent_files();
    ASSERT_EQ(files.size(), 10u);
    EXPECT_EQ(files[0].filename(), "p5");
    EXPECT_EQ(files[1].filename(), "p11");
    EXPECT_EQ(std::count(files.begin(), files.end(), files[0]), 1);
    fs::remove(folder / "p11");
    EXPECT_EQ(recent_files()[1].filename(), "p10");
}

TEST_F(RecentFiles, ADamagedListCountsAsEmptyAndIsReplaced)
{
    remember_recent(part("p"));
    for (const char* damaged : {"", "[", "7", "{\"schema\":\"spia-recent/1\",\"files\":[7]}", "{\"schema\":7}"}) {
        put(config_folder() / "recent.json", damaged);
        EXPECT_TRUE(recent_files().empty()) << damaged;
    }
    remember_recent(folder / "p");
    EXPECT_EQ(recent_files().size(), 1u);
}

TEST_F(UnfinishedWork, OfACrashedProgramIsFoundOnceAndGoneWhenDiscarded)
{
    EXPECT_FALSE(unfinished_session());
    Document document = viewer::document_of(dome, Stage::read);
    document.selected = {1, 2, 3};
    ASSERT_EQ(in_a_program_that_crashes([&] {
                  auto* autosave = new Autosave; // never destroyed
                  autosave->save(document, {}, folder / "mine.spia");
              }),
              0);
    {
        auto found = unfinished_session();
        ASSERT_TRUE(found);
        EXPECT_FALSE(unfinished_session()); // the one that has it keeps it
        Project project = open_project(found->file(), materials_folder);
        EXPECT_EQ(project.recovers, folder / "mine.spia");
        project.document.session = run_stage(Stage::read, project.document.session);
        restore_picks(project.document, project.picks);
        EXPECT_EQ(project.document.selected, document.selected);
    }
    auto again = unfinished_session(); // not discarded: still there
    ASSERT_TRUE(again);
    again->discard();
    EXPECT_FALSE(unfinished_session());
    EXPECT_TRUE(fs::is_empty(state_folder()));
}

TEST_F(UnfinishedWork, OfALivingProgramIsNotTouchedAndACleanEndLeavesNothing)
{
    const Document document = viewer::document_of(dome, Stage::read);
    Autosave autosave;
    autosave.save(document, {}, {});
    autosave.save(document, {}, {});
    int found = -1;
    ASSERT_EQ(in_a_program_that_crashes([&] {
                  if (unfinished_session())
                      throw InputError("found");
              }),
              0);
    found = unfinished_session().has_value();
    EXPECT_EQ(found, 0);
    autosave.clear();
    EXPECT_TRUE(fs::is_empty(state_folder()));
}

TEST_F(UnfinishedWork, IsCalledByItsProjectOrElseByItsPart)
{
    const Document document = viewer::document_of(dome, Stage::read);
    const auto crash = [&](const fs::path& project) {
        return in_a_program_that_crashes([&] { (new Autosave)->save(document, {}, project); });
    };
    ASSERT_EQ(crash({}), 0);
    auto left = unfinished_session();
    ASSERT_TRUE(left);
    EXPECT_EQ(left->name(), document.session.file.filename());
    left->discard();
    ASSERT_EQ(crash(folder / "mine.spia"), 0);
    left = unfinished_session();
    ASSERT_TRUE(left);
    EXPECT_EQ(left->name(), "mine.spia");
    put(left->file(), "{\"part\": 7}");
    EXPECT_EQ(left->name(), "");
    left.reset(); // no answer: it is kept, as damaged as it is
    EXPECT_TRUE(unfinished_session());
}

TEST_F(UnfinishedWork, OfAPartWithoutAProjectIsUnsavedAndHasNoProjectWhenItIsOpened)
{
    const Document document = viewer::document_of(dome, Stage::read);
    for (const char* project : {"", "mine.spia"}) {
        const fs::path own = *project ? folder / project : fs::path();
        ASSERT_EQ(in_a_program_that_crashes([&] { (new Autosave)->save(document, {}, own); }), 0);
        auto left = unfinished_session();
        ASSERT_TRUE(left);
        EXPECT_TRUE(is_autosave(left->file()));
        ViewerModel model(materials_folder.parent_path());
        model.apply(OpenProject{left->file()});
        EXPECT_EQ(model.state().project, own);
        EXPECT_TRUE(model.state().document.unsaved);
        left->discard();
    }
    EXPECT_FALSE(is_autosave(folder / "autosave-of-mine.spia"));
}

TEST(Ago, CountsTheLargestUnit)
{
    using namespace std::chrono_literals;
    EXPECT_EQ(ago(-5s), "just now"); // clocks are set back
    EXPECT_EQ(ago(59s), "just now");
    EXPECT_EQ(ago(60s), "1 minute ago");
    EXPECT_EQ(ago(59min + 59s), "59 minutes ago");
    EXPECT_EQ(ago(23h + 59min), "23 hours ago");
    EXPECT_EQ(ago(49h), "2 days ago");
}

TEST_F(UnfinishedWork, TheNewestIsOfferedFirst)
{
    const Document document = viewer::document_of(dome, Stage::read);
    for (const char* name : {"old.spia", "new.spia"})
        ASSERT_EQ(in_a_program_that_crashes([&] { (new Autosave)->save(document, {}, folder / name); }), 0);
    // time stamps of a file system may be coarse
    for (const auto& entry : fs::directory_iterator(state_folder()))
        if (entry.path().extension() == ".spia" &&
            open_project(entry.path(), materials_folder).recovers.filename() == "old.spia")
            fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::hours(1));
    auto first = unfinished_session();
    ASSERT_TRUE(first);
    EXPECT_EQ(open_project(first->file(), materials_folder).recovers.filename(), "new.spia");
    first->discard();
    auto second = unfinished_session();
    ASSERT_TRUE(second);
    EXPECT_EQ(open_project(second->file(), materials_folder).recovers.filename(), "old.spia");
}

} // namespace spia::viewer
