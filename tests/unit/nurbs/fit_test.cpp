#include "engine/nurbs/fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <numbers>
#include <oneapi/tbb/global_control.h>

#include "engine/core/error.h"
#include "engine/mesh/closest_point.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/interpolate.h"
#include "tests/support/known_surfaces.h"
#include "tests/support/meshed_sheet.h"

namespace spia {

namespace {

using Eigen::Vector3d;
using shapes::distance_from_sheet;
using shapes::independent_deviation;
using shapes::KnownSheet;
using shapes::MeshedSheet;

FitOptions within(double tolerance)
{
    FitOptions options;
    options.tolerance = tolerance;
    return options;
}

/// A roof of two planes at a right angle, its ridge askew of the grid lines.
KnownSheet roof(double askew)
{
    KnownSheet sheet;
    sheet.name = "roof";
    sheet.place = [askew](double s, double t) {
        const double x = 100 * (s - 0.5) + askew * (t - 0.5) * 100;
        return Vector3d(x, 100 * t, -std::abs(x));
    };
    sheet.distance = [](const Vector3d& p) { return std::abs(p.z() + std::abs(p.x())) / std::sqrt(2.); };
    return sheet;
}

/// Two plateaus, 10 mm apart, and a wall of 4 mm width between them.
KnownSheet step()
{
    KnownSheet sheet;
    sheet.name = "step";
    sheet.place = [](double s, double t) {
        const double x = 100 * s;
        return Vector3d(x, 80 * t, 10 * std::clamp((x - 48) / 4, 0., 1.));
    };
    return sheet;
}

struct HeightRange {
    double least = 1e9, most = -1e9;
};

HeightRange heights(const NurbsSurface& surface)
{
    HeightRange range;
    for (int i = 0; i <= 5000; ++i)
        for (const double v : {0., 0.37, 1.}) {
            const double z = evaluate(surface, i / 5000., v).position.z();
            range.least = std::min(range.least, z);
            range.most = std::max(range.most, z);
        }
    return range;
}

} // namespace

TEST(Fit, KnotsAreDyadicAndOnlyWhereTheyAreNeeded)
{
    // The bump is narrow: most of the knots belong around it; the cylinder is straight along v.
    const std::vector<KnownSheet> sheets = shapes::known_sheets();
    const MeshedSheet cylinder(sheets[1], 60), bump(sheets[4], 120);
    const FitResult round = fit(cylinder.source, cylinder.mesh, within(1e-2));
    EXPECT_EQ(round.report.knots_v, 0);
    EXPECT_GT(round.report.knots_u, 0);
    const FitResult narrow = fit(bump.source, bump.mesh, within(5e-2));
    for (const auto* knots : {&narrow.surface.knots_u, &narrow.surface.knots_v})
        for (const double knot : *knots) {
            EXPECT_EQ(std::ldexp(knot, 20), std::floor(std::ldexp(knot, 20)));
            EXPECT_EQ(1 - (1 - knot), knot);
        }
    int near = 0, far = 0;
    for (const double border : span_borders(narrow.surface.knots_u, 3))
        (std::abs(border - 0.5) < 0.25 ? near : far) += 1;
    EXPECT_GT(near, far) << "even spans have as many outside";
    const std::vector<AttemptReport>& tried = narrow.report.attempts;
    ASSERT_EQ(tried.size(), 3u);
    EXPECT_EQ(tried[0].name, "spans halved");
    EXPECT_EQ(tried[2].name, "knots equidistributed");
    const auto winner = std::find_if(tried.begin(), tried.end(), [](const AttemptReport& each) { return each.won; });
    ASSERT_NE(winner, tried.end());
    const std::string size = fmt::format("{} x {} control points", narrow.surface.count_u, narrow.surface.count_v);
    EXPECT_NE(winner->reason.find("within the tolerance with " + size), std::string::npos) << winner->reason;
}

TEST(Fit, KnotsComeInTheDirectionThatLacksThem)
{
    // Ridges that fade towards a flat border: the border curves tell nothing of them.
    KnownSheet ridges;
    ridges.place = [](double s, double t) {
        const double pi = std::numbers::pi;
        return Vector3d(100 * s, 100 * t, 4 * std::sin(8 * pi * s) * std::pow(std::sin(pi * t), 2));
    };
    const MeshedSheet meshed(ridges, 120);
    const FitResult result = fit(meshed.source, meshed.mesh, within(0.1));
    ASSERT_TRUE(result.report.reached);
    EXPECT_GT(result.report.knots_u, 3 * result.report.knots_v);
    EXPECT_GE(result.report.knots_u, 12) << "eight half waves";
}

TEST(Fit, ClampedEndsHaveTheTangentOfTheData)
{
    // A cubic is given back whatever the ends; so is its derivative.
    const auto cubic = [](double s, double t) {
        return Vector3d(100 * s + 20 * s * s * t, 80 * t - 15 * t * t * t, 30 * s * s * s - 20 * s * t * t);
    };
    const QuadGrid grid = surfaces::grid(24, 24, cubic);
    FitOptions options = within(1e-3);
    options.ends = CurveEnds::clamped;
    TriMesh mesh;
    mesh.position = grid.position;
    mesh.triangle = shapes::mesh_of({"", cubic, {}, 0}, 24).triangle;
    options.tolerance = 1; // the mesh is coarse: the first surface will do
    const FitResult result = fit(source_of(grid), mesh, options);
    ASSERT_TRUE(result.report.reached);
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j)
            EXPECT_LT((evaluate(result.surface, i / 20., j / 20.).position - cubic(i / 20., j / 20.)).norm(), 1e-10);
}

TEST(Fit, StepAndRidgeDoNotRing)
{
    const MeshedSheet stepped(step(), 100);
    const double tolerance = 0.05;
    const FitResult fine = fit(stepped.source, stepped.mesh, within(tolerance));
    ASSERT_TRUE(fine.report.reached);
    EXPECT_EQ(fine.report.knots_v, 0) << "the step runs along v";
    const HeightRange range = heights(fine.surface);
    EXPECT_GE(range.least, -1.02 * tolerance); // between the samples
    EXPECT_LE(range.most, 10 + 1.02 * tolerance);

    // Too few control points: the step stays blurred, yet it overshoots by no more than the least
    // squares spline of a jump (12 %).
    FitOptions poor = within(tolerance);
    poor.max_control_points = 64;
    const FitResult coarse = fit(stepped.source, stepped.mesh, poor);
    EXPECT_FALSE(coarse.report.reached);
    EXPECT_LE(coarse.surface.control.cols(), 64);
    const HeightRange blurred = heights(coarse.surface);
    EXPECT_GE(blurred.least, -1.25);
    EXPECT_LE(blurred.most, 11.25);
}

TEST(Fit, SharpEdgeThatKeepsItAwayIsNamed)
{
    const MeshedSheet meshed(roof(0.37), 100);
    FitOptions options = within(0.01);
    options.max_control_points = 900;
    options.file_number.resize(size_t(meshed.mesh.vertices()));
    for (int v = 0; v < meshed.mesh.vertices(); ++v)
        options.file_number[size_t(v)] = 7000 + v;
    const FitResult result = fit(meshed.source, meshed.mesh, options);
    EXPECT_FALSE(result.report.reached);
    const FitShortfall& shortfall = result.report.shortfall;
    ASSERT_EQ(shortfall.reason, FitShortfall::Reason::sharp_edge) << shortfall.text;
    // Triangles cut across the ridge: the named edge is near it, and turns by about a right angle
    // at most.
    for (const int vertex : {shortfall.a, shortfall.b}) {
        ASSERT_GE(vertex, 0);
        EXPECT_LT(std::abs(meshed.mesh.position.col(vertex).x()), 3);
        EXPECT_NE(shortfall.text.find(std::to_string(7000 + vertex)), std::string::npos) << shortfall.text;
    }
    EXPECT_GT(shortfall.angle, 0.3);
    EXPECT_LE(shortfall.angle, 1.1 * std::numbers::pi / 2);
    EXPECT_LT(result.deviation.within(), 1);
    EXPECT_GT(result.deviation.within(), 0.5) << "the two planes are met";
    // Where all vertices are of one of the file it is no edge of the part.
    options.file_number.assign(size_t(meshed.mesh.vertices()), 7000);
    EXPECT_NE(fit(meshed.source, meshed.mesh, options).report.shortfall.reason, FitShortfall::Reason::sharp_edge);
}

TEST(Fit, CornerOfTheOutlineIsNamed)
{
    // A flat sheet with a notch in the side v = 0: nothing is sharp but the outline.
    KnownSheet notched;
    notched.place = [](double s, double t) {
        const double bottom = 20 * std::max(0., 1 - std::abs(s - 0.4) / 0.1);
        return Vector3d(100 * s, bottom + (100 - bottom) * t, 0);
    };
    const MeshedSheet meshed(notched, 100);
    FitOptions options = within(1e-4);
    options.max_control_points = 400;
    const FitResult result = fit(meshed.source, meshed.mesh, options);
    ASSERT_FALSE(result.report.reached);
    ASSERT_EQ(result.report.shortfall.reason, FitShortfall::Reason::outline_corner) << result.report.shortfall.text;
    const Vector3d corner = meshed.mesh.position.col(result.report.shortfall.a);
    EXPECT_TRUE(std::abs(corner.x() - 30) < 1e-9 || std::abs(corner.x() - 40) < 1e-9 ||
                std::abs(corner.x() - 50) < 1e-9)
        << corner.transpose();
    EXPECT_GT(result.report.shortfall.angle, 1);
}

TEST(Fit, DataOfAFixedGridRunOutBeforeTheSystemIsSingular)
{
    const KnownSheet bump = shapes::known_sheets()[4];
    const MeshedSheet meshed(bump, 100);
    const FitResult result = fit(source_of(surfaces::grid(20, 20, bump.place)), meshed.mesh, within(1e-3));
    EXPECT_FALSE(result.report.reached);
    EXPECT_EQ(result.report.shortfall.reason, FitShortfall::Reason::data) << result.report.shortfall.text;
    EXPECT_NE(result.report.shortfall.text.find("finer grid"), std::string::npos);
    EXPECT_LE(result.surface.count_u, 21);
    // No worse than the surface through all of the nodes.
    const NurbsSurface through =
        interpolate(surfaces::grid(20, 20, bump.place), {.parameters = InterpolateOptions::Parameters::uniform})
            .surface;
    EXPECT_LE(result.deviation.max(), 1.001 * deviation(through, meshed.mesh).max());
    const std::vector<AttemptReport>& tried = result.report.attempts;
    ASSERT_EQ(tried.size(), 2u) << "a surface that is beyond the tolerance is not coarsened";
    EXPECT_EQ(tried[1].name, "nodes interpolated");
    EXPECT_EQ(tried[1].won, result.surface.control == through.control);
    EXPECT_NE(tried[0].won, tried[1].won);
}

TEST(Fit, CorrectedParametersNeedFewerKnotsWhereTheParametersRunUnevenly)
{
    // A gentle dome over a jerky parameterization: the shape is easy, the parameters are not.
    KnownSheet jerky;
    jerky.place = [](double s, double t) {
        const double x = 100 * s + 2 * std::sin(40 * s) * std::sin(std::numbers::pi * t), y = 100 * t;
        return Vector3d(x, y, 10 * std::sin(x / 40) * std::cos(y / 50));
    };
    jerky.distance = [](const Vector3d& p) {
        return std::abs(p.z() - 10 * std::sin(p.x() / 40) * std::cos(p.y() / 50));
    };
    const MeshedSheet meshed(jerky, 120);
    FitOptions options = within(0.02);
    const FitResult blank = fit(meshed.source, meshed.mesh, options);
    options.parameters = FitParameters::corrected;
    const FitResult corrected = fit(meshed.source, meshed.mesh, options);
    ASSERT_TRUE(blank.report.reached);
    ASSERT_TRUE(corrected.report.reached);
    EXPECT_LT(corrected.surface.control.cols(), 0.7 * blank.surface.control.cols());
    const double chord = shapes::chord_error(jerky, meshed.mesh);
    EXPECT_LE(independent_deviation(corrected.surface, jerky), options.tolerance + chord);
}

/// OpenCASCADE's GeomAPI_PointsToBSplineSurface, which chooses its parameters, too, needs 20 and 90
/// within the same distances (tests/bench/README.md).
TEST(Fit, CorrectedParametersNeedNoMoreControlPointsThanOpenCascade)
{
    struct Known {
        size_t sheet;
        double tolerance; // of its size
        int control_points;
    };
    for (const Known& known : {Known{2, 1e-4, 20}, Known{4, 1e-3, 89}}) {
        const KnownSheet sheet = shapes::known_sheets()[known.sheet];
        SCOPED_TRACE(sheet.name);
        const MeshedSheet meshed(sheet, 250);
        FitOptions options = within(known.tolerance * sheet.size);
        options.parameters = FitParameters::corrected;
        const FitResult result = fit(meshed.source, meshed.mesh, options);
        EXPECT_TRUE(result.report.reached);
        EXPECT_LE(result.surface.control.cols(), known.control_points);
        EXPECT_LE(independent_deviation(result.surface, sheet),
                  options.tolerance + shapes::chord_error(sheet, meshed.mesh));
        EXPECT_TRUE(result.deviation.turned.empty());
    }
}

TEST(Fit, SameBitsOnOneThreadAndOnTwo)
{
    const KnownSheet bump = shapes::known_sheets()[4];
    const MeshedSheet meshed(bump, 60);
    std::vector<NurbsSurface> surface;
    for (const size_t threads : {1, 2}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        FitOptions options = within(0.2);
        options.parameters = FitParameters::corrected;
        surface.push_back(fit(meshed.source, meshed.mesh, options).surface);
    }
    EXPECT_EQ(surface[0].control, surface[1].control);
    EXPECT_EQ(surface[0].knots_u, surface[1].knots_u);
}

TEST(Fit, RefusesWhatItCannotDo)
{
    const KnownSheet plane = shapes::known_sheets()[0];
    const MeshedSheet meshed(plane, 10);
    EXPECT_THROW(fit(meshed.source, meshed.mesh, within(0)), InputError);
    FitOptions options;
    options.degree_v = 6;
    EXPECT_THROW(fit(meshed.source, meshed.mesh, options), InputError);
    options = {};
    options.degree_u = 2;
    options.ends = CurveEnds::natural;
    EXPECT_THROW(fit(meshed.source, meshed.mesh, options), InputError);
    FitSource broken = meshed.source;
    broken.at = [](const auto&, const auto&) { return Eigen::Matrix3Xd(Eigen::Matrix3Xd::Zero(3, 4)); };
    EXPECT_THROW(fit(broken, meshed.mesh, {}), InputError);
}

} // namespace spia
