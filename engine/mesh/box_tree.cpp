#include "engine/mesh/box_tree.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <utility>

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

/// One face or piece of it while the tree is built; in the order of the leaves at the end.
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

/// The longest edge and the height over it.
std::pair<double, double> extents_of(const Eigen::Matrix3d& t)
{
    double longest = 0;
    for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (t.col((k + 1) % 3) - t.col(k)).norm());
    const double twice_area = (t.col(1) - t.col(0)).cross(t.col(2) - t.col(0)).norm();
    return {longest, longest > 0 ? twice_area / longest : 0};
}

/// Pieces longer than that are halved.
double most_length(double height, double least)
{
    constexpr double askew_enough = 4; // of the height: then a box is mostly empty
    return std::max(askew_enough * height, least);
}

/// The least length of pieces for which there are few enough of them.
double least_length(const TriMesh& mesh)
{
    const double faces = mesh.triangles();
    const double most_pieces = std::max(8 * faces, 100'000.0); // halving makes up to twice as many as lengths alone
    double area = 0;
    std::vector<std::pair<double, double>> extents;
    for (int f = 0; f < mesh.triangles(); ++f) {
        extents.push_back(extents_of(mesh.position(Eigen::all, mesh.triangle.col(f))));
        area += extents.back().first * extents.back().second / 2;
    }
    const auto pieces = [&](double least) {
        double sum = 0;
        for (const auto& [length, height] : extents)
            sum += length > 0 ? std::max(1.0, length / most_length(height, least)) : 1;
        return sum;
    };
    double least = std::sqrt(area / faces) / 4;
    if (!(least > 0))
        return std::numeric_limits<double>::infinity();
    while (pieces(least) > most_pieces)
        least *= 2;
    return least;
}

/// @param slack  what rounding can have moved the middles of edges by
void add_pieces(const Eigen::Matrix3d& piece, double longest, double slack, int face, std::vector<Entry>& entry)
{
    for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3;
        const double length = (piece.col(l) - piece.col(k)).norm();
        if (length <= longest || length < extents_of(piece).first)
            continue;
        for (const int replaced : {k, l}) {
            Eigen::Matrix3d half = piece;
            half.col(replaced) = (piece.col(k) + piece.col(l)) / 2;
            constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
            add_pieces(half, longest, rounding * piece.cwiseAbs().maxCoeff(), face, entry);
        }
        return;
    }
    Entry& e = entry.emplace_back();
    for (int k = 0; k < 3; ++k)
        e.box.extend(piece.col(k));
    e.box.min().array() -= slack;
    e.box.max().array() += slack;
    e.middle = e.box.center();
    e.face = face;
}

} // namespace

BoxTree::BoxTree(const TriMesh& mesh, Boxes boxes)
{
    require_usable(mesh);
    const double least = boxes == Boxes::pieces ? least_length(mesh) : std::numeric_limits<double>::infinity();
    std::vector<Entry> entry;
    entry.reserve(size_t(mesh.triangles()));
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Eigen::Matrix3d corners = mesh.position(Eigen::all, mesh.triangle.col(f));
        add_pieces(corners, most_length(extents_of(corners).second, least), 0, f, entry);
    }
    node.reserve(entry.size());
    build(*this, entry, 0, int(entry.size()));
    face.resize(entry.size());
    triangle.resize(entry.size());
    for (size_t i = 0; i < entry.size(); ++i) {
        face[i] = entry[i].face;
        for (int k = 0; k < 3; ++k)
            triangle[i].col(k) = mesh.position.col(mesh.triangle(k, face[i]));
    }
}

} // namespace spia
