#include "engine/pipeline/files/process_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/forming/process/drawbead.h"
#include "engine/pipeline/applied_process.h"
#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "engine/report/json/report_json.h"
#include "tests/support/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::process_file_test {
namespace {

const std::filesystem::path materials = SPIA_SOURCE_DIR "/assets/materials";

/// A sheet of 50 x 40 mm whose faces are numbered from 100 on in the file, two triangles each.
PartFile part()
{
    PartFile result;
    result.mesh = shapes::rectangle(50, 40, 5, 4);
    for (int f = 0; f < result.mesh.triangles(); ++f)
        result.source_face.push_back(100 + f / 2);
    return result;
}

ProcessConditions process_of(const std::string& text)
{
    const ScratchFolder folder;
    put(folder / "p.json", text);
    return read_process(folder / "p.json", part(), find_material("mild_steel", materials), 0.8, materials);
}

std::string refusal(const std::string& text)
{
    try {
        process_of(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "taken";
}

} // namespace

TEST(ProcessFile, HoldsEveryCondition)
{
    const ProcessConditions p = process_of(R"({
      "contact": [{"name": "binder", "faces": [101, 103], "force_N": 2e4, "friction": 0.12},
                  {"box": [[0, 0, -1], [10, 40, 1]], "pressure_MPa": 0.5, "friction": 0.1, "sides": 1}],
      "drawbeads": [{"line": [[20, 5, 0], [20, 35, 0]], "force_N_mm": 90},
                    {"name": "b", "line": [[30, 5, 0], [30, 35, 0]],
                     "shape": {"radius": 5, "shoulder_radius": 3, "depth": 4, "friction": 0.2}},
                    {"line": [[5, 5, 0], [5, 35, 0]],
                     "shape": {"radius": 5, "shoulder_radius": 3, "depth": 4, "friction": 0.2}}],
      "edge_restraint": 0.1, "pilots": [{"line": [[0, 0, 0]]}],
      "tailored": [{"box": [[25, 0, -1], [50, 40, 1]], "material": "dp600", "thickness": 1.4}],
      "rolling": [0, 1, 0] })");
    ASSERT_EQ(p.contact.size(), 2u);
    EXPECT_EQ(p.contact[0].faces, (std::vector<int>{2, 3, 6, 7}));
    EXPECT_EQ(p.contact[0].force_N, 2e4);
    EXPECT_EQ(p.contact[0].sides, 2);
    EXPECT_EQ(p.contact[1].name, "contact 2");
    EXPECT_EQ(p.contact[1].faces.size(), 8u); // the first of five columns
    EXPECT_EQ(p.contact[1].sides, 1);
    ASSERT_EQ(p.drawbeads.size(), 3u);
    EXPECT_EQ(p.drawbeads[2].force_N_mm, drawbead_force({5, 3, 4, 0.2}, find_material("mild_steel", materials), 0.8));
    EXPECT_EQ(p.drawbeads[0].force_N_mm, 90);
    EXPECT_EQ(p.drawbeads[1].force_N_mm, drawbead_force({5, 3, 4, 0.2}, find_material("dp600", materials), 1.4));
    EXPECT_EQ(p.edge_restraint, 0.1);
    EXPECT_EQ(p.pilots[0].line.size(), 1u);
    EXPECT_EQ(p.tailored[0].material.name, find_material("dp600", materials).name);
    EXPECT_EQ(p.tailored[0].faces.size(), 20u); // two columns, and of the next the triangles whose
                                                // middle is inside
    EXPECT_EQ(p.rolling, Eigen::Vector3d(0, 1, 0));
    EXPECT_EQ(process_of("{}"), ProcessConditions{});
}

TEST(ProcessFile, WhatIsWrongIsNamedWithItsPlace)
{
    const auto says = [](const std::string& text, const std::string& words) {
        EXPECT_NE(refusal(text).find(words), std::string::npos) << refusal(text);
    };
    says("", "p.json");
    says("[]", "must be an object");
    says(R"({"binder": 1})", "has no member \"binder\"; there are: contact, drawbeads");
    says(R"({"contact": [{"faces": [101], "force_N": 1, "pressure_MPa": 1, "friction": 0.1}]})",
         "/contact/0 needs either the member");
    says(R"({"contact": [{"faces": [99], "force_N": 1, "friction": 0.1}]})", "/contact/0/faces/0 is 99");
    says(R"({"contact": [{"faces": [101.5], "force_N": 1, "friction": 0.1}]})", "/contact/0/faces/0");
    says(R"({"contact": [{"box": [[90, 0, 0], [99, 9, 9]], "force_N": 1, "friction": 0.1}]})", "picks no face");
    says(R"({"contact": [{"force_N": 1, "friction": 0.1}]})", "needs the member \"faces\" or \"box\"");
    says(R"({"contact": [{"faces": [101], "force_N": 1}]})", "needs the member \"friction\"");
    says(R"({"contact": [{"faces": [101], "force_N": 1, "friction": -1}]})", "/contact/0/friction is -1");
    says(R"({"contact": [{"faces": [101], "force_N": 1, "friction": 0.1, "sides": 1.5}]})", "sides must be 1 or 2");
    says(R"({"drawbeads": [{"line": [[1, 2]], "force_N_mm": 1}]})", "/drawbeads/0/line/0 must be three numbers");
    says(R"({"drawbeads": [{"line": [[1, 2, 3]]}]})", "needs either the member \"force_N_mm\" or \"shape\"");
    says(R"({"edge_restraint": 2})", "/edge_restraint is 2");
    says(R"({"tailored": [{"faces": [101], "material": "gold", "thickness": 1}]})", "gold");
    says(R"({"rolling": [1, 0]})", "/rolling must be three numbers");
}

TEST(ProcessReport, HasTheFiguresOfWhatTheToolsDid)
{
    const ScratchFolder folder;
    const TriMesh mesh = shapes::rectangle(50, 40, 5, 4);
    shapes::write_mesh(folder / "part.obj", mesh);
    Session session;
    session.file = folder / "part.obj";
    session.options.flatten.material = find_material("mild_steel", materials);
    session = run_stage(Stage::solve, run_stage(Stage::read, session));
    const auto json = [&] { return nlohmann::json::parse(report_json(session, {}, 0))["process"]; };
    EXPECT_TRUE(json().is_null());
    EXPECT_TRUE(describe(applied_process(session)).empty());

    put(folder / "p.json", R"({
      "contact": [{"name": "binder", "box": [[0, 0, -1], [10, 40, 1]], "force_N": 800, "friction": 0.1},
                  {"name": "pad", "faces": [39], "pressure_MPa": 0.5, "friction": 0.2, "sides": 1}],
      "drawbeads": [{"name": "b", "line": [[20, 5, 0], [20, 35, 0], [24, 32, 0]], "force_N_mm": 90}],
      "edge_restraint": 0.1, "pilots": [{"line": [[0, 0, 0]]}],
      "tailored": [{"name": "all", "box": [[0, 0, -1], [50, 40, 1]], "material": "dp600", "thickness": 1.4},
                   {"name": "half", "box": [[20, 0, -1], [50, 40, 1]], "thickness": 0.7}],
      "rolling": [0, 1, 0] })");
    const FlattenOptions& options = session.options.flatten;
    session.options.flatten.process =
        read_process(folder / "p.json", *session.part, options.material, options.thickness, materials);
    session = judge_limits(session);
    const auto process = json();
    // 800 N on 10 x 40 mm: 2 MPa; 2 sides * 0.1 * 800 N
    const auto& binder = process["contact"][0];
    EXPECT_EQ(binder["name"], "binder");
    EXPECT_EQ(binder["faces"], 8);
    EXPECT_NEAR(binder["area_mm2"].get<double>(), 400, 1e-9);
    EXPECT_NEAR(binder["pressure_MPa"].get<double>(), 2, 1e-9);
    EXPECT_NEAR(binder["friction_force_N"].get<double>(), 160, 1e-9);
    EXPECT_EQ(binder["friction"], 0.1);
    EXPECT_EQ(binder["sides"], 2);
    // half of 10 x 10 mm
    EXPECT_NEAR(process["contact"][1]["friction_force_N"].get<double>(), 0.2 * 0.5 * 50, 1e-9);
    EXPECT_EQ(process["drawbeads"][0]["force_N_mm"], 90);
    EXPECT_NEAR(process["drawbeads"][0]["length_mm"].get<double>(), 35, 1e-9);
    const double lock = lock_force(options.material, options.thickness);
    EXPECT_EQ(process["edge_restraint"]["share"], 0.1);
    EXPECT_NEAR(process["edge_restraint"]["lock_force_N_mm"].get<double>(), lock, 1e-9);
    EXPECT_NEAR(process["edge_restraint"]["force_N_mm"].get<double>(), 0.1 * lock, 1e-9);
    EXPECT_NEAR(process["edge_restraint"]["held_mm"].get<double>(), 180, 1e-9);
    EXPECT_EQ(process["edge_restraint"]["upright_mm"], 0);
    EXPECT_EQ(process["acting_share"], session.blank->report.process_share);
    EXPECT_NEAR(process["tailored"][1]["edge_force_N_mm"].get<double>(), 0.1 * lock_force(options.material, 0.7), 1e-9);
    EXPECT_EQ(process["pilots"][0]["places"], 1);
    EXPECT_EQ(process["tailored"][0]["faces"], 16); // what the later one leaves
    EXPECT_NEAR(process["tailored"][0]["area_mm2"].get<double>(), 800, 1e-9);
    EXPECT_EQ(process["tailored"][1]["thickness_mm"], 0.7);
    EXPECT_EQ(process["tailored"][1]["material"], options.material.name);
    EXPECT_NEAR(process["tailored"][1]["area_mm2"].get<double>(), 1200, 1e-9);
    EXPECT_EQ(process["rolling"], nlohmann::json({0., 1., 0.}));
    const auto lines = describe(applied_process(session));
    EXPECT_EQ(lines.size(), 8u);
    EXPECT_EQ(lines[0], "contact binder: 2 MPa on 8 faces, friction 0.1 on 2 sides, holds up to 160 N");

    // The pieces are judged by their own curves.
    const auto limits = nlohmann::json::parse(report_json(session, {}, 0))["limits"];
    const FormingLimitCurve thin = keeler_brazier(0.7, uniform_strain(options.material.hardening, 0.99));
    ASSERT_EQ(limits["pieces"].size(), 2u);
    EXPECT_EQ(limits["pieces"][0]["faces"], 16);
    EXPECT_EQ(limits["pieces"][1]["margin"], 0.1);
    EXPECT_NEAR(limits["pieces"][1]["curve"]["flc0"].get<double>(), engineering_strain(thin.at_plane_strain()), 1e-12);
    for (int f = 0; f < mesh.triangles(); ++f)
        if (session.part->mesh.position(0, Eigen::all)(session.part->mesh.triangle.col(f)).mean() > 20) {
            EXPECT_NEAR(session.limits->zones.distance[f], engineering_strain(thin.at_plane_strain()), 1e-3);
        }
}

TEST(Shortcomings, TellOfConditionsThatCannotBeMeant)
{
    Session session;
    const auto says = [&](const char* text) {
        const auto list = shortcomings(session);
        return std::any_of(list.begin(), list.end(),
                           [&](const std::string& line) { return line.find(text) != std::string::npos; });
    };
    PartFile part;
    part.mesh = shapes::rectangle(50, 40, 5, 4);
    session.part = std::make_shared<PartFile>(part);
    session.options.flatten.material = find_material("mild_steel", materials);
    session = run_stage(Stage::solve, std::move(session), {});
    EXPECT_TRUE(shortcomings(session).empty());
    session.options.flatten.thickness = 0.001;
    EXPECT_TRUE(says("0.001 mm thick"));
    session.options.flatten.thickness = 1;
    session.options.flatten.process.drawbeads = {{"b", {{20, 5, 0}, {20, 35, 0}}, 1000}};
    EXPECT_TRUE(says("b restrains with 1000 N/mm"));
    session.options.flatten.process.drawbeads[0].force_N_mm = 0;
    EXPECT_TRUE(says("b has no effect"));
    session.options.flatten.process.edge_restraint = 0.2;
    EXPECT_FALSE(says("of the edge the sheet is parallel"));
    auto along = std::make_shared<FlattenResult>(*session.blank);
    along->stamping.direction = Eigen::Vector3d::UnitX();
    session.blank = along;
    EXPECT_TRUE(says("on 180 of 180 mm of the edge the sheet is parallel"));
}

} // namespace spia::process_file_test
