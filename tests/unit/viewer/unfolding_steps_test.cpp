// Unfolding step by step: what is proposed, and what a run of it gives.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/unit/viewer/steps_fixture.h"

namespace spia::viewer {
namespace {

using StepStatus::done;
using testing::HasSubstr;

} // namespace

TEST_F(UnfoldingSteps, AProposedListUnfoldsABentSheetToItsDevelopment)
{
    open_channel();
    propose();
    ASSERT_FALSE(document.steps.empty()) << last(Severity::error);
    EXPECT_THAT(last(Severity::done), HasSubstr("3 regions and 2 bends"));
    EXPECT_EQ(state.history.undo_name(), "Propose steps");
    EXPECT_EQ(state.view.step, 0);
    EXPECT_EQ(steps_done(document), 0u);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    const Eigen::Matrix2Xd& flat = document.unfolding->run.blank->position;
    const Eigen::Vector2d size = flat.rowwise().maxCoeff() - flat.rowwise().minCoeff();
    const Eigen::Vector2d wanted = channel.flat.rowwise().maxCoeff() - channel.flat.rowwise().minCoeff();
    EXPECT_NEAR(size[0], wanted.maxCoeff(), 1e-4);
    EXPECT_NEAR(size[1], 80, 1e-4);
    EXPECT_THAT(last(Severity::done), HasSubstr(fmt::format("a blank of {:.6g} x {:.6g} mm", size[0], size[1])));
    EXPECT_EQ(step_position(state), double(document.steps.size())) << "its end is shown";
    run();
    EXPECT_THAT(last(Severity::hint), HasSubstr("up to date"));
    model.apply(Undo{});
    EXPECT_EQ(document.unfolding, nullptr);
    model.apply(Undo{});
    EXPECT_TRUE(document.steps.empty());
    model.apply(Redo{});
    model.apply(Redo{});
    EXPECT_TRUE(all_steps_done(document));
}

TEST_F(UnfoldingSteps, TheSizeOfTheirBlankCountsTheBendsByTheKFactor)
{
    open_channel();
    const double thickness = document.session.options.flatten.thickness;
    const auto length = [&](double k) { return 105 + std::numbers::pi * (5 + (k - 0.5) * thickness); };
    model.apply(SetKFactor{"0.4"});
    wait();
    propose();
    run();
    auto blank = size_of_blank(document);
    ASSERT_TRUE(blank) << last(Severity::error);
    const Eigen::Vector2d size = blank->size;
    EXPECT_NEAR(size.maxCoeff(), length(0.4), 1e-4 * length(0.4));
    EXPECT_EQ(of_other_k(document, *blank), "");
    EXPECT_THAT(last(Severity::done), HasSubstr(fmt::format("a blank of {:.6g} x {:.6g} mm", size[0], size[1])));
    model.apply(SetKFactor{"0.3"}); // the size is yet that of the run, and says so
    ASSERT_TRUE(blank = size_of_blank(document));
    EXPECT_EQ(blank->size, size);
    EXPECT_EQ(of_other_k(document, *blank), ", K 0.4");
    model.apply(SetKFactor{"0.4"});
    model.apply(UseBlankOfSteps{false});
    wait();
    const Eigen::Matrix2Xd& used = document.session.blank->blank.position;
    EXPECT_LT((size - (used.rowwise().maxCoeff() - used.rowwise().minCoeff())).norm(), 1e-9);
    model.apply(SetKFactor{"0.3"}); // in use it is laid anew
    wait();
    ASSERT_TRUE(blank = size_of_blank(document));
    EXPECT_NEAR(blank->size.maxCoeff(), length(0.3), 1e-4 * length(0.3));
    EXPECT_EQ(of_other_k(document, *blank), "");
}

TEST_F(UnfoldingSteps, SayWhatIsLeftOutAsLongAsItIsThere)
{
    open_channel();
    propose();
    run();
    EXPECT_EQ(left_out_by_steps(document), "");
    model.apply(SetProcess{.edge_restraint = 0.49, .rolling = {}}); // when all is done
    EXPECT_THAT(left_out_by_steps(document), HasSubstr("as a whole: edge restraint."));
    model.apply(UseBlankOfSteps{false});
    wait();
    EXPECT_THAT(left_out_by_steps(document), HasSubstr("edge restraint"));
    const auto doubted = [&](std::string_view words) {
        return std::ranges::any_of(*state.doubts,
                                   [&](const Doubt& doubt) { return doubt.text.find(words) != std::string::npos; });
    };
    EXPECT_TRUE(doubted("leave out what acts on the part as a whole: edge restraint"));
    model.apply(SetKFactor{"0.4"});
    wait();
    EXPECT_FALSE(doubted("may push instead of pull")) << "of a restraint that is not in the blank";
    EXPECT_EQ(last(Severity::warning).find("may push"), std::string::npos);
    model.apply(Undo{});
    model.apply(
        AddLine{{.kind = LineKind::drawbead,
                 .point = {document.session.part->mesh.position.col(0), document.session.part->mesh.position.col(1)}}});
    EXPECT_THAT(left_out_by_steps(document), HasSubstr("drawbeads, edge restraint."));
    model.apply(Undo{});
    model.apply(SetProcess{});
    EXPECT_EQ(left_out_by_steps(document), "");
    // Set before, it is said there alone.
    open_channel();
    model.apply(SetProcess{.edge_restraint = 0.1, .rolling = {}});
    propose();
    run();
    EXPECT_EQ(last(Severity::hint), "");
    EXPECT_NE(left_out_by_steps(document), "");
}

TEST_F(UnfoldingSteps, TheRegionOfAFaceStaysWhereItIs)
{
    open_channel();
    const TriMesh& part = document.session.part->mesh;
    Eigen::Index outermost; // of the leg of 25
    part.position.row(2).minCoeff(&outermost);
    int keep = -1;
    for (int f = 0; f < part.triangles(); ++f)
        if ((part.triangle.col(f).array() == int(outermost)).any())
            keep = f;
    propose(keep);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    const Eigen::Matrix3Xd& flat = after(document.steps.size() - 1).position;
    EXPECT_EQ(flat(Eigen::all, part.triangle.col(keep)), part.position(Eigen::all, part.triangle.col(keep)));
    const auto before = names();
    const Eigen::VectorXi& label = document.bends->map.label; // regions, then bends
    propose(int(std::max_element(label.begin(), label.end()) - label.begin()));
    EXPECT_THAT(last(Severity::error), HasSubstr("lies on a bend"));
    EXPECT_EQ(names(), before);
}

TEST_F(UnfoldingSteps, AFlatPartIsItsOwnBlank)
{
    open_mesh(shapes::extruded(shapes::Profile({0, 0}, 0).straight(60), 40, 200).mesh);
    propose();
    ASSERT_EQ(document.steps.size(), 1u);
    run();
    ASSERT_TRUE(all_steps_done(document)) << last(Severity::error);
    const Eigen::Matrix2Xd& flat = document.unfolding->run.blank->position;
    const Eigen::Vector2d size = flat.rowwise().maxCoeff() - flat.rowwise().minCoeff();
    EXPECT_NEAR(size[0], 60, 1e-9);
    EXPECT_NEAR(size[1], 40, 1e-9);
}

TEST_F(UnfoldingSteps, FiguresAreThoseOfTheFacesThatAStepMoves)
{
    open_box();
    propose();
    run();
    ASSERT_EQ(status(), std::vector(5, done));
    for (size_t k = 0; k < 5; ++k) {
        double least = 1e300, greatest = -1e300, strain = 0;
        for (const int f : document.steps[k]->pick.freed) {
            least = std::min(least, after(k).face.thinning[f]);
            greatest = std::max(greatest, after(k).face.thinning[f]);
            strain = std::max(strain, after(k).face.strain_equivalent[f]);
        }
        const StepFigures& figures = document.unfolding->figure[k];
        EXPECT_EQ(figures.thinning, (std::array{least, greatest}));
        EXPECT_EQ(figures.strain_equivalent, strain);
    }
}

} // namespace spia::viewer
