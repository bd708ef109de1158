#include <filesystem>
#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/layout/simplify/simplify_layout.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/make_surface.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/shortcomings/shortcomings.h"

using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

namespace spia {
namespace {

Session sample(const char* file)
{
    Session session;
    session.file = std::filesystem::path(SPIA_SOURCE_DIR "/assets/parts") / file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.best_surface = true;
    return session;
}

} // namespace

TEST(BestSurface, IsOnePatchWhereThatIsGoodEnough)
{
    const Session session = completed(run_chain(sample("fender.obj")));
    const SurfaceStage& surface = *session.surface;
    EXPECT_FALSE(surface.patches);
    EXPECT_THAT(surface.choice, StartsWith("one patch over the whole blank"));
    EXPECT_TRUE(session.grid && session.lifted);
    EXPECT_FALSE(made_of_patches(session));
    EXPECT_DOUBLE_EQ(surface.fit->tolerance, 1e-3 * bounding_diagonal(session.part->mesh));
    EXPECT_LE(surface.deviation.max(), surface.fit->tolerance);
    EXPECT_LE(int(surface.result.surface.control.cols()), session.part->mesh.vertices());
    EXPECT_TRUE(surface.certificate.suited());
    EXPECT_GE(surface.certificate.patch.front().least_scaled, well_shaped_jacobian);
}

TEST(BestSurface, IsOfPatchesWhereOneIsNotAndHasNoGridThen)
{
    const Session session = completed(run_chain(sample("perforated-channel.obj")));
    const SurfaceStage& surface = *session.surface;
    ASSERT_TRUE(surface.patches);
    EXPECT_THAT(surface.choice,
                HasSubstr("patches, because one patch over the whole blank is not good enough: up to "));
    EXPECT_FALSE(session.grid || session.lifted);
    EXPECT_TRUE(made_of_patches(session));
    EXPECT_LE(surface.deviation.max(), 1e-3 * bounding_diagonal(session.part->mesh));
    EXPECT_TRUE(surface.certificate.suited());
    EXPECT_TRUE(shortcomings(session).empty()) << shortcomings(session).front();
}

TEST(BestSurface, OfARoundBlankHasItsCornersInside)
{
    const Session session = completed(run_chain(sample("dome.obj")));
    ASSERT_TRUE(session.surface->patches);
    EXPECT_EQ(session.surface->patches->patches.patch.size(), 5u);
    for (const PatchCertificate& patch : session.surface->certificate.patch)
        EXPECT_GE(patch.least_scaled, 0.5);
}

TEST(BestSurface, ThatNoWayIsGoodIsSaid)
{
    Session session = sample("fender.obj");
    session.options.tolerance = 1e-5; // mm
    session.options.max_control_points = 400;
    session = completed(run_chain(session));
    EXPECT_GT(session.surface->deviation.max(), 1e-5);
    EXPECT_THAT(session.surface->choice, AnyOf(HasSubstr("with a fault"), HasSubstr("Not without fault")));
    ASSERT_FALSE(shortcomings(session).empty());
}

TEST(BestSurface, APartWithoutAGridForOnePatchMayHaveSeveral)
{
    Session session = completed(run_chain(sample("perforated-channel.obj"), Stage::read, Stage::solve));
    // Corners in no order: no one patch has these. A layout has corners of its own.
    const auto loops = boundary_loops(session.part->mesh);
    const std::vector<int>& outline = loops[size_t(outer_loop(loops, session.blank->blank.position))];
    const auto number = [&](size_t k) { return session.part->source_vertex[size_t(outline[k])]; };
    session.options.corners = {number(0), number(2), number(1), number(3)};
    session = completed(run_chain(session, Stage::grid, Stage::fit));
    EXPECT_FALSE(session.no_grid.empty());
    ASSERT_TRUE(session.surface->patches);
    EXPECT_THAT(session.surface->choice, HasSubstr(session.no_grid));
    EXPECT_EQ(run_stage(Stage::solve, session).no_grid, "");
}

} // namespace spia
