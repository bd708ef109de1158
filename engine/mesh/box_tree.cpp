#include "engine/mesh/box_tree.h"

#include <algorithm>
#include <fmt/core.h>
#include <numeric>

#include "engine/core/error.h"

namespace spia {
namespace {

void require_usable(const TriMesh& mesh)
{
    if (mesh.triangles() == 0)
        throw InputError("a mesh without faces cannot be searched; read or mesh the part again");
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.triangle(k, f);
            if (v < 0 || v >= mesh.vertices())
                throw InputError(fmt::format("face {} names vertex {}, but there are {} vertices; mend the mesh there",
                                             f, v, mesh.vertices()));
            if (!mesh.position.col(v).allFinite())
                throw InputError(fmt::format("vertex {} of face {} has a coordinate that is not a number; mend the "
                                             "mesh there",
                                             v, f));
        }
}

/// One face while the tree is built; in the order of the leaves at the end.
struct Entry {
    Eigen::AlignedBox3d box;
    Eigen::Vector3d middle; ///< of the box
    int face;
};

void build(BoxTree& tree, std::vector<Entry>& entry, int from, int to)
{
    const size_t self = tree.node.size();
    tree.node.emplace_back();
    Eigen::AlignedBox3d whole, middles;
    for (int i = from; i < to; ++i) {
        whole.extend(entry[size_t(i)].box);
        middles.extend(entry[size_t(i)].middle);
    }
    tree.node[self].box = whole;
    if (to - from <= BoxTree::leaf_size) {
        tree.node[self].first = from;
        tree.node[self].count = to - from;
        return;
    }
    Eigen::Index axis;
    middles.sizes().maxCoeff(&axis);
    const int half = from + (to - from) / 2;
    std::nth_element(
        entry.begin() + from, entry.begin() + half, entry.begin() + to, [&](const Entry& a, const Entry& b) {
            return a.middle[axis] < b.middle[axis] || (a.middle[axis] == b.middle[axis] && a.face < b.face);
        });
    build(tree, entry, from, half);
    tree.node[self].second = int(tree.node.size());
    build(tree, entry, half, to);
}

} // namespace

BoxTree::BoxTree(const TriMesh& mesh)
{
    require_usable(mesh);
    std::vector<Entry> entry(size_t(mesh.triangles()));
    for (int f = 0; f < mesh.triangles(); ++f) {
        Entry& e = entry[size_t(f)];
        for (const int v : mesh.triangle.col(f))
            e.box.extend(mesh.position.col(v));
        e.middle = e.box.center();
        e.face = f;
    }
    node.reserve(entry.size());
    build(*this, entry, 0, mesh.triangles());
    face.resize(entry.size());
    triangle.resize(entry.size());
    for (size_t i = 0; i < entry.size(); ++i) {
        face[i] = entry[i].face;
        for (int k = 0; k < 3; ++k)
            triangle[i].col(k) = mesh.position.col(mesh.triangle(k, face[i]));
    }
}

} // namespace spia
