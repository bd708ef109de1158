#include "engine/compare/abf.h"

#include <gtest/gtest.h>
#include <numbers>

#include "engine/compare/lscm.h"
#include "engine/compare/map_quality.h"
#include "engine/core/small_dense.h"
#include "engine/mesh/topology.h"
#include "tests/support/developable.h"
#include "tests/support/inner_panel.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/unit/compare/layouts.h"

namespace spia {
namespace {

using std::numbers::pi;

std::vector<bool> inner(const TriMesh& part)
{
    std::vector<bool> result(size_t(part.vertices()), true);
    for (const auto& loop : boundary_loops(part))
        for (int v : loop)
            result[size_t(v)] = false;
    return result;
}

/// The constraints as the paper has them, the wheel as a difference of products: triangles, then
/// planarity and wheel of each inner vertex.
Eigen::VectorXd constraints(const TriMesh& part, const Eigen::Matrix3Xd& angle)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(part.vertices());
    Eigen::VectorXd next = Eigen::VectorXd::Ones(part.vertices()), previous = next;
    std::vector<double> result;
    for (int f = 0; f < part.triangles(); ++f) {
        result.push_back(angle.col(f).sum() - pi);
        for (int k = 0; k < 3; ++k) {
            const int v = part.triangle(k, f);
            sum[v] += angle(k, f);
            next[v] *= std::sin(angle((k + 1) % 3, f));
            previous[v] *= std::sin(angle((k + 2) % 3, f));
        }
    }
    const auto is_inner = inner(part);
    for (int v = 0; v < part.vertices(); ++v)
        if (is_inner[size_t(v)]) {
            result.push_back(sum[v] - 2 * pi);
            result.push_back(next[v] - previous[v]);
        }
    return Eigen::Map<Eigen::VectorXd>(result.data(), Eigen::Index(result.size()));
}

Eigen::VectorXd objective_gradient(const AbfAngles& a)
{
    return (2 * (a.angle - a.wanted).array() / a.wanted.array().square()).matrix().reshaped();
}

} // namespace

TEST(Abf, FulfilsItsConstraints)
{
    for (const TriMesh& part : {bumpy_disk(), bumpy_plate(), shapes::dome({.triangles = 2000}).mesh}) {
        const AbfAngles found = abf_angles(part);
        EXPECT_TRUE(found.converged);
        EXPECT_LE(found.iterations, 8); // quadratic
        EXPECT_LT(constraints(part, found.angle).cwiseAbs().maxCoeff(), 1e-10);
        EXPECT_GT(found.angle.minCoeff(), 0);
    }
}

TEST(Abf, IsNewtonsMethodItself)
{
    // Where the multipliers are large, a Hessian without the wheel (or with its wrong sign) needs
    // many more steps.
    const TriMesh part = bumpy(shapes::rectangle(60, 45, 16, 12), 20);
    const AbfAngles found = abf_angles(part);
    EXPECT_TRUE(found.converged);
    EXPECT_LE(found.iterations, 5);
}

TEST(Abf, WantsTheAnglesOfThePartScaledToAFullTurnInside)
{
    const TriMesh part = bumpy_disk();
    const AbfAngles found = abf_angles(part);
    const auto is_inner = inner(part);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(part.vertices());
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            sum[part.triangle(k, f)] += found.wanted(k, f);
    const Eigen::VectorXd formed = shapes::angle_sums(part);
    for (int v = 0; v < part.vertices(); ++v)
        EXPECT_NEAR(sum[v], is_inner[size_t(v)] ? 2 * pi : formed[v], 1e-12);
}

TEST(Abf, ItsObjectiveCannotFallAlongTheConstraints)
{
    // The gradient of the Lagrangian vanishes: that of the objective is a combination of those of
    // the constraints, found here by differences and a dense least squares, without the solver's
    // multipliers.
    const TriMesh part = bumpy_disk();
    const AbfAngles found = abf_angles(part);
    const double step = 1e-5;
    Eigen::MatrixXd slopes(found.angle.size(), constraints(part, found.angle).size());
    for (Eigen::Index i = 0; i < found.angle.size(); ++i) {
        Eigen::Matrix3Xd up = found.angle, down = found.angle;
        up(i) += step;
        down(i) -= step;
        slopes.row(i) = (constraints(part, up) - constraints(part, down)).transpose() / (2 * step);
    }
    const Eigen::VectorXd gradient = objective_gradient(found);
    ASSERT_GT(gradient.norm(), 0.05); // there is something to balance
    const Eigen::VectorXd multiplier = least_squares(slopes, gradient);
    EXPECT_LT((gradient - slopes * multiplier).norm(), 1e-7 * gradient.norm());
}

TEST(Abf, ItsMultipliersBalanceTheObjectiveAngleByAngle)
{
    const TriMesh part = bumpy_plate();
    const AbfAngles a = abf_angles(part);
    const Eigen::VectorXd gradient = objective_gradient(a);
    double largest = 0;
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = part.triangle(k, f), next = part.triangle((k + 1) % 3, f);
            const int previous = part.triangle((k + 2) % 3, f);
            const double wheel = (a.vertex(1, previous) - a.vertex(1, next)) / std::tan(a.angle(k, f));
            largest = std::max(largest, std::abs(gradient[3 * f + k] + a.triangle[f] + a.vertex(0, v) + wheel));
        }
    EXPECT_LT(largest, 1e-9);
}

TEST(Abf, LaysADiskOutWithExactlyItsAngles)
{
    const TriMesh part = shapes::dome({.triangles = 2000}).mesh;
    const Eigen::Matrix3Xd angle = abf_angles(part).angle;
    const Eigen::Matrix2Xd flat = abf(part).position;
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector2d at = flat.col(part.triangle(k, f));
            const Eigen::Vector2d p = flat.col(part.triangle((k + 1) % 3, f)) - at;
            const Eigen::Vector2d q = flat.col(part.triangle((k + 2) % 3, f)) - at;
            ASSERT_NEAR(std::atan2(p[0] * q[1] - p[1] * q[0], p.dot(q)), angle(k, f), 1e-8);
        }
    EXPECT_NEAR(flat_area(part, flat), area(part), 1e-9 * area(part));
}

TEST(Abf, LaysDevelopablePartsOutUpToASimilarityAlsoWithHoles)
{
    const auto cone = shapes::cone_sector({.triangles = 2000});
    const TriMesh holes = shapes::plate({.triangles = 2000});
    EXPECT_LT(distance_up_to_similarity(abf(cone.mesh).position, cone.flat), 1e-8);
    EXPECT_LT(distance_up_to_similarity(abf(holes).position, holes.position.topRows<2>()), 1e-8);
}

TEST(Abf, DistortsAnglesLessThanLscmOnAPanelWithManyHoles)
{
    shapes::InnerPanel shape;
    shape.triangles = 3000;
    const TriMesh part = shapes::inner_panel(shape).mesh;
    const MapQuality ours = map_quality(part, abf(part).position), theirs = map_quality(part, lscm(part).position);
    EXPECT_EQ(ours.flips, 0);
    EXPECT_LT(ours.angular_rms, theirs.angular_rms);
}

TEST(Abf, TakesASharpSpike)
{
    // Three faces around a spike: the wanted angles are 2 pi / 3 each, far from the part's, and
    // with fewer than four faces there is no other choice.
    TriMesh spike;
    spike.position.resize(3, 4);
    spike.position << 0, 1, -0.5, -0.5, 0, 0, 0.8660254037844386, -0.8660254037844386, 6, 0, 0, 0;
    spike.triangle.resize(3, 3);
    spike.triangle << 0, 0, 0, 1, 2, 3, 2, 3, 1;
    const AbfAngles found = abf_angles(spike);
    EXPECT_TRUE(found.converged);
    for (int f = 0; f < 3; ++f) {
        EXPECT_NEAR(found.angle(0, f), 2 * pi / 3, 1e-9);
        EXPECT_NEAR(found.angle(1, f), pi / 6, 1e-9);
    }
}

} // namespace spia
