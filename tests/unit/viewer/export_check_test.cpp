#include "app/viewer/model/reports/export_check.h"

#include <gmock/gmock.h>

#include "app/viewer/model/document/state.h"
#include "app/viewer/model/reports/lights.h"
#include "engine/nurbs/interpolate.h"

using testing::HasSubstr;
using testing::Not;

namespace spia::viewer {
namespace {

/// @param within  shares of the area, of the surface and of the part
Session with_deviation(double greatest, double within_surface, double within_part, std::optional<double> tolerance = {})
{
    Session session;
    session.part = std::make_shared<PartFile>();
    auto surface = std::make_shared<SurfaceStage>();
    surface->deviation.surface_to_mesh = {.max = greatest, .p95 = 0.02, .within = within_surface};
    surface->deviation.mesh_to_surface = {.max = greatest / 2, .p95 = 0.01, .within = within_part};
    if (tolerance) {
        surface->fit.emplace();
        surface->fit->tolerance = *tolerance;
    }
    session.surface = surface;
    return session;
}

} // namespace

TEST(ExportCheck, IsJudgedByTheWorseOfBothWaysAndTheToleranceOfTheFit)
{
    EXPECT_EQ(fit_verdict(with_deviation(0.08, 1, 1)).fit, Fit::within); // of the usual 0.1 mm
    EXPECT_EQ(fit_verdict(with_deviation(0.08, 0.9, 1, 0.05)).fit, Fit::beyond);
    EXPECT_EQ(fit_verdict(with_deviation(0.51, 0.9, 1, 0.05)).fit, Fit::far_off);
    EXPECT_EQ(fit_verdict(Session{}).fit, Fit::none);
    const FitVerdict verdict = fit_verdict(with_deviation(0.5, 0.9942, 0.978));
    EXPECT_EQ(verdict.greatest, 0.5);
    EXPECT_EQ(verdict.p95, 0.02);
    EXPECT_NEAR(verdict.beyond, 0.022, 1e-12);
    EXPECT_EQ(fit_verdict(with_deviation(0.08, 1, 1)).beyond, 0);
}

TEST(ExportCheck, SharesHaveOnePrecisionAndNeverSayAllOfMostOrNothingOfALittle)
{
    EXPECT_EQ(area_share(0), "0 %");
    EXPECT_EQ(area_share(1), "100 %");
    EXPECT_EQ(area_share(0.0058), "0.58 %");
    EXPECT_EQ(area_share(1e-6), "less than 0.01 %");
    EXPECT_EQ(area_share(1 - 1e-6), "more than 99.99 %");
}

TEST(ExportCheck, TheWordsAreTheMeasureInTheUnitOfTheScreenAndNoAdvice)
{
    const std::string beyond = text(fit_verdict(with_deviation(0.5, 1, 0.8333)));
    for (const char* words : {"0.5 mm", "16.67 %", "0.1 mm"})
        EXPECT_THAT(beyond, HasSubstr(words));
    EXPECT_THAT(beyond, Not(HasSubstr("tolerance"))) << "a fit within one may have been made";
    EXPECT_THAT(text(fit_verdict(with_deviation(0.5, 0.5, 1, 0.02))), HasSubstr("25 times the tolerance"));
    EXPECT_THAT(text(fit_verdict(with_deviation(0.508, 0.5, 1)), LengthUnit::inch), HasSubstr("up to 0.02 in"));
}

TEST(ExportCheck, AnInterpolatingSurfaceIsMeasuredByTheUsualTolerance)
{
    // The step shows the share within the tolerance of DeviationOptions: for a plane 0.2 mm above
    // the part all is beyond.
    TriMesh part;
    part.position.resize(3, 4);
    part.position << 0, 10, 10, 0, 0, 0, 10, 10, 0, 0, 0, 0;
    part.triangle.resize(3, 2);
    part.triangle << 0, 0, 1, 2, 2, 3;
    QuadGrid grid{2, 2, Eigen::Matrix3Xd(3, 9)};
    for (int i = 0; i <= 2; ++i)
        for (int j = 0; j <= 2; ++j)
            grid.position.col(grid.node(i, j)) = Eigen::Vector3d(5. * i, 5. * j, 0.2);
    const NurbsSurface above = interpolate(grid, {.degree_u = 2, .degree_v = 2}).surface;
    EXPECT_EQ(deviation(above, part, {.tolerance = usual_tolerance}).within(), 0);
    EXPECT_EQ(deviation(above, part, {.tolerance = 0.21}).within(), 1);
}

TEST(ExportCheck, IsGreenOnlyWhereNoLightHoldsAnythingAgainstTheResult)
{
    using Kind = ExportVerdict::Kind;
    ViewerState state;
    state.document.session = with_deviation(0.08, 1, 1);
    const FitVerdict fits = fit_verdict(state.document.session);
    EXPECT_EQ(export_verdict(state, fits, true).kind, Kind::good);
    state.doubts = std::make_shared<std::vector<Doubt>>(
        std::vector<Doubt>{{ChainStep::unfold, "It has not converged."}, {ChainStep::surface, "It may have a fold."}});
    const ExportVerdict doubted = export_verdict(state, fits, true);
    EXPECT_EQ(doubted.kind, Kind::warning);
    EXPECT_EQ(doubted.doubts, 2u);
    EXPECT_EQ(doubted.headline, "The surface is within tolerance; 2 things to look at");
    const FitVerdict far = fit_verdict(with_deviation(5, 0, 0));
    EXPECT_EQ(export_verdict(state, far, true).kind, Kind::bad);
    const ExportVerdict flat = export_verdict(state, far, false);
    EXPECT_EQ(flat.kind, Kind::warning) << "the blank alone is written";
    EXPECT_THAT(flat.text, HasSubstr("None of the files chosen holds it"));
}

} // namespace spia::viewer
