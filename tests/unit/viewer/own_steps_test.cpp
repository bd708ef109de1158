// Steps of picked faces.
#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>

#include "engine/mesh/region.h"
#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

using StepStatus::done;
using testing::HasSubstr;

} // namespace

TEST_F(UnfoldingSteps, AStepOfPickedFacesLaysThemOnTheFaceOfARegion)
{
    open_channel();
    const double top = document.session.part->mesh.position.row(2).maxCoeff();
    model.apply(AddStep{0, {}, "", {}});
    EXPECT_THAT(last(Severity::error), HasSubstr("no region 1"));
    // The first leg lies at the top; what is below its plane hangs on it: all else of the part.
    const FaceSet leg = with_height(top - 1e-6, top);
    model.apply(SelectFaces{leg});
    model.apply(MakeRegion{"leg", RegionKind::fixed});
    model.apply(AddStep{0, 0, "", {}});
    EXPECT_THAT(last(Severity::error), HasSubstr("cannot be both fixed and unfolded"));
    model.apply(AddStep{0, {}, "", {}});
    EXPECT_THAT(last(Severity::error), HasSubstr(fmt::format("{} faces to unfold also belong", leg.size())));
    model.apply(ClearSelection{});
    model.apply(AddStep{0, {}, "", {}});
    EXPECT_THAT(last(Severity::error), HasSubstr("Select the faces to unfold first"));
    EXPECT_TRUE(document.steps.empty());
    model.apply(SelectFaces{inverted(leg, document.session.part->mesh.triangles())});
    model.apply(AddStep{0, {}, "", {}});
    ASSERT_EQ(document.steps.size(), 1u) << last(Severity::error);
    EXPECT_THAT(names()[0], HasSubstr("onto leg"));
    EXPECT_EQ(carrying_faces(*document.steps[0]), leg);
    EXPECT_EQ(document.steps[0]->pick.fixed, leg);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    EXPECT_LT((after(0).position.row(2).array() - top).abs().maxCoeff(), 1e-6);
    EXPECT_EQ(after(0).position(Eigen::all, document.session.part->mesh.triangle.col(leg[0])),
              document.session.part->mesh.position(Eigen::all, document.session.part->mesh.triangle.col(leg[0])));
}

TEST_F(UnfoldingSteps, APickOfHalfAQuadTakesAllOfIt)
{
    std::ofstream file(folder / "quads.obj"); // an L of rows of four quads: ten level, ten down
    for (int row = 0; row <= 20; ++row)
        for (int k = 0; k <= 4; ++k)
            file << fmt::format("v {} {} {}\n", 3 * std::min(row, 10), 5 * k, -3 * std::max(row - 10, 0));
    for (int row = 0; row < 20; ++row)
        for (int k = 1; k <= 4; ++k)
            file << fmt::format("f {} {} {} {}\n", 5 * row + k, 5 * row + k + 5, 5 * row + k + 6, 5 * row + k + 1);
    file.close();
    model.apply(OpenPart{folder / "quads.obj", ""});
    wait();
    ASSERT_TRUE(document.session.part) << last(Severity::error);
    const double top = document.session.part->mesh.position.row(2).maxCoeff();
    const FaceSet leg = with_height(top - 1e-6, top);
    model.apply(SelectFaces{leg});
    model.apply(MakeRegion{"leg", RegionKind::fixed});
    const FaceSet others = inverted(leg, document.session.part->mesh.triangles());
    model.apply(SelectFaces{FaceSet(others.begin(), others.end() - 1)});
    model.apply(AddStep{0, {}, "", {}});
    ASSERT_EQ(document.steps.size(), 1u) << last(Severity::error);
    EXPECT_EQ(document.steps[0]->pick.freed, others);
    model.apply(SaveSteps{folder / "steps.json"});
    wait();
    model.apply(OpenSteps{folder / "steps.json"});
    wait();
    ASSERT_EQ(document.steps.size(), 1u) << last(Severity::error);
    EXPECT_EQ(document.steps[0]->pick.freed, others);
}

TEST_F(UnfoldingSteps, AllThatIsNotPickedStaysButOnlyTheRegionCarriesTheFace)
{
    open_channel();
    const TriMesh& part = document.session.part->mesh;
    const double right = part.position.row(0).maxCoeff(), top = part.position.row(2).maxCoeff();
    FaceSet web, upper;
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Matrix3d corner = part.position(Eigen::all, part.triangle.col(f));
        if (corner.row(0).minCoeff() > right - 1e-4)
            web.push_back(f);
        else if (corner.row(2).minCoeff() > top - 5 - 1e-4)
            upper.push_back(f);
    }
    model.apply(SelectFaces{web});
    model.apply(MakeRegion{"web", RegionKind::fixed});
    model.apply(SelectFaces{upper});
    model.apply(MakeRegion{"upper leg", RegionKind::other});
    model.apply(AddStep{0, 1, "", {}});
    EXPECT_EQ(names(), std::vector<std::string>{"upper leg onto web"});
    run();
    ASSERT_EQ(status(), std::vector{done}) << last(Severity::error);
    EXPECT_THAT(last(Severity::warning), HasSubstr("is not flat yet; add a step"));
    for (const int f : upper)
        for (const int v : part.triangle.col(f))
            EXPECT_NEAR(after(0).position(0, v), right, 1e-4);
    for (const int f : inverted(upper, part.triangles())) // the lower leg, too
        EXPECT_EQ(after(0).position(Eigen::all, part.triangle.col(f)), part.position(Eigen::all, part.triangle.col(f)));
    const auto before = document.steps[0];
    model.apply(SaveProject{folder / "own.spia"});
    model.apply(OpenProject{folder / "own.spia"});
    wait();
    ASSERT_EQ(document.steps.size(), 1u);
    EXPECT_EQ(document.steps[0]->pick.carrying, web);
    EXPECT_EQ(document.steps[0]->pick.fixed, before->pick.fixed);
    EXPECT_EQ(document.steps[0]->pick.freed, upper);
}

} // namespace spia::viewer
