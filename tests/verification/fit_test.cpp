// Surfaces within a tolerance, against sheets whose distance has a closed form.
#include "engine/nurbs/fit.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

#include "engine/mesh/closest_point.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/interpolate.h"
#include "tests/support/meshed_sheet.h"

namespace spia {
namespace {

using Eigen::Vector3d;
using shapes::even_grid;
using shapes::independent_deviation;
using shapes::KnownSheet;
using shapes::MeshedSheet;

FitOptions within(double tolerance)
{
    FitOptions options;
    options.tolerance = tolerance;
    return options;
}

} // namespace

TEST(Fit, KnownSurfacesStayWithinTheToleranceAndTheChordErrorOfTheMesh)
{
    for (const KnownSheet& sheet : shapes::known_sheets()) {
        int before = 0;
        for (const double relative : {1e-1, 1e-2, 1e-3, 1e-4}) {
            const int mesh_cells = relative < 5e-4   ? 250
                                   : relative < 5e-3 ? 100
                                                     : 50; // facets well below the tolerance
            const MeshedSheet meshed(sheet, mesh_cells);
            const double chord = shapes::chord_error(sheet, meshed.mesh);
            const double tolerance = relative * sheet.size;
            const FitResult result = fit(meshed.source, meshed.mesh, within(tolerance));
            const NurbsSurface& surface = result.surface;
            EXPECT_TRUE(result.report.reached) << sheet.name << " at " << relative << result.report.shortfall.text;
            EXPECT_LE(result.deviation.max(), tolerance);
            EXPECT_EQ(result.deviation.within(), 1);
            EXPECT_TRUE(result.deviation.beyond.empty());
            EXPECT_LE(independent_deviation(surface, sheet), tolerance + chord) << sheet.name << " at " << relative;
            EXPECT_GE(1.1 * int(surface.control.cols()), before) << "less tolerance needs no fewer control points";
            before = int(surface.control.cols());

            // Uniform interpolation with fewer control points is not as close;
            // tests/bench/fit_table.cpp has the figures.
            const int cells = int(std::ceil(std::sqrt(before))) - 2;
            if (cells < 3)
                continue;
            const QuadGrid grid = even_grid(meshed.mesh, mesh_cells, cells);
            const InterpolateOptions uniform{.parameters = InterpolateOptions::Parameters::uniform};
            EXPECT_GT(distance_from_sheet(interpolate(grid, uniform).surface, sheet), tolerance)
                << sheet.name << " at " << relative;
        }
    }
}

TEST(Fit, EveryDegreeAndEveryEndReachesTheTolerance)
{
    const KnownSheet torus = shapes::known_sheets()[2];
    const MeshedSheet meshed(torus, 80);
    const double tolerance = 0.1, chord = shapes::chord_error(torus, meshed.mesh);
    for (const int degree : {2, 3, 4, 5})
        for (const CurveEnds ends : {CurveEnds::averaged_knots, CurveEnds::clamped, CurveEnds::natural}) {
            if (ends == CurveEnds::natural && degree < 3)
                continue;
            FitOptions options = within(tolerance);
            options.degree_u = degree;
            options.degree_v = degree == 5 ? 2 : degree;
            if (ends == CurveEnds::natural)
                options.degree_v = 3;
            options.ends = ends;
            const FitResult result = fit(meshed.source, meshed.mesh, options);
            EXPECT_TRUE(result.report.reached) << "degree " << degree << ", " << name(ends);
            EXPECT_EQ(result.surface.degree_u, degree);
            EXPECT_LE(independent_deviation(result.surface, torus), tolerance + chord) << degree << ", " << name(ends);
            for (const double v : {0., 0.3, 1.}) {
                const SurfacePoint at = evaluate(result.surface, 0, v);
                if (ends == CurveEnds::natural)
                    EXPECT_LT(at.S_uu.norm(), 1e-6 * at.S_u.norm()) << "degree " << degree;
                else
                    EXPECT_GT(at.S_uu.norm(), 1e-2 * at.S_u.norm()) << "the torus is curved there";
            }
        }
}

} // namespace spia
