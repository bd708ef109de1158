// The energy stage with held vertices.
#include "engine/forming/solver/energy_stage.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/revolved.h"
#include "tests/support/shapes.h"

namespace spia::energy_stage_test {
namespace {

Material mild_steel() { return {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""}; }

struct Held {
    TriMesh part;
    std::vector<Element> element = elements(part);
    Sheet sheet = uniform_sheet(MembraneLaw(mild_steel()), 0.8, part.triangles());
    BlockMatrix matrix{part.triangle, part.vertices()};
    Cholesky cholesky{matrix};

    EnergyResult solve(const Eigen::Matrix2Xd& start, const EnergyOptions& options)
    {
        return minimise_energy(part.triangle, element, sheet, start, matrix, cholesky, options, {});
    }
};

} // namespace

TEST(EnergyStage, HeldAtTheFreeBlankMovedAwayTheRestFollowsAndTheHeldStay)
{
    const shapes::AxisymmetricPart dome = shapes::dome({.triangles = 1500});
    Held held{dome.mesh};
    const Eigen::Matrix2Xd start = dome.mesh.position.topRows<2>();
    EnergyOptions options;
    options.decrement = 1e-12;
    const Eigen::Matrix2Xd free = held.solve(start, options).position;
    const Eigen::Rotation2Dd turn(0.4);
    const Eigen::Matrix2Xd there = (turn.toRotationMatrix() * free).colwise() + Eigen::Vector2d(3, -2);
    Eigen::Matrix2Xd from = (turn.toRotationMatrix() * start).colwise() + Eigen::Vector2d(3, -2);
    for (const int v : dome.rim) {
        options.held.push_back({v, there.col(v)});
        from.col(v) = there.col(v);
    }
    const EnergyResult fixed = held.solve(from, options);
    EXPECT_EQ(fixed.ended, Ended::converged);
    for (const HeldVertex& h : options.held)
        EXPECT_EQ(fixed.position.col(h.vertex), h.place);
    EXPECT_LT((fixed.position - there).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(EnergyStage, ASpringStretchesAStripAsFarAsItsForceGoes)
{
    // Two springs k hold the ends of a strip of length L and width w half of d beyond them: they
    // are the sheet's own springs E h w / L in a row as long as it is elastic.
    const double L = 100, w = 10, d = 1e-3, young = 206000, h = 0.8;
    Held strip{shapes::rectangle(L, w, 20, 2)};
    EnergyOptions options;
    options.decrement = 1e-14;
    for (int v = 0; v < strip.part.vertices(); ++v) {
        const Eigen::Vector2d x = strip.part.position.col(v).head<2>();
        if (x[0] < 1e-9 || x[0] > L - 1e-9)
            options.held.push_back({v, x + Eigen::Vector2d(x[0] < 1 ? -d / 2 : d / 2, 0)});
    }
    const double per_end = double(options.held.size()) / 2, sheet = young * h * w / L;
    options.spring = sheet / per_end; // k of an end is as stiff as the sheet: a third of the way is
                                      // left to each of the three
    const Eigen::Matrix2Xd X = strip.solve(strip.part.position.topRows<2>(), options).position;
    const double longer = X.row(0).maxCoeff() - X.row(0).minCoeff() - L;
    EXPECT_NEAR(longer / d, 1. / 3, 0.02); // the ends do not narrow with the rest; r is not the
                                           // elastic Poisson's ratio
}

} // namespace spia::energy_stage_test
