#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/mesh/halfedges.h"
#include "engine/mesh/topology.h"
#include "tests/support/mesh_tools.h"

/// What several test files of sample parts look at.
namespace spia::shapes {

inline int euler_characteristic(const TriMesh& mesh)
{
    return mesh.vertices() - int(edge_lengths(mesh).size()) + mesh.triangles();
}

/// A proper surface (halfedges() throws otherwise) with this many boundary loops and this Euler
/// characteristic.
inline void expect_topology(const TriMesh& mesh, size_t loops, int euler)
{
    ASSERT_NO_THROW(halfedges(mesh));
    EXPECT_EQ(boundary_loops(mesh).size(), loops);
    EXPECT_EQ(euler_characteristic(mesh), euler);
}

inline void expect_count(const TriMesh& mesh, int wanted, double tolerance = 0.1)
{
    EXPECT_NEAR(mesh.triangles(), wanted, tolerance * wanted);
}

/// At most `share` of the faces have an angle below 20 degrees, and none is below `least_deg`.
inline void expect_well_shaped(const TriMesh& mesh, double share, double least_deg)
{
    const Eigen::VectorXd angle = least_angles(mesh) * 180 / std::numbers::pi;
    EXPECT_LE(share_below(angle, 20), share) << "smallest " << angle.minCoeff();
    EXPECT_GE(angle.minCoeff(), least_deg);
}

/// The least z of the faces' unit normals: positive for a height field, 0 with vertical walls,
/// negative with undercuts.
inline double least_upward(const TriMesh& mesh)
{
    const Eigen::Matrix3Xd normal = area_vectors(mesh).colwise().normalized();
    return normal.row(2).minCoeff();
}

inline std::vector<bool> on_boundary(const TriMesh& mesh)
{
    std::vector<bool> boundary(mesh.vertices(), false);
    for (const auto& loop : boundary_loops(mesh))
        for (int v : loop)
            boundary[v] = true;
    return boundary;
}

/// max |sum of angles - 2 pi| over inner vertices
inline double largest_angle_defect(const TriMesh& mesh)
{
    const Eigen::VectorXd sum = angle_sums(mesh);
    const std::vector<bool> boundary = on_boundary(mesh);
    double largest = 0;
    for (int v = 0; v < mesh.vertices(); ++v)
        if (!boundary[v])
            largest = std::max(largest, std::abs(sum[v] - 2 * std::numbers::pi));
    return largest;
}

} // namespace spia::shapes
