#include "engine/remesh/two_way_distance.h"

#include <Eigen/Geometry>

#include "engine/core/parallel.h"
#include "engine/mesh/box_tree.h"

namespace spia {
namespace {

constexpr double precision = 0.1; // of the tolerance

/// What the faces that are the same say.
MeshDistance carried_over(const MeshDistance& before, const std::vector<int>& was)
{
    const Eigen::Index faces = Eigen::Index(was.size());
    MeshDistance result;
    result.of_face = result.seen_of_face = Eigen::VectorXd::Zero(faces);
    result.place = Eigen::Matrix3Xd::Zero(3, faces);
    result.nearest.assign(was.size(), -1);
    for (Eigen::Index f = 0; f < faces; ++f) {
        const int old = was[size_t(f)];
        if (old < 0)
            continue;
        result.of_face[f] = before.of_face[old];
        result.seen_of_face[f] = before.seen_of_face[old];
        result.place.col(f) = before.place.col(old);
        result.nearest[size_t(f)] = before.nearest[size_t(old)];
    }
    return result;
}

/// The faces of both meshes that are not the same in the other one.
TriMesh differences(const TriMesh& before, const TriMesh& after, const std::vector<int>& was)
{
    std::vector<char> stays(size_t(before.triangles()), 0);
    std::vector<Eigen::Vector3i> face;
    for (int f = 0; f < after.triangles(); ++f)
        if (const int old = was[size_t(f)]; old >= 0)
            stays[size_t(old)] = 1;
        else
            face.push_back(after.triangle.col(f).array() + before.vertices());
    for (int f = 0; f < before.triangles(); ++f)
        if (!stays[size_t(f)])
            face.push_back(before.triangle.col(f));
    TriMesh result{Eigen::Matrix3Xd(3, before.vertices() + after.vertices()), Eigen::Matrix3Xi(3, face.size())};
    result.position << before.position, after.position;
    for (size_t f = 0; f < face.size(); ++f)
        result.triangle.col(Eigen::Index(f)) = face[f];
    return result;
}

bool meets(const BoxTree& tree, int k, const Eigen::AlignedBox3d& box)
{
    const BoxTree::Node& node = tree.node[size_t(k)];
    return node.box.intersects(box) && (node.count > 0 || meets(tree, k + 1, box) || meets(tree, node.second, box));
}

/// Of each face of a part whether something has changed no farther from it than its bound: only
/// that can have been nearest to it.
std::vector<char> faces_near(const TriMesh& part, const Eigen::VectorXd& bound, const TriMesh& changed)
{
    std::vector<char> near(size_t(part.triangles()), 0);
    if (changed.triangles() == 0)
        return near;
    const BoxTree tree(changed);
    parallel_for(part.triangles(), [&](int f) {
        Eigen::AlignedBox3d box;
        for (const int v : part.triangle.col(f))
            box.extend(part.position.col(v));
        box.min().array() -= bound[f];
        box.max().array() += bound[f];
        near[size_t(f)] = meets(tree, 0, box);
    });
    return near;
}

} // namespace

TwoWayDistance::TwoWayDistance(const TriMesh& part, const ClosestPointSearch& search, double tolerance)
    : part_(part), search_(search), tolerance_(tolerance)
{
}

void TwoWayDistance::measure(const TriMesh& mesh, const std::vector<int>& was, const Progress& progress)
{
    std::vector<char> again(was.size(), 0);
    for (size_t f = 0; f < was.size(); ++f)
        again[f] = was[f] < 0;
    on_mesh_.emplace(mesh);
    const double sharp = precision * tolerance_;
    to_part_ = carried_over(to_part_, was);
    measure_again(to_part_, again, mesh, part_, search_, sharp, tolerance_, progress.part(0, 0.5));
    if (mesh_.triangles() == 0)
        from_part_ = farthest(part_, mesh, *on_mesh_, sharp, tolerance_, progress.part(0.5, 1));
    else {
        std::vector<char> near = faces_near(part_, from_part_.of_face, differences(mesh_, mesh, was));
        for (int f = 0; f < part_.triangles(); ++f)
            near[size_t(f)] = near[size_t(f)] || from_part_.of_face[f] > tolerance_;
        from_part_.nearest.assign(from_part_.nearest.size(), -1); // numbers of the mesh that was
        measure_again(from_part_, near, part_, mesh, *on_mesh_, sharp, tolerance_, progress.part(0.5, 1));
    }
    mesh_ = mesh;
}

} // namespace spia
