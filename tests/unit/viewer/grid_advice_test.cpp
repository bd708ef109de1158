#include "app/viewer/model/reports/grid_advice.h"

#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "tests/support/shapes.h"
#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {
namespace {

/// A flat rectangle as a part with its blank; vertex numbers in its file are three times those of
/// the mesh.
Session plate()
{
    Session session;
    PartFile part;
    part.mesh = shapes::rectangle(60, 40, 12, 8);
    for (int v = 0; v < part.mesh.vertices(); ++v)
        part.source_vertex.push_back(3 * v);
    session.part = std::make_shared<PartFile>(std::move(part));
    FlattenResult flat;
    flat.blank.position = session.part->mesh.position.topRows<2>();
    session.blank = std::make_shared<FlattenResult>(std::move(flat));
    return session;
}

int vertex_at(const Session& session, double x, double y)
{
    int nearest = 0;
    (session.part->mesh.position.topRows<2>().colwise() - Eigen::Vector2d(x, y)).colwise().norm().minCoeff(&nearest);
    return nearest;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST(OutlineAngle, IsThatOfARegularPolygonWhicheverWayAround)
{
    for (const int sides : {3, 4, 6}) {
        const int fine = 20 * sides;
        Eigen::Matrix2Xd plane(2, fine);
        std::vector<int> loop;
        for (int k = 0; k < fine; ++k) { // points on the sides
            const auto corner = [&](int i) {
                const double turn = 2 * std::numbers::pi * i / sides;
                return Eigen::Vector2d(std::cos(turn), std::sin(turn));
            };
            const double t = (k % 20) / 20.;
            plane.col(k) = (1 - t) * corner(k / 20) + t * corner(k / 20 + 1);
            loop.push_back(k);
        }
        const double inner = 180. * (sides - 2) / sides;
        EXPECT_NEAR(outline_angle_deg(plane, loop, 20), inner, 1e-9);
        EXPECT_NEAR(outline_angle_deg(plane, loop, 30), 180, 1e-9);
        std::reverse(loop.begin(), loop.end());
        EXPECT_NEAR(outline_angle_deg(plane, loop, size_t(fine) - 1 - 20), inner, 1e-9);
    }
}

TEST(GridAdvice, NamesTheCornerOnAStraightSideAndTheTurnItBelongsTo)
{
    Session session = plate();
    const int free = vertex_at(session, 60, 40), straight = vertex_at(session, 60, 20);
    session.options.corners = {3 * vertex_at(session, 0, 0), 3 * vertex_at(session, 60, 0), 3 * straight,
                               3 * vertex_at(session, 0, 40)};
    const std::string text = grid_advice(session);
    EXPECT_TRUE(has(text, fmt::format("Corner 3 (vertex {})", 3 * straight))) << text;
    EXPECT_TRUE(has(text, "180 degrees")) << text;
    EXPECT_TRUE(has(text, fmt::format("at vertex {}", 3 * free))) << text;
    const std::string after = grid_advice(session, fmt::format("no cell fits into corner 3 (vertex {})", 3 * straight));
    EXPECT_TRUE(after.starts_with("Drag it to a sharp corner")) << after;
    EXPECT_TRUE(has(after, fmt::format("at vertex {}", 3 * free))) << after;
}

TEST(GridAdvice, OffersAnotherMethodWhereTheCornersAreRight)
{
    Session session = plate();
    session.options.grid.method = GridMethod::coons;
    EXPECT_TRUE(has(grid_advice(session), "automatic or the harmonic method"));
    session.options.grid.method = GridMethod::harmonic;
    EXPECT_TRUE(has(grid_advice(session), "more cells"));
    EXPECT_FALSE(has(grid_advice(session), "Corner "));
}

} // namespace spia::viewer
