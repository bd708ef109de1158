// Looking into a file before it is opened.
#include "app/viewer/model/document/file_listing.h"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <tuple>

#include "app/viewer/model/actions/script.h"
#include "app/viewer/model/document/project_file.h"
#include "app/viewer/model/reports/state_report.h"
#include "app/viewer/views/import_scene.h"
#include "engine/core/error.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {
namespace {

using testing::ElementsAre;

/// A deck of the parts 7 "Hood" (four quads) and 9 "Rail" (a quad and two triangles).
struct LookedInto : ModelFixture {
    ScratchFolder scratch;
    std::filesystem::path deck = scratch / "strip.k";

    void SetUp() override { put(deck, sample::dyna()); }
    const ListedFile& listed()
    {
        model.apply(ListFile{deck});
        wait();
        if (!state.listing || !state.listing->listed)
            throw Error("not listed: " + (state.listing ? state.listing->failure : ""));
        return *state.listing->listed;
    }
};

} // namespace

TEST_F(LookedInto, APartIsChosenOfADeckAndRead)
{
    const ListedFile& file = listed();
    ASSERT_EQ(file.items.item.size(), 2u);
    EXPECT_EQ(file.items.item[0].name, "Hood");
    EXPECT_EQ(file.mesh.triangles(), 12);
    EXPECT_EQ(document.session.part, nullptr) << "nothing is read yet";
    EXPECT_EQ(proposed_item(file.items), 0) << "the larger one";
    EXPECT_EQ(state_report(state)["listing"]["items"][1]["choice"], "9");

    Reading reading;
    reading.parts = choices_of(file.items, {0, 1});
    EXPECT_THAT(reading.parts, ElementsAre("9"));
    EXPECT_THAT(items_of(file.items, reading.parts).item, ElementsAre(0, 1));
    model.apply(OpenPart{deck, "cm", reading});
    wait();
    ASSERT_NE(document.session.part, nullptr);
    EXPECT_EQ(document.session.part->mesh.triangles(), 4);
    EXPECT_EQ(document.session.part->unit, LengthUnit::cm);
    EXPECT_FALSE(state.listing);
}

TEST_F(LookedInto, WhatCannotBeReadIsSaidAndAnotherFileTakesItsPlace)
{
    const std::filesystem::path good = deck;
    deck = scratch / "no.k";
    model.apply(ListFile{deck});
    wait();
    ASSERT_TRUE(state.listing);
    EXPECT_EQ(state.listing->listed, nullptr);
    EXPECT_THAT(state.listing->failure, testing::HasSubstr("no such file"));
    deck = good;
    EXPECT_EQ(listed().items.item.size(), 2u);
    model.apply(ListFile{deck});
    model.apply(CloseList{}); // while it is being read
    wait();
    EXPECT_FALSE(state.listing);
}

TEST_F(LookedInto, TheFileOfThePartIsReadAgainWithoutLosingWhatWasDone)
{
    Reading reading;
    reading.parts = {"7"};
    model.apply(OpenPart{deck, "", reading});
    wait();
    model.apply(SelectFaces{{0, 1}});
    model.apply(MakeRegion{"flat"});
    ASSERT_EQ(document.regions.size(), 1u);
    model.apply(ListFile{scratch / "other.k", true});
    EXPECT_FALSE(state.listing) << "it is not that of the part";
    model.apply(ListFile{deck, true});
    wait();
    ASSERT_TRUE(state.listing && state.listing->again);
    reading.parts = {"7", "9"};
    model.apply(ReadAgain{"", reading});
    wait();
    EXPECT_FALSE(state.listing) << "it is closed when it is read";
    ASSERT_NE(document.session.part, nullptr);
    EXPECT_EQ(document.session.part->mesh.triangles(), 12);
    ASSERT_EQ(document.regions.size(), 1u) << "regions are found again";
    EXPECT_EQ(document.regions[0].name, "flat");
    model.apply(Undo{});
    wait();
    EXPECT_THAT(document.session.options.read.parts, ElementsAre("7"));
    const auto part = document.session.part;
    model.apply(ListFile{deck, true});
    wait();
    reading.parts = {"7"};
    model.apply(ReadAgain{"", reading});
    wait();
    EXPECT_EQ(document.session.part, part) << "nothing else was chosen";
    EXPECT_FALSE(state.listing);
    model.apply(ReadAgain{"inch", reading});
    wait();
    EXPECT_EQ(document.session.part->unit, LengthUnit::inch);
    EXPECT_EQ(document.regions.size(), 1u);
}

/// Looking into a large file is given up for another one.
TEST_F(LookedInto, AFileThatTakesLongIsLeftForAnother)
{
    put(
        scratch / "long.k", "*KEYWORD\n*NODE\n" + [] {
            std::string nodes;
            for (int i = 1; i < 400'000; ++i)
                nodes += std::to_string(i) + ",0,0,0\n";
            return nodes;
        }());
    model.apply(ListFile{scratch / "long.k"});
    EXPECT_EQ(state.listing->listed, nullptr);
    model.apply(ListFile{deck}); // at once
    wait();
    ASSERT_TRUE(state.listing && state.listing->listed);
    EXPECT_EQ(state.listing->file, deck);
    EXPECT_EQ(state.listing->listed->items.item.size(), 2u);
    model.apply(ListFile{scratch / "long.k"});
    model.apply(CancelJob{});
    EXPECT_FALSE(state.listing) << "looking is work that can be cancelled";
}

TEST_F(LookedInto, ThePreviewTellsWhatIsChosen)
{
    const ListedFile& file = listed();
    const auto faces = [&](const std::vector<char>& chosen) {
        std::vector<Eigen::Index> count;
        for (const SceneLayer& layer : import_scene(file, preview_shape(file, chosen), {}).layers)
            count.push_back(layer.mesh->triangle.cols());
        return count;
    };
    EXPECT_THAT(faces({1, 0}), ElementsAre(8, 4)) << "what is chosen, and the rest";
    EXPECT_THAT(faces({0, 1}), ElementsAre(4, 8));
    EXPECT_THAT(faces({0, 0}), ElementsAre(12)) << "the whole file";
    EXPECT_THAT(faces({1, 1}), ElementsAre(12));
    const Scene scene = import_scene(file, preview_shape(file, {1, 0}), 1);
    const auto lit = [](const SceneLayer& layer) {
        const auto& mark = layer.marks->mark;
        return std::count_if(mark.begin(), mark.end(), [](uint8_t m) { return m == FaceMarks::hovered; });
    };
    EXPECT_EQ(lit(scene.layers[0]), 0);
    EXPECT_EQ(lit(scene.layers[1]), 4);
    EXPECT_LT(scene.layers[1].colour[3], 1) << "what lies inside is seen";
}

TEST(FileItems, WhatLiesInAChosenItemIsNotNamedTwice)
{
    FileItems items;
    items.item.resize(4); // an assembly of two bodies, and a body beside it
    const char* choices[] = {"assembly:0", "body:0", "body:1", "body:2"};
    const int parents[] = {-1, 0, 0, -1};
    for (size_t i = 0; i < 4; ++i) {
        items.item[i].choice = choices[i];
        items.item[i].parent = parents[i];
        items.item[i].faces = 6;
        items.item[i].area = i == 0 ? 99 : double(i);
    }
    EXPECT_THAT(choices_of(items, {1, 1, 0, 1}), ElementsAre("assembly:0", "body:2"));
    EXPECT_THAT(with_what_they_hold(items, {1, 0, 0, 0}), ElementsAre(1, 1, 1, 0));
    EXPECT_EQ(proposed_item(items), 3) << "the largest that holds no others";
    for (FileItem& item : items.item) {
        item.kind = "sheet body";
        item.faces = 1;
    }
    EXPECT_EQ(proposed_item(items), -1) << "loose faces, which belong together";
    items.item[1].faces = 2;
    EXPECT_EQ(proposed_item(items), 3);
    items.item.resize(1);
    EXPECT_EQ(proposed_item(items), -1) << "there is no choice";
}

TEST(FileItems, AreFoundByTheirNamesToo)
{
    FileItems items;
    items.item.resize(4);
    const std::pair<const char*, const char*> called[] = {{"7", "Hood"}, {"9", "hood"}, {"12", "Rail"}, {"", "Rest"}};
    for (size_t i = 0; i < 4; ++i)
        std::tie(items.item[i].choice, items.item[i].name) = called[i];
    const auto chosen = [&](const std::vector<std::string>& choices) { return items_of(items, choices); };
    EXPECT_THAT(chosen({"9", "RAIL"}).item, ElementsAre(0, 1, 1, 0));
    EXPECT_THAT(chosen({"hood"}).item, ElementsAre(0, 1, 0, 0)) << "as it is written, before any case";
    EXPECT_THAT(chosen({"3", "Rail", "10-19", "Rest"}).others, ElementsAre("3", "10-19", "Rest"))
        << "faces, and what cannot be chosen";
}

TEST(FileItems, TrianglesWithoutPlaceAreLeftOutOfThePreview)
{
    const ScratchFolder scratch;
    put(scratch / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\nf 1 1 2\n");
    const ListedFile file = look_into(scratch / "a.obj", {});
    EXPECT_EQ(file.mesh.triangles(), 2);
    EXPECT_THAT(file.polygon, ElementsAre(0, 1));
    ASSERT_TRUE(file.picker);
    EXPECT_EQ(file.picker->first({0.2, 0.2, 9}, {0, 0, -1}).face, 0);
}

TEST(FileItems, DecksAndCadFilesAreWorthLookingInto)
{
    for (const char* name : {"a.K", "b.step", "c.IGS", "d.msh"})
        EXPECT_TRUE(has_choices(name)) << name;
    for (const char* name : {"a.stl", "b.obj", "c.spia", "d"})
        EXPECT_FALSE(has_choices(name)) << name;
}

TEST(Readings, AreWhatTheyWereAfterTheOptionsAndAProject)
{
    const Reading reading{true, true, {"7", "body:2"}, Skin::middle, 0.02, 0.1, true};
    ReadOptions options;
    options.unit = LengthUnit::inch;
    set_reading(options, reading);
    EXPECT_EQ(reading_of(options), reading);
    EXPECT_EQ(options.unit, LengthUnit::inch) << "is none of them";

    const ScratchFolder scratch;
    Document document;
    document.session.file = scratch / "part.step";
    document.session.options.read = options;
    document.session.part = std::make_shared<PartFile>();
    save_project(scratch / "p.spia", document, {});
    const Project again = open_project(scratch / "p.spia", SPIA_SOURCE_DIR "/assets/materials");
    EXPECT_EQ(reading_of(again.document.session.options.read), reading);
}

} // namespace spia::viewer
