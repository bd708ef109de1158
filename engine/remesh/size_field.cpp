#include "engine/remesh/size_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/mesh/box_tree.h"
#include "engine/mesh/nearest_share.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double long_edge = 2; // of the size at its ends: a shorter one is known by them

/// What asks for less than the most, as segments; a vertex or place is one of no length.
struct Asking {
    TriMesh segments;
    std::vector<double> size; // mm
};

Asking what_asks(const TriMesh& mesh, const EdgeSizes& sizes)
{
    const EdgeGraph graph = edge_graph(mesh);
    std::vector<std::array<int, 2>> ends;
    Asking result;
    const auto add = [&](int a, int b, double size) {
        if (size < sizes.most) {
            ends.push_back({a, b});
            result.size.push_back(size);
        }
    };
    for (int v = 0; v < mesh.vertices(); ++v)
        add(v, v, sizes.at_vertex[v]);
    for (size_t e = 0; e < graph.edge.size(); ++e) {
        const EdgeGraph::Edge& edge = graph.edge[e];
        const double at_ends = std::min(sizes.at_vertex[edge.low], sizes.at_vertex[edge.high]);
        if (edge.length > long_edge * at_ends)
            add(edge.low, edge.high, std::max(sizes.along_edge[Eigen::Index(e)], at_ends));
    }
    const Eigen::Index vertices = mesh.vertices(), places = Eigen::Index(sizes.elsewhere.size());
    result.segments.position.resize(3, vertices + places);
    result.segments.position.leftCols(vertices) = mesh.position;
    for (Eigen::Index i = 0; i < places; ++i) {
        result.segments.position.col(vertices + i) = sizes.elsewhere[size_t(i)].position;
        add(int(vertices + i), int(vertices + i), sizes.elsewhere[size_t(i)].size);
    }
    result.segments.triangle.resize(3, Eigen::Index(ends.size()));
    for (size_t i = 0; i < ends.size(); ++i)
        result.segments.triangle.col(Eigen::Index(i)) << ends[i][0], ends[i][1], ends[i][1];
    return result;
}

} // namespace

SizeField::SizeField(const TriMesh& mesh, EdgeSizes sizes, LongFaces long_faces)
    : mesh_(&mesh), sizes_(std::move(sizes)), long_faces_(long_faces)
{
    if (long_faces == LongFaces::between_corners)
        return;
    Asking asking = what_asks(mesh, sizes_);
    if (asking.size.empty())
        return;
    tree_ = std::make_unique<const BoxTree>(asking.segments, BoxTree::Boxes::pieces);
    for (const int segment : tree_->face)
        asked_.push_back(asking.size[size_t(segment)]);
    least_.resize(tree_->node.size());
    for (size_t k = least_.size(); k-- > 0;) { // children come after their parent
        const BoxTree::Node& node = tree_->node[k];
        least_[k] = node.count > 0
                        ? *std::min_element(asked_.begin() + node.first, asked_.begin() + node.first + node.count)
                        : std::min(least_[k + 1], least_[size_t(node.second)]);
    }
}

SizeField::~SizeField() = default;
SizeField::SizeField(SizeField&&) noexcept = default;
SizeField& SizeField::operator=(SizeField&&) noexcept = default;

/// @param known  mm, of the corners: it does not become less
double SizeField::beyond(const Eigen::Vector3d& place, double known) const
{
    if (long_faces_ == LongFaces::between_corners)
        return known;
    double best = sizes_.most;
    if (!tree_)
        return best;
    const auto at_least = [&](int k) {
        return least_[size_t(k)] + sizes_.growth * std::sqrt(tree_->node[size_t(k)].box.squaredExteriorDistance(place));
    };
    struct Waiting {
        double bound;
        int node;
    };
    std::array<Waiting, BoxTree::most_levels + 1> open;
    size_t waiting = 0;
    open[waiting++] = {at_least(0), 0};
    while (waiting > 0 && best > known) {
        const auto [bound, k] = open[--waiting];
        if (bound >= best)
            continue;
        const BoxTree::Node& node = tree_->node[size_t(k)];
        for (int i = node.first; i < node.first + node.count; ++i) {
            const Eigen::Matrix3d& ends = tree_->triangle[size_t(i)];
            const Eigen::Vector3d a = ends.col(0), along = ends.col(1) - ends.col(0);
            const double t = nearest_share(place, a, along);
            best = std::min(best, asked_[size_t(i)] + sizes_.growth * (a + t * along - place).norm());
        }
        if (node.count > 0)
            continue;
        Waiting near{at_least(k + 1), k + 1}, far{at_least(node.second), node.second};
        if (far.bound < near.bound)
            std::swap(near, far);
        open[waiting++] = far;
        open[waiting++] = near;
    }
    return std::max(best, known);
}

double SizeField::in_face(int face, const Eigen::Vector3d& barycentric) const
{
    const Eigen::Vector3i corner = mesh_->triangle.col(face);
    const Eigen::Matrix3d at = mesh_->position(Eigen::all, corner);
    const Eigen::Vector3d size = sizes_.at_vertex(corner);
    const double known = barycentric.dot(size);
    const double longest = std::max({(at.col(1) - at.col(0)).squaredNorm(), (at.col(2) - at.col(1)).squaredNorm(),
                                     (at.col(0) - at.col(2)).squaredNorm()});
    const double short_enough = long_edge * size.minCoeff();
    return longest > short_enough * short_enough ? beyond(at * barycentric, known) : known;
}

double SizeField::between(int a, int b, double share) const
{
    const Eigen::Vector3d from = mesh_->position.col(a), to = mesh_->position.col(b);
    const double here = at_vertex(a), there = at_vertex(b), known = (1 - share) * here + share * there;
    return (to - from).norm() > long_edge * std::min(here, there) ? beyond((1 - share) * from + share * to, known)
                                                                  : known;
}

namespace {

/// Of a piece of a face, halved along its longest edge until its middle says how long edges are in
/// it.
/// @param corners  barycentric
double triangles_in(const SizeField& field, int face, const Eigen::Matrix3d& at, const Eigen::Matrix3d& corners,
                    int halvings)
{
    const Eigen::Matrix3d place = at * corners;
    const double size = field.in_face(face, corners.rowwise().mean());
    int longest = 0;
    double length = 0;
    for (int k = 0; k < 3; ++k)
        if (const double side = (place.col((k + 1) % 3) - place.col(k)).norm(); side > length) {
            longest = k;
            length = side;
        }
    if (halvings == 0 || length <= long_edge * size)
        return 2 / std::sqrt(3.0) * (place.col(1) - place.col(0)).cross(place.col(2) - place.col(0)).norm() /
               (size * size);
    const Eigen::Vector3d middle = (corners.col(longest) + corners.col((longest + 1) % 3)) / 2;
    Eigen::Matrix3d half = corners, other = corners;
    half.col((longest + 1) % 3) = middle;
    other.col(longest) = middle;
    return triangles_in(field, face, at, half, halvings - 1) + triangles_in(field, face, at, other, halvings - 1);
}

} // namespace

double SizeField::triangles() const
{
    constexpr int most_halvings = 10; // of a needle that is a thousand times as long as its ends ask
    double count = 0;
    for (int f = 0; f < mesh_->triangles(); ++f)
        count += triangles_in(*this, f, mesh_->position(Eigen::all, mesh_->triangle.col(f)),
                              Eigen::Matrix3d::Identity(), most_halvings);
    return count;
}

} // namespace spia
