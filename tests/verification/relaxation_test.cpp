#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

#include "engine/forming/flatten.h"
#include "engine/forming/solver/equilibrium.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"

namespace spia::relaxation_test {
namespace {

Material mild_steel() { return {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""}; }

} // namespace

TEST(Relaxation, EndsInTheStrictSolutionWhereThereIsOne)
{
    shapes::Dome shape;
    shape.triangles = 4000;
    const TriMesh part = shapes::dome(shape).mesh;
    const std::vector<Element> element = elements(part);
    const MembraneLaw law(mild_steel());
    const ExternalForces none;
    const Sheet sheet = uniform_sheet(law, 0.8, part.triangles());
    const Eigen::Matrix2Xd start = part.position.topRows<2>();
    BlockMatrix matrix(part.triangle, part.vertices());
    Cholesky cholesky(matrix);
    const Eigen::Matrix2Xd X = minimise_energy(part.triangle, element, sheet, start, matrix, cholesky, {}, {}).position;

    VirtualWork work(part, element, sheet, none);
    const EquilibriumResult strict = solve_equilibrium(part, element, work, X, matrix, cholesky, {}, {});
    ASSERT_EQ(strict.ended, Ended::converged);
    const EquilibriumResult relaxed = solve_relaxed_equilibrium(part, element, work, X, matrix, cholesky, {}, {});
    ASSERT_EQ(relaxed.ended, Ended::converged);
    EXPECT_EQ(std::count(work.relaxed().begin(), work.relaxed().end(), char(1)), 0);
    EXPECT_LT((strict.position - relaxed.position).colwise().norm().maxCoeff(), 1e-6);

    // With every vertex relaxed the answer is another one: what is neglected, the change of F
    // across a vertex, does not vanish on finer meshes. On this part it is within 2 % of its
    // radius.
    work.relax(std::vector<char>(size_t(part.vertices()), 1));
    const EquilibriumResult all = solve_equilibrium(part, element, work, X, matrix, cholesky, {}, {});
    ASSERT_EQ(all.ended, Ended::converged);
    const double apart = (strict.position - all.position).colwise().norm().maxCoeff();
    EXPECT_GT(apart, 1e-4);
    EXPECT_LT(apart, 0.02 * strict.position.colwise().norm().maxCoeff());
}

TEST(Relaxation, SolvesACrumpledSheetAndSaysWhatItGaveUp)
{
    TriMesh part = shapes::rectangle(60, 40, 30, 20);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> height(-6, 6); // of vertices 2 mm apart
    for (int v = 0; v < part.vertices(); ++v)
        part.position(2, v) = height(random);
    FlattenOptions options;
    options.material = mild_steel();
    options.thickness = 0.8;
    const FlattenResult result = flatten(part, options);
    EXPECT_TRUE(result.report.converged) << result.report.reason;
    EXPECT_LE(result.report.residual, options.tolerance);
    EXPECT_EQ(result.flipped_triangles, 0);
    EXPECT_GT(result.report.relaxed_vertices, 0);
    EXPECT_NE(result.report.reason.find("relaxed at"), std::string::npos) << result.report.reason;
    const std::vector<AttemptReport>& tried = result.report.attempts;
    ASSERT_EQ(tried.size(), 3u) << "both with the curve as given came first";
    EXPECT_FALSE(tried[0].won || tried[1].won);
    EXPECT_TRUE(tried[2].won);
    EXPECT_EQ(tried[2].reason.substr(0, 9), "converged") << tried[2].reason;
}

} // namespace spia::relaxation_test
