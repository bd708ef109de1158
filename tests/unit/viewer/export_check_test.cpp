#include "app/viewer/model/export_check.h"

#include <gtest/gtest.h>

namespace spia::viewer {
namespace {

/// A square of 10 mm in two triangles, and a surface as far from its four vertices as given.
Session with_deviation(const Eigen::Vector4d& at_vertex, double greatest)
{
    Session session;
    auto part = std::make_shared<PartFile>();
    part->mesh.position.resize(3, 4);
    part->mesh.position << 0, 10, 10, 0, 0, 0, 10, 10, 0, 0, 0, 0;
    part->mesh.triangle.resize(3, 2);
    part->mesh.triangle << 0, 0, 1, 2, 2, 3;
    session.part = part;
    auto surface = std::make_shared<SurfaceStage>();
    surface->deviation.at_vertex = at_vertex;
    surface->deviation.surface_to_mesh.max = greatest;
    surface->deviation.mesh_to_surface.max = at_vertex.cwiseAbs().maxCoeff();
    surface->deviation.mesh_to_surface.p95 = 0.02;
    session.surface = surface;
    return session;
}

} // namespace

TEST(ExportCheck, WithinTheToleranceIsJudgedByTheLargerOfBothWays)
{
    const Session session = with_deviation({0.05, -0.03, 0, 0}, 0.08);
    EXPECT_EQ(fit_verdict(session, 0.08).fit, Fit::within);
    EXPECT_EQ(fit_verdict(session, 0.079).fit, Fit::beyond); // the surface strays although no vertex does
    EXPECT_EQ(fit_verdict(session, 0.079).share, 0);
    EXPECT_EQ(fit_verdict(session, 0.0079).fit, Fit::far_off);
    EXPECT_EQ(fit_verdict(session, 0.01).greatest, 0.08);
    EXPECT_EQ(fit_verdict(Session{}, 0.1).fit, Fit::none);
}

TEST(ExportCheck, TheShareIsThatOfTheAreaBeyondTheTolerance)
{
    // Vertices 0 and 2 have two faces, 1 and 3 have one: 100 mm2 in shares of 2/6, 1/6, 2/6, 1/6.
    EXPECT_NEAR(fit_verdict(with_deviation({0.5, 0, 0, 0}, 0.5), 0.1).share, 1. / 3, 1e-12);
    EXPECT_NEAR(fit_verdict(with_deviation({0, -0.5, 0, 0}, 0.5), 0.1).share, 1. / 6, 1e-12);
    EXPECT_NEAR(fit_verdict(with_deviation({0.5, -0.5, 0.5, 0.5}, 0.5), 0.1).share, 1, 1e-12);
}

TEST(ExportCheck, TheWordsNameTheDeviationTheShareAndTheTolerance)
{
    const Session session = with_deviation({0, -0.5, 0, 0}, 0.5);
    const std::string beyond = text(fit_verdict(session, 0.1), 0.1);
    for (const char* words : {"0.5 mm", "16.7 %", "0.1 mm"})
        EXPECT_NE(beyond.find(words), std::string::npos) << beyond;
    const std::string far_off = text(fit_verdict(session, 0.02), 0.02);
    EXPECT_NE(far_off.find("25 times the tolerance"), std::string::npos) << far_off;
    EXPECT_NE(text(fit_verdict(session, 1), 1).find("within 0.5 mm"), std::string::npos);
}

} // namespace spia::viewer
