#include "engine/mesh/locate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include "engine/mesh/vectors.h"

namespace spia {

namespace {

namespace bg = boost::geometry;
using BoxCorner = bg::model::point<double, 2, bg::cs::cartesian>;
using Box = bg::model::box<BoxCorner>;
using BoxEntry = std::pair<Box, int>;

constexpr double relative_tolerance = 1e-10;

/// The nearest point of the segment a b, as the weight of b.
double nearest_on_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
    const Eigen::Vector2d ab = b - a;
    const double length2 = ab.squaredNorm();
    return length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
}

/// The nearest place of one triangle, which may be turned over or have no area.
MeshPoint nearest_in_triangle(const Eigen::Vector2d& p, const std::array<Eigen::Vector2d, 3>& corner, int face)
{
    Eigen::Vector3d area;
    for (int k = 0; k < 3; ++k)
        area[k] = cross(corner[(k + 1) % 3] - p, corner[(k + 2) % 3] - p);
    const double sum = area.sum();
    if ((sum > 0 && area.minCoeff() >= 0) || (sum < 0 && area.maxCoeff() <= 0))
        return {face, area / sum, 0.0};
    MeshPoint best;
    for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3;
        const double t = nearest_on_segment(p, corner[k], corner[l]);
        const double distance = (corner[k] + t * (corner[l] - corner[k]) - p).norm();
        if (best.face >= 0 && distance >= best.distance)
            continue;
        best = {face, Eigen::Vector3d::Zero(), distance};
        best.barycentric[k] = 1 - t;
        best.barycentric[l] = t;
    }
    return best;
}

bool better(const MeshPoint& a, const MeshPoint& b)
{
    if (b.face < 0 || a.distance != b.distance)
        return b.face < 0 || a.distance < b.distance;
    const double depth_a = a.barycentric.minCoeff(), depth_b = b.barycentric.minCoeff();
    return depth_a != depth_b ? depth_a > depth_b : a.face < b.face;
}

} // namespace

struct PlanarLocator::Tree {
    Eigen::Matrix2Xd position;
    Eigen::Matrix3Xi triangle;
    double tolerance = 0;
    bg::index::rtree<BoxEntry, bg::index::quadratic<16>> boxes;

    std::array<Eigen::Vector2d, 3> corners(int face) const
    {
        return {position.col(triangle(0, face)), position.col(triangle(1, face)), position.col(triangle(2, face))};
    }
};

PlanarLocator::PlanarLocator(const Eigen::Matrix2Xd& position, const Eigen::Matrix3Xi& triangle)
{
    auto tree = std::make_unique<Tree>();
    tree->position = position;
    tree->triangle = triangle;
    if (position.cols() > 0)
        tree->tolerance = relative_tolerance * (position.rowwise().maxCoeff() - position.rowwise().minCoeff()).norm();
    std::vector<BoxEntry> entries;
    entries.reserve(size_t(triangle.cols()));
    for (int f = 0; f < triangle.cols(); ++f) {
        const auto [a, b, c] = tree->corners(f);
        const Eigen::Vector2d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        entries.push_back({{{low.x(), low.y()}, {high.x(), high.y()}}, f});
    }
    tree->boxes = decltype(tree->boxes)(entries); // packed at once: balanced and without insertions
    tree_ = std::move(tree);
}

PlanarLocator::~PlanarLocator() = default;
PlanarLocator::PlanarLocator(PlanarLocator&&) noexcept = default;
PlanarLocator& PlanarLocator::operator=(PlanarLocator&&) noexcept = default;

double PlanarLocator::tolerance() const { return tree_->tolerance; }

MeshPoint PlanarLocator::nearest(const Eigen::Vector2d& point) const
{
    const BoxCorner p(point.x(), point.y());
    MeshPoint best;
    const auto look = [&](const BoxEntry& entry) {
        const MeshPoint here = nearest_in_triangle(point, tree_->corners(entry.second), entry.second);
        if (better(here, best))
            best = here;
    };
    for (auto it = tree_->boxes.qbegin(bg::index::intersects(p)); it != tree_->boxes.qend(); ++it)
        look(*it);
    if (best.face >= 0 && best.distance == 0)
        return best;
    // Outside: the triangle in the nearest box bounds the distance, and only boxes within it can do
    // better.
    for (auto it = tree_->boxes.qbegin(bg::index::nearest(p, 1)); it != tree_->boxes.qend(); ++it)
        look(*it);
    const double r = best.distance;
    const Box around(BoxCorner(point.x() - r, point.y() - r), BoxCorner(point.x() + r, point.y() + r));
    for (auto it = tree_->boxes.qbegin(bg::index::intersects(around)); it != tree_->boxes.qend(); ++it)
        look(*it);
    return best;
}

std::vector<MeshPoint> PlanarLocator::covering(const Eigen::Vector2d& point) const
{
    const double r = tree_->tolerance;
    const Box around(BoxCorner(point.x() - r, point.y() - r), BoxCorner(point.x() + r, point.y() + r));
    std::vector<MeshPoint> found;
    for (auto it = tree_->boxes.qbegin(bg::index::intersects(around)); it != tree_->boxes.qend(); ++it) {
        const MeshPoint here = nearest_in_triangle(point, tree_->corners(it->second), it->second);
        if (here.distance <= r)
            found.push_back(here);
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.face < b.face; });
    return found;
}

} // namespace spia
