#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/exchange/cad/write_iges.h"
#include "engine/exchange/cad/write_step.h"
#include "engine/exchange/read_part.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/evaluate.h"
#include "tests/unit/exchange/sample_faces.h"
#include "tests/unit/exchange/sample_surface.h"
#include "tests/unit/exchange/scratch_folder.h"

namespace spia::trimmed_files_test {
namespace {

using std::numbers::pi;

/// A polygon in (u, v), clockwise.
TrimLoop polygon(int corners, const Eigen::Vector2d& middle, double radius_u, double radius_v)
{
    PlaneCurve curve{1, {0, 0}, Eigen::Matrix2Xd(2, corners + 1)};
    for (int i = 0; i <= corners; ++i) {
        const double angle = -2 * pi * (i % corners) / corners;
        curve.control.col(i) << middle.x() + radius_u * std::cos(angle), middle.y() + radius_v * std::sin(angle);
        if (i > 0)
            curve.knots.push_back(double(i) / corners);
    }
    curve.knots.push_back(1);
    return {curve};
}

/// Half of an ellipse by each of two cubics, clockwise; within 0.03 % of it.
TrimLoop ellipse(const Eigen::Vector2d& middle, double radius_u, double radius_v)
{
    TrimLoop loop;
    const double k = 4. / 3 * (std::sqrt(2.) - 1); // of a quarter of a circle [Goldapp 1991]
    for (const double side : {1., -1.}) {
        PlaneCurve curve{3, {0, 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1}, Eigen::Matrix2Xd(2, 7)};
        curve.control << 1, 1, k, 0, -k, -1, -1, 0, -k, -1, -1, -1, -k, 0;
        curve.control.row(0) *= side * radius_u;
        curve.control.row(1) *= side * radius_v;
        curve.control.colwise() += middle;
        loop.push_back(curve);
    }
    return loop;
}

struct Written {
    double area;
    int loops, faces;
};

/// @param deflection  mm
Written read_back(const std::filesystem::path& file, double deflection = 4e-3)
{
    ReadOptions fine;
    fine.cad.deflection = deflection;
    const PartFile part = read_part(file, fine);
    return {area(part.mesh), part.doctor.boundary_loops.value_or(0), part.cad->faces};
}

} // namespace

TEST(TrimmedFiles, OtherReadersFindTheHoles)
{
    const ScratchFolder folder;
    const std::vector<NurbsSurface> surface = {samples::curved_surface(80, true)};
    write_step(folder / "whole.step", surface);
    const double whole = read_back(folder / "whole.step").area;
    const std::vector<std::vector<TrimLoop>> holes = {
        {polygon(4, {0.3, 0.4}, 0.1, 0.1), ellipse({0.7, 0.6}, 0.2, 0.1)}};
    // |S_u x S_v| is not even over the surface: a fine sum is the reference.
    const auto inside = [](double u, double v) {
        return std::abs(u - 0.3) + std::abs(v - 0.4) < 0.1 || std::hypot((u - 0.7) / 0.2, (v - 0.6) / 0.1) < 1;
    };
    double cut = 0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            if (const double u = (i + 0.5) / n, v = (j + 0.5) / n; inside(u, v)) {
                const SurfacePoint at = evaluate(surface[0], u, v);
                cut += at.S_u.cross(at.S_v).norm() / n / n;
            }
    ASSERT_GT(cut, 0.03 * whole);
    write_step(folder / "cut.step", surface, "part", LengthUnit::inch, holes);
    write_iges(folder / "cut.igs", surface, "part", LengthUnit::inch, holes);
    for (const char* file : {"cut.step", "cut.igs"}) {
        const Written back = read_back(folder / file);
        EXPECT_EQ(back.faces, 1) << file;
        EXPECT_EQ(back.loops, 3) << file;
        EXPECT_NEAR(back.area, whole - cut, 2e-4 * whole) << file;
    }
    for (const int curves_of : {-2, -3}) // the plane of parameters, and space
        EXPECT_NEAR(area_by_curves(folder / "cut.igs", curves_of), whole - cut, 2e-4 * whole) << curves_of;
}

TEST(TrimmedFiles, BordersOfManyCornersOnFoldedSurfacesAreWritten)
{
    // In space such a border has many more pieces than corners.
    const ScratchFolder folder;
    std::vector<NurbsSurface> surface = {samples::curved_surface(80, false, 60, 20)};
    for (int i = 0; i < surface[0].count_u; ++i)
        for (int j = 0; j < surface[0].count_v; ++j)
            surface[0].control(2, surface[0].index(i, j)) += i % 4 < 2 ? 3 : -3;
    const std::vector<std::vector<TrimLoop>> holes = {{polygon(120, {0.5, 0.5}, 0.4, 0.4)}};
    write_step(folder / "cut.step", surface, "part", LengthUnit::mm, holes);
    write_iges(folder / "cut.igs", surface, "part", LengthUnit::mm, holes);
    constexpr double coarse = 0.3;
    const Written step = read_back(folder / "cut.step", coarse), iges = read_back(folder / "cut.igs", coarse);
    EXPECT_EQ(step.loops, 2);
    EXPECT_EQ(iges.loops, 2);
    EXPECT_NEAR(step.area, iges.area, 5e-3 * step.area);
}

TEST(TrimmedFiles, WithoutHolesAreAsBefore)
{
    const ScratchFolder folder;
    const std::vector<NurbsSurface> surface = {samples::curved_surface(80, true)};
    const std::vector<std::vector<TrimLoop>> none = {{}};
    write_iges(folder / "plain.igs", surface);
    write_iges(folder / "none.igs", surface, "part", LengthUnit::mm, none);
    EXPECT_EQ(content_of(folder / "none.igs").find("     144"), std::string::npos);
    EXPECT_EQ(read_back(folder / "none.igs").loops, 1);
}

/// A cone that was cut open, whose sides fit each other but for `gap`, mm, in the middle.
static NurbsSurface cut_cone(double gap)
{
    constexpr int round = 13, along = 4;
    NurbsSurface cone;
    cone.degree_u = cone.degree_v = 3;
    cone.count_u = round;
    cone.count_v = along;
    cone.knots_u = {0, 0, 0};
    for (int i = 0; i <= round - 3; ++i)
        cone.knots_u.push_back(double(i) / (round - 3));
    cone.knots_u.insert(cone.knots_u.end(), 3, 1);
    cone.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
    cone.control.resize(3, round * along);
    cone.weight = Eigen::VectorXd::Ones(round * along);
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < round; ++i) {
            const double angle = 2 * pi * i / (round - 1), radius = 40 - 6 * j;
            cone.control.col(cone.index(i, j)) << radius * std::cos(angle) - 4 * j, radius * std::sin(angle), 25 * j;
        }
    for (const int j : {1, 2})
        cone.control(1, cone.index(round - 1, j)) += gap;
    return cone;
}

TEST(TrimmedFiles, ASurfaceThatWasCutOpenIsReadWhole)
{
    const ScratchFolder folder;
    const std::vector<NurbsSurface> surface = {cut_cone(2e-5)};
    // A hole where it would be divided, and one elsewhere.
    const std::vector<std::vector<TrimLoop>> holes = {{ellipse({0.5, 0.5}, 0.1, 0.3), ellipse({0.8, 0.5}, 0.1, 0.3)}};
    const auto inside = [](double u, double v, double middle) {
        return std::hypot((u - middle) / 0.1, (v - 0.5) / 0.3) < 1;
    };
    double whole = 0, left = 0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double u = (i + 0.5) / n, v = (j + 0.5) / n;
            const SurfacePoint at = evaluate(surface[0], u, v);
            const double cell = at.S_u.cross(at.S_v).norm() / (n * n);
            whole += cell;
            left += inside(u, v, 0.5) || inside(u, v, 0.8) ? 0 : cell;
        }
    write_step(folder / "cone.step", surface);
    const Written plain = read_back(folder / "cone.step", 0.05);
    EXPECT_NEAR(plain.area / whole, 1, 1e-3);
    EXPECT_EQ(plain.faces, 2);
    write_step(folder / "holes.step", surface, "part", LengthUnit::mm, holes);
    const Written cut = read_back(folder / "holes.step", 0.05);
    EXPECT_EQ(cut.faces, 2);
    EXPECT_NEAR(cut.area / left, 1, 1e-3);
}

} // namespace spia::trimmed_files_test
