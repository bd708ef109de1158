// Plates and parts with holes, from the blank to patches that analysis accepts.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <numbers>
#include <unistd.h>

#include "engine/core/parallel.h"
#include "engine/exchange/read_surfaces.h"
#include "engine/exchange/write_step.h"
#include "engine/layout/fit_patches.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/certificate.h"
#include "engine/nurbs/evaluate.h"
#include "tests/support/shapes.h"
#include "tests/unit/layout/step_shell.h"

namespace spia {
namespace {

constexpr double pi = std::numbers::pi;

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
                plate.holes.push_back({{25 + 50 * i + 3 * (j % 2), 25 + 50 * j - 2 * (i % 3)}, 8 + double((i + 2 * j) % 5)});
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
    const PatchesFit fit = fit_patches(part, blank, layout, options);
    EXPECT_TRUE(fit.reached) << fit.deviation_max();
    double of_patches = 0, border = 0;
    for (const NurbsSurface& patch : fit.patches.patch)
        of_patches += area_of(patch);
    for (const LayoutCurve& curve : fit.layout.curve)
        border += curve.on_border() ? length(curve) : 0;
    EXPECT_NEAR(of_patches, area(part), options.tolerance * border);
    std::printf("holes %d: %zu patches (split %d), %zu interfaces, deviation %.4g, area %.3f of %.3f, rounds %d\n", GetParam(),
                fit.patches.patch.size(), layout.split, fit.patches.interfaces.size(), fit.deviation_max(), of_patches, area(part),
                fit.rounds);
    expect_joined(fit, 1 + GetParam());
}

} // namespace spia
