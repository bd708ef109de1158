#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/core/error.h"
#include "engine/forming/material_library.h"
#include "engine/pipeline/outputs.h"
#include "engine/pipeline/report.h"
#include "engine/pipeline/session.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

Session sample(const char* file)
{
    Session session;
    session.file = std::filesystem::path(SPIA_SOURCE_DIR "/assets/parts") / file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return session;
}

Session finished(const char* file)
{
    Session session = sample(file);
    for (const Stage stage : chain)
        session = run_stage(stage, std::move(session));
    return session;
}

} // namespace

TEST(Chain, RunsEverySamplePartWithoutAFlipOrAFold)
{
    for (const auto& entry : std::filesystem::directory_iterator(SPIA_SOURCE_DIR "/assets/parts")) {
        if (entry.path().extension() != ".obj")
            continue;
        const Session session = finished(entry.path().filename().c_str());
        EXPECT_TRUE(session.blank->report.converged) << entry.path() << session.blank->report.reason;
        EXPECT_EQ(session.blank->flipped_triangles, 0) << entry.path();
        EXPECT_EQ(session.grid->result.quality.folded_cells, 0) << entry.path();
        EXPECT_TRUE(shortcomings(session).empty()) << entry.path() << shortcomings(session).front();
    }
}

TEST(Chain, AnEarlierStageForgetsTheLaterResultsAndLeavesTheCopyAlone)
{
    const Session before = finished("dome.obj");
    const Session after = run_stage(Stage::grid, before);
    EXPECT_EQ(after.blank, before.blank); // the same object, not an equal one
    EXPECT_NE(after.grid, before.grid);
    EXPECT_EQ(after.surface, nullptr);
    EXPECT_NE(before.surface, nullptr);
}

TEST(Chain, AStageOutOfOrderSaysWhatComesFirst)
{
    EXPECT_THROW(run_stage(Stage::fit, sample("dome.obj")), InputError);
    EXPECT_THROW(write_outputs(sample("dome.obj"), "nowhere", {"csv"}), InputError);
}

TEST(Chain, CornersAreNamedByTheNumbersOfTheFile)
{
    Session session = finished("fender.obj");
    std::array<int, 4> chosen;
    for (size_t k = 0; k < 4; ++k) // the same four corners, one further round
        chosen[k] = session.part->source_vertex[size_t(session.grid->boundary.corner[(k + 1) % 4])];
    session.options.corners = chosen;
    const Session again = run_stage(Stage::grid, session);
    EXPECT_EQ(again.grid->boundary.corner[0], session.grid->boundary.corner[1]);
    session.options.corners = {-1, 0, 1, 2};
    EXPECT_THROW(run_stage(Stage::grid, session), InputError);
}

TEST(Report, HasTheKeysOfTheContractAndTheFiguresOfTheResult)
{
    const Session session = finished("dome.obj");
    const auto json = nlohmann::json::parse(report_json(session, {"a.iges"}, 0.25));
    for (const char* key : {"/schema",
                            "/part/vertices",
                            "/part/triangles",
                            "/part/boundary_loops",
                            "/part/area_mm2",
                            "/solve/converged",
                            "/solve/reason",
                            "/solve/energy_iterations",
                            "/solve/newton_iterations",
                            "/solve/residual",
                            "/solve/seconds",
                            "/solve/start",
                            "/blank/area_mm2",
                            "/blank/perimeter_mm",
                            "/blank/bounding_box_mm",
                            "/blank/flipped_triangles",
                            "/blank/outline_self_intersections",
                            "/result/thinning_max",
                            "/result/thinning_min",
                            "/result/equivalent_strain_max",
                            "/result/thickness_min_mm",
                            "/result/thickness_max_mm",
                            "/result/necking_triangles",
                            "/result/volume_error",
                            "/distortion/angular_rms",
                            "/distortion/area_rms",
                            "/distortion/definition",
                            "/grid/columns",
                            "/grid/rows",
                            "/grid/folded_cells",
                            "/grid/method",
                            "/grid/min_scaled_jacobian",
                            "/surface/control_points_u",
                            "/surface/control_points_v",
                            "/surface/deviation_max_mm",
                            "/surface/deviation_rms_mm",
                            "/surface/deviation_p95_mm",
                            "/files/0",
                            "/seconds/read",
                            "/seconds/solve",
                            "/seconds/grid",
                            "/seconds/lift",
                            "/seconds/fit",
                            "/seconds/write",
                            "/seconds/total",
                            "/peak_memory_mb"})
        EXPECT_TRUE(json.contains(nlohmann::json::json_pointer(key))) << key;
    EXPECT_EQ(json["part"]["triangles"], session.part->mesh.triangles());
    EXPECT_EQ(json["seconds"]["write"], 0.25);
    // Volume is kept: blank area times sheet thickness is the sum of formed area times thickness.
    double volume = 0;
    const auto element = elements(session.part->mesh);
    for (size_t f = 0; f < element.size(); ++f)
        volume += element[f].area * session.blank->face.thickness[Eigen::Index(f)];
    EXPECT_NEAR(json["blank"]["area_mm2"].get<double>(), volume, 1e-9 * volume);
}

TEST(Outputs, WhatHasNoSurfaceYetIsWrittenWithoutIt)
{
    const ScratchFolder folder;
    Session session = finished("dome.obj");
    const auto all = write_outputs(session, folder / "whole", output_formats());
    EXPECT_EQ(all.size(), output_formats().size() + 1); // csv: two tables
    session.grid.reset();
    session.lifted.reset();
    session.surface.reset();
    std::set<std::string> names;
    for (const auto& file : write_outputs(session, folder / "partial", output_formats())) {
        EXPECT_GT(std::filesystem::file_size(file), 100u) << file;
        names.insert(file.filename().string());
    }
    EXPECT_EQ(names,
              (std::set<std::string>{"dome.glb", "dome.vtu", "dome.dxf", "fields.csv", "outline.csv", "dome.png"}));
    const auto json = nlohmann::json::parse(report_json(session, {}, 0, Failure{Stage::grid, "no corner"}));
    EXPECT_EQ(json["failure"]["stage"], "grid");
    EXPECT_EQ(json["failure"]["message"], "no corner");
    EXPECT_TRUE(json.contains("blank"));
    session.blank.reset();
    EXPECT_THROW(write_outputs(session, folder / "nothing", output_formats()), InputError);
}

} // namespace spia
