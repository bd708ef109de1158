#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/session.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/pipeline/shortcomings/surface_shortcomings.h"
#include "engine/pipeline/usual_tolerance.h"
#include "engine/report/json/report_json.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::stage_test {
namespace {

Session sample(const char* file)
{
    Session session;
    session.file = std::filesystem::path(SPIA_SOURCE_DIR "/assets/parts") / file;
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return session;
}

Session finished(const char* file) { return completed(run_chain(sample(file))); }

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
        EXPECT_EQ(session.blank->report.system, SolvedSystem::strict) << entry.path();
        // None of these surfaces, which go through the nodes of the usual grid, stays within the
        // usual tolerance.
        const double off = session.surface->deviation.max();
        EXPECT_EQ(off > usual_tolerance, far_surface(session).has_value()) << entry.path();
        EXPECT_EQ(shortcomings(session).size(), (session.blank->necking_triangles > 0) +
                                                    far_surface(session).has_value() +
                                                    folded_surface(session).has_value())
            << entry.path();
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

TEST(Chain, LimitsAreJudgedWithTheBlankAndAnewWithoutSolving)
{
    Session session = sample("square-cup.obj");
    EXPECT_THROW(judge_limits(session), InputError);
    session = completed(run_chain(std::move(session), Stage::read, Stage::solve));
    ASSERT_TRUE(session.limits);
    const LimitsResult direct =
        forming_limits(session.part->mesh, session.blank->face, session.options.flatten.material, 1);
    EXPECT_EQ(session.limits->zones.zone, direct.zones.zone);
    EXPECT_EQ(session.limits->zones.distance, direct.zones.distance);

    Session stricter = session;
    stricter.options.limits.zones.max_thickening = 0.001;
    stricter = judge_limits(stricter);
    EXPECT_EQ(stricter.blank, session.blank); // the same object
    const auto faces = [](const Session& s, Zone zone) { return s.limits->zones.share[size_t(zone)].faces; };
    EXPECT_GT(faces(stricter, Zone::strong_thickening), faces(session, Zone::strong_thickening));
    EXPECT_EQ(run_stage(Stage::read, stricter).limits, nullptr);
    EXPECT_EQ(run_stage(Stage::grid, stricter).limits, stricter.limits);
}

TEST(Report, HasTheLimitsAsTheSheetWasJudged)
{
    Session session = sample("square-cup.obj");
    session.options.limits.margin = 0.2;
    session = completed(run_chain(std::move(session), Stage::read, Stage::solve));
    const auto json = nlohmann::json::parse(report_json(session, {}, 0));
    const auto& limits = json["limits"];
    EXPECT_EQ(json["hardening"]["law"], "swift");
    EXPECT_EQ(limits["settings"]["margin"], 0.2);
    EXPECT_NEAR(limits["curve"]["flc0"].get<double>(), 0.3743, 1e-9); // t = 1 mm, n above 0.21
    EXPECT_EQ(limits["notes"].size(), 1u);
    int faces = 0;
    double share = 0;
    for (const Zone zone : all_zones) {
        const auto& entry = limits["zones"][std::string(name(zone))];
        EXPECT_EQ(entry["number"], int(zone));
        EXPECT_EQ(entry["faces"], session.limits->zones.share[size_t(zone)].faces);
        EXPECT_FALSE(entry["definition"].get<std::string>().empty());
        faces += entry["faces"].get<int>();
        share += entry["area_share"].get<double>();
    }
    EXPECT_EQ(faces, session.part->mesh.triangles());
    EXPECT_NEAR(share, 1, 1e-12);
    ASSERT_FALSE(limits["worst_spots"].empty());
    const WorstSpot& worst = session.limits->zones.spots[0];
    EXPECT_EQ(limits["worst_spots"][0]["zone"], name(worst.zone));
    EXPECT_EQ(limits["worst_spots"][0]["face"], session.part->source_face[size_t(worst.face)]);
    EXPECT_EQ(limits["worst_spots"][0]["position_mm"][2], worst.position[2]);

    session.options.limits.source = LimitsOptions::Source::none;
    session = judge_limits(session);
    EXPECT_TRUE(nlohmann::json::parse(report_json(session, {}, 0))["limits"]["curve"].is_null());
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
                            "/source/from",
                            "/solve/converged",
                            "/solve/reason",
                            "/solve/energy_iterations",
                            "/solve/newton_iterations",
                            "/solve/residual",
                            "/solve/seconds",
                            "/solve/start",
                            "/solve/attempts/0/name",
                            "/solve/attempts/0/won",
                            "/solve/attempts/0/reason",
                            "/solve/attempts/0/seconds",
                            "/blank/area_mm2",
                            "/blank/perimeter_mm",
                            "/blank/bounding_box_mm",
                            "/blank/flipped_triangles",
                            "/blank/outline_self_intersections",
                            "/blank/overlap/crossing_edges",
                            "/blank/overlap/wound_vertices",
                            "/part/seam",
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
                            "/grid/attempts/0/attempts/0/name",
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

TEST(Report, TellsWhetherLinesStayedForWantOfBends)
{
    Session session = finished("dome.obj");
    for (const bool none : {false, true}) {
        GridStage grid = *session.grid;
        grid.result.no_bends = none;
        session.grid = std::make_shared<GridStage>(grid);
        EXPECT_EQ(nlohmann::json::parse(report_json(session, {}, 0)).at("grid").at("no_bends"), none);
    }
}

TEST(Report, SaysThatABlankWinds)
{
    Session session = finished("dome.obj");
    const auto winds = [&] {
        const auto all = shortcomings(session);
        return std::count_if(all.begin(), all.end(),
                             [](const std::string& line) { return line.find("the blank winds") != line.npos; });
    };
    EXPECT_EQ(winds(), 0);
    GridStage grid = *session.grid;
    grid.result.route = GridRoute::spiral;
    session.grid = std::make_shared<GridStage>(grid);
    EXPECT_EQ(winds(), 1);
}

/// The figures of a part with holes and of a blank that lies on itself, each found in another way
/// than the report's.
TEST(Report, GivesTheFiguresOfTheResult)
{
    const Session session = finished("inner-panel.obj");
    const auto json = nlohmann::json::parse(report_json(session, {}, 0));
    const auto figure = [&](const char* key) { return json.at(nlohmann::json::json_pointer(key)).get<double>(); };
    const FlattenResult& flat = *session.blank;
    double thinnest = 1e9, thickest = 0, strain = 0;
    int necking = 0;
    for (int f = 0; f < session.part->mesh.triangles(); ++f) {
        thinnest = std::min(thinnest, flat.face.thickness[f]);
        thickest = std::max(thickest, flat.face.thickness[f]);
        strain = std::max(strain, flat.face.strain_equivalent[f]);
        necking += flat.face.necking[f];
    }
    const double h0 = session.options.flatten.thickness;
    EXPECT_DOUBLE_EQ(figure("/result/thickness_min_mm"), thinnest);
    EXPECT_DOUBLE_EQ(figure("/result/thickness_max_mm"), thickest);
    EXPECT_NEAR(figure("/result/thinning_max"), 1 - thinnest / h0, 1e-14);
    EXPECT_NEAR(figure("/result/thinning_min"), 1 - thickest / h0, 1e-14);
    EXPECT_EQ(figure("/result/equivalent_strain_max"), strain);
    EXPECT_EQ(figure("/result/necking_triangles"), necking);
    EXPECT_EQ(json["solve"]["system"], "strict");
    EXPECT_EQ(json["part"]["boundary_loops"], 12); // the edge, a window and ten round holes

    // The outer boundary is the loop around the largest area.
    double perimeter = 0, largest = 0;
    for (const auto& loop : boundary_loops(session.part->mesh)) {
        double length = 0, area = 0;
        for (size_t i = 0; i < loop.size(); ++i) {
            const Eigen::Vector2d a = flat.blank.position.col(loop[i]),
                                  b = flat.blank.position.col(loop[(i + 1) % loop.size()]);
            length += (b - a).norm();
            area += (a[0] * b[1] - a[1] * b[0]) / 2;
        }
        if (area > largest) {
            largest = area;
            perimeter = length;
        }
    }
    EXPECT_NEAR(figure("/blank/perimeter_mm"), perimeter, 1e-9 * perimeter);

    // The holes are filled for the surface; what it does there counts as no deviation.
    const Deviation& d = session.surface->deviation;
    EXPECT_GT(d.surface_to_mesh.excluded, 0);
    EXPECT_EQ(figure("/surface/deviation_max_mm"), std::max(d.surface_to_mesh.max, d.mesh_to_surface.max));
    EXPECT_EQ(figure("/surface/deviation_rms_mm"), std::max(d.surface_to_mesh.rms, d.mesh_to_surface.rms));
    EXPECT_EQ(figure("/surface/deviation_p95_mm"), std::max(d.surface_to_mesh.p95, d.mesh_to_surface.p95));
}

TEST(Report, HasTheStrainsOfTheSkinsWhereTheyWereAskedFor)
{
    const auto solved = [](bool skins) {
        Session session = sample("square-cup.obj");
        session.options.flatten.skins = skins;
        return run_stage(Stage::solve, run_stage(Stage::read, std::move(session)));
    };
    const Session without = solved(false), with = solved(true);
    EXPECT_EQ(with.blank->blank.position, without.blank->blank.position) << "nothing else depends on them";
    EXPECT_FALSE(nlohmann::json::parse(report_json(without, {}, 0)).contains("skins"));
    const auto json = nlohmann::json::parse(report_json(with, {}, 0)).at("skins");
    const SkinStrains& skins = *with.blank->skins;
    EXPECT_EQ(json["outer"]["strain_major_max"], skins.outer.strain_major.maxCoeff());
    EXPECT_EQ(json["inner"]["strain_minor_min"], skins.inner.strain_minor.minCoeff());
    EXPECT_EQ(json["smallest_radius_mm"], 1 / skins.curvature.cwiseAbs().maxCoeff());
    EXPECT_EQ(json["sharp_faces"], skins.sharp_faces);
    // A bend stretches one skin beyond the middle, the other less.
    EXPECT_GT(std::max(skins.outer.strain_major.maxCoeff(), skins.inner.strain_major.maxCoeff()),
              with.blank->face.strain_major.maxCoeff());
}

TEST(Report, NamesEveryShortcoming)
{
    Session session = finished("dome.obj");
    EXPECT_EQ(shortcomings(session).size(), 1u) << "the surface is 0.2 mm off";
    FlattenResult poorer = *session.blank;
    poorer.report.system = SolvedSystem::energy;
    poorer.report.reason = "stalled";
    poorer.necking_triangles = 3;
    poorer.blank.position.row(0).array() -= poorer.blank.position.row(0).mean();
    // folded over: the outline meets itself
    poorer.blank.position.row(0) = poorer.blank.position.row(0).cwiseAbs();
    poorer.overlap = overlap(session.part->mesh, poorer.blank.position);
    poorer.overlap.wound = {0};
    session.blank = std::make_shared<FlattenResult>(poorer);
    GridStage folded = *session.grid;
    QuadGrid& planar = folded.result.planar = {4, 3, Eigen::Matrix3Xd::Zero(3, 20)};
    for (int j = 0; j <= 3; ++j)
        for (int i = 0; i <= 4; ++i)
            planar.position.col(planar.node(i, j)) << i, j, 0;
    planar.position.col(planar.node(4, 3)) << 3.3, 2.3, 0; // a corner of one cell alone, pushed in
    folded.result.quality = cell_quality(planar);
    folded.result.quality.folded_cells = 2;
    session.grid = std::make_shared<GridStage>(folded);
    std::string all;
    for (const std::string& text : shortcomings(session))
        all += text + "\n";
    for (const char* part : {"stalled", "3 triangles are strained", "crosses itself", "winds around 1 vertex",
                             "2 cells of the grid", "column 3, row 2"})
        EXPECT_NE(all.find(part), std::string::npos) << part << " in\n" << all;
}

TEST(Outputs, AFileNeverTakesThePlaceOfThePart)
{
    const ScratchFolder folder;
    const auto part = folder / "dome.glb";
    std::filesystem::copy_file(SPIA_SOURCE_DIR "/assets/parts/dome.obj", folder / "dome.obj");
    Session session = finished("dome.obj");
    write_outputs(session, folder / ".", {"glb"});
    const auto size = std::filesystem::file_size(part);
    session.file = part; // as if it had been read from there
    EXPECT_THROW(require_place(session, folder / ".", {"glb"}), ExchangeError);
    EXPECT_THROW(write_outputs(session, folder / ".", {"csv", "glb"}), ExchangeError);
    EXPECT_THROW(require_place(session, folder / "new", {"csv"}, {part}), ExchangeError);
    EXPECT_THROW(require_place(session, folder / "new", {"csv"}, {folder / "new" / "fields.csv"}), ExchangeError);
    EXPECT_NO_THROW(require_place(session, folder / "new", {"glb"}, {folder / "new.json", {}}));
    EXPECT_THROW(require_place(session, folder / "new", {"glb"}, {folder / "new.json", folder / "./new.json"}),
                 ExchangeError);
    EXPECT_EQ(std::filesystem::file_size(part), size);
    EXPECT_FALSE(std::filesystem::exists(folder / "new.json"));
}

TEST(Outputs, AFormatThatCannotBeWrittenKeepsNoOtherFromBeing)
{
    const ScratchFolder folder;
    std::vector<std::string> written;
    const auto fails_after_iges = [&](const std::filesystem::path& file) {
        if (file.extension() == ".iges")
            throw ExchangeError("the disk is full");
        written.push_back(file.filename().string());
    };
    EXPECT_THROW(write_outputs(finished("dome.obj"), folder / "out", {"iges", "step", "glb"}, {}, {}, fails_after_iges),
                 ExchangeError);
    EXPECT_EQ(written, (std::vector<std::string>{"dome.step", "dome.glb"}));
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / "dome.glb"));
}

TEST(Outputs, OptionsSayWhatIsWrittenUnderWhichName)
{
    const ScratchFolder folder;
    Session session = finished("dome.obj");
    OutputOptions options;
    options.name = "door v2";
    options.unit = LengthUnit::inch;
    options.csv.outline = false;
    options.csv.faces = false;
    const std::vector<std::string> formats = {"iges", "step", "glb", "csv"};
    const auto expected = output_files(session, folder / "out", formats, options);
    const auto written = write_outputs(session, folder / "out", formats, options);
    EXPECT_EQ(written, expected);
    std::set<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(folder / "out"))
        names.insert(file.path().filename().string());
    EXPECT_EQ(names, (std::set<std::string>{"door v2.iges", "door v2.step", "door v2.glb", "door v2-fields.csv"}));
    EXPECT_THROW(require_place(session, folder / "new", {"iges"}, {folder / "new" / "door v2.iges"}, options),
                 ExchangeError);

    options.csv.fields = false;
    EXPECT_THROW(output_files(session, folder / "out", {"csv"}, options), InputError);
    options.glb = {false, false, false, false, false};
    EXPECT_THROW(write_outputs(session, folder / "out", {"glb"}, options), InputError);
    options = {};
    for (const char* name : {"../x", "a/b", "..", "a\\b"}) {
        options.name = name;
        EXPECT_THROW(output_files(session, folder / "out", {"dxf"}, options), InputError) << name;
    }
    options = {};
    options.glb = {false, false, false, true, true};
    session.surface.reset();
    // no surface yet
    EXPECT_TRUE(write_outputs(session, folder / "none", {"iges", "glb"}, options).empty());
}

TEST(Outputs, AGlbFileHoldsTheSurfaceOnlyIfAskedTo)
{
    OutputOptions options;
    const auto holds = [&](const char* format) { return holds_surface(format, options); };
    options.glb = {};
    options.glb.surface = options.glb.control_net = false;
    EXPECT_FALSE(holds("glb"));
    options.glb.control_net = true;
    EXPECT_TRUE(holds("glb"));
    options.glb.control_net = false;
    options.glb.surface = true;
    EXPECT_TRUE(holds("glb"));
    EXPECT_FALSE(is_of_surface("glb")) << "it can be without";
    for (const char* format : {"iges", "step", "gismo"})
        EXPECT_TRUE(holds(format) && is_of_surface(format)) << format;
    for (const char* format : {"dxf", "csv", "vtu", "png"})
        EXPECT_FALSE(holds(format) || is_of_surface(format)) << format;
}

TEST(Outputs, TheTableOfFieldsCallsVerticesAsTheFileDoes)
{
    const ScratchFolder folder;
    std::ofstream(folder / "strip.obj")
        << "v 9 9 9\nv 0 0 0\nv 10 0 0\nv 9 9 8\nv 10 10 0\nv 0 10 0\nv 20 0 0\nv 20 10 "
           "0\nf 2 3 5\nf 2 5 6\nf 3 7 8\nf 3 8 5\n"; // the first and fourth vertex are strays
    Session session = sample("dome.obj");
    session.file = folder / "strip.obj";
    session = completed(run_chain(std::move(session), Stage::read, Stage::solve));
    write_outputs(session, folder / "out", {"csv"});
    std::ifstream file(folder / "out" / "fields.csv");
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line, "vertex,x,y,z,blank_x,blank_y,thickness,thinning,strain_major,strain_minor,strain_equivalent");
    std::vector<int> numbers;
    while (std::getline(file, line))
        numbers.push_back(std::stoi(line));
    EXPECT_EQ(numbers, (std::vector<int>{1, 2, 4, 5, 6, 7}));
}

TEST(Outputs, WhatHasNoSurfaceYetIsWrittenWithoutIt)
{
    const ScratchFolder folder;
    Session session = finished("dome.obj");
    const auto all = write_outputs(session, folder / "whole", usual_formats());
    EXPECT_EQ(all.size(), usual_formats().size() + 2); // csv: three tables
    session.grid.reset();
    session.lifted.reset();
    session.surface.reset();
    std::set<std::string> names;
    for (const auto& file : write_outputs(session, folder / "partial", usual_formats())) {
        EXPECT_GT(std::filesystem::file_size(file), 100u) << file;
        names.insert(file.filename().string());
    }
    EXPECT_EQ(names, (std::set<std::string>{"dome.glb", "dome.vtu", "dome.dxf", "fields.csv", "outline.csv",
                                            "faces.csv", "dome.png"}));
    const auto json = nlohmann::json::parse(report_json(session, {}, 0, Failure{Stage::grid, "no corner"}));
    EXPECT_EQ(json["failure"]["stage"], "grid");
    EXPECT_EQ(json["failure"]["message"], "no corner");
    EXPECT_TRUE(json.contains("blank"));
    session.blank.reset();
    EXPECT_THROW(write_outputs(session, folder / "nothing", output_formats()), InputError);
}

TEST(Chain, NumbersThatMayBeMeantInAnotherUnitAreAskedAbout)
{
    Session session = sample("dome.obj");
    auto& hardening = std::get<Swift>(session.options.flatten.material.hardening);
    hardening.K_MPa /= 1000; // GPa
    session.options.flatten.process.contact = {{"binder", {0, 1, 2}, 1e-3, {}, 12, 2}};
    session = run_stage(Stage::solve, run_stage(Stage::read, std::move(session)));
    std::string all;
    for (const std::string& text : shortcomings(session))
        all += text + "\n";
    EXPECT_NE(all.find("are its stresses in MPa?"), std::string::npos) << all;
    EXPECT_NE(all.find("the friction coefficient of binder is 12"), std::string::npos) << all;
}

} // namespace spia::stage_test
