#include "app/viewer/model/picking/measuring.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include "app/viewer/views/views.h"
#include "engine/core/error.h"
#include "tests/support/bent_parts.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {
namespace {

using Eigen::Vector3d;

using std::numbers::pi;

/// A flange on a web: 40 mm flat, a bend of 90 degrees with a radius of 6 mm, 40 mm flat; 60 mm
/// deep along y.
struct Bend {
    static constexpr double radius = 6, flat = 40, arc = pi / 2 * radius, length = 2 * flat + arc;
    static Vector3d place(double u, double v)
    {
        const double s = u * length, y = 60 * v;
        if (s <= flat)
            return {s, y, 0};
        if (s >= flat + arc)
            return {flat + radius, y, radius + s - flat - arc};
        const double turn = (s - flat) / radius;
        return {flat + radius * std::sin(turn), y, radius - radius * std::cos(turn)};
    }
    /// Cells end where the bend begins and ends, so that its vertices are on the cylinder.
    static TriMesh mesh(int per_flat = 8, int per_arc = 6)
    {
        const int columns = 2 * per_flat + per_arc;
        return shapes::grid_surface({columns, 20}, [&](double u, double v) {
            const double c = u * columns;
            const double s = c <= per_flat             ? flat * c / per_flat
                             : c >= per_flat + per_arc ? flat + arc + flat * (c - per_flat - per_arc) / per_flat
                                                       : flat + arc * (c - per_flat) / per_arc;
            return place(s / length, v);
        });
    }
};

/// The face whose middle is nearest to a place.
int face_at(const TriMesh& mesh, const Vector3d& place)
{
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Vector3d middle = mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean();
        if (const double away = (middle - place).norm(); away < least) {
            least = away;
            nearest = f;
        }
    }
    return nearest;
}

/// A vertex as a place on one of its faces.
Probe at_vertex(const TriMesh& mesh, int vertex)
{
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            if (mesh.triangle(k, f) == vertex)
                return {f, Vector3d::Unit(k)};
    throw Error("no face has this vertex");
}

int vertex_at(const TriMesh& mesh, const Vector3d& place)
{
    Eigen::Index nearest;
    (mesh.position.colwise() - place).colwise().squaredNorm().minCoeff(&nearest);
    return int(nearest);
}

std::string refusal(const TriMesh& mesh, const Measurement& measurement)
{
    try {
        measured(mesh, measurement);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(Measuring, ARoundedBendHasItsRadiusWhereverItIsClickedAndHoweverItLies)
{
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(1.1, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    for (const TriMesh& mesh :
         {Bend::mesh(), Bend::mesh(12, 10), shapes::transformed(Bend::mesh(), turned, Vector3d(300, -20, 50)),
          shapes::mirrored(Bend::mesh())}) {
        const TriMesh flat = Bend::mesh();
        const bool fine = mesh.triangles() != flat.triangles();
        const int face = fine ? face_at(mesh, Bend::place(0.5, 0.4)) : face_at(flat, Bend::place(0.5, 0.4));
        const Measured found = measured(mesh, {MeasureKind::rounding, {{face, Vector3d::Constant(1. / 3)}}});
        // Vertices are on the cylinder: only rounding is between them and it.
        EXPECT_NEAR(found.value, Bend::radius, 1e-6);
        ASSERT_TRUE(found.residual.has_value());
        EXPECT_LT(*found.residual, 1e-6);
        Measurement kept{MeasureKind::rounding, {}};
        kept.found = std::make_shared<const Measured>(found);
        EXPECT_EQ(text_of(kept, LengthUnit::mm), "R 6.00 mm");
        EXPECT_EQ(text_of(kept, LengthUnit::inch), "R 0.2362 in");
    }
}

TEST(Measuring, ARadiusTellsHowFarTheSheetIsFromItsCylinder)
{
    const TriMesh exact = shapes::pipe(25, 25, 80, 60, 20);
    const TriMesh rough = shapes::noisy(exact, 0.05);
    const Measured found =
        measured(rough, {MeasureKind::rounding, {{face_at(rough, {25, 0, 40}), Vector3d::Constant(1. / 3)}}});
    EXPECT_NEAR(found.value, 25, 0.05);
    ASSERT_TRUE(found.residual.has_value());
    EXPECT_GT(*found.residual, 0.02); // the greatest of so many random ways is near to the most
    EXPECT_LT(*found.residual, 0.1);
}

/// The radius that a click on the face nearest to a place finds, and all that is said of it.
Measured radius_at(const TriMesh& mesh, const Vector3d& place)
{
    return measured(mesh, {MeasureKind::rounding, {{face_at(mesh, place), Vector3d::Constant(1. / 3)}}});
}

std::string said(const Measured& found, const std::string& name)
{
    for (const Measured::Figure& figure : found.more)
        if (figure.name == name)
            return text_of(figure, LengthUnit::mm);
    return "";
}

TEST(Measuring, AFreeformBendHasTheRadiusOfItsCurvatureThere)
{
    // Of a cone the radius across is that of the normal section: r / cos(half angle) (Meusnier).
    const TriMesh cone = shapes::pipe(40, 20, 50, 96, 40);
    const double slope = std::atan2(20., 50.);
    for (const double up : {15., 25., 35.}) {
        const double r = 40 - 0.4 * up;
        const Measured found = radius_at(cone, {r, 0, up});
        EXPECT_NEAR(found.value, r / std::cos(slope), 0.02 * r) << up;
        EXPECT_EQ(said(found, "Radius along the bend"), "straight");
        EXPECT_NE(said(found, "Measured").find("cone"), std::string::npos);
    }
    // A ball has its own wherever it is clicked, in every direction.
    const TriMesh ball = shapes::closed_sphere(30, 6000);
    for (const Vector3d& place : {Vector3d(30, 0, 0), Vector3d(0, 18, 24), Vector3d(10, -20, -20)}) {
        const Measured found = radius_at(ball, place);
        EXPECT_NEAR(found.value, 30, 0.6);
        EXPECT_NE(said(found, "Radius along the bend"), "straight");
        ASSERT_TRUE(found.residual);
        EXPECT_LT(*found.residual, 0.1);
    }
    // A parabolic trough z = x^2 / (2 p): 1 / R = 1 / (p (1 + (x / p)^2)^1.5).
    constexpr double p = 20;
    const TriMesh trough = shapes::grid_surface({120, 60}, [](double u, double v) {
        const double x = 60 * u - 30;
        return Vector3d(x, 40 * v, x * x / (2 * p));
    });
    for (const double x : {0.25, 10.25, 20.25}) {
        const double wanted = p * std::pow(1 + x * x / (p * p), 1.5);
        EXPECT_NEAR(radius_at(trough, {x, 20, x * x / (2 * p)}).value, wanted, 0.02 * wanted) << x;
    }
}

TEST(Measuring, WhatIsFlatOrTooCoarseIsRefusedInWords)
{
    const TriMesh bend = Bend::mesh();
    const auto rounding = [](const TriMesh& mesh, const Vector3d& place) {
        return Measurement{MeasureKind::rounding, {{face_at(mesh, place), Vector3d::Constant(1. / 3)}}};
    };
    EXPECT_NE(refusal(bend, rounding(bend, {10, 30, 0})).find("flat"), std::string::npos);
    // no better than its noise
    const TriMesh rough = shapes::noisy(shapes::rectangle(100, 80, 20, 16), 0.2);
    EXPECT_NE(refusal(rough, rounding(rough, {50, 40, 0})).find("flat"), std::string::npos);
}

TEST(Measuring, TheAngleBetweenTwoFacesIsThatOfTheBend)
{
    const TriMesh mesh = Bend::mesh();
    const auto at = [&](const Vector3d& place) { return Probe{face_at(mesh, place), Vector3d::Constant(1. / 3)}; };
    const Probe web = at({10, 30, 0}), flange = at({46, 30, 30}), other = at({20, 10, 0});
    EXPECT_NEAR(measured(mesh, {MeasureKind::faces, {web, flange}}).value, 90, 1e-9);
    EXPECT_NEAR(measured(mesh, {MeasureKind::faces, {web, other}}).value, 0, 1e-9);
    // Facets of the bend turn by the same share of it each: half a step at its ends.
    const Probe first = at(Bend::place((Bend::flat + Bend::arc / 12) / Bend::length, 0.5));
    EXPECT_NEAR(measured(mesh, {MeasureKind::faces, {web, first}}).value, 90. / 12, 1e-9);
    EXPECT_NE(refusal(mesh, {MeasureKind::faces, {web, web}}), "");
}

TEST(Measuring, ThreePlacesHaveTheirAngleAndTheirCircle)
{
    const TriMesh plate = shapes::rectangle(30, 40, 3, 4); // a grid of 10 mm
    const Probe a = at_vertex(plate, vertex_at(plate, plate.position.rowwise().minCoeff()));
    const Vector3d origin = plate.position.rowwise().minCoeff();
    const Probe x = at_vertex(plate, vertex_at(plate, origin + Vector3d(30, 0, 0))),
                y = at_vertex(plate, vertex_at(plate, origin + Vector3d(0, 40, 0))),
                half = at_vertex(plate, vertex_at(plate, origin + Vector3d(10, 0, 0)));
    const Measured right = measured(plate, {MeasureKind::angle, {x, a, y}});
    EXPECT_NEAR(right.value, 90, 1e-12);
    EXPECT_NEAR(measured(plate, {MeasureKind::angle, {a, x, y}}).value, std::atan2(4., 3.) * 180 / pi, 1e-10);
    EXPECT_NEAR(measured(plate, {MeasureKind::distance, {x, y}}).value, 50, 1e-12);
    // Thales: the hypotenuse is the diameter.
    EXPECT_NEAR(measured(plate, {MeasureKind::circle, {x, a, y}}).value, 25, 1e-12);
    EXPECT_NE(refusal(plate, {MeasureKind::circle, {a, half, x}}).find("straight line"), std::string::npos);
    EXPECT_NE(refusal(plate, {MeasureKind::angle, {a, a, y}}), "");
    EXPECT_NE(refusal(plate, {MeasureKind::angle, {a, y}}), "");
    EXPECT_NE(refusal(plate, {MeasureKind::distance, {a, {1000, Vector3d::Unit(0)}}}).find("no face"),
              std::string::npos);
    for (const Measured& each : {right, measured(plate, {MeasureKind::circle, {x, a, y}})})
        for (const Eigen::Matrix3Xd& line : each.line)
            EXPECT_TRUE(line.allFinite());
}

using MeasuringModel = ModelFixture;

TEST_F(MeasuringModel, MeasurementsAreShownTakenBackAndKeptWithTheProject)
{
    open();
    const TriMesh& mesh = document.session.part->mesh;
    const Probe a = at_vertex(mesh, 0), b = at_vertex(mesh, mesh.vertices() - 1);
    model.apply(AddMeasurement{{MeasureKind::distance, {a, b}}});
    model.apply(AddMeasurement{{MeasureKind::angle, {a, b, at_vertex(mesh, mesh.vertices() / 2)}}});
    ASSERT_EQ(document.measurements.size(), 2u);
    const double wanted = (mesh.position.col(0) - mesh.position.col(mesh.vertices() - 1)).norm();
    EXPECT_NEAR(document.measurements[0].found->value, wanted, 1e-12);
    SceneCache cache;
    const Scene scene = viewer::scene(View::part, state, cache);
    EXPECT_TRUE(std::any_of(scene.labels.begin(), scene.labels.end(),
                            [&](const SceneLabel& l) { return l.text == fmt::format("M1  {:.2f} mm", wanted); }));

    model.apply(AddMeasurement{{MeasureKind::faces, {a, a}}}); // refused, in words
    EXPECT_EQ(document.measurements.size(), 2u);
    EXPECT_TRUE(says(Severity::error, "same face"));

    const auto file = std::filesystem::temp_directory_path() / "spia-measuring-test.spia";
    model.apply(SaveProject{file});
    model.apply(RemoveMeasurement{0});
    ASSERT_EQ(document.measurements.size(), 1u);
    EXPECT_EQ(document.measurements[0].kind, MeasureKind::angle);
    model.apply(Undo{});
    EXPECT_EQ(document.measurements.size(), 2u);
    model.apply(ClearMeasurements{});
    EXPECT_TRUE(document.measurements.empty());
    model.apply(OpenProject{file});
    wait();
    ASSERT_EQ(document.measurements.size(), 2u);
    EXPECT_NEAR(document.measurements[0].found->value, wanted, 1e-9);
    std::filesystem::remove(file);

    model.apply(SetUnit{"cm"}); // the same faces, ten times as far apart
    wait();
    ASSERT_EQ(document.measurements.size(), 2u);
    EXPECT_NEAR(document.measurements[0].found->value, 10 * wanted, 1e-8);
}

TEST_F(MeasuringModel, EachViewIsMeasuredInItsOwnPicture)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    ASSERT_TRUE(document.session.surface);
    const TriMesh& part = document.session.part->mesh;
    const Probe a = at_vertex(part, 0), b = at_vertex(part, part.vertices() / 2);
    model.apply(AddMeasurement{{MeasureKind::distance, {a, b}, View::blank}});
    ASSERT_EQ(document.measurements.size(), 1u);
    const auto flat = [&] {
        const auto& plane = document.session.blank->blank.position;
        return (plane.col(0) - plane.col(part.vertices() / 2)).norm();
    };
    EXPECT_NEAR(document.measurements[0].found->value, flat(), 1e-9);

    // Two opposite corners of the quads; faces 0 and the last are the triangles there.
    const QuadGrid& quads = document.session.lifted->lifted;
    const int last = 2 * quads.columns * quads.rows - 2; // its third corner is the last node
    model.apply(
        AddMeasurement{{MeasureKind::distance, {{0, Vector3d::Unit(0)}, {last, Vector3d::Unit(2)}}, View::quads}});
    ASSERT_EQ(document.measurements.size(), 2u);
    EXPECT_NEAR(document.measurements[1].found->value,
                (quads.position.col(0) - quads.position.col(quads.nodes() - 1)).norm(), 1e-9);

    const auto surface = measured_mesh(state, View::surface);
    ASSERT_TRUE(surface);
    model.apply(AddMeasurement{{MeasureKind::distance,
                                {{0, Vector3d::Unit(0)}, {surface->triangles() - 1, Vector3d::Unit(1)}},
                                View::surface}});
    ASSERT_EQ(document.measurements.size(), 3u);
    // The surface has the corners of the quads as its own.
    EXPECT_NEAR(document.measurements[2].found->value, document.measurements[1].found->value, 0.5);
    SceneCache cache;
    for (const auto& [view, called] :
         {std::pair(View::blank, "M1  "), {View::quads, "M2  "}, {View::surface, "M3  "}}) {
        const Scene scene = viewer::scene(view, state, cache);
        EXPECT_TRUE(std::any_of(scene.labels.begin(), scene.labels.end(), [&](const SceneLabel& l) {
            return l.text.starts_with(called);
        })) << called;
    }

    model.apply(SetThickness{2}); // another blank, another quad mesh
    model.apply(RunTo{Stage::fit});
    wait();
    ASSERT_EQ(document.measurements.size(), 1u);
    EXPECT_EQ(document.measurements[0].on, View::blank);
    EXPECT_NEAR(document.measurements[0].found->value, flat(), 1e-9);
}

} // namespace spia::viewer
