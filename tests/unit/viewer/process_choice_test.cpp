#include "app/viewer/model/document/process_choice.h"

#include <gtest/gtest.h>
#include <thread>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/jobs/viewer_model.h"
#include "app/viewer/model/reports/viewer_words.h"
#include "app/viewer/views/process_lines.h"
#include "engine/forming/material/material_library.h"
#include "engine/mesh/topology.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {
namespace {

struct ProcessChoice : ModelFixture {
    const ProcessConditions& process = document.session.options.flatten.process;

    void SetUp() override { open(); }
    void make_region(RegionKind kind)
    {
        model.apply(SelectFaces{{3, 5, 8}});
        model.apply(MakeRegion{"tool", kind});
    }
    /// Two places of the part, a third of its size apart.
    std::vector<Eigen::Vector3d> places() const
    {
        const auto loop = boundary_loops(document.session.part->mesh).front();
        const Eigen::Matrix3Xd& p = document.session.part->mesh.position;
        return {p.col(loop[0]), p.col(loop[1])};
    }
    std::string last_error() const
    {
        for (auto message = state.messages.rbegin(); message != state.messages.rend(); ++message)
            if (message->severity == Severity::error)
                return message->text;
        return "";
    }
};

} // namespace

TEST_F(ProcessChoice, ABinderPressesOnBothSidesAPadOnOne)
{
    make_region(RegionKind::binder);
    EXPECT_TRUE(process.contact.empty());
    model.apply(SetContact{0, ToolContact{.force_N = 20'000, .friction = 0.1}});
    ASSERT_EQ(process.contact.size(), 1u);
    EXPECT_EQ(process.contact[0], (ContactRegion{"tool", {3, 5, 8}, {}, 20'000, 0.1, 2}));
    EXPECT_EQ(load_words(document.regions[0]), "20 kN, friction 0.1 on both sides");
    model.apply(ChangeRegion{0, "tool", RegionKind::pad});
    EXPECT_EQ(process.contact.at(0).sides, 1);
    EXPECT_EQ(load_words(document.regions[0]), "20 kN, friction 0.1");
    model.apply(SetContact{0, ToolContact{.pressure_MPa = 2.5}});
    EXPECT_EQ(process.contact.at(0).pressure_MPa, 2.5);
    EXPECT_FALSE(process.contact.at(0).force_N);
    model.apply(ChangeRegion{0, "tool", RegionKind::fixed}); // that presses on nothing
    EXPECT_TRUE(process.contact.empty());
    model.apply(SetContact{0, ToolContact{.force_N = 1}});
    EXPECT_NE(last_error().find("only a binder, a pad or the punch"), std::string::npos) << last_error();
    EXPECT_TRUE(process.contact.empty());
    model.apply(Undo{});
    model.apply(Undo{});
    EXPECT_EQ(process.contact.size(), 1u);
    model.apply(RemoveRegion{0});
    EXPECT_TRUE(process.contact.empty());
}

TEST_F(ProcessChoice, ARegionMayBeOfAnotherSheet)
{
    make_region(RegionKind::material);
    model.apply(SetOwnSheet{0, OwnSheet{"dp600", 1.6}});
    ASSERT_EQ(process.tailored.size(), 1u) << last_error();
    EXPECT_EQ(process.tailored[0],
              (TailoredPiece{"tool", {3, 5, 8}, find_material("dp600", assets / "materials"), 1.6}));
    model.apply(SetOwnSheet{0, OwnSheet{"cheese", 1.6}});
    EXPECT_NE(last_error().find("cheese"), std::string::npos);
    EXPECT_EQ(document.regions[0].sheet->material, "dp600"); // all or nothing
}

TEST_F(ProcessChoice, LinesBecomeBeadsAndPilotsWithNamesOfTheirOwn)
{
    const auto at = places();
    model.apply(AddLine{{.kind = LineKind::drawbead, .point = at, .force_N_mm = 80}});
    model.apply(AddLine{{.kind = LineKind::pilot, .point = {at[0]}}});
    model.apply(AddLine{{.kind = LineKind::drawbead, .point = at, .shape = BeadShape{6, 3, 4, 0.1}}});
    ASSERT_EQ(process.drawbeads.size(), 2u);
    EXPECT_EQ(process.drawbeads[0], (Drawbead{"drawbead 1", at, 80}));
    EXPECT_EQ(process.drawbeads[1].name, "drawbead 2");
    const FlattenOptions& sheet = document.session.options.flatten;
    EXPECT_EQ(process.drawbeads[1].force_N_mm, drawbead_force({6, 3, 4, 0.1}, sheet.material, 1));
    model.apply(SetThickness{2}); // a thicker sheet is harder to bend
    EXPECT_EQ(process.drawbeads[1].force_N_mm, drawbead_force({6, 3, 4, 0.1}, sheet.material, 2));
    EXPECT_EQ(bead_force(document, 0), 80);
    EXPECT_EQ(bead_force(document, 1), std::nullopt); // a pilot
    EXPECT_EQ(bead_force(document, 2), process.drawbeads[1].force_N_mm);
    EXPECT_EQ(process.pilots.at(0), (Pilot{"pilot 1", {at[0]}}));
    model.apply(AddLine{{.kind = LineKind::drawbead, .point = {at[0]}}});
    EXPECT_NE(last_error().find("two points"), std::string::npos);
    model.apply(SelectVertices{{4, 9}});
    model.apply(PinVertices{});
    EXPECT_EQ(process.pilots.size(), 3u);
    EXPECT_EQ(process.pilots[2].line.at(0), document.session.part->mesh.position.col(9));
    model.apply(RemoveLine{0});
    EXPECT_EQ(process.drawbeads.size(), 1u);
}

TEST_F(ProcessChoice, ABeadByShapeTakesTheSheetInWhichItLies)
{
    const TriMesh& part = document.session.part->mesh;
    const Eigen::Matrix3d corner = part.position(Eigen::all, part.triangle.col(5));
    const std::vector<Eigen::Vector3d> at{0.6 * corner.col(0) + 0.2 * (corner.col(1) + corner.col(2)),
                                          0.6 * corner.col(1) + 0.2 * (corner.col(0) + corner.col(2))};
    model.apply(AddLine{{.kind = LineKind::drawbead, .point = at, .shape = BeadShape{6, 3, 4, 0.1}}});
    const Material base = document.session.options.flatten.material;
    EXPECT_EQ(process.drawbeads.at(0).force_N_mm, drawbead_force({6, 3, 4, 0.1}, base, 1));
    make_region(RegionKind::material); // face 5 among others
    model.apply(SetOwnSheet{0, OwnSheet{"dp600", 1.6}});
    EXPECT_EQ(process.drawbeads.at(0).force_N_mm,
              drawbead_force({6, 3, 4, 0.1}, find_material("dp600", assets / "materials"), 1.6));
    EXPECT_EQ(bead_force(document, 0), process.drawbeads[0].force_N_mm);
    model.apply(RemoveRegion{0});
    EXPECT_EQ(bead_force(document, 0), drawbead_force({6, 3, 4, 0.1}, base, 1));
}

TEST_F(ProcessChoice, MakesTheBlankOldAndChangesIt)
{
    model.apply(RunTo{Stage::solve});
    wait();
    ASSERT_NE(document.session.blank, nullptr);
    const auto free = document.session.blank;
    EXPECT_GT(first_stale(document), Stage::solve);
    model.apply(SetProcess{0.3, {}});
    EXPECT_EQ(first_stale(document), Stage::solve);
    model.apply(RunTo{Stage::solve});
    wait();
    ASSERT_NE(document.session.blank, free);
    // what is held at the edge must be stretched instead of drawn in
    EXPECT_GT(document.session.blank->face.thinning.mean(), free->face.thinning.mean() + 1e-3);
    EXPECT_EQ(first_stale(document), Stage::grid);
}

TEST_F(ProcessChoice, LinesFollowTheSheetAndLeaveNothingWhereTheyLeaveIt)
{
    const TriMesh& part = document.session.part->mesh;
    const auto at = places();
    const auto found =
        places_of_lines(part, {{.point = {at[0], at[1]}}, {.point = {at[0], at[0] + Eigen::Vector3d(0, 0, 1e4)}}});
    ASSERT_EQ(found.size(), 2u);
    ASSERT_GE(found[0].size(), 2u);
    EXPECT_NEAR((found[0].front().position - at[0]).norm(), 0, 1e-9);
    EXPECT_NEAR((found[0].back().position - at[1]).norm(), 0, 1e-9);
    EXPECT_TRUE(found[1].empty());
}

TEST_F(ProcessChoice, LimitsJudgeTheBlankAnewAtOnce)
{
    model.apply(RunTo{Stage::solve});
    wait();
    const auto before = document.session.limits;
    ASSERT_NE(before, nullptr);
    const double thinnest = document.session.blank->face.thinning.maxCoeff();
    ASSERT_GT(thinnest, 0.01);
    LimitsChoice choice = document.limits;
    choice.curve = LimitsOptions::Source::none;
    choice.max_thinning = thinnest / 2;
    model.apply(SetLimits{choice});
    ASSERT_NE(document.session.limits, before) << last_error();
    EXPECT_FALSE(document.session.limits->curve);
    EXPECT_GT(document.session.limits->zones.share[size_t(Zone::excessive_thinning)].faces, 0);
    EXPECT_EQ(first_stale(document), Stage::grid); // the blank itself is as good as before
    const Eigen::VectorXd zone = values(document.session, Field::zone, true);
    EXPECT_EQ(zone.size(), document.session.part->mesh.triangles());
    EXPECT_TRUE((zone.array() == double(Zone::excessive_thinning)).any());
    EXPECT_FALSE(available(document.session, Field::limit_distance));
    model.apply(Undo{});
    EXPECT_EQ(document.session.limits, before);
    EXPECT_TRUE(available(document.session, Field::limit_distance));
    choice.curve = LimitsOptions::Source::points;
    choice.table = "/nowhere/flc.csv";
    model.apply(SetLimits{choice});
    EXPECT_NE(last_error().find("flc.csv"), std::string::npos);
    EXPECT_EQ(document.session.limits, before);
}

TEST_F(ProcessChoice, ZonesAreShownPerFace)
{
    FieldDisplay display;
    display.field = Field::zone;
    model.apply(SetDisplay{display});
    EXPECT_TRUE(by_face(document.display));
    EXPECT_FALSE(document.display.per_face) << "as the user chose for other fields";
}

} // namespace spia::viewer
