#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/evaluate.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/session.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/report/json/report_json.h"

namespace spia {
namespace {

Session lifted(const char* file)
{
    Session session;
    session.file = std::filesystem::path(SPIA_SOURCE_DIR "/assets/parts") / file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return completed(run_chain(std::move(session), Stage::read, Stage::lift));
}

} // namespace

TEST(FitStage, SurfaceIsWithinTheToleranceAndTheReportSaysSo)
{
    Session session = lifted("dome.obj");
    const TriMesh& part = session.part->mesh;
    const double tolerance = 1e-3 * bounding_diagonal(part);
    session.options.tolerance = tolerance;
    session = run_stage(Stage::fit, session);
    const SurfaceStage& made = *session.surface;
    ASSERT_TRUE(made.fit.has_value());
    ASSERT_TRUE(made.fit->reached) << made.fit->shortfall.text;
    const ClosestPointSearch search(made.source->sheet.mesh);
    for (int j = 0; j <= 211; ++j)
        for (int i = 0; i <= 211; ++i) {
            const ClosestPoint foot = search.nearest(evaluate(made.result.surface, i / 211., j / 211.).position);
            if (foot.face < made.source->part_faces) {
                EXPECT_LE(foot.distance, tolerance);
            }
        }
    EXPECT_EQ(made.deviation.at_vertex.size(), session.grid->result.filled->mesh.vertices());

    const auto json = nlohmann::json::parse(report_json(session, {}, 0)).at("surface");
    EXPECT_EQ(json["fit"]["tolerance_mm"], tolerance);
    EXPECT_EQ(json["fit"]["reached"], true);
    EXPECT_EQ(json["share_within_tolerance"], 1);
    EXPECT_EQ(json["fit"]["knots_inserted_u"].get<int>() + 4, json["control_points_u"]);
    EXPECT_FALSE(json["fit"].contains("shortfall"));
    EXPECT_FALSE(json.contains("between_data"));
    EXPECT_NEAR(json["normal_deviation"]["mean_deg"], made.deviation.normal.mean * 180 / 3.14159265358979, 1e-9);
}

TEST(FitStage, PartThatCannotBeMetIsNamedAmongTheShortcomings)
{
    Session session = lifted("square-cup.obj");
    session.options.tolerance = 1e-3;
    session.options.max_control_points = 400;
    session = run_stage(Stage::fit, session);
    const FitReport& fit = *session.surface->fit;
    ASSERT_FALSE(fit.reached);
    const auto list = shortcomings(session);
    EXPECT_NE(std::find(list.begin(), list.end(), fit.shortfall.text), list.end());
    const auto json = nlohmann::json::parse(report_json(session, {}, 0)).at("surface");
    EXPECT_EQ(json["fit"]["reached"], false);
    EXPECT_EQ(json["fit"]["shortfall"]["text"], fit.shortfall.text);
    EXPECT_LT(json["share_within_tolerance"], 1);
    if (fit.shortfall.a >= 0) {
        EXPECT_EQ(json["fit"]["shortfall"]["vertices"][0], session.part->source_vertex[size_t(fit.shortfall.a)]);
    }
}

TEST(FitStage, WithoutAToleranceTheSurfaceRunsThroughTheGridWithTheDegreeAsked)
{
    Session session = lifted("dome.obj");
    session.options.interpolate.degree_u = 4;
    session.options.interpolate.ends = CurveEnds::clamped;
    session = run_stage(Stage::fit, session);
    EXPECT_FALSE(session.surface->fit.has_value());
    const NurbsSurface& surface = session.surface->result.surface;
    EXPECT_EQ(surface.degree_u, 4);
    EXPECT_EQ(surface.degree_v, 3);
    const QuadGrid& grid = session.lifted->lifted;
    EXPECT_EQ(surface.count_u, grid.columns + 3);
    const auto& r = session.surface->result;
    EXPECT_LT((evaluate(surface, r.u[5], r.v[7]).position - grid.position.col(grid.node(5, 7))).norm(), 1e-9);
}

} // namespace spia
