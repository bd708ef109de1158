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

constexpr int faces_at_a_time = 16384; // between two checkpoints: some milliseconds
constexpr const char* sorting = "sorting faces by their place";

void build(BoxTree& tree, std::vector<Entry>& entry, int from, int to, const Progress& progress)
{
    if (to - from > faces_at_a_time)
        progress.checkpoint(double(from) / double(entry.size()), sorting);
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
    build(tree, entry, from, half, progress);
    tree.node[self].second = int(tree.node.size());
    build(tree, entry, half, to, progress);
}

/// The longest edge (it ends in the next corner) and the height over it.
struct Extents {
    int longest = 0;
    double length = 0, height = 0;
};

Extents extents_of(const Eigen::Matrix3d& t)
{
    Extents result;
    for (int k = 0; k < 3; ++k)
        if (const double length = (t.col((k + 1) % 3) - t.col(k)).norm(); length > result.length) {
            result.longest = k;
            result.length = length;
        }
    if (result.length > 0)
        result.height = (t.col(1) - t.col(0)).cross(t.col(2) - t.col(0)).norm() / result.length;
    return result;
}

/// Into how many pieces across its longest edge a triangle is cut, none of them shorter than that.
double pieces_of(const Extents& extents, double least)
{
    constexpr double askew_enough = 4; // of the height: then a box is mostly empty
    const double longest = std::max(askew_enough * extents.height, least);
    return longest > 0 ? std::max(1.0, std::ceil(extents.length / longest)) : 1;
}

/// The least length of pieces for which there are few enough of them.
double least_length(const TriMesh& mesh)
{
    const double faces = mesh.triangles(), most_pieces = std::max(8 * faces, 100'000.0);
    double area = 0;
    std::vector<Extents> extents;
    for (int f = 0; f < mesh.triangles(); ++f) {
        extents.push_back(extents_of(mesh.position(Eigen::all, mesh.triangle.col(f))));
        area += extents.back().length * extents.back().height / 2;
    }
    double least = std::sqrt(area / faces) / 4;
    if (!(least > 0) || !std::isfinite(least))
        return std::numeric_limits<double>::infinity();
    const auto pieces = [&] {
        double sum = 0;
        for (const Extents& each : extents)
            sum += pieces_of(each, least);
        return sum;
    };
    while (pieces() > most_pieces)
        least *= 2;
    return least;
}

/// The box of what lies between two shares of the longest edge.
Eigen::AlignedBox3d slab(const Eigen::Matrix3d& t, int longest, double from, double to)
{
    const Eigen::Vector3d a = t.col(longest), b = t.col((longest + 1) % 3), c = t.col((longest + 2) % 3);
    // share below c
    const double top = std::clamp((c - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    Eigen::AlignedBox3d box;
    for (const double s : {from, to}) {
        box.extend(a + s * (b - a));
        // share of the height there
        const double up = s <= top ? (top > 0 ? s / top : 1) : (1 - s) / (1 - top);
        box.extend(s <= top ? Eigen::Vector3d(a + up * (c - a)) : Eigen::Vector3d(b + up * (c - b)));
    }
    if (from <= top && top <= to)
        box.extend(c);
    // of rounding
    const double slack = 8 * std::numeric_limits<double>::epsilon() * t.cwiseAbs().maxCoeff();
    box.min().array() -= slack;
    box.max().array() += slack;
    return box;
}

} // namespace

BoxTree::BoxTree(const TriMesh& mesh, Boxes boxes, const Progress& progress)
{
    progress.checkpoint(0, sorting);
    require_usable(mesh);
    const double least = boxes == Boxes::pieces ? least_length(mesh) : std::numeric_limits<double>::infinity();
    std::vector<Entry> entry;
    entry.reserve(size_t(mesh.triangles()));
    for (int f = 0; f < mesh.triangles(); ++f) {
        if (f % faces_at_a_time == 0)
            progress.checkpoint(0, sorting);
        const Eigen::Matrix3d corners = mesh.position(Eigen::all, mesh.triangle.col(f));
        const Extents extents = extents_of(corners);
        const int pieces = int(pieces_of(extents, least));
        for (int piece = 0; piece < pieces; ++piece) {
            Entry& e = entry.emplace_back();
            if (pieces > 1)
                e.box = slab(corners, extents.longest, double(piece) / pieces, double(piece + 1) / pieces);
            else
                for (int k = 0; k < 3; ++k)
                    e.box.extend(corners.col(k));
            e.middle = e.box.center();
            e.face = f;
        }
    }
    node.reserve(entry.size());
    build(*this, entry, 0, int(entry.size()), progress);
    progress.checkpoint(1, sorting);
    face.resize(entry.size());
    triangle.resize(entry.size());
    box.resize(entry.size());
    for (size_t i = 0; i < entry.size(); ++i) {
        face[i] = entry[i].face;
        box[i] = entry[i].box;
        for (int k = 0; k < 3; ++k)
            triangle[i].col(k) = mesh.position.col(mesh.triangle(k, face[i]));
    }
}

} // namespace spia
