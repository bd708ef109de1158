// Looking into a file before it is opened.
#include "app/viewer/model/file_listing.h"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>

#include "app/viewer/model/project_file.h"
#include "app/viewer/model/script.h"
#include "app/viewer/model/state_report.h"
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
    EXPECT_EQ(items_of(file.items, reading.parts), (std::vector<char>{0, 1}));
    model.apply(OpenPart{deck, "cm", reading});
    model.apply(CloseList{});
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
    EXPECT_TRUE(lies_in(items, 2, 0));
    EXPECT_FALSE(lies_in(items, 3, 0));
    EXPECT_EQ(proposed_item(items), 3) << "the largest that holds no others";
    items.item.resize(1);
    EXPECT_EQ(proposed_item(items), -1) << "there is no choice";
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
