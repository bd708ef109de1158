// ARAP and SLIM.
#include <gtest/gtest.h>
#include <random>

#include "engine/compare/arap.h"
#include "engine/compare/map_quality.h"
#include "engine/compare/slim.h"
#include "engine/core/error.h"
#include "engine/forming/solver/energy_stage.h"
#include "engine/mesh/topology.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/unit/compare/layouts.h"

namespace spia {
namespace {

double energy(const TriMesh& part, const Eigen::Matrix2Xd& flat, double (*density)(const Eigen::Matrix2d&))
{
    double sum = 0;
    const auto element = elements(part);
    for (int f = 0; f < part.triangles(); ++f)
        sum += element[size_t(f)].area *
               density(inverse_gradient(element[size_t(f)], corners(flat, part.triangle.col(f))));
    return sum;
}

/// The largest slope of the energy over the mean edge, by central differences, as a share of the
/// part's area.
double largest_slope(const TriMesh& part, const Eigen::Matrix2Xd& flat, double (*density)(const Eigen::Matrix2d&))
{
    const double step = 1e-4;
    double largest = 0;
    for (Eigen::Index i = 0; i < flat.size(); ++i) {
        Eigen::Matrix2Xd up = flat, down = flat;
        up(i) += step;
        down(i) -= step;
        largest = std::max(largest, std::abs(energy(part, up, density) - energy(part, down, density)) / (2 * step));
    }
    return largest * shapes::mean_edge(part) / area(part);
}

void expect_falling(const std::vector<double>& energy)
{
    ASSERT_GT(energy.size(), 3u);
    for (size_t i = 1; i < energy.size(); ++i)
        EXPECT_LT(energy[i], energy[i - 1]) << "step " << i;
}

/// A start without flips, with stretches of 0.3 to 3.
Eigen::Matrix2Xd far_start(const TriMesh& part)
{
    Eigen::Matrix2Xd X = part.position.topRows<2>();
    X.row(0) *= 2.5;
    X.row(1) *= 0.4;
    return X;
}

/// A start without flips whose middle columns are crushed to a hundredth: full steps from it turn
/// triangles over.
Eigen::Matrix2Xd crushed(const TriMesh& part)
{
    Eigen::Matrix2Xd X = part.position.topRows<2>();
    X.colwise() -= X.rowwise().mean().eval();
    X.row(0) = X.row(0).array() * (0.001 + X.row(0).array().square());
    X.row(0) *= 30 / X.row(0).maxCoeff();
    return X;
}

constexpr IsometricOptions thorough{.most_steps = 3000, .decrease = 1e-13, .nothing = 1e-20};

} // namespace

TEST(Arap, DensityIsTheSquaredDistanceFromTheNearestRotation)
{
    Eigen::Matrix2d turn, J;
    turn << 0.6, -0.8, 0.8, 0.6;
    J << 1.5, 0, 0, 0.7;
    EXPECT_NEAR(arap_density(turn * J), 0.25 + 0.09, 1e-15);
    EXPECT_NEAR(arap_density(turn * J * turn), 0.25 + 0.09, 1e-15);
    J << 1.5, 0, 0, -0.7; // turned over: the nearest rotation leaves (1.5 - 1)^2 + (-0.7 - 1)^2
    EXPECT_NEAR(arap_density(turn * J), 0.25 + 2.89, 1e-15);
    EXPECT_NEAR(arap_density(turn), 0, 1e-30);
}

TEST(Slim, DensityIsThatOfSymmetricDirichlet)
{
    Eigen::Matrix2d turn, J;
    turn << 0.6, -0.8, 0.8, 0.6;
    J << 2, 0, 0, 0.5;
    EXPECT_NEAR(symmetric_dirichlet_density(turn * J * turn), 4 + 0.25 + 0.25 + 4, 1e-13);
    EXPECT_NEAR(symmetric_dirichlet_density(turn), 4, 1e-14);
    J(1, 1) = -0.5;
    EXPECT_EQ(symmetric_dirichlet_density(J), std::numeric_limits<double>::infinity());
    J(1, 1) = 0;
    EXPECT_EQ(symmetric_dirichlet_density(J), std::numeric_limits<double>::infinity());
}

TEST(Arap, LowersItsEnergyInEveryStep)
{
    const TriMesh part = bumpy_plate();
    const FlatMap map = arap(part, {}, {}, far_start(part));
    expect_falling(map.energy);
    EXPECT_NEAR(map.energy.back(), energy(part, map.position, arap_density), 1e-10 * area(part));
    expect_falling(arap(shapes::dome({.triangles = 2000}).mesh, {.decrease = 1e-9}).energy);
}

TEST(Arap, EndsWhereItsEnergyHasNoSlope)
{
    const TriMesh part = bumpy_disk();
    EXPECT_GT(largest_slope(part, far_start(part), arap_density), 0.01);
    EXPECT_LT(largest_slope(part, arap(part, thorough).position, arap_density), 1e-7);
}

TEST(Slim, NeverFlipsAndLowersItsEnergyInEveryStep)
{
    const TriMesh part = bumpy(shapes::rectangle(60, 45, 32, 24), 6);
    const Eigen::Matrix2Xd start = crushed(part);
    ASSERT_EQ(flipped_triangles(part.triangle, start), 0);
    IsometricOptions options = slim_options;
    for (options.most_steps = 1; options.most_steps <= 12; ++options.most_steps)
        EXPECT_EQ(flipped_triangles(part.triangle, slim(part, options, {}, start).position), 0);
    options.most_steps = 300;
    const FlatMap map = slim(part, options, {}, start);
    expect_falling(map.energy);
    EXPECT_NEAR(map.energy.back(), energy(part, map.position, symmetric_dirichlet_density), 1e-10 * area(part));
    expect_falling(slim(shapes::dome({.triangles = 2000}).mesh).energy);
}

TEST(Slim, EndsWhereItsEnergyHasNoSlope)
{
    const TriMesh part = bumpy_disk();
    EXPECT_GT(largest_slope(part, far_start(part), symmetric_dirichlet_density), 0.01);
    EXPECT_LT(largest_slope(part, slim(part, thorough).position, symmetric_dirichlet_density), 1e-6);
}

TEST(Slim, ReachesTheSameMapFromFarAndNear)
{
    const TriMesh part = bumpy_disk();
    const Eigen::Matrix2Xd near = slim(part, thorough).position,
                           far = slim(part, thorough, {}, far_start(part)).position;
    EXPECT_LT(distance_up_to_similarity(near, far), 1e-5);
}

TEST(Slim, RefusesAStartWithFlips)
{
    const TriMesh part = bumpy_disk();
    Eigen::Matrix2Xd start = far_start(part);
    start.row(0) *= -1;
    EXPECT_THROW(slim(part, slim_options, {}, start), InputError);
}

TEST(IsometricMaps, OfDevelopablePartsHaveNoDistortion)
{
    for (const auto& part : {shapes::quarter_cylinder({.triangles = 1000}), shapes::cone_sector({.triangles = 1000}),
                             shapes::lipped_channel({.triangles = 1500})}) {
        for (const FlatMap& map : {arap(part.mesh), slim(part.mesh)}) {
            const MapQuality q = map_quality(part.mesh, map.position);
            EXPECT_LT(q.angular_rms, 1e-6);
            EXPECT_LT(q.area_rms, 1e-6);
            EXPECT_NEAR(q.l2_stretch, 1, 1e-10);
            EXPECT_NEAR(q.symmetric_dirichlet, 4, 1e-10);
            // true to scale
            EXPECT_NEAR(flat_area(part.mesh, map.position), area(part.mesh), 1e-6 * area(part.mesh));
        }
    }
}

} // namespace spia
