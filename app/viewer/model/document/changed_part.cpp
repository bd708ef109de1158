#include "app/viewer/model/document/changed_part.h"

#include <algorithm>
#include <set>

#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

constexpr double reach_of_diagonal = 0.01; ///< how far a surface may have moved and still be the
                                           ///< same place
constexpr double beside_of_edge = 0.05;    ///< of its mean edge, how far a face's middle may lie
                                           ///< beside a patch
constexpr double least_cosine = 0.5;       ///< 60 degrees between the normals of one place: coarse
                                           ///< faces cut across a bend

} // namespace

Eigen::Matrix3d corners_of(const TriMesh& mesh, int triangle)
{
    return mesh.position(Eigen::all, mesh.triangle.col(triangle));
}

Eigen::Vector3d unit_normal(const Eigen::Matrix3d& corners)
{
    return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
}

ChangedPart::ChangedPart(const TriMesh& mesh, const ClosestPointSearch& search)
    : mesh_(mesh), search_(search), reach_(reach_of_diagonal * bounding_diagonal(mesh))
{
}

ClosestPoint ChangedPart::find(const Eigen::Vector3d& at, const Eigen::Vector3d& normal) const
{
    ClosestPoint found = search_.nearest(at, reach_);
    if (found.face >= 0 && !(unit_normal(corners_of(mesh_, found.face)).dot(normal) >= least_cosine))
        found.face = -1;
    return found;
}

std::vector<int> ChangedPart::find(const StoredPatch& patch, int& lost, Eigen::Vector3d& where) const
{
    lost = 0;
    const TriMesh old{patch.point, patch.triangle};
    std::set<int> found, next; // faces in the patch; nearest to the triangles of the patch
    for (int t = 0; t < old.triangles(); ++t) {
        const Eigen::Matrix3d corners = corners_of(old, t);
        const Eigen::Vector3d middle = corners.rowwise().mean();
        const ClosestPoint place = find(middle, unit_normal(corners));
        if (place.face >= 0)
            next.insert(place.face);
        else if (lost++ == 0)
            where = middle;
    }
    if (old.triangles() == 0)
        return {};
    const ClosestPointSearch patch_search(old);
    const Eigen::AlignedBox3d near(old.position.rowwise().minCoeff().array() - reach_,
                                   old.position.rowwise().maxCoeff().array() + reach_);
    for (int f = 0; f < mesh_.triangles(); ++f) {
        const Eigen::Matrix3d corners = corners_of(mesh_, f);
        if (near.contains(corners.rowwise().mean()) && lies_on(old, patch_search, corners))
            found.insert(f);
    }
    if (found.empty()) // the new faces are larger than the whole patch
        found = std::move(next);
    return {found.begin(), found.end()};
}

int ChangedPart::find_corner(const Eigen::Vector3d& at) const { return find_on(boundary_loops(mesh_)[0], at); }

int ChangedPart::find_vertex(const StoredVertex& old) const
{
    int found = -1;
    const auto take = [&](int v) {
        if (v >= 0 &&
            (found < 0 || (mesh_.position.col(v) - old.at).norm() < (mesh_.position.col(found) - old.at).norm()))
            found = v;
    };
    if (old.boundary)
        for (const std::vector<int>& loop : loops())
            take(find_on(loop, old.at));
    else if (const int face = find(old.at, old.normal).face; face >= 0)
        for (const int v : mesh_.triangle.col(face))
            take(v);
    return found;
}

const std::vector<std::vector<int>>& ChangedPart::loops() const
{
    if (!loops_)
        loops_ = boundary_loops(mesh_);
    return *loops_;
}

int ChangedPart::find_on(const std::vector<int>& loop, const Eigen::Vector3d& at) const
{
    const auto distance = [&](int v) { return (mesh_.position.col(v) - at).norm(); };
    const auto nearest =
        std::min_element(loop.begin(), loop.end(), [&](int a, int b) { return distance(a) < distance(b); });
    const int next = nearest + 1 == loop.end() ? loop.front() : *(nearest + 1);
    const double edge = (mesh_.position.col(next) - mesh_.position.col(*nearest)).norm();
    return distance(*nearest) <= std::max(reach_, edge) ? *nearest : -1;
}

bool ChangedPart::lies_on(const TriMesh& old, const ClosestPointSearch& search, const Eigen::Matrix3d& corners) const
{
    const Eigen::Vector3d middle = corners.rowwise().mean();
    const ClosestPoint place = search.nearest(middle, reach_);
    if (place.face < 0)
        return false;
    const Eigen::Vector3d normal = unit_normal(corners);
    if (!(normal.dot(unit_normal(corners_of(old, place.face))) >= least_cosine))
        return false;
    const Eigen::Vector3d off = middle - place.position;
    const double beside = (off - off.dot(normal) * normal).norm();
    const double edge = ((corners.col(1) - corners.col(0)).norm() + (corners.col(2) - corners.col(1)).norm() +
                         (corners.col(0) - corners.col(2)).norm()) /
                        3;
    return beside <= beside_of_edge * edge;
}

} // namespace spia::viewer
