#include "app/viewer/model/reports/state_report.h"

#include <gtest/gtest.h>

#include "app/viewer/model/actions/script.h"
#include "tests/unit/viewer/action_as.h"
#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {

TEST(StateReport, OfANewProgramSaysThatNothingIsThere)
{
    ViewerState state;
    const Json report = state_report(state);
    EXPECT_TRUE(report["part"].is_null());
    EXPECT_EQ(report["stages"]["read"], false);
    EXPECT_EQ(report["selection"]["faces"], 0);
    EXPECT_TRUE(report["corners"].is_null());
    EXPECT_EQ(report["job"]["running"], false);
}

TEST(StateReport, TellsWhatTheStateHolds)
{
    ViewerState state;
    Document& document = state.document = document_of(dome, Stage::fit);
    for (int f = 0; f < 25; ++f)
        document.selected.push_back(2 * f);
    document.regions.push_back({"clamp", RegionKind::binder, {0.5f, 0.25f, 0, 1}, {4, 5, 6}});
    document.probes.push_back({7, {0.5, 0.25, 0.25}});
    document.display.field = Field::thickness;
    state.messages.push_back({Severity::warning, "mind the gap"});
    state.history.remember("Select faces", document);
    state.view.camera[size_t(View::quads)].height = 321;

    const Json report = state_report(state);
    const TriMesh& part = document.session.part->mesh;
    EXPECT_EQ(report["part"]["triangles"], part.triangles());
    EXPECT_EQ(report["stages"]["fit"], true);
    EXPECT_EQ(report["selection"]["faces"], 25);
    EXPECT_EQ(report["selection"]["first"].size(), 10u);
    EXPECT_EQ(report["selection"]["first"][9], 18);
    EXPECT_EQ(report["regions"][0]["kind"], "binder");
    EXPECT_EQ(report["regions"][0]["faces"], 3);
    EXPECT_EQ(report["messages"][0]["severity"], "warning");
    EXPECT_EQ(report["history"]["undo"], "Select faces");
    EXPECT_EQ(report["view"]["camera"]["quads"]["height"], 321);
    EXPECT_EQ(report["figures"]["result"]["thinning_max"], document.session.blank->face.thinning.maxCoeff());

    EXPECT_TRUE(report["vertices"].empty());
    EXPECT_TRUE(report["distance"].is_null());
    // Two vertices by hand, one of the outline.
    const int edge = document.session.grid->boundary.corner[1];
    document.vertices = {std::min(3, edge), std::max(3, edge)};
    const Json measured = state_report(state);
    for (size_t k = 0; k < 2; ++k) {
        const int v = document.vertices[k];
        EXPECT_EQ(measured["vertices"][k]["in_file"], document.session.part->source_vertex[size_t(v)]);
        EXPECT_EQ(measured["vertices"][k]["at"][2], part.position(2, v));
        EXPECT_EQ(measured["vertices"][k]["value"], document.session.blank->node.thickness[v]);
        EXPECT_TRUE(v != edge || measured["vertices"][k]["boundary"] == true);
    }
    const auto apart = [&](const auto& position) { return (position.col(3) - position.col(edge)).norm(); };
    EXPECT_NEAR(measured["distance"]["part"].get<double>(), apart(part.position), 1e-9);
    EXPECT_NEAR(measured["distance"]["blank"].get<double>(), apart(document.session.blank->blank.position), 1e-9);

    // The probe by hand: half of the first corner, a quarter of the others.
    const Eigen::Vector3i corner = part.triangle.col(7);
    EXPECT_EQ(report["probes"][0]["value"], document.session.blank->face.thickness[7]) << "that of its face";
    const double x =
        0.5 * part.position(0, corner[0]) + 0.25 * part.position(0, corner[1]) + 0.25 * part.position(0, corner[2]);
    EXPECT_NEAR(report["probes"][0]["at"][0].get<double>(), x, 1e-9);
    const QuadGrid& grid = document.session.grid->result.planar;
    const int corners[] = {grid.node(0, 0), grid.node(grid.columns, 0), grid.node(grid.columns, grid.rows),
                           grid.node(0, grid.rows)};
    for (size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(report["corners"][k]["blank"][0].get<double>(), grid.position(0, corners[k]), 1e-9);
}

TEST(StateReport, ShowsDisplayAndViewAsTheScriptActionsTakeThem)
{
    ViewerState state;
    state.document.display.bands = 5;
    state.document.display.range = {{-1, 2}};
    Json display = state_report(state)["display"];
    display["do"] = "set_display";
    EXPECT_EQ(as<SetDisplay>(action_from_json(display)).display.range, state.document.display.range);
    Json view = state_report(state)["view"];
    view["do"] = "set_view";
    EXPECT_EQ(as<SetViewSettings>(action_from_json(view)).view.camera, state.view.camera);
}

} // namespace spia::viewer
