#include "engine/unfold/ring_chart.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/unfold/unfold_step.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"

namespace spia {
namespace {

using std::numbers::pi;

FlattenOptions steel(double r = 1.77)
{
    FlattenOptions options;
    options.material = {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, r, r, r, ""};
    options.thickness = 0.8;
    return options;
}

} // namespace

TEST(RingChart, Probe)
{
    for (double lean : {0., 30., 60., 90., -60.})
    for (double H : {10., 20., 40.}) {
        if (lean < 0 && H > 25) continue;
        const int n = 48, m = 12;
        const double R = 40, tube = 30;
        const double a = lean * pi / 180;
        const TriMesh part = shapes::grid_surface({n, 2 * m, true, false}, [&](double u, double v) {
            const double t = 2 * pi * u, s = (tube + H) * 0;
            (void)s;
            const double k = v * 2 * m;
            const double below = std::min(k / m, 1.) * tube, above = std::max(k / m - 1, 0.) * H;
            const double r = R + above * std::sin(a);
            return Eigen::Vector3d(r * std::cos(t), r * std::sin(t), below + above * std::cos(a));
        });
        UnfoldPick pick;
        for (int f = 0; f < part.triangles(); ++f)
            (f < part.triangles() / 2 ? pick.fixed : pick.freed).push_back(f);
        try {
            const auto r = unfold_step(part, part.position, pick, steel());
            double lo = 1e9, hi = -1e9;
            for (int v = part.vertices() - n; v < part.vertices(); ++v) {
                lo = std::min(lo, r.position(2, v));
                hi = std::max(hi, r.position(2, v));
            }
            printf("%g %g: %d top %.9f..%.9f, %zu+%zu, %.2f s %s\n", lean, H, r.converged(), lo, hi, r.piece[0].report.energy.size(), r.piece[0].report.newton.size(), r.seconds, r.piece[0].report.reason.c_str());
        } catch (const std::exception& e) {
            printf("%g %g: %s\n", lean, H, e.what());
        }
    }
}

} // namespace spia
