#include "app/viewer/model/jobs/viewer_model.h"

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "app/viewer/model/actions/names.h"
#include "app/viewer/model/picking/pickers.h"
#include "app/viewer/views/views.h"
#include "tests/support/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {

using CornerChoice = ModelFixture;

TEST_F(CornerChoice, ACornerDroppedOnAnotherEndsTheCoarseGrid)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    const int cells = document.session.grid->result.planar.columns;
    const auto corner = document.session.grid->boundary.corner;
    model.apply(SetCorner{0, document.session.grid->boundary.side[0][3], true});
    wait();
    model.apply(SetCorner{0, corner[1], false}); // where corner 2 is
    wait();
    EXPECT_NEAR(document.session.grid->result.planar.columns, cells, 4);
    EXPECT_FALSE(first_stale(document));
}

TEST_F(CornerChoice, ACornerInsideTheBlankIsRefusedAndNotWanted)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    const auto wanted = document.session.options.corners;
    const std::vector<int>& outline = model.pickers().outline(document.session);
    int inside = 0;
    while (std::find(outline.begin(), outline.end(), inside) != outline.end())
        ++inside;
    model.apply(SetCorner{0, inside, false});
    EXPECT_TRUE(says(Severity::error, "not on the outer outline"));
    EXPECT_EQ(document.session.options.corners, wanted);
    EXPECT_FALSE(model.busy());
}

TEST_F(CornerChoice, ADraggedCornerCountsAsOneChangeAndEndsWithAFullGrid)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    const auto before = document.session.grid->boundary.corner;
    const int columns = document.session.grid->result.planar.columns;
    const auto& side = document.session.grid->boundary.side[0];
    for (size_t k = 1; k < 6; ++k)
        model.apply(SetCorner{0, side[k], true});
    wait();
    EXPECT_EQ(document.session.grid->boundary.corner[0], side[5]);
    EXPECT_LT(document.session.grid->result.planar.columns, columns / 2); // coarse while dragging
    model.apply(SetCorner{0, side[6], false});
    wait();
    EXPECT_EQ(document.session.grid->boundary.corner[0], side[6]);
    EXPECT_NEAR(document.session.grid->result.planar.columns, columns,
                4); // square cells between sides of another length
    EXPECT_NE(document.session.surface, nullptr);
    EXPECT_FALSE(first_stale(document));
    EXPECT_EQ(state.history.undo_name(), "Move corner 1");
    model.apply(Undo{});
    EXPECT_EQ(document.session.grid->boundary.corner, before);
}

TEST_F(CornerChoice, ACornerThatIsDroppedWhereItWasIsNoChange)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    const auto grid = document.session.grid;
    model.apply(SetCorner{1, grid->boundary.corner[1], false});
    EXPECT_FALSE(document.unsaved);
    EXPECT_FALSE(model.busy());
    EXPECT_NE(state.history.undo_name(), "Move corner 2");
    EXPECT_EQ(document.session.grid, grid);
    EXPECT_TRUE(says(Severity::hint, "Corner 2 stays where it is"));
}

TEST_F(CornerChoice, WhileACornerIsDraggedTheQuadsFollowAndTheLastSurfaceStaysAndIsCalledOld)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    const auto lifted = document.session.lifted;
    const auto surface = document.session.surface;
    EXPECT_FALSE(is_old(state, View::quads) || is_old(state, View::surface));
    const std::vector<int> side = document.session.grid->boundary.side[0];
    for (const size_t k : {2, 4}) { // two coarse grids, one after the other
        model.apply(SetCorner{0, side[k], true});
        wait();
        ASSERT_NE(document.session.lifted, nullptr);
        EXPECT_EQ(quads_shown(state).lifted, document.session.lifted);
        EXPECT_NE(document.session.lifted, lifted);
        EXPECT_EQ(document.session.grid->boundary.corner[0], side[k]);
        EXPECT_EQ(surface_shown(state).surface, surface);
        EXPECT_TRUE(is_old(state, View::surface));
        SceneCache cache;
        EXPECT_TRUE(scene(View::quads, state, cache).empty.empty());
        EXPECT_TRUE(scene(View::surface, state, cache).empty.empty());
    }
    model.apply(SetCorner{0, side[5], false});
    wait();
    EXPECT_NE(quads_shown(state).lifted, lifted);
    EXPECT_EQ(quads_shown(state).lifted, document.session.lifted);
    EXPECT_EQ(state.before.surface, nullptr) << "memory for nothing";
    EXPECT_FALSE(is_old(state, View::quads) || is_old(state, View::surface));
    model.apply(SetCorner{0, side[2], true});
    wait();
    open("square-cup.obj");
    EXPECT_EQ(quads_shown(state).lifted, nullptr) << "to another part";
    EXPECT_EQ(surface_shown(state).surface, nullptr) << "to another part";
}

TEST_F(CornerChoice, ACornerIsWhereItWasPutBeforeItsGridIsThere)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    Pickers pickers;
    EXPECT_EQ(pickers.corners(document.session), document.session.grid->boundary.corner);
    const int former = document.session.grid->boundary.corner[0], chosen = document.session.grid->boundary.side[0][3];
    model.apply(SetCorner{0, chosen, false});
    ASSERT_EQ(document.session.grid->boundary.corner[0], former) << "it is being made";
    ASSERT_TRUE(pickers.corners(document.session));
    EXPECT_EQ((*pickers.corners(document.session))[0], chosen) << "to be taken again there";
    wait();
    model.apply(ProposeCorners{});
    EXPECT_EQ(pickers.corners(document.session), document.session.grid->boundary.corner);
}

TEST_F(CornerChoice, ARefusedCornerIsOfThePastOnceCornersAreProposed)
{
    const auto file = std::filesystem::path(testing::TempDir()) / "corner-plate.obj";
    shapes::write_mesh(file, shapes::rectangle(100, 60, 40, 24));
    model.apply(OpenPart{file, ""});
    wait();
    model.apply(RunTo{Stage::fit});
    wait();
    ASSERT_TRUE(document.session.grid);
    const auto& side = document.session.grid->boundary.side[0];
    model.apply(SetCorner{0, side[side.size() / 2], false});
    wait();
    const auto refused = [&] {
        return std::ranges::any_of(state.messages, [](const Message& message) {
            return message.shown() && message.text.find("No cell fits into corner 1") == 0;
        });
    };
    EXPECT_TRUE(refused());
    model.apply(ProposeCorners{});
    wait();
    EXPECT_FALSE(refused());
}

TEST_F(CornerChoice, FourVerticesOfTheOutlineBecomeTheCornersInTheirOrder)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    const auto& sides = document.session.grid->boundary.side;
    const Eigen::Matrix2Xd plane = document.session.blank->blank.position;
    std::vector<int> chosen;
    for (const auto& side : sides)
        chosen.push_back(side[side.size() / 3]);
    model.apply(SelectVertices{{chosen[0], chosen[1], chosen[2]}});
    model.apply(UseVerticesAsCorners{});
    EXPECT_TRUE(says(Severity::error, "3 vertices are picked"));
    EXPECT_FALSE(document.session.options.corners);

    model.apply(SelectVertices{{chosen[2], chosen[0], chosen[3], chosen[1]}});
    model.apply(UseVerticesAsCorners{});
    EXPECT_EQ(state.history.undo_name(), "Use vertices as corners");
    wait();
    // The same row of corners, from the lowest to the left on.
    const auto height = [&](int v) { return plane.col(v).sum(); };
    std::rotate(chosen.begin(),
                std::min_element(chosen.begin(), chosen.end(), [&](int a, int b) { return height(a) < height(b); }),
                chosen.end());
    const auto& corner = document.session.grid->boundary.corner;
    EXPECT_EQ(std::vector<int>(corner.begin(), corner.end()), chosen);
    EXPECT_FALSE(first_stale(document));

    Eigen::Index inside = 0; // the vertex that is nearest to the middle
    (plane.colwise() - Eigen::Vector2d(plane.rowwise().mean())).colwise().norm().minCoeff(&inside);
    const auto before = document.session.options.corners;
    model.apply(SelectVertices{{chosen[0], chosen[1], chosen[2], int(inside)}});
    model.apply(UseVerticesAsCorners{});
    EXPECT_TRUE(says(Severity::error, fmt::format("Vertex {} is not on the outer outline",
                                                  document.session.part->source_vertex[size_t(inside)])));
    EXPECT_EQ(document.session.options.corners, before);
}

} // namespace spia::viewer
