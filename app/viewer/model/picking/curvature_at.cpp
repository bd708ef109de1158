#include "app/viewer/model/picking/curvature_at.h"

#include <algorithm>
#include <set>

#include "engine/core/error.h"
#include "engine/core/small_dense.h"

namespace spia::viewer {
namespace {

using Eigen::Vector3d;

std::set<int> vertices_of(const TriMesh& mesh, const FaceSet& faces)
{
    std::set<int> vertices;
    for (const int f : faces)
        for (const int v : mesh.triangle.col(f))
            vertices.insert(v);
    return vertices;
}

Vector3d normal_of(const TriMesh& mesh, const FaceSet& faces)
{
    Vector3d sum = Vector3d::Zero();
    for (const int f : faces) {
        const Eigen::Matrix3d c = mesh.position(Eigen::all, mesh.triangle.col(f));
        sum += (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0));
    }
    return sum.normalized();
}

} // namespace

CurvatureAt curvature_at(const TriMesh& mesh, int face, const Vector3d& place, const FaceSet& region)
{
    constexpr size_t enough = 15; // vertices: more than twice the six numbers of the quadric
    FaceSet patch{face};
    std::set<int> vertices;
    while (vertices.size() < enough) {
        FaceSet wider, inside = grown(mesh, patch);
        std::set_intersection(inside.begin(), inside.end(), region.begin(), region.end(), std::back_inserter(wider));
        if (wider.size() <= patch.size()) // the region ends
            break;
        patch = std::move(wider);
        vertices = vertices_of(mesh, patch);
    }
    constexpr size_t least = 7;
    if (vertices.size() < least)
        throw InputError("The mesh is too coarse here to say how it bends: there are fewer than 7 vertices around this "
                         "point. Measure the circle through three points instead.");
    CurvatureAt found;
    found.vertices = int(vertices.size());
    const Vector3d z = normal_of(mesh, patch), x = z.unitOrthogonal(), y = z.cross(x);
    for (const int v : vertices)
        found.reach_mm = std::max(found.reach_mm, (mesh.position.col(v) - place).norm());
    // In lengths of the patch, so that the columns are of one size.
    const double unit = found.reach_mm;
    Eigen::MatrixXd A(Eigen::Index(vertices.size()), 6);
    Eigen::VectorXd height(A.rows());
    Eigen::Index row = 0;
    for (const int v : vertices) {
        const Vector3d at = (mesh.position.col(v) - place) / unit;
        const double u = x.dot(at), w = y.dot(at);
        A.row(row) << u * u, u * w, w * w, u, w, 1;
        height[row++] = z.dot(at);
    }
    const Eigen::VectorXd q = shortest_least_squares(A, height);
    found.distance_mm = unit * (A * q - height).cwiseAbs().maxCoeff();
    // Shape operator of the graph of the quadric at the place.
    const double zx = q[3], zy = q[4], root = std::sqrt(1 + zx * zx + zy * zy);
    Eigen::Matrix2d first, second;
    first << 1 + zx * zx, zx * zy, zx * zy, 1 + zy * zy;
    second << 2 * q[0], q[1], q[1], 2 * q[2];
    second /= root * unit;
    const EigenPairs<2> metric = eigen_pairs(first);
    const Eigen::Matrix2d unit_tangents =
        metric.vector * metric.value.cwiseSqrt().cwiseInverse().asDiagonal() * metric.vector.transpose();
    const EigenPairs<2> principal = eigen_pairs(unit_tangents * second * unit_tangents);
    const Eigen::Vector2d k = principal.value;
    const int strong = std::abs(k[0]) >= std::abs(k[1]) ? 0 : 1;
    found.curvature = {k[strong], k[1 - strong]};
    const Eigen::Vector2d way = unit_tangents * principal.vector.col(strong);
    found.place = place + unit * q[5] * z;
    found.normal = (z - zx * x - zy * y).normalized();
    found.across = (way[0] * (x + zx * z) + way[1] * (y + zy * z)).normalized();
    return found;
}

} // namespace spia::viewer
