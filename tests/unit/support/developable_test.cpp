#include "tests/support/developable.h"

#include "tests/unit/support/expectations.h"

namespace spia::shapes {
namespace {

using std::numbers::pi;

void expect_exactly_developable(const DevelopablePart& part, int triangles)
{
    expect_count(part.mesh, triangles, 0.05);
    expect_topology(part.mesh, 1, 1);
    expect_well_shaped(part.mesh, 0, 20);
    EXPECT_LT(largest_angle_defect(part.mesh), 1e-12 * 2 * pi);

    TriMesh flat = part.mesh;
    flat.position.topRows(2) = part.flat;
    flat.position.row(2).setZero();
    const Eigen::VectorXd on_part = edge_lengths(part.mesh);
    EXPECT_LT((on_part - edge_lengths(flat)).cwiseAbs().maxCoeff(), 1e-12 * bounding_diagonal(part.mesh));
    EXPECT_GT(least_upward(flat), 0) << "a flat triangle is turned over";
}

TEST(Developable, FlatPositionsAreIsometricToThePart)
{
    for (int n : {2000, 50000}) {
        expect_exactly_developable(quarter_cylinder({.triangles = n}), n);
        expect_exactly_developable(cone_sector({.triangles = n}), n);
        expect_exactly_developable(hat_channel({.triangles = n}), n);
        expect_exactly_developable(lipped_channel({.triangles = n}), n);
    }
}

TEST(Developable, QuarterCylinderUnrollsToItsArc)
{
    const DevelopablePart part = quarter_cylinder({.radius = 50, .length = 80, .triangles = 40000});
    EXPECT_NEAR(part.flat.row(0).maxCoeff(), 50 * pi / 2, 1e-3);
    EXPECT_EQ(part.flat.row(1).maxCoeff(), 80);
    EXPECT_NEAR(area(part.mesh), 50 * pi / 2 * 80, 0.1);
    const Eigen::Vector3d outwards = area_vectors(part.mesh).rowwise().sum();
    EXPECT_GT(outwards.x(), 0); // the convex side of x > 0, z > 0
    EXPECT_GT(outwards.z(), 0);
}

TEST(Developable, ConeSectorUnrollsToARingSector)
{
    const ConeSector shape{.near = 60, .far = 140, .half_angle_deg = 30, .sector_deg = 180, .triangles = 40000};
    const DevelopablePart part = cone_sector(shape);
    EXPECT_NEAR(area(part.mesh), (140 * 140 - 60 * 60) * pi / 4,
                1.0); // unrolled angle: 180 sin 30 = 90 degrees
    EXPECT_NEAR(part.flat.colwise().norm().minCoeff(), 60, 1e-12);
    EXPECT_NEAR(part.flat.colwise().norm().maxCoeff(), 140, 1e-12);
    EXPECT_LT((part.flat.colwise().norm() - part.mesh.position.colwise().norm()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Developable, ChannelsEndFlatAgain)
{
    const DevelopablePart hat = hat_channel();
    const Eigen::Matrix3Xd normal = area_vectors(hat.mesh).colwise().normalized();
    EXPECT_NEAR(normal(2, 0), 1, 1e-12);
    EXPECT_NEAR(normal(2, normal.cols() - 1), 1, 1e-12);
    EXPECT_NEAR(hat.mesh.position.row(2).maxCoeff(), 2 * 8 + 35, 1e-12);

    const DevelopablePart lipped = lipped_channel({.triangles = 60000});
    const Eigen::Matrix3Xd turned = area_vectors(lipped.mesh).colwise().normalized();
    EXPECT_LT(turned.row(2).minCoeff(), -0.99) << "the inner flanges look down";
    EXPECT_NEAR(lipped.flat.row(0).maxCoeff(), 60 + 2 * (40 + 12 + 8) + 6 * 6 * pi / 2, 0.5);
    const Eigen::Vector3d size = lipped.mesh.position.rowwise().maxCoeff() - lipped.mesh.position.rowwise().minCoeff();
    EXPECT_NEAR(size.x(), 60 + 2 * 6, 1e-9);
    EXPECT_NEAR(size.z(), 40 + 2 * 6, 1e-9);
}

TEST(Developable, PerforatedChannelIsIsometricUpToTheChordError)
{
    std::vector<double> h, error;
    for (int n : {4000, 16000, 64000}) {
        const DevelopablePart part = perforated_channel({.channel = {.triangles = n}});
        expect_count(part.mesh, n);
        expect_topology(part.mesh, 10, -8);
        expect_well_shaped(part.mesh, 0, 20);
        TriMesh flat = part.mesh;
        flat.position.topRows(2) = part.flat;
        flat.position.row(2).setZero();
        EXPECT_GT(least_upward(flat), 0) << "a flat triangle is turned over";
        const Eigen::ArrayXd in_plane = edge_lengths(flat);
        EXPECT_TRUE((edge_lengths(part.mesh).array() <= in_plane + 1e-9).all()) << "a chord is longer than its arc";
        h.push_back(mean_edge(part.mesh));
        error.push_back((1 - edge_lengths(part.mesh).array() / in_plane).maxCoeff());
    }
    EXPECT_NEAR(convergence_order(h, error), 2, 0.3);
}

} // namespace
} // namespace spia::shapes
