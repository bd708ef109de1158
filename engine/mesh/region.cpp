#include "engine/mesh/region.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/core/parallel.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double uneven = 0.1; ///< evenness() of the last faces before a bend is below; inside of
                               ///< one rarely

std::vector<char> flags(const FaceSet& set, int faces)
{
    std::vector<char> result(size_t(faces), 0);
    for (const int f : set)
        result[size_t(f)] = 1;
    return result;
}

FaceSet flagged(const std::vector<char>& flag)
{
    FaceSet result;
    for (size_t f = 0; f < flag.size(); ++f)
        if (flag[f])
            result.push_back(int(f));
    return result;
}

Eigen::Vector3d middle(const TriMesh& mesh, int face)
{
    const auto t = mesh.triangle.col(face);
    return (mesh.position.col(t[0]) + mesh.position.col(t[1]) + mesh.position.col(t[2])) / 3;
}

/// How evenly a face lies in the curvature around it, 0 to 1: the least over the largest angle
/// between its normal and those of its vertices. Near 0 for the last face of a flat piece before a
/// bend: the vertices on the bend line are turned, the third is not. Near 1 within the bend.
double evenness(const TriMesh& mesh, const Eigen::Matrix3Xd& vertex_normal, const Eigen::Vector3d& area_vector,
                int face)
{
    Eigen::Vector3d turned;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d normal = vertex_normal.col(mesh.triangle(k, face));
        turned[k] = std::atan2(area_vector.cross(normal).norm(), area_vector.dot(normal));
    }
    return turned.maxCoeff() > 0 ? turned.minCoeff() / turned.maxCoeff() : 1;
}

/// The larger principal curvature of a face, from how the vertex normals turn along its edges
/// [Rusinkiewicz 2004].
double curvature(const TriMesh& mesh, const Eigen::Matrix3Xd& vertex_normal, const Eigen::Vector3d& area_vector,
                 int face)
{
    const auto t = mesh.triangle.col(face);
    const Eigen::Vector3d normal = area_vector.normalized();
    const Eigen::Vector3d x = (mesh.position.col(t[1]) - mesh.position.col(t[0])).normalized(), y = normal.cross(x);
    // Least squares for the symmetric (e, f, g) that takes each edge to the change of the normal
    // along it.
    Eigen::Matrix<double, 6, 3> A;
    Eigen::Matrix<double, 6, 1> b;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d edge = mesh.position.col(t[(k + 1) % 3]) - mesh.position.col(t[k]);
        const Eigen::Vector3d change = vertex_normal.col(t[(k + 1) % 3]) - vertex_normal.col(t[k]);
        const double along = edge.dot(x), across = edge.dot(y);
        A.row(2 * k) << along, across, 0;
        A.row(2 * k + 1) << 0, along, across;
        b[2 * k] = change.dot(x);
        b[2 * k + 1] = change.dot(y);
    }
    const Eigen::Vector3d form = (A.transpose() * A).ldlt().solve(A.transpose() * b);
    const double mean = (form[0] + form[2]) / 2, spread = std::hypot((form[0] - form[2]) / 2, form[1]);
    const double result = std::abs(mean) + spread;
    return std::isfinite(result) ? result : 0; // a face without area has no curvature of its own
}

} // namespace

FaceSet united(const FaceSet& a, const FaceSet& b)
{
    FaceSet result;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

FaceSet without(const FaceSet& a, const FaceSet& b)
{
    FaceSet result;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

FaceSet inverted(const FaceSet& set, int faces)
{
    std::vector<char> flag = flags(set, faces);
    for (char& f : flag)
        f = !f;
    return flagged(flag);
}

FaceSet grown(const TriMesh& mesh, const FaceSet& set)
{
    std::vector<char> touched(size_t(mesh.vertices()), 0);
    for (const int f : set)
        for (const int v : mesh.triangle.col(f))
            touched[size_t(v)] = 1;
    FaceSet result;
    for (int f = 0; f < mesh.triangles(); ++f)
        if (touched[size_t(mesh.triangle(0, f))] || touched[size_t(mesh.triangle(1, f))] ||
            touched[size_t(mesh.triangle(2, f))])
            result.push_back(f);
    return result;
}

FaceSet shrunk(const TriMesh& mesh, const FaceSet& set)
{
    return inverted(grown(mesh, inverted(set, mesh.triangles())), mesh.triangles());
}

RegionSearch::RegionSearch(const TriMesh& mesh)
    : diagonal_(bounding_diagonal(mesh)), neighbour_(Eigen::Matrix3Xi::Constant(3, mesh.triangles(), -1)),
      angle_(Eigen::Matrix3Xd::Zero(3, mesh.triangles())), edge_curvature_(Eigen::Matrix3Xd::Zero(3, mesh.triangles())),
      face_curvature_(mesh.triangles()), evenness_(mesh.triangles())
{
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin != 2)
            return;
        const EdgeUse &a = uses[begin], &b = uses[begin + 1];
        neighbour_(a.corner, a.face) = b.face;
        neighbour_(b.corner, b.face) = a.face;
    });
    const Eigen::Matrix3Xd face_normal = area_vectors(mesh), vertex_normal = vertex_normals(mesh);
    parallel_for(mesh.triangles(), [&](int f) {
        const Eigen::Vector3d here = face_normal.col(f);
        for (int k = 0; k < 3; ++k) {
            const int g = neighbour_(k, f);
            if (g < 0)
                continue;
            const Eigen::Vector3d there = face_normal.col(g);
            angle_(k, f) = std::atan2(here.cross(there).norm(), here.dot(there));
            edge_curvature_(k, f) = angle_(k, f) / (middle(mesh, g) - middle(mesh, f)).norm();
        }
        face_curvature_[f] = curvature(mesh, vertex_normal, here, f);
        evenness_[f] = evenness(mesh, vertex_normal, here, f);
    });
}

template <class May> FaceSet RegionSearch::reached(int face, const May& may_cross) const
{
    std::vector<char> in(size_t(neighbour_.cols()), 0);
    in[size_t(face)] = 1;
    FaceSet result = {face};
    for (size_t next = 0; next < result.size(); ++next)
        for (int k = 0; k < 3; ++k) {
            const int f = result[next], g = neighbour_(k, f);
            if (g >= 0 && !in[size_t(g)] && may_cross(f, k)) {
                in[size_t(g)] = 1;
                result.push_back(g);
            }
        }
    std::sort(result.begin(), result.end());
    return result;
}

FaceSet RegionSearch::flood(int face, double angle) const
{
    return reached(face, [&](int f, int k) { return angle_(k, f) <= angle; });
}

FaceSet RegionSearch::smooth_region(int face, const SmoothLimits& limits) const
{
    const double bend = limits.bend / diagonal_;
    const auto gentle = [&](int f) { return face_curvature_[f] <= bend || evenness_[f] <= uneven; };
    if (gentle(face))
        return reached(face, [&](int f, int k) {
            return angle_(k, f) <= limits.sharp &&
                   (edge_curvature_(k, f) <= bend || face_curvature_[neighbour_(k, f)] <= bend);
        });
    // One face alone says little on an irregular mesh: the mean with its neighbours on the bend.
    const auto around = [&](int f) {
        double sum = face_curvature_[f];
        int count = 1;
        for (int k = 0; k < 3; ++k)
            if (const int g = neighbour_(k, f); g >= 0 && angle_(k, f) <= limits.sharp && !gentle(g)) {
                sum += face_curvature_[g];
                ++count;
            }
        return sum / count;
    };
    const double here = around(face);
    return reached(face, [&](int f, int k) {
        const int g = neighbour_(k, f);
        if (angle_(k, f) > limits.sharp || gentle(g))
            return false;
        const double there = around(g);
        return there >= limits.likeness * here && there <= here / limits.likeness;
    });
}

} // namespace spia
