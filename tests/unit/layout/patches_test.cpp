// Plates and parts with holes, from the blank to patches that analysis accepts.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <numbers>
#include <tbb/global_control.h>
#include <unistd.h>

#include "engine/core/error.h"
#include "engine/exchange/cad/read_surfaces.h"
#include "engine/exchange/cad/write_step.h"
#include "engine/layout/fit_patches.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/certificate.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/project.h"
#include "tests/support/developable.h"
#include "tests/support/shapes.h"
#include "tests/unit/layout/step_shell.h"

namespace spia {
namespace {

using std::numbers::pi;

shapes::Plate plate_with(int holes)
{
    switch (holes) {
    case 1: return {100, 80, {{{50, 40}, 15}}, 4000};
    case 2: return {120, 80, {{{35, 40}, 12}, {{85, 40}, 12}}, 4000};
    case 5: return {200, 120, {{{35, 30}, 12}, {{150, 40}, 18}, {{100, 62}, 9}, {{45, 90}, 14}, {{160, 92}, 7}}, 8000};
    default: {
        shapes::Plate plate{250, 200, {}, 16000};
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 5; ++i)
                plate.holes.push_back(
                    {{25 + 50 * i + 3 * (j % 2), 25 + 50 * j - 2 * (i % 3)}, 8 + double((i + 2 * j) % 5)});
        return plate;
    }
    }
}

Eigen::Vector3d on_side(const NurbsSurface& s, Side side, double t)
{
    switch (side) {
    case Side::v0: return evaluate(s, t, 0).position;
    case Side::v1: return evaluate(s, t, 1).position;
    case Side::u0: return evaluate(s, 0, t).position;
    default: return evaluate(s, 1, t).position;
    }
}

/// mm, between the two sides of all interfaces, at 10,000 points each.
double widest_gap(const MultiPatch& patches)
{
    double widest = 0;
    for (const PatchInterface& joint : patches.interfaces)
        for (int i = 0; i < 10'000; ++i) {
            const double t = double(i) / 9'999;
            widest = std::max(widest, (on_side(patches.patch[size_t(joint.first.patch)], joint.first.side, t) -
                                       on_side(patches.patch[size_t(joint.second.patch)], joint.second.side,
                                               joint.reversed ? 1 - t : t))
                                          .norm());
        }
    return widest;
}

double area_of(const NurbsSurface& s)
{
    constexpr int n = 400;
    double sum = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const SurfacePoint at = evaluate(s, (i + 0.5) / n, (j + 0.5) / n);
            sum += at.S_u.cross(at.S_v).norm();
        }
    return sum / (n * n);
}

void expect_joined(const PatchesFit& fit, int loops)
{
    require_watertight(fit.patches);
    EXPECT_LE(widest_gap(fit.patches), 1e-12); // mm: the same controls, summed in another order
    const Certificate certificate = certify(fit.patches);
    EXPECT_TRUE(certificate.suited());
    // One sheet with that many loops of border: V - E + F = 2 - loops.
    const int patches = int(fit.patches.patch.size()), joints = int(fit.patches.interfaces.size());
    const int edges = 4 * patches - joints;
    EXPECT_EQ(int(fit.layout.curve.size()), edges);
    std::vector<int> used;
    for (const LayoutCurve& curve : fit.layout.curve)
        used.insert(used.end(), {curve.vertex[0], curve.vertex[1]});
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    EXPECT_EQ(int(used.size()) - edges + patches, 2 - loops);

    const auto file = std::filesystem::temp_directory_path() / ("spia-patches-" + std::to_string(getpid()) + ".step");
    write_step(file, fit.patches.patch);
    const StepShell back = read_step_shell(file);
    const auto surfaces = read_step_surfaces(file);
    std::filesystem::remove(file);
    EXPECT_EQ(back.shells, 1);
    EXPECT_EQ(back.faces, patches);
    EXPECT_EQ(back.free_edges, int(outer_sides(fit.patches).size()));
    EXPECT_TRUE(back.valid);
    EXPECT_EQ(surfaces.size(), fit.patches.patch.size());
}

} // namespace

class Plates : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Holes, Plates, testing::Values(1, 2, 5, 20));

TEST_P(Plates, ArePatchesThatFillTheSheetAndShareTheirSides)
{
    const shapes::Plate shape = plate_with(GetParam());
    const TriMesh part = shapes::plate(shape);
    const Blank blank{part.position.topRows(2)};
    const Layout layout = make_layout(part, blank);
    EXPECT_GE(layout.patch.size(), size_t(4 * GetParam()));
    double sheet = 0;
    for (const LayoutPatch& patch : layout.patch)
        sheet += area(layout, patch);
    EXPECT_NEAR(sheet, area(part), 1e-9 * area(part)); // the polygons' own

    PatchesFitOptions options;
    options.tolerance = 0.05;
    const PatchesFit fit = blank_patches(part, blank, {}, options);
    EXPECT_TRUE(fit.reached) << fit.deviation_max();
    double of_patches = 0, border = 0;
    for (const NurbsSurface& patch : fit.patches.patch)
        of_patches += area_of(patch);
    for (const LayoutCurve& curve : fit.layout.curve)
        border += curve.on_border() ? length(curve) : 0;
    EXPECT_NEAR(of_patches, area(part), options.tolerance * border);
    std::printf("holes %d: %zu patches (split %d), %zu interfaces, deviation %.4g, area %.3f of %.3f, rounds %d\n",
                GetParam(), fit.patches.patch.size(), fit.layout.split, fit.patches.interfaces.size(),
                fit.deviation_max(), of_patches, area(part), fit.rounds);
    expect_joined(fit, 1 + GetParam());
}

/// The place of each patch is on the patch or on the part, and as far from the other as is said.
void expect_farthest_places(const TriMesh& part, const PatchesFit& fit)
{
    const ClosestPointSearch search(part);
    ASSERT_EQ(fit.patch_deviation.size(), fit.patches.patch.size());
    double greatest = 0;
    for (size_t p = 0; p < fit.patches.patch.size(); ++p) {
        const auto& [max, where] = fit.patch_deviation[p];
        const double to_part = search.nearest(where).distance,
                     to_patch = SurfaceProjection(fit.patches.patch[p]).nearest(where).distance;
        EXPECT_NEAR(std::max(to_part, to_patch), max, 1e-9) << "patch " << p;
        EXPECT_NEAR(std::min(to_part, to_patch), 0, 1e-9) << "patch " << p;
        EXPECT_GT(max, 0) << "patch " << p;
        greatest = std::max(greatest, max);
    }
    EXPECT_EQ(greatest, fit.deviation_max());
}

TEST(Patches, OfACylinderWithARoundHoleLieOnIt)
{
    const shapes::QuarterCylinder shape{50, 80, 5000};
    const double width = shape.radius * pi / 2;
    const TriMesh flat = shapes::plate({width, shape.length, {{{width / 2, shape.length / 2}, 12}}, 6000});
    TriMesh part = flat; // rolled up
    for (int v = 0; v < part.vertices(); ++v) {
        const double angle = flat.position(0, v) / shape.radius;
        part.position.col(v) << -shape.radius * std::cos(angle), flat.position(1, v), shape.radius * std::sin(angle);
    }
    PatchesFitOptions options;
    options.tolerance = 0.05;
    const PatchesFit fit = blank_patches(part, Blank{flat.position.topRows(2)}, {}, options);
    EXPECT_TRUE(fit.reached) << fit.deviation_max();
    double farthest = 0; // from the cylinder itself, which the triangles are near
    for (const NurbsSurface& patch : fit.patches.patch)
        for (int i = 0; i <= 50; ++i)
            for (int j = 0; j <= 50; ++j) {
                const Eigen::Vector3d p = evaluate(patch, i / 50., j / 50.).position;
                farthest = std::max(farthest, std::abs(std::hypot(p.x(), p.z()) - shape.radius));
            }
    expect_farthest_places(part, fit);
    EXPECT_LT(farthest, 0.1); // tolerance and sagitta of the triangles, 2 mm long: 0.01 mm
    expect_joined(fit, 2);
    double angle = 0;
    for (const InterfaceCertificate& joint : certify(fit.patches).interfaces)
        angle = std::max(angle, joint.greatest_angle);
    std::printf("cylinder: %zu patches, deviation %.4g, from the cylinder %.4g, angle %.3g degrees\n",
                fit.patches.patch.size(), fit.deviation_max(), farthest, angle * 180 / pi);
    EXPECT_LT(angle * 180 / pi, 5);
}

TEST(Patches, AreTwoWhereACutDividesASheet)
{
    const TriMesh part = shapes::saddle();
    const Blank blank{part.position.topRows(2)}; // its projection: one-to-one is all that counts
                                                 // here
    const auto nearest = [&](double x, double y) {
        Eigen::Index v;
        (blank.position.colwise() - Eigen::Vector2d(x, y)).colwise().norm().minCoeff(&v);
        return int(v);
    };
    const Eigen::Vector2d low = blank.position.rowwise().minCoeff(), high = blank.position.rowwise().maxCoeff();
    LayoutOptions options;
    options.cuts = {{nearest(0, low.y()), nearest(0, high.y())}};
    options.corners = {nearest(low.x(), low.y()), nearest(high.x(), low.y()), nearest(high.x(), high.y()),
                       nearest(low.x(), high.y())};
    PatchesFitOptions fitting;
    fitting.tolerance = 0.05;
    const PatchesFit fit = blank_patches(part, blank, options, fitting);
    EXPECT_EQ(fit.patches.patch.size(), 2u);
    EXPECT_EQ(fit.patches.interfaces.size(), 1u);
    EXPECT_TRUE(fit.reached);
    expect_joined(fit, 1);
    expect_farthest_places(part, fit);
    ASSERT_EQ(fit.attempts.size(), 1u) << "few patches are enough";
    EXPECT_TRUE(fit.attempts[0].won);
    options.cuts = {{options.corners[0], nearest(0, 0)}};
    EXPECT_THROW(make_layout(part, blank, options), InputError); // ends within the sheet
    options.cuts = {{options.corners[0], options.corners[2]}, {options.corners[1], options.corners[3]}};
    EXPECT_THROW(make_layout(part, blank, options), InputError); // cross each other
}

TEST(Patches, AreTheSameOnOneThreadAndOnTwo)
{
    const TriMesh part = shapes::plate(plate_with(2));
    const Blank blank{part.position.topRows(2)};
    const auto control = [&](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, size_t(threads));
        return blank_patches(part, blank).patches.patch;
    };
    const auto one = control(1), two = control(2);
    ASSERT_EQ(one.size(), two.size());
    for (size_t p = 0; p < one.size(); ++p)
        EXPECT_TRUE((one[p].control.array() == two[p].control.array()).all());
}

} // namespace spia
