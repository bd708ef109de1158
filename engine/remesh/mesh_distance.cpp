#include "engine/remesh/mesh_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "engine/core/parallel.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using Polygon = std::vector<Eigen::Vector3d>; ///< convex, flat

struct Side {
    Eigen::Vector3d normal; ///< away from the face
    double offset;
};

/// Of each face the planes through its edges that halve the angle to its neighbours.
std::vector<std::array<Side, 3>> sides_of(const TriMesh& mesh)
{
    Eigen::Matrix3Xd normal = area_vectors(mesh);
    for (int f = 0; f < mesh.triangles(); ++f)
        normal.col(f).normalize();
    std::vector<std::array<Side, 3>> result(size_t(mesh.triangles()));
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        Eigen::Vector3d across = Eigen::Vector3d::Zero();
        for (size_t u = begin; u < end; ++u)
            across += normal.col(uses[u].face);
        for (size_t u = begin; u < end; ++u) {
            const auto [low, high, face, corner, forward] = uses[u];
            const Eigen::Vector3d a = mesh.position.col(mesh.triangle(corner, face)),
                                  b = mesh.position.col(mesh.triangle((corner + 1) % 3, face));
            const Eigen::Vector3d out = (b - a).cross(across).normalized();
            result[size_t(face)][size_t(corner)] = {out, out.dot(a)};
        }
    });
    return result;
}

/// Cuts the polygon in two; one is empty where the other one holds all but `on`, mm. Corners nearer to the plane than that belong to
/// both: a needle along the plane would else be cut by rounding, again and again.
std::pair<Polygon, Polygon> cut(const Polygon& polygon, const Side& side, double on)
{
    std::pair<Polygon, Polygon> result;
    bool inside = false, outside = false;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double at_a = side.normal.dot(a) - side.offset, at_b = side.normal.dot(b) - side.offset;
        inside = inside || at_a < -on;
        outside = outside || at_a > on;
        if (at_a <= on)
            result.first.push_back(a);
        if (at_a >= -on)
            result.second.push_back(a);
        if ((at_a < -on && at_b > on) || (at_a > on && at_b < -on)) {
            const Eigen::Vector3d between = a + at_a / (at_a - at_b) * (b - a);
            result.first.push_back(between);
            result.second.push_back(between);
        }
    }
    if (!inside)
        result.first.clear();
    if (!outside)
        result.second.clear();
    return result;
}

Eigen::Vector3d middle_of(const Polygon& polygon)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : polygon)
        sum += p;
    return sum / double(polygon.size());
}

class FaceDistance {
public:
    FaceDistance(const TriMesh& to, const ClosestPointSearch& search, double precision)
        : to_(to), search_(search), precision_(precision), on_(1e-3 * precision), sides_(sides_of(to))
    {
    }

    struct Found {
        double bound = 0, seen = 0;
        Eigen::Vector3d where = Eigen::Vector3d::Zero();
    };

    Found of(const Eigen::Matrix3d& triangle) const
    {
        constexpr int most_pieces = 1'000'000; // then what is left is bounded by the way from its middle
        Found found;
        for (int k = 0; k < 3; ++k)
            see(triangle.col(k), found);
        std::vector<Polygon> waiting = {{triangle.col(0), triangle.col(1), triangle.col(2)}};
        int pieces = 0;
        while (!waiting.empty()) {
            const Polygon piece = std::move(waiting.back());
            ++pieces;
            waiting.pop_back();
            const Eigen::Vector3d middle = middle_of(piece);
            const ClosestPoint nearest = see(middle, found);
            const double bound = bound_of(piece, nearest.face);
            if (bound <= enough(found)) {
                found.bound = std::max(found.bound, bound);
                continue;
            }
            double radius = 0;
            for (const Eigen::Vector3d& p : piece)
                radius = std::max(radius, (p - middle).norm());
            const double sure = std::min(bound, nearest.distance + radius); // no distance changes faster than the way
            if (sure <= enough(found) || pieces >= most_pieces) {
                found.bound = std::max(found.bound, sure);
                continue;
            }
            const size_t before = waiting.size();
            Polygon inside = piece;
            for (const Side& side : sides_[size_t(nearest.face)]) {
                auto [in, out] = cut(inside, side, on_);
                if (in.empty() || out.empty())
                    continue;
                waiting.push_back(std::move(out));
                inside = std::move(in);
            }
            if (waiting.size() > before)
                waiting.push_back(std::move(inside));
            else
                halve(piece, [&](Polygon half) { waiting.push_back(std::move(half)); });
        }
        found.bound = std::max(found.bound, found.seen);
        return found;
    }

private:
    ClosestPoint see(const Eigen::Vector3d& point, Found& found) const
    {
        const ClosestPoint nearest = search_.nearest(point);
        if (nearest.distance > found.seen) {
            found.seen = nearest.distance;
            found.where = point;
        }
        return nearest;
    }

    /// Far away the bound may be farther from what was seen.
    double enough(const Found& found) const { return found.seen + std::max(precision_, 0.1 * found.seen); }

    double bound_of(const Polygon& polygon, int face) const
    {
        const Eigen::Matrix3d triangle = to_.position(Eigen::all, to_.triangle.col(face));
        double most = 0;
        for (const Eigen::Vector3d& p : polygon)
            most = std::max(most, (triangle * closest_on_triangle(triangle, p) - p).norm());
        return most;
    }

    /// Across its longest extent, through the middle.
    template <class Take> static void halve(const Polygon& polygon, const Take& take)
    {
        const Eigen::Vector3d middle = middle_of(polygon);
        Eigen::Vector3d along = Eigen::Vector3d::Zero();
        for (const Eigen::Vector3d& p : polygon)
            if ((p - middle).squaredNorm() > along.squaredNorm())
                along = p - middle;
        along.normalize();
        auto [a, b] = cut(polygon, {along, along.dot(middle)}, 0);
        for (Polygon* half : {&a, &b})
            if (!half->empty())
                take(std::move(*half));
    }

    const TriMesh& to_;
    const ClosestPointSearch& search_;
    double precision_, on_; ///< mm
    std::vector<std::array<Side, 3>> sides_;
};

} // namespace

MeshDistance farthest(const TriMesh& from, const TriMesh& to, const ClosestPointSearch& search, double precision,
                      const Progress& progress)
{
    const FaceDistance distance(to, search, precision);
    std::vector<FaceDistance::Found> found(size_t(from.triangles()));
    constexpr int at_a_time = 16384;
    for (int first = 0; first < from.triangles(); first += std::min(at_a_time, from.triangles() - first)) {
        progress.checkpoint(double(first) / from.triangles(), "measuring the distance of both meshes");
        parallel_for(std::min(at_a_time, from.triangles() - first), [&](int i) {
            found[size_t(first + i)] = distance.of(from.position(Eigen::all, from.triangle.col(first + i)));
        });
    }
    MeshDistance result;
    result.of_face.resize(from.triangles());
    for (int f = 0; f < from.triangles(); ++f) {
        const FaceDistance::Found& each = found[size_t(f)];
        result.of_face[f] = each.bound;
        if (each.bound > result.bound || result.face < 0) {
            result.bound = each.bound;
            result.face = f;
        }
        if (each.seen > result.seen) {
            result.seen = each.seen;
            result.where = each.where;
        }
    }
    return result;
}

} // namespace spia
