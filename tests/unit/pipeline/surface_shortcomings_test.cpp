#include "engine/pipeline/shortcomings/surface_shortcomings.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/forming/material/material_library.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/pipeline/usual_tolerance.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::surface_shortcomings_test {
namespace {

using testing::HasSubstr;

Session finished(const TriMesh& mesh, std::optional<double> tolerance = {})
{
    const ScratchFolder folder;
    shapes::write_mesh(folder / "part.obj", mesh);
    Session session;
    session.file = folder / "part.obj";
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    session.options.tolerance = tolerance;
    session.options.read.doctor.keep_largest = true; // a slot may leave crumbs of triangles
    return completed(run_chain(std::move(session)));
}

/// A flat U: the middle of one side of a plate is cut out.
TriMesh flat_u(double slot)
{
    const TriMesh plate = shapes::plate();
    const Eigen::Vector3d low = plate.position.rowwise().minCoeff(), high = plate.position.rowwise().maxCoeff();
    const Eigen::Vector3d size = high - low;
    return shapes::without_faces(plate, [&](const Eigen::Vector3d& at) {
        const Eigen::Vector3d p = at - low;
        return std::abs(p[0] - size[0] / 2) < slot * size[0] / 2 && p[1] > 0.3 * size[1];
    });
}

SurfaceStage& changed(Session& session)
{
    auto stage = std::make_shared<SurfaceStage>(*session.surface);
    session.surface = stage;
    return *stage;
}

} // namespace

TEST(SurfaceShortcomings, AFlatPlateHasNone)
{
    const Session session = finished(shapes::plate());
    EXPECT_FALSE(far_surface(session));
    EXPECT_FALSE(folded_surface(session));
    EXPECT_TRUE(shortcomings(session).empty());
}

TEST(SurfaceShortcomings, ASurfaceThatCutsCornersIsSaidWithTheWayOut)
{
    for (const double slot : {0.2, 0.4, 0.6}) {
        const Session session = finished(flat_u(slot));
        ASSERT_GT(session.surface->deviation.max(), usual_tolerance) << "the case is none any more; make another";
        const auto text = far_surface(session);
        ASSERT_TRUE(text) << slot;
        EXPECT_THAT(*text, HasSubstr(mention(option::tolerance)));
        EXPECT_THAT(*text, HasSubstr(mention(option::patches, "auto")));
        const auto all = shortcomings(session);
        EXPECT_EQ(std::count(all.begin(), all.end(), *text), 1);
    }
}

TEST(SurfaceShortcomings, WhereAToleranceIsAskedForTheFitSaysWhetherItIsReached)
{
    const Session session = finished(flat_u(0.4), 0.5);
    EXPECT_FALSE(far_surface(session));
    ASSERT_TRUE(session.surface->fit);
    const auto all = shortcomings(session);
    if (!session.surface->fit->reached) {
        EXPECT_EQ(std::count(all.begin(), all.end(), session.surface->fit->shortfall.text), 1);
    }
}

TEST(SurfaceShortcomings, AFoldIsSaidButNotACornerThatASmoothOutlineLacks)
{
    Session session = finished(shapes::plate());
    Refusal refusal;
    refusal.why = Refusal::Why::vanishes;
    refusal.place.u = 1;
    changed(session).certificate.patch.at(0).refusal = refusal;
    EXPECT_FALSE(folded_surface(session));
    refusal.place.u = 0.5;
    changed(session).certificate.patch.at(0).refusal = refusal;
    ASSERT_TRUE(folded_surface(session));
    EXPECT_THAT(*folded_surface(session), HasSubstr(mention(option::corners)));
    EXPECT_EQ(shortcomings(session).size(), 1u);
    changed(session).certificate.patch.at(0).refusal.reset();
    EXPECT_FALSE(folded_surface(session));
    changed(session).deviation.normal.turned = 0.002;
    ASSERT_TRUE(folded_surface(session));
    EXPECT_THAT(*folded_surface(session), HasSubstr("0.20 %"));
    session.options.patches = LayoutOptions{};
    EXPECT_THAT(*folded_surface(session), HasSubstr(mention(option::patches, "FILE")));
}

} // namespace spia::surface_shortcomings_test
