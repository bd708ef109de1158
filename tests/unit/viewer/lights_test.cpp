#include "app/viewer/model/reports/lights.h"

#include <fstream>
#include <gmock/gmock.h>

#include "app/viewer/model/actions/remedies.h"
#include "engine/mesh/topology.h"
#include "engine/report/figures/face_values.h"
#include "tests/support/bent_parts.h"
#include "tests/support/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/model_fixture.h"

using testing::HasSubstr;

namespace spia::viewer {
namespace {

struct Lights : ModelFixture {
    ScratchFolder folder;

    std::vector<Doubt> of(ChainStep step) const
    {
        std::vector<Doubt> found;
        for (const Doubt& doubt : *state.doubts)
            if (doubt.step == step)
                found.push_back(doubt);
        return found;
    }
    std::string all() const
    {
        std::string text;
        for (const Doubt& doubt : *state.doubts)
            text += doubt.text + "\n";
        return text;
    }
    void press(const Doubt& doubt)
    {
        EXPECT_FALSE(doubt.button.empty()) << doubt.text;
        for (const Action& action : actions_of(doubt, document))
            model.apply(action);
        wait();
    }
    void confirm_sheet()
    {
        const auto assumed = of(ChainStep::sheet);
        ASSERT_EQ(assumed.size(), 1u) << all();
        press(assumed[0]);
    }
    void run(Stage stage = Stage::fit)
    {
        model.apply(RunTo{stage});
        wait();
    }
};

TEST_F(Lights, ASheetThatNobodyGaveIsAssumedUntilItIsConfirmed)
{
    open();
    ASSERT_EQ(of(ChainStep::sheet).size(), 1u);
    const Doubt assumed = of(ChainStep::sheet)[0];
    EXPECT_THAT(assumed.text, HasSubstr("The thickness 1 mm is assumed"));
    EXPECT_THAT(assumed.text, HasSubstr("mild_steel is assumed"));
    EXPECT_FALSE(readiness(state).fine);
    model.apply(SetMaterial{"dp600"}); // the thickness is still nobody's
    ASSERT_EQ(of(ChainStep::sheet).size(), 1u);
    EXPECT_THAT(of(ChainStep::sheet)[0].text, testing::Not(HasSubstr("grade")));
    press(of(ChainStep::sheet)[0]);
    EXPECT_TRUE(of(ChainStep::sheet).empty()) << all();
    EXPECT_EQ(document.session.options.flatten.thickness, 1);
    EXPECT_TRUE(readiness(state).fine);
    EXPECT_EQ(readiness(state).text, "Ready");
    model.apply(Undo{});
    EXPECT_EQ(of(ChainStep::sheet).size(), 1u) << "undo takes the word back";
}

TEST_F(Lights, ThicknessOfTheFileIsGivenAndThatOfAnotherPartIsNot)
{
    std::ofstream(folder / "strip.k") << sample::dyna();
    model.apply(OpenPart{folder / "strip.k", "", {.parts = {"7"}}});
    wait();
    ASSERT_TRUE(document.session.part);
    EXPECT_EQ(document.session.options.flatten.thickness, 1.25);
    ASSERT_EQ(of(ChainStep::sheet).size(), 1u);
    EXPECT_THAT(of(ChainStep::sheet)[0].text, testing::Not(HasSubstr("thick")));
    EXPECT_THAT(of(ChainStep::sheet)[0].text, HasSubstr("The file calls the material \"DC04\""));
    confirm_sheet();
    EXPECT_TRUE(of(ChainStep::sheet).empty());
    open();
    ASSERT_EQ(of(ChainStep::sheet).size(), 1u);
    EXPECT_THAT(of(ChainStep::sheet)[0].text, HasSubstr("1.25 mm is that of the previous part"));
    EXPECT_THAT(of(ChainStep::sheet)[0].text, HasSubstr("is that of the previous part")) << "so is the grade";
    EXPECT_THAT(of(ChainStep::sheet)[0].text, HasSubstr("The grade mild_steel is that of the previous part"));
}

TEST_F(Lights, AProjectKeepsWhoGaveTheSheet)
{
    open();
    model.apply(SetThickness{0.8});
    model.apply(SaveProject{folder / "dome.spia"});
    model.apply(OpenProject{folder / "dome.spia"});
    wait();
    EXPECT_EQ(document.thickness_from, SheetSource::chosen);
    EXPECT_EQ(document.material_from, SheetSource::assumed);
    EXPECT_EQ(of(ChainStep::sheet).size(), 1u);
}

TEST_F(Lights, AProjectThatIsOpenedKnowsNoPreviousPart)
{
    open();
    confirm_sheet();
    open();
    ASSERT_EQ(document.thickness_from, SheetSource::before);
    ASSERT_EQ(document.material_from, SheetSource::before);
    model.apply(SaveProject{folder / "dome.spia"});
    model.apply(OpenProject{folder / "dome.spia"});
    wait();
    ASSERT_EQ(of(ChainStep::sheet).size(), 1u);
    EXPECT_THAT(of(ChainStep::sheet)[0].text, testing::Not(HasSubstr("previous")));
    EXPECT_THAT(of(ChainStep::sheet)[0].text, HasSubstr("assumed"));
}

TEST_F(Lights, ASurfaceOutOfToleranceOffersAFitWithinIt)
{
    open();
    confirm_sheet();
    GridOptions coarse = document.session.options.grid;
    coarse.cells = 3;
    model.apply(SetGrid{coarse});
    run();
    ASSERT_TRUE(document.session.surface);
    ASSERT_GT(document.session.surface->deviation.max(), usual_tolerance) << "or this test says nothing";
    const auto far = of(ChainStep::surface);
    ASSERT_FALSE(far.empty());
    EXPECT_THAT(far[0].text, HasSubstr("deviates from the part by up to"));
    const Deviation& deviation = document.session.surface->deviation;
    EXPECT_EQ(deviation.worse().max, deviation.max());
    EXPECT_EQ(far[0].place, deviation.worse().where) << "what Show flies to";
    EXPECT_FALSE(readiness(state).fine);
    press(far[0]);
    ASSERT_TRUE(document.session.surface->fit);
    EXPECT_EQ(document.session.surface->fit->tolerance, usual_tolerance);
    EXPECT_THAT(all(), testing::Not(HasSubstr("a usual tolerance")));
}

TEST_F(Lights, CracksAndForbiddenThinningAreAmberAndShowTheirZones)
{
    open();
    confirm_sheet();
    run(Stage::solve);
    EXPECT_TRUE(of(ChainStep::unfold).empty()) << all();
    double greatest = 0;
    int thinner = 0;
    for (const double each : document.session.blank->face.thinning)
        greatest = std::max(greatest, each);
    LimitsChoice strict = document.limits;
    strict.curve = LimitsOptions::Source::none;
    strict.max_thinning = 0.9 * greatest;
    for (const double each : document.session.blank->face.thinning)
        thinner += each > strict.max_thinning;
    model.apply(SetLimits{strict});
    ASSERT_EQ(of(ChainStep::unfold).size(), 1u) << all();
    const Doubt doubt = of(ChainStep::unfold)[0];
    EXPECT_THAT(doubt.text, HasSubstr(thinner == 1 ? "1 face is thinner"
                                                   : fmt::format("{} faces exceed the allowed thinning", thinner)));
    EXPECT_EQ(doubt.field, Field::zone);
    const WorstSpot& worst = document.session.limits->zones.spots.front();
    EXPECT_EQ(face_of(doubt, document.session.part->mesh), worst.face);
    const FieldDisplay before = document.display;
    model.apply(FlyTo{worst.face, doubt.field});
    EXPECT_EQ(document.display.field, Field::zone);
    model.apply(HideSpot{});
    EXPECT_EQ(document.display, before) << "Esc goes back in all";
    model.apply(FlyTo{worst.face, doubt.field});
    EXPECT_TRUE(by_face(document.display)) << "as zones are";
    EXPECT_EQ(document.display.per_face, before.per_face) << "what the user chose comes back";
    model.apply(FlyTo{0, Field::thickness});
    EXPECT_EQ(document.display.field, Field::thickness);
    EXPECT_EQ(document.display.per_face, before.per_face) << "zones alone are";
    model.apply(HideSpot{});
    EXPECT_EQ(document.display, before) << "past both spots";
    model.apply(FlyTo{worst.face, doubt.field});
    FieldDisplay chosen = document.display;
    chosen.field = Field::thickness;
    model.apply(SetDisplay{chosen});
    model.apply(HideSpot{});
    EXPECT_EQ(document.display.field, Field::thickness) << "chosen since";
    model.apply(Undo{}); // of the displays
    model.apply(Undo{});
    EXPECT_TRUE(of(ChainStep::unfold).empty()) << all();
}

TEST_F(Lights, WhatIsOutOfDateIsNotReady)
{
    open();
    confirm_sheet();
    run(Stage::solve);
    EXPECT_EQ(readiness(state).text, "Ready");
    model.apply(SetThickness{0.7});
    EXPECT_FALSE(readiness(state).fine);
    EXPECT_THAT(readiness(state).text, HasSubstr("Out of date from the step Unfold on"));
    EXPECT_THAT(readiness(state).text, HasSubstr("F5"));
    EXPECT_TRUE(of(ChainStep::unfold).empty());
}

TEST_F(Lights, AllShortcomingsOfTheEngineAreAmongThem)
{
    open();
    model.apply(SetThickness{30}); // plate
    run();
    EXPECT_THAT(all(), HasSubstr("is 30 mm thick: is that in mm?"));
    ASSERT_FALSE(of(ChainStep::sheet).empty());
}

TEST_F(Lights, APartOfUnlikelySizeIsReadInAnotherUnitByAClick)
{
    TriMesh metres = shapes::rectangle(0.3, 0.2, 6, 4);
    shapes::write_mesh(folder / "metres.obj", metres);
    model.apply(OpenPart{folder / "metres.obj", ""});
    wait();
    ASSERT_EQ(of(ChainStep::part).size(), 1u) << all();
    press(of(ChainStep::part)[0]);
    EXPECT_EQ(document.session.part->unit, LengthUnit::m);
    EXPECT_TRUE(of(ChainStep::part).empty()) << all();
}

TEST_F(Lights, AFoldedSurfaceIsAmberHoweverNearItIs)
{
    open();
    confirm_sheet();
    model.apply(SetFit{{.tolerance = 0.5}}); // with which it need not follow the facets
    run();
    ASSERT_TRUE(document.session.surface);
    EXPECT_TRUE(of(ChainStep::surface).empty()) << all();
    Document folded = document;
    auto surface = std::make_shared<SurfaceStage>(*document.session.surface);
    surface->certificate.patch.at(0).refusal = Refusal{Refusal::Why::folded, {0.3, 0.5, {1, 2, 3}}};
    folded.session.surface = surface;
    folded.session.deformed = nullptr;
    const auto says = [](const std::vector<Doubt>& doubts, const char* words) {
        return std::any_of(doubts.begin(), doubts.end(), [&](const Doubt& doubt) {
            return doubt.step == ChainStep::surface && doubt.text.find(words) != std::string::npos;
        });
    };
    EXPECT_TRUE(says(find_doubts(folded), "The surface folds at u = 0.3"));
    surface->certificate.patch.at(0).refusal = Refusal{Refusal::Why::vanishes, {0, 1, {1, 2, 3}}};
    EXPECT_FALSE(says(find_doubts(folded), "fold")) << "at a corner on a smooth outline it has no angle";
    surface->deviation.normal.turned = 0.02;
    EXPECT_TRUE(says(find_doubts(folded), "2.00 %"));
}

TEST_F(Lights, ASurfaceOfMoreControlPointsThanVerticesIsAmber)
{
    open();
    confirm_sheet();
    model.apply(SetFit{{.tolerance = 0.5}}); // with which it need not follow the facets
    run();
    ASSERT_TRUE(document.session.surface->fit);
    const int count = shared_controls(fitted_patches(*document.session.surface)).count;
    ASSERT_LE(count, document.session.part->mesh.vertices());
    EXPECT_TRUE(of(ChainStep::surface).empty()) << all();
    // The same with 600 control points, of a part with one vertex more and one less; some hundred are
    // few whatever the mesh.
    Document other = document;
    const auto is_amber = [&](int control_points, int vertices) {
        auto surface = std::make_shared<SurfaceStage>(*document.session.surface);
        surface->result.surface.count_u = control_points;
        surface->result.surface.count_v = 1;
        surface->result.surface.control = Eigen::Matrix3Xd::Zero(3, control_points);
        surface->result.surface.weight = Eigen::VectorXd::Ones(control_points);
        other.session.surface = surface;
        auto part = std::make_shared<PartFile>(*document.session.part);
        part->mesh.position.conservativeResize(3, vertices);
        other.session.part = part;
        const auto doubts = find_doubts(other);
        return std::any_of(doubts.begin(), doubts.end(), [&](const Doubt& doubt) {
            return doubt.text.find(fmt::format("has {} control points, more than the part has vertices ({})",
                                               control_points, vertices)) != std::string::npos;
        });
    };
    EXPECT_TRUE(is_amber(600, 599));
    EXPECT_FALSE(is_amber(600, 601));
    EXPECT_FALSE(is_amber(80, 66));
}

TEST_F(Lights, PatchesThatKinkWhereThePartDoesNotAreAmber)
{
    open("perforated-channel.obj");
    confirm_sheet();
    model.apply(SetFit{{.tolerance = 0.5}});
    model.apply(SetPatches{LayoutOptions{}});
    run();
    ASSERT_TRUE(document.session.surface && document.session.surface->patches);
    const auto kinks = [](const Document& shown) {
        const auto doubts = find_doubts(shown);
        return std::any_of(doubts.begin(), doubts.end(), [](const Doubt& doubt) {
            return doubt.text.find("Patches join with a kink of up to") == 0;
        });
    };
    Document bent = document;
    auto surface = std::make_shared<SurfaceStage>(*document.session.surface);
    ASSERT_FALSE(surface->certificate.interfaces.empty());
    for (InterfaceCertificate& joint : surface->certificate.interfaces)
        joint.greatest_angle = 0.01;
    bent.session.surface = surface;
    EXPECT_FALSE(kinks(bent));
    surface->certificate.interfaces.back().greatest_angle = 1.5;
    EXPECT_TRUE(kinks(bent));
}

TEST_F(Lights, WhereTheStrainIsBeyondTheCurveIsGoneTo)
{
    open();
    confirm_sheet();
    run(Stage::solve);
    Document beyond = document;
    auto flat = std::make_shared<FlattenResult>(*document.session.blank);
    auto& strain = flat->face.strain_equivalent;
    int worst = 0;
    strain.maxCoeff(&worst);
    const TriMesh& mesh = document.session.part->mesh;
    for (const int f : {0, mesh.triangles() / 2, worst})
        flat->face.necking[f] = 1;
    flat->necking_triangles = int(flat->face.necking.sum());
    beyond.session.blank = flat;
    const auto doubts = find_doubts(beyond);
    const auto found = std::ranges::find(doubts, std::optional(Field::necking), &Doubt::field);
    ASSERT_NE(found, doubts.end());
    EXPECT_THAT(found->text, HasSubstr("strained beyond"));
    EXPECT_EQ(found->face, worst);
    const auto listed = worst_faces(mesh, face_values(beyond.session, Field::necking), Field::necking, 6);
    ASSERT_FALSE(listed.empty());
    EXPECT_EQ(listed.front(), worst) << "as Worst spots lists them";
}

TEST_F(Lights, ABlankThatHasNotConvergedSaysWhyAndWhatNext)
{
    open();
    confirm_sheet();
    run(Stage::solve);
    Document poor = document;
    auto flat = std::make_shared<FlattenResult>(*document.session.blank);
    flat->report.converged = false;
    flat->report.system = SolvedSystem::energy;
    flat->report.reason = "the residual does not go down";
    poor.session.blank = flat;
    const auto doubts = find_doubts(poor);
    const auto found =
        std::find_if(doubts.begin(), doubts.end(), [](const Doubt& doubt) { return doubt.step == ChainStep::unfold; });
    ASSERT_NE(found, doubts.end());
    EXPECT_EQ(found->text, "The residual does not go down.");
    EXPECT_THAT(found->next, HasSubstr("another stamping direction"));
}

TEST_F(Lights, APartHardlyLargerThanItsSheetIsThickIsDoubtedWhateverWasSaidOfItsUnit)
{
    const TriMesh sheet = shapes::rectangle(0.6, 0.45, 8, 6);
    shapes::write_mesh(folder / "metres.obj", sheet); // in metres, read as if it were mm
    model.apply(OpenPart{folder / "metres.obj", "mm"});
    wait();
    ASSERT_TRUE(document.session.part);
    ASSERT_EQ(of(ChainStep::part).size(), 1u) << all();
    const Doubt doubt = of(ChainStep::part)[0];
    EXPECT_THAT(doubt.text, HasSubstr("the sheet 1 mm thick"));
    EXPECT_EQ(doubt.button, "Read it in m");
    press(doubt);
    EXPECT_TRUE(of(ChainStep::part).empty()) << all();
    EXPECT_NEAR(bounding_diagonal(document.session.part->mesh), 750 /* of 600 x 450 mm */, 1e-3);
    model.apply(SetThickness{200}); // of a part 750 mm across
    ASSERT_EQ(of(ChainStep::part).size(), 1u) << all();
    EXPECT_THAT(of(ChainStep::part)[0].next, HasSubstr("thickness"));
}

TEST_F(Lights, CornersThatKeepABentPartFromUnrollingAreCutByAClick)
{
    shapes::write_mesh(folder / "tray.obj", shapes::lipped_box());
    model.apply(OpenPart{folder / "tray.obj", "mm"});
    wait();
    const auto corners = [&] { return std::ranges::count(of(ChainStep::part), Remedy::cut_corners, &Doubt::remedy); };
    EXPECT_EQ(corners(), 1) << all(); // before a minute of unfolding
    run(Stage::solve);
    ASSERT_TRUE(document.session.blank) << all();
    const auto strain = [&] { return document.session.blank->face.strain_equivalent.maxCoeff(); };
    EXPECT_GT(strain(), 0.1);
    ASSERT_EQ(corners(), 1) << all();
    const auto doubts = of(ChainStep::part);
    const Doubt& doubt = *std::ranges::find(doubts, Remedy::cut_corners, &Doubt::remedy);
    EXPECT_THAT(doubt.text, HasSubstr("The sheet is only bent"));
    press(doubt);
    run(Stage::solve);
    EXPECT_LT(strain(), 1e-6);
    EXPECT_EQ(corners(), 0) << all();
}

} // namespace
} // namespace spia::viewer
