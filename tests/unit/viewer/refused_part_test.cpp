#include <gtest/gtest.h>
#include <thread>

#include "app/viewer/model/actions/members.h"
#include "app/viewer/model/jobs/viewer_model.h"
#include "app/viewer/model/reports/state_report.h"
#include "app/viewer/views/views.h"
#include "tests/support/mesh_file.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::viewer {
namespace {

struct RefusedPart : testing::Test {
    ScratchFolder folder;
    ViewerModel model{SPIA_SOURCE_DIR "/assets"};
    const ViewerState& state = model.state();

    void apply(const Action& action)
    {
        model.apply(action);
        while (model.busy()) {
            model.poll();
            std::this_thread::yield();
        }
    }
    int errors() const
    {
        return int(std::count_if(state.messages.begin(), state.messages.end(),
                                 [](const Message& m) { return m.severity == Severity::error && !m.dismissed; }));
    }
    /// Of the refused part; -1: the doctor has none of that kind.
    int finding(Fault fault) const
    {
        const auto& all = state.refused->doctor.findings;
        const auto at = std::find_if(all.begin(), all.end(), [&](const Finding& f) { return f.fault == fault; });
        return at == all.end() ? -1 : int(at - all.begin());
    }
    Eigen::Vector3d place_of(int number) const { return state.refused->doctor.findings[size_t(number)].place[0]; }
    /// Two rectangles that do not touch: half the triangles each.
    std::filesystem::path two_pieces()
    {
        auto file = folder / "two.obj";
        shapes::write_mesh(file, shapes::two_rectangles());
        return file;
    }
};

} // namespace

TEST_F(RefusedPart, IsShownWithItsFaultsAndTheViewGoesToEach)
{
    apply(OpenPart{two_pieces(), ""});
    EXPECT_EQ(state.document.session.part, nullptr);
    ASSERT_NE(state.refused, nullptr);
    EXPECT_EQ(errors(), 1);
    EXPECT_EQ(state_report(state)["doctor"]["refused"], true);
    EXPECT_EQ(window_title(state), "SPIA");

    SceneCache cache;
    const Scene shown = scene(View::part, state, cache);
    ASSERT_EQ(shown.layers.size(), 1u);
    EXPECT_EQ(shown.layers[0].mesh->triangle.cols(), state.refused->mesh.triangles());

    const int pieces = finding(Fault::several_components);
    ASSERT_GE(pieces, 0);
    const auto before = state.view.camera;
    apply(ShowFault{pieces, 0});
    ASSERT_TRUE(state.fault);
    EXPECT_EQ(state.fault->place, place_of(pieces));
    EXPECT_NE(state.view.camera, before);
    const glm::dvec3 target = state.view.camera[size_t(View::part)].target;
    EXPECT_EQ(Eigen::Vector3d(target.x, target.y, target.z), place_of(pieces));
    EXPECT_EQ(scene(View::part, state, cache).labels.size(), 1u);

    apply(ShowFault{pieces, 1});
    EXPECT_EQ(errors(), 2); // there is one place only
    apply(ShowFault{int(state.refused->doctor.findings.size()), 0});
    EXPECT_EQ(errors(), 3);
    apply(ShowFault{pieces, 0}); // from place to place the way back is that of the first one
    apply(HideFault{});
    EXPECT_FALSE(state.fault);
    EXPECT_TRUE(scene(View::part, state, cache).labels.empty());
    EXPECT_EQ(state.view.camera, before);
    apply(ShowFault{pieces, 0});
    apply(LookFrom{View::part, StandardView::left});
    const auto moved = state.view.camera;
    apply(HideFault{});
    EXPECT_EQ(state.view.camera[size_t(View::part)], moved[size_t(View::part)]) << "a view that was moved on stays";
    for (const Message& message : state.messages)
        EXPECT_EQ(message.text.find("--"), std::string::npos) << message.text << ": there is no command line here";
}

TEST_F(RefusedPart, IsTakenWithoutItsSmallerPiecesAndRefusedAgainAfterUndo)
{
    const TriMesh both = shapes::two_rectangles();
    apply(OpenPart{two_pieces(), ""});
    apply(SetReading{{{}, true}});
    ASSERT_NE(state.document.session.part, nullptr);
    EXPECT_EQ(state.refused, nullptr);
    EXPECT_LT(state.document.session.part->mesh.triangles(), both.triangles());
    EXPECT_EQ(first_stale(state.document), Stage::solve);
    EXPECT_EQ(state.history.undo_name(), "Change reading options");
    apply(SetReading{{{}, false}}); // refused again: what is there stays to be looked at, out of
                                    // date
    EXPECT_EQ(errors(), 1);
    EXPECT_EQ(first_stale(state.document), Stage::read);
    EXPECT_NE(state.document.session.part, nullptr);
    apply(Undo{});
    EXPECT_EQ(first_stale(state.document), Stage::solve);
    apply(Undo{});
    EXPECT_EQ(state.document.session.part, nullptr);
    EXPECT_FALSE(state.document.session.options.read.doctor.keep_largest);
}

TEST_F(RefusedPart, KeepsRegionsOnTheirFacesWhenFacesBeforeThemAreLeftOut)
{
    // A small piece first in the file, so that all numbers change.
    const TriMesh sheet = shapes::rectangle(50, 40, 5, 4);
    TriMesh both = sheet;
    const TriMesh rib = shapes::rectangle(5, 4, 2, 2);
    both.position.resize(3, rib.vertices() + sheet.vertices());
    both.position << (rib.position.colwise() + Eigen::Vector3d(0, 0, 30)), sheet.position;
    both.triangle.resize(3, rib.triangles() + sheet.triangles());
    both.triangle << rib.triangle, (sheet.triangle.array() + rib.vertices()).matrix();
    shapes::write_mesh(folder / "rib.obj", both);

    apply(OpenPart{folder / "rib.obj", ""});
    apply(SetReading{{{}, true}});
    ASSERT_NE(state.document.session.part, nullptr);
    ASSERT_EQ(state.document.session.part->mesh.triangles(), sheet.triangles());
    apply(SelectFaces{{3, 7}, PickMode::replace});
    apply(MakeRegion{"clamp", RegionKind::binder});
    apply(SetReading{{true, true}});
    ASSERT_EQ(state.document.regions.size(), 1u);
    EXPECT_EQ(state.document.regions[0].faces, (std::vector<int>{3, 7}));
    EXPECT_EQ(errors(), 0);
}

TEST_F(RefusedPart, ReadAgainWithItsFacesInAnotherOrderKeepsPicksWhereTheyAreInSpace)
{
    const TriMesh sheet = shapes::rectangle(50, 40, 5, 4);
    const shapes::Permuted other = shapes::permuted(sheet, 5);
    const std::vector<int> clamp = {3, 7}, chosen = {12};
    const auto elsewhere = [&](const std::vector<int>& faces) {
        std::vector<int> result;
        result.reserve(faces.size());
        for (const int f : faces)
            result.push_back(other.face[size_t(f)]);
        std::sort(result.begin(), result.end());
        return result;
    };
    ASSERT_NE(elsewhere(clamp), clamp);
    ASSERT_NE(elsewhere(chosen), chosen);

    shapes::write_mesh(folder / "sheet.obj", sheet);
    apply(OpenPart{folder / "sheet.obj", ""});
    apply(SelectFaces{clamp, PickMode::replace});
    apply(MakeRegion{"clamp", RegionKind::binder});
    apply(SelectFaces{chosen, PickMode::replace});
    apply(AddProbe{{7, {0.2, 0.3, 0.5}}});
    apply(SelectVertices{{4}, PickMode::replace});
    shapes::write_mesh(folder / "sheet.obj", other.mesh); // another program wrote the file in its
                                                          // own order
    apply(SetReading{{true, true}});
    EXPECT_EQ(errors(), 0);
    const Document& after = state.document;
    ASSERT_EQ(after.session.part->mesh.triangle, other.mesh.triangle);
    ASSERT_EQ(after.regions.size(), 1u);
    EXPECT_EQ(after.regions[0].faces, elsewhere(clamp));
    EXPECT_EQ(after.selected, elsewhere(chosen));
    EXPECT_EQ(after.vertices, (std::vector<int>{other.vertex[4]}));
    ASSERT_EQ(after.probes.size(), 1u);
    EXPECT_EQ(after.probes[0].face, other.face[7]);
    apply(Undo{});
    EXPECT_EQ(after.regions[0].faces, clamp);
    EXPECT_EQ(after.selected, chosen);
}

TEST_F(RefusedPart, ThatCannotBeReadAtAllIsNotShown)
{
    put(folder / "broken.obj", "v 0 0 x\n");
    apply(OpenPart{folder / "broken.obj", ""});
    EXPECT_EQ(state.refused, nullptr);
    EXPECT_EQ(errors(), 1);
    apply(ShowFault{0, 0});
    EXPECT_EQ(errors(), 2);
    apply(OpenPart{two_pieces(), ""});
    EXPECT_NE(state.refused, nullptr);
    apply(OpenPart{SPIA_SOURCE_DIR "/assets/parts/dome.obj", ""});
    EXPECT_EQ(state.refused, nullptr);
    EXPECT_EQ(errors(), 0);
}

TEST_F(RefusedPart, LeavesThePartThatIsOpenWithItsResults)
{
    apply(OpenPart{SPIA_SOURCE_DIR "/assets/parts/dome.obj", ""});
    apply(SelectFaces{{1, 2, 3}, PickMode::replace});
    apply(RunTo{Stage::solve});
    const auto part = state.document.session.part;
    const auto blank = state.document.session.blank;
    ASSERT_NE(blank, nullptr);
    const auto cameras = state.view.camera;
    put(folder / "broken.obj", "v 0 0 x\n");
    for (const auto& file : {folder / "broken.obj", two_pieces()}) {
        apply(OpenPart{file, ""});
        EXPECT_EQ(state.document.session.part, part);
        EXPECT_EQ(state.document.session.blank, blank);
        EXPECT_EQ(first_stale(state.document), Stage::grid);
        EXPECT_EQ(state.document.selected, (std::vector<int>{1, 2, 3}));
        EXPECT_TRUE(state.document.unsaved);
        EXPECT_EQ(window_title(state), "dome* - SPIA");
        EXPECT_EQ(state.view.camera, cameras);
        EXPECT_EQ(examined(state), part.get()) << "until its faults are asked for";
        ASSERT_FALSE(state.messages.empty());
        const Message& said = state.messages.back();
        EXPECT_EQ(said.severity, Severity::error);
        EXPECT_NE(said.text.find(file.filename().string()), std::string::npos) << said.text;
        EXPECT_EQ(said.text.find(folder / ""), std::string::npos) << said.text << ": the name is enough";
        EXPECT_NE(said.text.find("dome.obj is still open"), std::string::npos) << said.text;
    }
    apply(Undo{}); // the run, as if nothing had been opened
    EXPECT_EQ(state.history.undo_name(), "Select faces");
    EXPECT_EQ(state.document.session.blank, nullptr);
    EXPECT_NE(state.refused, nullptr) << "it has nothing to do with the part";
}

TEST_F(RefusedPart, OpenedBesideAPartIsShownOnRequestAndThePartComesBack)
{
    apply(OpenPart{SPIA_SOURCE_DIR "/assets/parts/dome.obj", ""});
    const auto part = state.document.session.part;
    apply(ShowRefused{});
    EXPECT_EQ(errors(), 1) << "there is none";
    apply(OpenPart{two_pieces(), ""});
    ASSERT_TRUE(state.refused_file);
    const auto cameras = state.view.camera;
    SceneCache cache;
    EXPECT_EQ(scene(View::part, state, cache).layers[0].mesh->triangle.cols(), part->mesh.triangles());

    apply(ShowRefused{});
    EXPECT_TRUE(shows_refused(state));
    EXPECT_EQ(scene(View::part, state, cache).layers[0].mesh->triangle.cols(), state.refused->mesh.triangles());
    EXPECT_EQ(examined(state), state.refused.get());
    const int pieces = finding(Fault::several_components);
    ASSERT_GE(pieces, 0);
    apply(ShowFault{pieces, 0});
    ASSERT_TRUE(state.fault);
    EXPECT_EQ(state.fault->place, place_of(pieces));
    EXPECT_EQ(state.view.camera[size_t(View::surface)], cameras[size_t(View::surface)]) << "shows the part";
    model.hover(View::part, {300, 200}, {600, 400});
    EXPECT_FALSE(state.hovered) << "no face of the part is there";
    EXPECT_EQ(kept_view(state).camera, cameras);

    apply(CloseRefused{});
    EXPECT_FALSE(shows_refused(state));
    EXPECT_EQ(state.refused, nullptr);
    EXPECT_FALSE(state.fault);
    EXPECT_EQ(state.view.camera, cameras);
    EXPECT_EQ(scene(View::part, state, cache).layers[0].mesh->triangle.cols(), part->mesh.triangles());
    EXPECT_TRUE(state.messages.back().gone) << "what was said of it";
}

TEST_F(RefusedPart, StaysFittedWhereTheViewsBesideItAreFittedAnew)
{
    for (const View view : {View::part, View::blank, View::quads, View::surface})
        model.resized(view, {600, 400});
    apply(OpenPart{SPIA_SOURCE_DIR "/assets/parts/dome.obj", ""});
    apply(OpenPart{two_pieces(), ""});
    apply(ShowRefused{});
    const Camera fitted = state.view.camera[size_t(View::part)], other = state.view.camera[size_t(View::quads)];
    model.resized(View::quads, {300, 400}); // as where a legend comes or goes
    EXPECT_NE(state.view.camera[size_t(View::quads)], other);
    EXPECT_EQ(state.view.camera[size_t(View::part)], fitted);
}

TEST_F(RefusedPart, BesideAPartIsTakenWithoutItsSmallerPieces)
{
    apply(OpenPart{SPIA_SOURCE_DIR "/assets/parts/dome.obj", ""});
    apply(OpenPart{two_pieces(), ""});
    apply(ShowRefused{});
    apply(OpenPart{two_pieces(), "", {{}, true}}); // as the panel's button does
    ASSERT_NE(state.document.session.part, nullptr);
    EXPECT_EQ(window_title(state), "two - SPIA");
    EXPECT_FALSE(state.refused_file);
    EXPECT_EQ(state.refused, nullptr);
    EXPECT_EQ(state.history.undo_name(), "");
}

TEST_F(RefusedPart, UntilAnotherPartIsThereTheOneBeforeIsNotChangedButLookedAt)
{
    apply(OpenPart{SPIA_SOURCE_DIR "/assets/parts/dome.obj", ""});
    const auto part = state.document.session.part;
    model.apply(OpenPart{SPIA_SOURCE_DIR "/assets/parts/inner-panel.obj", ""});
    EXPECT_EQ(state.document.session.part, part);
    EXPECT_TRUE(model.opening_beside());
    EXPECT_EQ(window_title(state), "dome - SPIA");
    model.apply(SelectFaces{{4}, PickMode::replace});
    EXPECT_TRUE(state.document.selected.empty()) << "it would be lost";
    EXPECT_EQ(errors(), 1);
    FieldDisplay display = state.document.display;
    display.field = Field::strain_major;
    display.bands = 8;
    model.apply(SetDisplay{display});
    EXPECT_EQ(errors(), 0) << "a refusal goes with the next change";
    while (model.busy())
        model.poll();
    EXPECT_NE(state.document.session.part, part);
    EXPECT_EQ(window_title(state), "inner-panel - SPIA");
    EXPECT_EQ(state.document.display.bands, 8) << "how fields are drawn is of the user";
    EXPECT_EQ(state.document.display.field, Field::thinning) << "what another part is looked at for first";
    EXPECT_EQ(errors(), 0);
}

TEST_F(RefusedPart, OpeningThatIsCancelledLeavesThePart)
{
    apply(OpenPart{SPIA_SOURCE_DIR "/assets/parts/dome.obj", ""});
    const auto part = state.document.session.part;
    // read long after it is cancelled
    shapes::write_mesh(folder / "large.obj", shapes::rectangle(300, 200, 300, 200));
    model.apply(OpenPart{folder / "large.obj", ""});
    apply(CancelJob{});
    ASSERT_EQ(state.document.session.part, part);
    EXPECT_EQ(window_title(state), "dome - SPIA");
    EXPECT_NE(state.messages.back().text.find("dome.obj is still open"), std::string::npos);
    apply(SelectFaces{{4}, PickMode::replace});
    EXPECT_EQ(state.document.selected, (std::vector<int>{4}));
}

TEST_F(RefusedPart, ARunThatAnOpeningEndsIsNoChangeOfThePartThatStays)
{
    apply(OpenPart{SPIA_SOURCE_DIR "/assets/parts/inner-panel.obj", ""});
    model.apply(RunTo{Stage::solve});
    EXPECT_FALSE(state.document.unsaved) << "what is computed comes again by one key";
    apply(OpenPart{two_pieces(), ""});
    EXPECT_EQ(window_title(state), "inner-panel - SPIA") << "nothing to save";
    EXPECT_EQ(state.history.undo_name(), "");
    EXPECT_EQ(state.document.session.blank, nullptr);
}

TEST(TakeChanges, OfTwoThatSawTheSameBothCount)
{
    ViewSettings seen, now;
    ViewSettings first = seen, second = seen;
    first.edges = true;
    first.camera[size_t(View::blank)].height = 7;
    second.dark = !seen.dark;
    second.camera[size_t(View::part)].height = 9;
    take_changes(seen, first, now);
    take_changes(seen, second, now);
    EXPECT_TRUE(now.edges);
    EXPECT_EQ(now.dark, !seen.dark);
    EXPECT_EQ(now.camera[size_t(View::blank)].height, 7);
    EXPECT_EQ(now.camera[size_t(View::part)].height, 9);
    EXPECT_EQ(now.camera[size_t(View::quads)], seen.camera[size_t(View::quads)]);
}

TEST_F(RefusedPart, ChangesOfOneNameAreOneForUndoUntilTheMouseIsFree)
{
    apply(OpenPart{SPIA_SOURCE_DIR "/assets/parts/dome.obj", ""});
    const double before = state.document.session.options.flatten.thickness;
    apply(SetThickness{2});
    apply(SetThickness{3});
    model.gesture_ended();
    apply(SetThickness{4});
    apply(Undo{});
    EXPECT_EQ(state.document.session.options.flatten.thickness, 3);
    apply(Undo{});
    EXPECT_EQ(state.document.session.options.flatten.thickness, before);
}

} // namespace spia::viewer
