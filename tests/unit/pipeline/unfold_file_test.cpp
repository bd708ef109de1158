#include "engine/pipeline/files/unfold_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <numeric>

#include "engine/core/error.h"
#include "engine/core/json_file.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "engine/report/json/unfold_report_json.h"
#include "tests/support/bent_parts.h"
#include "tests/support/mesh_tools.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

PartFile part_file(TriMesh mesh)
{
    PartFile part;
    part.mesh = std::move(mesh);
    part.source_face.resize(size_t(part.mesh.triangles()));
    std::iota(part.source_face.begin(), part.source_face.end(), 0);
    return part;
}

class UnfoldFile : public testing::Test {
protected:
    UnfoldFile() : part(part_file(shapes::lipped_box())), map(find_bends(part.mesh)) {}

    ReadScript read(const std::string& text) { return read(text, part, map); }
    ReadScript read(const std::string& text, const PartFile& other, const BendMap& bends)
    {
        const std::filesystem::path file = scratch / "steps.json";
        std::ofstream(file) << text;
        return read_unfold_script(file, other, bends);
    }
    std::string fault(const std::string& text)
    {
        try {
            read(text);
        } catch (const InputError& error) {
            const std::string what = error.what();
            return what.substr(what.find("steps.json") + 10);
        }
        return "none";
    }

    ScratchFolder scratch;
    PartFile part; ///< regions: 1 bottom, 2 and 3 long walls, 4 and 5 short ones, 6 to 9 their lips
    BendMap map;
};

} // namespace

TEST_F(UnfoldFile, AProposalIsReadBackAsItIs)
{
    for (const bool rolled : {false, true}) {
        if (rolled) {
            part = part_file(
                shapes::extruded(shapes::Profile({0, 0}, 0).bend(150, 1).bend(5, 1.5).straight(20), 150, 3000).mesh);
            map = find_bends(part.mesh);
        }
        const UnfoldScript steps = propose_sequence(part.mesh, map).steps;
        const ReadScript back = read(unfold_script_json(map, steps));
        EXPECT_TRUE(back.findings.empty()) << back.findings[0];
        ASSERT_EQ(back.steps.size(), steps.size());
        for (size_t k = 0; k < steps.size(); ++k) {
            EXPECT_EQ(back.steps[k].name, steps[k].name);
            EXPECT_EQ(back.steps[k].kind, steps[k].kind);
            EXPECT_EQ(back.steps[k].pick.freed, steps[k].pick.freed);
            EXPECT_EQ(back.steps[k].pick.fixed, steps[k].pick.fixed);
            EXPECT_EQ(back.steps[k].pick.carrying, steps[k].pick.carrying);
            EXPECT_EQ(back.steps[k].within_mm, steps[k].within_mm);
        }
    }
}

TEST_F(UnfoldFile, APickUnitesRegionsFacesAndABox)
{
    const ReadScript script = read(R"({"steps": [
        {"freed": {"regions": ["region 6"]}, "fixed": {"regions": ["region 2"]}, "name": "lip",
         "target": {"within_mm": 0.5, "offset_mm": -2, "extent_mm": 12.5}, "options": {"most_newton_steps": 7, "tolerance": 1e-6}},
        {"freed": {"box": [[-60, -60, 0.1], [60, 60, 99]], "faces": [1579]}, "fixed": {"box": [[-60, -60, -1], [0, 60, 0.01]]},
         "target": {"plane": {"origin": [0, 0, 1], "normal": [0, 0, -3]}}}]})");
    EXPECT_FALSE(script.findings.empty()) << "the walls would tear off the other half of the bottom";
    ASSERT_EQ(script.steps.size(), 1u);
    const PlannedStep& lip = script.steps[0];
    EXPECT_EQ(lip.pick.freed, map.faces_of(5));
    EXPECT_EQ(lip.pick.carrying, map.faces_of(1));
    EXPECT_EQ(lip.within_mm, 0.5);
    EXPECT_EQ(lip.offset_mm, -2);
    EXPECT_EQ(lip.extent_mm, 12.5);
    EXPECT_EQ(read(unfold_script_json(map, {lip})).steps.at(0).extent_mm, 12.5);
    EXPECT_EQ(lip.most_newton_steps, 7);
    EXPECT_EQ(lip.tolerance, 1e-6);
    EXPECT_EQ(lip.carrier, 1);
    const ReadScript whole = read(R"({"steps": [{"freed": {"box": [[-60, -60, 0.1], [60, 60, 99]]},
        "fixed": {"regions": ["region 1"]}, "target": {"plane": {"origin": [0, 0, 0], "normal": [0, 0, -3]}}}]})");
    ASSERT_EQ(whole.steps.size(), 1u);
    EXPECT_EQ(whole.steps[0].name, "what is in a box onto region 1");
    EXPECT_EQ(int(whole.steps[0].pick.freed.size()), part.mesh.triangles() - map.regions[0].faces);
    ASSERT_TRUE(whole.steps[0].pick.target);
    const Eigen::Vector3d normal = outer_normal(*whole.steps[0].pick.target, {5, 5, 5});
    EXPECT_NEAR((normal + Eigen::Vector3d::UnitZ()).norm(), 0, 1e-12);
}

TEST_F(UnfoldFile, AStepWithoutANameIsCalledByWhatItDoes)
{
    const auto named = [&](const std::string& members) {
        return read(R"({"steps": [{)" + members + "}]}").steps.at(0).name;
    };
    const std::string lip = R"("freed": {"regions": ["region 6"]}, "fixed": {"regions": ["region 2"]})";
    EXPECT_EQ(named(lip), "region 6 onto region 2");
    EXPECT_EQ(named(R"("name": "", )" + lip), "region 6 onto region 2");
    EXPECT_EQ(named(R"("name": "the lip", )" + lip), "the lip");
    EXPECT_EQ(named(R"("freed": {"regions": ["region 6", "region 7"]}, "fixed": {"regions": ["region 2", "region 3"]},
                       "carrying": {"regions": ["region 3"]})"),
              "region 6, region 7 onto region 3");
    EXPECT_EQ(named(R"("kind": "flatten")"), "flatten the whole part");
    EXPECT_EQ(named(R"("kind": "unroll", "carrying": {"regions": ["region 1"], "faces": [0, 1]})"),
              "unroll from region 1, 2 faces");
    const ReadScript left = read(R"({"regions": [{"name": "far", "at": [900, 0, 0]}],
        "steps": [{"freed": {"regions": ["far"]}, "fixed": {"regions": ["region 2"]}}, {)" +
                                 lip + "}]}");
    EXPECT_EQ(left.findings.back(), "step \"far onto region 2\" is left out: nothing of what it moves is there");
}

TEST_F(UnfoldFile, ANumberBeyondAllBoundsIsToldWithTheFile)
{
    EXPECT_EQ(fault(R"({"steps": [{"freed": {"faces": [1e400]}, "fixed": {"regions": ["region 2"]}}]})"),
              ": number overflow parsing '1e400'");
}

TEST_F(UnfoldFile, FrictionIsReadAndWrittenBackAsItIs)
{
    const std::string lip =
        R"({"steps": [{"freed": {"regions": ["region 6", "region 7"]}, "fixed": {"regions": ["region 2",
        "region 3"]}, "carrying": {"regions": ["region 2"]}, "friction": )";
    const auto back = [&](const std::string& friction) {
        const ReadScript first = read(lip + friction + "}]}");
        // The writer names the carrier alone, so that it can be read again.
        UnfoldScript steps = first.steps;
        steps.at(0).carrier = 1;
        const ReadScript again = read(unfold_script_json(map, steps, part.source_face));
        EXPECT_TRUE(again.findings.empty()) << again.findings[0];
        EXPECT_EQ(again.steps.at(0).pick.friction, first.steps.at(0).pick.friction) << friction;
        return *first.steps.at(0).pick.friction;
    };
    const ContactRegion plain = back(R"({"coefficient": 0.12, "pressure_MPa": 2.5})");
    EXPECT_EQ(plain, (ContactRegion{"the target", {}, 2.5, {}, 0.12, 2}));
    const ContactRegion forced = back(R"({"coefficient": 0.1, "force_N": 4000, "sides": 1, "regions": ["region 7"]})");
    EXPECT_EQ(forced, (ContactRegion{"the target", map.faces_of(6), {}, 4000, 0.1, 1}));
    const int some = map.faces_of(5)[3];
    for (int& number : part.source_face) // as the file counts them
        number += 7;
    const std::string number = std::to_string(part.source_face[size_t(some)]);
    const ContactRegion face = back(R"({"coefficient": 0.1, "pressure_MPa": 1, "faces": [)" + number + "]}");
    EXPECT_EQ(face.faces, std::vector<int>{some});
    // Where the region on which it was is gone, nothing rubs: no faces would mean all.
    const ReadScript gone =
        read(R"({"regions": [{"name": "far", "at": [900, 0, 0]}], "steps": [{"freed": {"regions": ["region 6"]},
        "fixed": {"regions": ["region 2"]}, "friction": {"coefficient": 0.1, "pressure_MPa": 1, "regions": ["far"]}}]})");
    ASSERT_EQ(gone.steps.size(), 1u);
    EXPECT_FALSE(gone.steps[0].pick.friction);
    EXPECT_NE(
        std::find(gone.findings.begin(), gone.findings.end(), "step \"region 6 onto region 2\": friction without far"),
        gone.findings.end());
}

TEST_F(UnfoldFile, CylinderAndConeAreTargets)
{
    const auto target = [&](const std::string& face) {
        return *read(
                    R"({"steps": [{"freed": {"regions": ["region 6"]}, "fixed": {"regions": ["region 2"]}, "target": )" +
                    face + "}]}")
                    .steps.at(0)
                    .pick.target;
    };
    const TargetSurface cylinder = target(R"({"cylinder": {"origin": [1, 2, 3], "axis": [0, 0, 2], "radius": 40}})");
    EXPECT_NEAR(placed(cylinder, developed(cylinder, {101, 2, 9}))[0], 41, 1e-9);
    const TargetSurface cone = target(R"({"cone": {"apex": [0, 0, 0], "axis": [0, 0, 1], "half_angle_deg": 45}})");
    EXPECT_NEAR((placed(cone, developed(cone, {10, 0, 10})) - Eigen::Vector3d(10, 0, 10)).norm(), 0, 1e-9);
}

TEST_F(UnfoldFile, AnUnrollIsWrittenWithAllTheFacesThatCarryIt)
{
    const ReadScript first =
        read(R"({"steps": [{"kind": "unroll", "carrying": {"regions": ["region 1", "region 2"], "faces": [3]}}]})");
    const ReadScript again = read(unfold_script_json(part, map, first.steps));
    EXPECT_TRUE(again.findings.empty());
    EXPECT_EQ(again.steps.at(0).pick.carrying, first.steps.at(0).pick.carrying);
}

TEST_F(UnfoldFile, EveryFaultIsToldWithItsPlace)
{
    const std::string ends = R"(, "fixed": {"regions": ["region 2"]}}]})",
                      lip = R"({"steps": [{"freed": {"regions": ["region 6"]}, "fixed": {"regions": ["region 2"]}, )";
    EXPECT_EQ(fault(R"({"step": []})"), " has no member \"step\"; there are: schema, regions, steps");
    EXPECT_EQ(fault("{}"), " needs the member \"steps\"");
    EXPECT_EQ(fault(R"({"schema": "spia.unfold/9", "steps": []})"), ": /schema must be \"spia.unfold/1\"");
    EXPECT_EQ(fault(R"({"steps": []})"), ": /steps has no step; there is nothing to unfold");
    EXPECT_EQ(fault(R"({"steps": [{"freed": {"regions": ["lid"]})" + ends),
              ": /steps/0/freed/regions/0 is \"lid\": neither the list \"regions\" nor the part has such a region");
    EXPECT_EQ(fault(R"({"steps": [{"freed": {"faces": [9999]})" + ends),
              ": /steps/0/freed/faces/0 is 9999: the part has no such face");
    EXPECT_EQ(fault(R"({"steps": [{"freed": {})" + ends),
              ": /steps/0/freed needs the member \"regions\", \"faces\" or \"box\"");
    EXPECT_EQ(fault(R"({"steps": [{"freed": {"box": [[500, 0, 0], [501, 1, 1]]})" + ends),
              ": /steps/0/freed picks no face of the part");
    EXPECT_EQ(fault(R"({"steps": [{"freed": {"regions": ["region 2"]})" + ends).find(": /steps/0 picks face"), 0u);
    EXPECT_EQ(fault(lip + R"("target": "plane"}]})"), ": /steps/0/target must be \"fitted\" or an object { }");
    EXPECT_EQ(fault(lip + R"("target": {"plane": {"origin": [0, 0, 0], "normal": [0, 0, 0]}}}]})"),
              ": /steps/0/target/plane/normal must not be zero");
    EXPECT_EQ(fault(lip + R"("target": {"cylinder": {"origin": [0, 0, 0], "axis": [0, 0, 1]}}}]})"),
              ": /steps/0/target/cylinder needs the member \"radius\"");
    EXPECT_EQ(fault(lip + R"("options": {"most_newton_steps": 1.5}}]})"),
              ": /steps/0/options/most_newton_steps must be a whole number");
    const auto friction = [&](const std::string& members) {
        return fault(lip + R"("friction": {)" + members + "}}]}");
    };
    EXPECT_EQ(friction(R"("pressure_MPa": 1)"), ": /steps/0/friction needs the member \"coefficient\"");
    EXPECT_EQ(friction(R"("coefficient": -0.1, "pressure_MPa": 1)").find(": /steps/0/friction/coefficient "), 0u);
    EXPECT_EQ(friction(R"("coefficient": 0.1, "pressure_MPa": 0)").find(": /steps/0/friction/pressure_MPa "), 0u);
    EXPECT_EQ(friction(R"("coefficient": 0.1, "force_N": -1)").find(": /steps/0/friction/force_N "), 0u);
    EXPECT_EQ(friction(R"("coefficient": 0.1, "pressure_MPa": 1, "sides": 1.5)"),
              ": /steps/0/friction/sides must be 1 or 2");
    EXPECT_EQ(friction(R"("coefficient": 0.1, "pressure_MPa": 1, "force_N": 1)"),
              ": /steps/0/friction needs either the member \"pressure_MPa\" or \"force_N\"");
    EXPECT_EQ(friction(R"("coefficient": 0.1)"),
              ": /steps/0/friction needs either the member \"pressure_MPa\" or \"force_N\"");
    EXPECT_EQ(friction(R"("coefficient": 0.1, "pressure_MPa": 1, "regions": ["region 2"])")
                  .find(": /steps/0/friction picks face"),
              0u);
    EXPECT_EQ(fault(R"({"steps": [{"kind": "flatten", "friction": {"coefficient": 0.1, "pressure_MPa": 1}}]})"),
              ": /steps/0/friction has no meaning: flatten moves the whole part");
    EXPECT_EQ(fault(R"({"steps": [{"kind": "unroll", "carrying": {"regions": ["region 1"]}, "options": {}}]})"),
              ": /steps/0/options has no meaning: nothing is solved when a face is unrolled");
    EXPECT_EQ(fault(lip + R"("kind": "bend"}]})"), ": /steps/0/kind must be \"lay\", \"unroll\" or \"flatten\"");
    EXPECT_EQ(fault(lip + R"("kind": "flatten"}]})"), ": /steps/0/freed has no meaning: flatten moves the whole part");
    EXPECT_EQ(fault(lip + R"("carrying": {"regions": ["region 1"]}}]})").find(": /steps/0/carrying picks face"), 0u);
    EXPECT_EQ(fault(R"({"regions": [{"name": "a", "at": [0, 0, 0]}, {"name": "a", "at": [0, 0, 0]}], "steps": []})"),
              ": /regions/1/name names a region for the second time");
}

TEST_F(UnfoldFile, OnAChangedPartWhatIsStillThereIsUnfoldedTheRestReported)
{
    const UnfoldScript steps = propose_sequence(part.mesh, map).steps;
    const std::string script = unfold_script_json(map, steps);
    // Another mesh of the same box, and one a little higher: all is found again, by place.
    for (const double height : {30.0, 32.0}) {
        const PartFile finer = part_file(shapes::lipped_box({.height = height, .edge = 3.3}));
        const BendMap there = find_bends(finer.mesh);
        const ReadScript again = read(script, finer, there);
        EXPECT_TRUE(again.findings.empty()) << again.findings[0];
        EXPECT_EQ(again.steps.size(), steps.size());
        FlattenOptions options;
        options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        EXPECT_TRUE(run_unfolding(finer.mesh, again.steps, options).blank);
    }
    // Without the lips their steps are left out; the walls are laid down all the same.
    const double top = part.mesh.position.row(2).maxCoeff() - 1e-9;
    std::vector<Eigen::Vector3i> kept;
    for (const auto& t : part.mesh.triangle.colwise())
        if (part.mesh.position(2, t[0]) < top || part.mesh.position(2, t[1]) < top || part.mesh.position(2, t[2]) < top)
            kept.emplace_back(t);
    TriMesh cut{part.mesh.position, Eigen::Matrix3Xi(3, Eigen::Index(kept.size()))};
    for (size_t f = 0; f < kept.size(); ++f)
        cut.triangle.col(Eigen::Index(f)) = kept[f];
    const PartFile bare = part_file(cut);
    const ReadScript rest = read(script, bare, find_bends(bare.mesh));
    ASSERT_EQ(rest.steps.size(), 1u);
    EXPECT_EQ(rest.steps[0].name, steps.back().name);
    EXPECT_EQ(rest.findings.size(), 4u + 4u + 1u) << "four lips, their steps, and what the last step does without";
    // The whole part moved away: nothing is where the script says.
    PartFile away = part;
    away.mesh.position.colwise() += Eigen::Vector3d(0, 0, 1000);
    EXPECT_TRUE(read(script, away, map).steps.empty());
}

TEST_F(UnfoldFile, WhereTwoRegionsMeetTheSizeTellsWhichIsMeant)
{
    const auto steps = [&](const std::string& regions) {
        return read(R"({"regions": [)" + regions +
                    R"(], "steps": [{"freed": {"regions": ["lip"]}, "fixed": {"regions": ["wall"]}}]})");
    };
    const std::string edge = R"("at": [0, -35, 30], "area_mm2": )"; // between the wall and its lip
    const ReadScript told = steps(R"({"name": "wall", )" + edge + R"(3000}, {"name": "lip", )" + edge + "640}");
    ASSERT_EQ(told.steps.size(), 1u);
    EXPECT_EQ(map.regions[size_t(told.steps[0].carrier)].area, map.regions[1].area);
    EXPECT_EQ(told.steps[0].pick.freed.size(), 64u);
    // In the corner of a long wall (3000 mm2) and a short one (2100 mm2), either could be meant.
    const ReadScript corner = steps(
        R"({"name": "wall", "at": [50, -35, 15], "area_mm2": 2150}, {"name": "lip", "at": [46, 0, 30], "area_mm2": 400})");
    ASSERT_EQ(corner.steps.size(), 1u) << "the lip can only be laid on its own wall";
    EXPECT_NEAR(map.regions[size_t(corner.steps[0].carrier)].area, 2100, 1e-6);
    // Both names on one region: the second means nothing.
    const ReadScript twice = steps(R"({"name": "wall", "at": [0, -35, 15]}, {"name": "lip", "at": [10, -35, 15]})");
    EXPECT_TRUE(twice.steps.empty());
    ASSERT_FALSE(twice.findings.empty());
    EXPECT_EQ(twice.findings[0], "lip: is now the same region as wall");
}

TEST_F(UnfoldFile, TheReportSaysWhatCameOfEachStep)
{
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    const UnfoldScript steps = propose_sequence(part.mesh, map).steps;
    const UnfoldRun run = run_unfolding(part.mesh, steps, options);
    const Json json =
        parse_json(unfold_report_json("box.stl", part, map, steps, run, {"a finding"}, {"x.vtu"}), "report");
    EXPECT_EQ(json["schema"], "spia.unfold-result/1");
    EXPECT_EQ(json["regions"].size(), 9u);
    EXPECT_EQ(json["bends"].size(), 12u);
    EXPECT_NEAR(json["bends"][0]["angle_deg"], 90, 1e-9);
    EXPECT_EQ(json["bends"][0]["between"], (Json{"region 1", "region 2"}));
    ASSERT_EQ(json["states"].size(), 5u);
    EXPECT_EQ(json["states"][0]["face"], "plane");
    EXPECT_LT(json["states"][0]["angle_to_fixed_deg"], 1e-6);
    EXPECT_TRUE(json["failure"].is_null());
    EXPECT_EQ(json["findings"], Json{"a finding"});
    EXPECT_EQ(json["blank"]["flipped_triangles"], 0);
    TriMesh flat = part.mesh;
    flat.position.topRows(2) = run.blank->position;
    flat.position.row(2).setZero();
    EXPECT_NEAR(json["blank"]["area_mm2"], area(flat), 1e-6);
    EXPECT_NEAR(json["part"]["area_mm2"], 7000 + 340 * 30 + 260 * 8, 1e-6);
}

} // namespace spia
