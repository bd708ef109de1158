#include "engine/remesh/two_way_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/mesh/topology.h"
#include "engine/remesh/incremental.h"
#include "tests/support/samples.h"
#include "tests/support/shapes.h"
#include "tests/unit/remesh/same_size.h"

namespace spia {
namespace {

/// No place drawn at random is farther from the other mesh than the bound of its face.
void expect_bounds_hold(const MeshDistance& distance, const TriMesh& from, const ClosestPointSearch& to)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0, 1);
    for (int f = 0; f < from.triangles(); ++f) {
        double a = share(random), b = share(random);
        if (a + b > 1)
            a = 1 - a, b = 1 - b;
        const Eigen::Matrix3d t = from.position(Eigen::all, from.triangle.col(f));
        const double away = to.nearest(t * Eigen::Vector3d(1 - a - b, a, b)).distance;
        ASSERT_LE(away, distance.of_face[f] * (1 + 1e-9) + 1e-12) << f;
    }
}

/// After every change a new measure of all is the independent truth for what only measures again
/// what is near to the change.
TEST(TwoWayDistance, AfterChangesItIsWhatMeasuringAllAgainGives)
{
    std::mt19937 random(8);
    for (const char* name : {"dome", "hat-channel", "inner-panel", "fender"}) {
        const TriMesh part = shapes::sample(name).make(3000);
        const double diagonal = bounding_diagonal(part), size = diagonal / 25, tolerance = diagonal / 2000;
        const KeptLines lines = kept_lines(part, {}, 0.5, 0.1, size);
        const ClosestPointSearch search(part);
        const SizeField sizes = shapes::same_size(part, size);
        IncrementalRemesh remesh(part, lines, sizes, search, {5 * tolerance});
        remesh.run();
        TwoWayDistance distance(part, search, tolerance);
        for (int change = 0; change < 5; ++change) {
            const IncrementalRemesh::Snapshot snapshot = remesh.snapshot();
            distance.measure(snapshot.mesh, snapshot.was);
            TwoWayDistance whole(part, search, tolerance);
            whole.measure(snapshot.mesh, std::vector<int>(snapshot.was.size(), -1));
            EXPECT_NEAR(distance.seen(), whole.seen(), 0.11 * whole.seen() + 0.1 * tolerance) << name << change;
            EXPECT_NEAR(distance.bound(), whole.bound(), 0.11 * whole.bound() + 0.1 * tolerance) << name << change;
            expect_bounds_hold(distance.to_part(), snapshot.mesh, search);
            expect_bounds_hold(distance.from_part(), part, distance.on_mesh());
            for (int f = 0; f < snapshot.mesh.triangles(); ++f)
                EXPECT_EQ(distance.to_part().nearest[size_t(f)], whole.to_part().nearest[size_t(f)]);
            const auto same = std::count_if(snapshot.was.begin(), snapshot.was.end(), [](int was) { return was >= 0; });
            EXPECT_EQ(same > 0, change > 0);
            Eigen::VectorXd share = Eigen::VectorXd::Ones(snapshot.mesh.vertices());
            for (int k = 0; k < 3; ++k)
                share[Eigen::Index(random() % unsigned(snapshot.mesh.vertices()))] = 0.4;
            remesh.refine(share, size / 50, 0.35);
        }
    }
}

} // namespace
} // namespace spia
