// The chain from a blank that was made in steps.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/core/error.h"
#include "engine/forming/material/material_library.h"
#include "engine/forming/solver/membrane.h"
#include "engine/mesh/topology.h"
#include "engine/pipeline/applied_process.h"
#include "engine/pipeline/outputs/outputs.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/run_stage.h"
#include "engine/report/json/report_json.h"
#include "engine/unfold/automatic_unfolding.h"
#include "tests/support/bent_parts.h"
#include "tests/support/mesh_file.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia {
namespace {

using std::numbers::pi;

/// A part read from its file, and its steps done.
struct InSteps {
    ScratchFolder folder;
    Session session;

    explicit InSteps(const TriMesh& mesh)
    {
        shapes::write_mesh(folder / "part.obj", mesh);
        session.file = folder / "part.obj";
        session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        session = run_stage(Stage::read, session);
        const TriMesh& part = session.part->mesh;
        session.options.steps = {
            std::make_shared<UnfoldRun>(automatic_unfolding(part, find_bends(part), {}, session.options.flatten).run)};
    }
    void finish() { session = completed(run_chain(session, Stage::solve)); }
};

} // namespace

TEST(BlankOfSteps, GoesThroughTheWholeChainAsItIs)
{
    InSteps box(shapes::lipped_box());
    box.finish();
    const Session& session = box.session;
    const UnfoldRun& run = *session.options.steps->run;
    const FlattenResult& flat = *session.blank;
    EXPECT_EQ(flat.blank.position, run.blank->position);
    EXPECT_EQ(flat.face.strain_major, run.states.back().face.strain_major);
    EXPECT_EQ(flat.report.newton.size(), 0u);
    EXPECT_TRUE(flat.report.whole()) << flat.report.reason;
    EXPECT_LT(flat.volume_error, 1e-8) << "fields and blank belong together";
    // A vertex has the mean of its faces, by the zones as by hand.
    const double greatest = flat.face.thinning.maxCoeff();
    EXPECT_LE(flat.node.thinning.maxCoeff(), greatest);
    EXPECT_GT(flat.node.thinning.maxCoeff(), 0.2 * greatest);
    const auto direct = forming_limits(session.part->mesh, run.states.back().face, session.options.flatten.material,
                                       session.options.flatten.thickness, session.options.limits);
    EXPECT_EQ(session.limits->zones.zone, direct.zones.zone);
    ASSERT_TRUE(session.surface);
    EXPECT_EQ(session.grid->result.quality.folded_cells, 0);
    EXPECT_LT(session.surface->deviation.surface_to_mesh.p95, 2);
    const auto files = write_outputs(session, box.folder / "out", {"iges", "step", "glb", "dxf"});
    EXPECT_EQ(files.size(), 4u);
    for (const auto& file : files)
        EXPECT_GT(std::filesystem::file_size(file), 1000u) << file;
}

TEST(BlankOfSteps, TheReportNamesTheStepsAndASolveInOneStepDoesNot)
{
    InSteps box(shapes::lipped_box());
    box.session = run_stage(Stage::solve, box.session);
    auto json = nlohmann::json::parse(report_json(box.session, {}, 0));
    EXPECT_EQ(json["source"]["from"], "steps");
    ASSERT_EQ(json["source"]["steps"].size(), box.session.options.steps->run->states.size());
    EXPECT_EQ(json["source"]["steps"][4]["face"], "plane");
    EXPECT_EQ(json["source"]["steps"][1]["name"], box.session.options.steps->run->states[1].name);
    EXPECT_EQ(json["solve"]["reason"], "made in 5 steps, each of which converged");
    InSteps flat(shapes::extruded(shapes::Profile({0, 0}, 0).straight(60).bend(5, -1).straight(20), 40, 400).mesh);
    flat.session.options.steps.reset();
    flat.session = run_stage(Stage::solve, flat.session);
    json = nlohmann::json::parse(report_json(flat.session, {}, 0));
    EXPECT_EQ(json["source"], nlohmann::json({{"from", "one step"}}));
}

TEST(BlankOfSteps, PolishedItIsInEquilibriumAsAWhole)
{
    InSteps box(shapes::lipped_box());
    box.session = run_stage(Stage::solve, box.session);
    const auto steps = box.session.blank;
    box.session.options.steps->polish = true;
    box.session = run_stage(Stage::solve, box.session);
    const FlattenResult& polished = *box.session.blank;
    EXPECT_TRUE(polished.report.converged) << polished.report.reason;
    EXPECT_GT(polished.report.newton.size(), 0u);
    EXPECT_LT(polished.report.residual, 1e-7);
    const double moved = (polished.blank.position - steps->blank.position).colwise().norm().maxCoeff();
    EXPECT_GT(moved, 1e-3) << "all material may move once more";
    EXPECT_LT(moved, 0.1 * bounding_diagonal(box.session.part->mesh)) << "it lies on that of the steps";
    EXPECT_EQ(nlohmann::json::parse(report_json(box.session, {}, 0))["source"]["from"], "steps, polished");
}

TEST(BlankOfSteps, TheStampingDirectionIsTheNormalOfItsPlaneAndTheSkinsKnowTheBends)
{
    // A U whose middle stays: its plane is that of the blank, and nothing but bending strains the
    // skins.
    const shapes::DevelopablePart channel = shapes::extruded(
        shapes::Profile({0, 0}, 0).straight(20).bend(5, -pi / 2).straight(60).bend(5, -pi / 2).straight(25), 80, 4000);
    InSteps u(channel.mesh);
    u.session.options.flatten.skins = true;
    u.session = run_stage(Stage::solve, u.session);
    const FlattenResult& flat = *u.session.blank;
    EXPECT_NEAR(std::abs(flat.stamping.direction[0]), 1, 1e-9) << "the web of 60 is upright";
    EXPECT_GT(flat.stamping.direction.dot(area_vectors(u.session.part->mesh).rowwise().sum()), 0);
    ASSERT_TRUE(flat.skins);
    // Half the thickness over the radius: log(1 + 0.5 / 5), outside or inside.
    const double wanted = std::log(1 + 0.5 / 5);
    const double greatest =
        std::max(flat.skins->outer.strain_major.maxCoeff(), flat.skins->inner.strain_major.maxCoeff());
    EXPECT_NEAR(greatest, wanted, 0.15 * wanted);
    EXPECT_LT(flat.face.strain_equivalent.maxCoeff(), 0.01);
}

TEST(BlankOfSteps, ToolsAndRunsWithoutABlankAreRefused)
{
    InSteps box(shapes::lipped_box());
    Session held = box.session;
    held.options.flatten.process.edge_restraint = 0.2;
    EXPECT_THROW(run_stage(Stage::solve, held), InputError);
    UnfoldRun short_run = *box.session.options.steps->run;
    short_run.blank.reset();
    box.session.options.steps->run = std::make_shared<UnfoldRun>(short_run);
    EXPECT_THROW(run_stage(Stage::solve, box.session), InputError);
    short_run.blank = Blank{Eigen::Matrix2Xd::Zero(2, box.session.part->mesh.vertices())};
    short_run.flipped = 3;
    box.session.options.steps->run = std::make_shared<UnfoldRun>(short_run);
    EXPECT_THROW(run_stage(Stage::solve, box.session), InputError);
}

} // namespace spia
