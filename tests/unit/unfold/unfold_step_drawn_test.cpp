#include "engine/core/error.h"
#include "tests/support/developable.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"
#include "tests/support/square_cup.h"
#include "tests/unit/unfold/step_fixture.h"

namespace spia {

using namespace steps;

TEST(UnfoldStep, AllFacesFreedOntoAPlaneAreTheBlankOfFlatten)
{
    const TriMesh dome =
        shapes::transformed(shapes::dome({.triangles = 2000}).mesh, shapes::random_rotation(3), {40, 5, -9});
    std::vector<int> all(size_t(dome.triangles()));
    for (size_t f = 0; f < all.size(); ++f)
        all[f] = int(f);
    const Eigen::Matrix3d axes = shapes::random_rotation(3); // its axis is the dome's
    for (const double side : {1., -1.}) {                    // either side of the plane up
        PlaneFace plane{{1, 2, 3}, axes.leftCols<2>()};
        plane.axes.col(1) *= side;
        FlattenOptions options = steel();
        options.direction = plane.axes.col(0).cross(plane.axes.col(1));
        const FlattenResult flat = flatten(dome, options);
        const UnfoldStepResult step = unfold_step(dome, dome.position, {{}, all, plane}, steel());
        EXPECT_TRUE(step.converged());
        EXPECT_EQ(step.face.thickness, flat.face.thickness); // bit by bit
        EXPECT_EQ(step.face.strain_major, flat.face.strain_major);
        for (int v = 0; v < dome.vertices(); v += 7) {
            EXPECT_NEAR(axes.col(2).dot(step.position.col(v)), axes.col(2).dot(Eigen::Vector3d(1, 2, 3)), 1e-10);
            EXPECT_NEAR((step.position.col(v) - step.position.col(0)).norm(),
                        (flat.blank.position.col(v) - flat.blank.position.col(0)).norm(), 1e-10);
        }
    }
}

TEST(UnfoldStep, ACupsWallIsLaidAroundItsBottomByTheClosedForm)
{
    const double r = 1.77, m = r / (1 + r);
    const shapes::SharpCup shape{.radius = 40, .height = 30, .triangles = 6000};
    const shapes::AxisymmetricPart cup = shapes::sharp_cup(shape);
    const std::vector<int> bottom = faces_where(cup.arc_length.transpose(), cup.mesh,
                                                [&](const Eigen::VectorXd& s) { return s[0] < shape.radius; });
    const std::vector<int> wall = faces_where(cup.arc_length.transpose(), cup.mesh,
                                              [&](const Eigen::VectorXd& s) { return s[0] > shape.radius; });
    const UnfoldStepResult result = unfold_step(cup.mesh, cup.mesh.position, {bottom, wall}, steel(r));
    EXPECT_TRUE(result.converged());
    EXPECT_LT(result.position.row(2).cwiseAbs().maxCoeff(), 1e-9);
    for (int v = 0; v < cup.mesh.vertices(); ++v) {
        const double beyond = std::max(0., cup.arc_length[v] - shape.radius);
        const double R = cup.arc_length[v] <= shape.radius
                             ? cup.arc_length[v]
                             : shape.radius * std::pow(1 + (1 + m) * beyond / shape.radius, 1 / (1 + m));
        EXPECT_NEAR(result.position.col(v).head<2>().norm(), R, 1e-3 * R) << beyond;
    }
    // Its fields are those of uniaxial compression around.
    for (size_t k = 0; k < wall.size(); ++k) {
        const double around = result.face.strain_minor[Eigen::Index(k)];
        EXPECT_NEAR(result.face.strain_major[Eigen::Index(k)], -m * around, 0.03); // rows of 1.6 mm
    }
}

TEST(UnfoldStep, TheCollarOfAHoleIsLaidIntoTheHoleByTheClosedForm)
{
    // No force acts along the upright wall, so its rings are stretched around only: the cup's
    // formula with the height negative.
    const double r = 1.77, m = r / (1 + r), radius = 40, height = 10;
    Eigen::Matrix2Xd meridian(2, 3);
    meridian << radius, radius, 70, /**/ -height, 0, 0;
    const shapes::AxisymmetricPart part = shapes::axisymmetric(meridian, 6000);
    const auto is_plate = [&](const Eigen::VectorXd& s) { return s[0] > height; };
    const std::vector<int> plate = faces_where(part.arc_length.transpose(), part.mesh, is_plate),
                           collar = faces_where(part.arc_length.transpose(), part.mesh,
                                                [&](const Eigen::VectorXd&s) { return !is_plate(s); });
    const UnfoldStepResult result = unfold_step(part.mesh, part.mesh.position, {plate, collar}, steel(r));
    EXPECT_TRUE(result.converged());
    for (int v = 0; v < part.mesh.vertices(); ++v)
        if (const double down = height - part.arc_length[v]; down >= 0) {
            const double R = radius * std::pow(1 - (1 + m) * down / radius, 1 / (1 + m));
            EXPECT_NEAR(result.position.col(v).head<2>().norm(), R, 3e-3 * R) << down;
        }
}

TEST(UnfoldStep, ADomeInsideAPlateIsLaidFlatBetweenItsFixedEdge)
{
    // Held all around: the sheet has no choice but to be stretched into it.
    const shapes::AxisymmetricPart dome =
        shapes::dome({.radius = 80, .die_radius = 20, .wall_angle_deg = 25, .flange_width = 30, .triangles = 4000});
    const double flat = dome.arc_length.maxCoeff() - 30;
    const auto on_flange = [&](const Eigen::VectorXd& s) { return s[0] > flat; };
    const std::vector<int> flange = faces_where(dome.arc_length.transpose(), dome.mesh, on_flange),
                           inside = faces_where(dome.arc_length.transpose(), dome.mesh,
                                                [&](const Eigen::VectorXd&s) { return !on_flange(s); });
    const UnfoldStepResult result = unfold_step(dome.mesh, dome.mesh.position, {flange, inside}, steel());
    EXPECT_TRUE(result.converged());
    EXPECT_LT(result.position.row(2).cwiseAbs().maxCoeff(), 1e-9);
    double formed = 0, laid = 0;
    for (const int f : inside)
        for (const bool after : {false, true}) {
            const Eigen::Matrix3d x =
                (after ? result.position : dome.mesh.position)(Eigen::all, dome.mesh.triangle.col(f));
            (after ? laid : formed) += (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() / 2;
        }
    const double h0 = steel().thickness;
    double volume = 0;
    for (size_t k = 0; k < inside.size(); ++k) {
        const Eigen::Matrix3d x = dome.mesh.position(Eigen::all, dome.mesh.triangle.col(inside[k]));
        volume += result.face.thickness[Eigen::Index(k)] * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() / 2;
    }
    EXPECT_LT(laid, 0.97 * formed);
    EXPECT_NEAR(volume, h0 * laid, 1e-9 * volume);
    EXPECT_LT(result.face.thickness.maxCoeff(), h0);
}

TEST(UnfoldStep, ASquareCupIsLaidAroundItsBottomOrIntoItsFlange)
{
    const TriMesh cup = shapes::square_cup({.depth = 20, .triangles = 4000});
    for (const double level : {cup.position.row(2).minCoeff(), cup.position.row(2).maxCoeff()}) {
        UnfoldPick pick;
        for (int f = 0; f < cup.triangles(); ++f)
            ((cup.position.row(2)(cup.triangle.col(f)).array() - level).abs().maxCoeff() < 1e-9 ? pick.fixed
                                                                                                : pick.freed)
                .push_back(f);
        const UnfoldStepResult result = unfold_step(cup, cup.position, pick, steel());
        EXPECT_TRUE(result.converged()) << result.piece[0].report.reason;
        EXPECT_LT((result.position.row(2).array() - level).abs().maxCoeff(), 1e-9);
        double volume = 0, laid = 0;
        for (size_t k = 0; k < pick.freed.size(); ++k)
            for (const bool after : {false, true}) {
                const Eigen::Matrix3d c =
                    (after ? result.position : cup.position)(Eigen::all, cup.triangle.col(pick.freed[k]));
                const double area = (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0)).norm() / 2;
                (after ? laid : volume) += area * (after ? steel().thickness : result.face.thickness[Eigen::Index(k)]);
            }
        EXPECT_NEAR(volume, laid, 1e-9 * laid);
    }
}

} // namespace spia
