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

TEST(UnfoldStep, AFlangeOnACylinderLandsOnTheCylindersOwnExtension)
{
    // A strip over most of a cylinder, then a bend towards the axis; its continuation is known: the
    // arc goes on.
    const double radius = 40, length = 60;
    const int columns = 60, rows = 10;
    const double step = 0.05, chord = 2 * radius * std::sin(step / 2); // radians, mm
    // wherever the development would have been cut
    for (const double start : {0., 2.0, 3.1})
        for (const bool inside : {false, true}) {
            const auto on_arc = [&](double k) {
                return Eigen::Vector2d(radius * std::cos(start + k * step), radius * std::sin(start + k * step));
            };
            const int bend = 40; // columns from here on leave the cylinder along the tangent turned
                                 // by 70 degrees
            TriMesh part = shapes::grid_surface({columns, rows}, [&](double u, double v) {
                const double k = std::round(u * columns);
                Eigen::Vector2d at = on_arc(std::min(k, double(bend)));
                if (k > bend) {
                    const double heading = start + bend * step + pi / 2 + 70 * pi / 180;
                    at += (k - bend) * chord * Eigen::Vector2d(std::cos(heading), std::sin(heading));
                }
                return Eigen::Vector3d(at[0], at[1], length * v);
            });
            if (inside)
                part.triangle.row(1).swap(part.triangle.row(2));
            std::vector<int> fixed, freed;
            for (int f = 0; f < part.triangles(); ++f)
                (f / 2 % columns < bend ? fixed : freed).push_back(f);
            const UnfoldStepResult result = unfold_step(part, part.position, {fixed, freed}, steel());
            ASSERT_EQ(name(result.target.face), "cylinder");
            EXPECT_EQ(std::get<CylinderFace>(result.target.face).bulges, !inside);
            EXPECT_LT(largest_strain(result.face), 1e-6);
            EXPECT_LT(result.target.distance_mm, 1e-6);
            EXPECT_LT(result.target.angle, 1e-3); // a chord against its arc is no crease
            // Flat lengths along the flange become arcs: a chord is shorter by step^2 / 24.
            for (int v = 0; v < part.vertices(); ++v) {
                const int k = v % (columns + 1);
                const double arc = k <= bend ? k * step : bend * step + (k - bend) * chord / radius;
                const Eigen::Vector3d expected(radius * std::cos(start + arc), radius * std::sin(start + arc),
                                               part.position(2, v));
                EXPECT_LT((result.position.col(v) - expected).norm(), 1e-4) << k;
            }
        }
}

TEST(UnfoldStep, AStripOnAConeGoesOnAroundItAndNotOverItsApex)
{
    // A sector of a cone, of which a part is bent off along a generator: a flat strip there.
    const shapes::ConeSector shape{.near = 60, .far = 140, .half_angle_deg = 30, .sector_deg = 120, .triangles = 3000};
    const shapes::DevelopablePart cone = shapes::cone_sector(shape);
    TriMesh part = cone.mesh;
    // Its faces beyond the 80th degree are turned about that generator.
    const auto azimuth = [&](const Eigen::Vector3d& x) { return std::atan2(x[1], x[0]) * 180 / pi; };
    double hinge = 0;
    for (int v = 0; v < part.vertices(); ++v)
        if (const double a = azimuth(cone.mesh.position.col(v)); a < 80)
            hinge = std::max(hinge, a);
    const double at = hinge * pi / 180, half = pi / 6;
    const Eigen::Vector3d generator(std::sin(half) * std::cos(at), std::sin(half) * std::sin(at), -std::cos(half));
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, generator).toRotationMatrix();
    std::vector<int> fixed, freed;
    for (int f = 0; f < part.triangles(); ++f)
        (azimuth(cone.mesh.position(Eigen::all, part.triangle.col(f)).rowwise().mean()) < hinge ? fixed : freed)
            .push_back(f);
    for (int v = 0; v < part.vertices(); ++v)
        if (azimuth(cone.mesh.position.col(v)) > hinge + 1e-6)
            part.position.col(v) = turn * part.position.col(v);
    for (const Eigen::Matrix3d& moved : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), shapes::random_rotation(4)}) {
        const TriMesh there = shapes::transformed(part, moved, {10, 20, 30});
        const UnfoldStepResult result = unfold_step(there, there.position, {fixed, freed}, steel());
        ASSERT_EQ(name(result.target.face), "cone");
        EXPECT_TRUE(result.converged());
        // A chord over its arc, of which there are some 40: second order.
        EXPECT_LT(furthest(result.position, shapes::transformed(cone.mesh, moved, {10, 20, 30}).position), 0.05);
        EXPECT_LT(largest_strain(result.face), 1e-3);
    }
    // A strip that hangs from the small end is too long for what is left of the cone.
    const double chord = 60 * std::sin(half) * 0.2;
    TriMesh strip = shapes::grid_surface({10, 30}, [&](double u, double v) {
        const double a = 0.2 * u, s = 130 - 200 * v; // on the cone up to 70, then straight down
                                                     // inside
        const double along = std::max(s, 70.);
        Eigen::Vector3d x =
            along * Eigen::Vector3d(std::sin(half) * std::cos(a), std::sin(half) * std::sin(a), -std::cos(half));
        if (s < 70)
            x[2] -= 70 - s;
        return x;
    });
    UnfoldPick pick;
    for (int f = 0; f < strip.triangles(); ++f)
        (f / 20 < 9 ? pick.fixed : pick.freed).push_back(f);
    ASSERT_GT(chord, 0);
    try {
        unfold_step(strip, strip.position, pick, steel());
        FAIL() << "there is no cone beyond its apex";
    } catch (const SolveError& error) {
        EXPECT_NE(std::string(error.what()).find("across the apex"), std::string::npos) << error.what();
    }
}

} // namespace spia
