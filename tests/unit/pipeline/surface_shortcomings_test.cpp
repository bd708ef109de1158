#include "engine/pipeline/shortcomings/surface_shortcomings.h"

#include <algorithm>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/forming/material/material_library.h"
#include "engine/options/surface_options.h"
#include "engine/pipeline/make_surface.h"
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

TEST(SurfaceShortcomings, ManyControlPointsAreSaidOfAFitAlone)
{
    Session session = finished(shapes::plate(), 0.5);
    EXPECT_FALSE(heavy_surface(session));
    const auto with = [&](int count) {
        NurbsSurface& surface = changed(session).result.surface;
        surface.count_u = count;
        surface.count_v = 1;
        surface.control = Eigen::Matrix3Xd::Zero(3, count);
        surface.weight = Eigen::VectorXd::Ones(count);
    };
    const int enough = enough_control_points(session.part->mesh);
    with(enough);
    EXPECT_FALSE(heavy_surface(session));
    with(enough + 1);
    ASSERT_TRUE(heavy_surface(session));
    EXPECT_THAT(*heavy_surface(session), HasSubstr(fmt::format("has {} control points", enough + 1)));
    EXPECT_THAT(shortcomings(session), testing::Contains(*heavy_surface(session)));
    changed(session).fit.reset(); // through the nodes of a grid that was asked for
    EXPECT_FALSE(heavy_surface(session));
}

TEST(SurfaceShortcomings, ASharpCornerIsSaidWhereTheProgramChose)
{
    Session session = finished(shapes::plate(), 0.5);
    changed(session).certificate.patch.at(0).least_scaled = 0.19;
    EXPECT_FALSE(ill_shaped_surface(session)); // one patch that was asked for
    session.options.best_surface = true;
    ASSERT_TRUE(ill_shaped_surface(session));
    EXPECT_THAT(*ill_shaped_surface(session), HasSubstr("scaled Jacobian of 0.19"));
    EXPECT_THAT(shortcomings(session), testing::Contains(*ill_shaped_surface(session)));
    changed(session).certificate.patch.at(0).least_scaled = 0.2;
    EXPECT_FALSE(ill_shaped_surface(session));
}

TEST(SurfaceShortcomings, KinksOfPatchesAreSaidWhereThePartHasNoneAsGreat)
{
    Session session = finished(shapes::plate()); // flat
    EXPECT_FALSE(kinked_surface(session));
    InterfaceCertificate joint;
    joint.joint.first.patch = 4;
    joint.joint.second.patch = 2;
    for (const double degrees : {9., 11.}) { // those of less are smoothed
        joint.greatest_angle = degrees * std::numbers::pi / 180;
        changed(session).certificate.interfaces = {joint};
        ASSERT_EQ(kinked_surface(session).has_value(), degrees > 10);
    }
    EXPECT_THAT(*kinked_surface(session), HasSubstr("11 degrees (patch 3)"));
    EXPECT_THAT(shortcomings(session), testing::Contains(*kinked_surface(session)));
    PartFile folded = *session.part; // by 90 degrees
    const double middle = 0.5 * folded.mesh.position.row(0).maxCoeff();
    for (int v = 0; v < folded.mesh.vertices(); ++v)
        if (double& x = folded.mesh.position(0, v); x > middle) {
            folded.mesh.position(2, v) = x;
            x = middle;
        }
    session.part = std::make_shared<PartFile>(folded);
    EXPECT_FALSE(kinked_surface(session));
}

} // namespace spia::surface_shortcomings_test
