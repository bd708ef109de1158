#include "engine/nurbs/correct_parameters.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <memory>

#include "engine/core/error.h"
#include "engine/mesh/closest_point.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/foot_point_projection.h"
#include "tests/support/meshed_sheet.h"

namespace spia {
namespace {

/// At the data of a fit.
struct AtData {
    double least_sine = 1, largest_distance = 0;

    explicit AtData(const Attempt& fit)
    {
        const std::vector<double>&u = fit.along_u.parameters(), &v = fit.along_v.parameters();
        for (size_t j = 0; j < v.size(); ++j)
            for (size_t i = 0; i < u.size(); ++i) {
                const SurfacePoint at = evaluate(fit.surface, u[i], v[j]);
                least_sine = std::min(least_sine, at.S_u.cross(at.S_v).norm() / (at.S_u.norm() * at.S_v.norm()));
                largest_distance =
                    std::max(largest_distance, (at.position - fit.points.col(Eigen::Index(i + j * u.size()))).norm());
            }
    }
};

} // namespace

TEST(CorrectParameters, ComesCloserOnThePartAndDoesNotLeanOver)
{
    for (const size_t which : {2u, 4u}) { // the torus piece, and the bump, at which most parameters
                                          // want to be
        const shapes::KnownSheet sheet = shapes::known_sheets()[which];
        const shapes::MeshedSheet meshed(sheet, 120);
        const FootPointProjection projection(meshed.mesh);
        const ClosestPointSearch part(meshed.mesh);
        for (int spans = 1; spans <= 6; ++spans) {
            SCOPED_TRACE(sheet.name + " " + std::to_string(spans));
            std::vector<double> borders;
            for (int k = 0; k <= spans; ++k)
                borders.push_back(double(k) / spans);
            Attempt fit = attempt(meshed.source, {}, borders, borders);
            const AtData before(fit);
            correct_parameters(fit, projection);
            const AtData after(fit);
            EXPECT_LT(after.largest_distance, before.largest_distance);
            if (which == 2 && spans <= 2) {
                EXPECT_LT(after.largest_distance, before.largest_distance / 5);
            }
            EXPECT_GE(after.least_sine, 0.5 * before.least_sine);
            double off = 0;
            for (Eigen::Index n = 0; n < fit.points.cols(); ++n)
                off = std::max(off, part.nearest(fit.points.col(n)).distance);
            EXPECT_LT(off, 1e-9);
        }
    }
}

TEST(CorrectParameters, CanBeCancelled)
{
    const shapes::MeshedSheet meshed(shapes::known_sheets()[2], 40);
    Attempt fit = attempt(meshed.source, {}, {0, 1}, {0, 1});
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    const Progress progress([&](double share, std::string_view) { *stop = share > 0.1; }, stop);
    EXPECT_THROW(correct_parameters(fit, FootPointProjection(meshed.mesh), progress), Cancelled);
}

} // namespace spia
