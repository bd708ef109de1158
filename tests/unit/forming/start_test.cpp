// Stamping direction, first guess and the step that flips nothing.
#include <gtest/gtest.h>
#include <numbers>

#include "engine/forming/solver/energy_stage.h"
#include "engine/forming/solver/initial_guess.h"
#include "engine/forming/solver/stamping_direction.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

InitialGuess guess(const TriMesh& part)
{
    const auto element = elements(part);
    BlockMatrix matrix(part.triangle, part.vertices());
    Cholesky cholesky(matrix);
    return initial_guess(part, element, stamping_direction(part), matrix, cholesky);
}

} // namespace

TEST(StampingDirection, OfADomeIsItsAxisInAnyOrientation)
{
    const TriMesh dome = shapes::dome({.triangles = 2000}).mesh;
    for (unsigned seed : {1u, 2u, 3u}) {
        const Eigen::Matrix3d turn = shapes::random_rotation(seed);
        const StampingDirection found = stamping_direction(shapes::transformed(dome, turn, Eigen::Vector3d::Zero()));
        EXPECT_LT(std::acos(std::min(1.0, found.direction.dot(turn.col(2)))), 2 * std::numbers::pi / 180);
        EXPECT_TRUE(found.height_field);
        EXPECT_EQ(found.hidden_area_fraction, 0);
    }
}

TEST(StampingDirection, SeesTheUndercutsOfReturnedFlanges)
{
    const StampingDirection found = stamping_direction(shapes::lipped_channel({.triangles = 3000}).mesh);
    EXPECT_FALSE(found.height_field);
    EXPECT_GT(found.hidden_area_fraction, 0.1);
}

TEST(LargestStep, IsTheStepAtWhichTheTriangleCollapses)
{
    Eigen::Matrix3Xi triangle = Eigen::Vector3i(0, 1, 2);
    Eigen::Matrix2Xd X(2, 3), direction = Eigen::Matrix2Xd::Zero(2, 3);
    X << 0, 1, 0, 0, 0, 1;
    direction(1, 2) = -0.25; // the upper corner sinks to the base within four steps
    EXPECT_DOUBLE_EQ(largest_step(triangle, X, direction), 4);
    direction(1, 2) = 1;
    EXPECT_EQ(largest_step(triangle, X, direction), std::numeric_limits<double>::infinity());
    // First the area grows: 1 + t - t^2 of it is left.
    direction << 0, 1, 1, 0, 1, 0;
    EXPECT_NEAR(largest_step(triangle, X, direction), (1 + std::sqrt(5)) / 2, 1e-14);
    EXPECT_EQ(flipped_triangles(triangle, X), 0);
    X(1, 2) = -1;
    EXPECT_EQ(flipped_triangles(triangle, X), 1);
}

TEST(InitialGuess, IsAProjectionOnlyForShallowHeightFields)
{
    EXPECT_EQ(guess(shapes::sphere_cap({.half_angle_deg = 40, .triangles = 1000}).mesh).method,
              StartMethod::projection);
    EXPECT_EQ(guess(shapes::lipped_channel({.triangles = 2000}).mesh).method, StartMethod::conformal);
}

TEST(InitialGuess, OfADevelopablePartIsAlreadyItsLayout)
{
    // An isometry is conformal: up to rotation and scale the conformal map is the answer.
    const auto part = shapes::lipped_channel({.triangles = 2000});
    const Eigen::Matrix2Xd X = guess(part.mesh).position;
    EXPECT_EQ(flipped_triangles(part.mesh.triangle, X), 0);
    const double scale = std::sqrt((X.colwise() - X.rowwise().mean()).squaredNorm() /
                                   (part.flat.colwise() - part.flat.rowwise().mean()).squaredNorm());
    EXPECT_NEAR(scale, 1, 0.05);
}

} // namespace spia
