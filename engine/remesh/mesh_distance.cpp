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

/// Cuts the polygon in two; one is empty where the other one holds all but `on`, mm. Corners nearer
/// to the plane than that belong to both: a needle along the plane would else be cut by rounding,
/// again and again.
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

/// Far away the bound may be farther from what was seen.
double sharp_enough(double seen, double precision) { return seen + std::max(precision, 0.1 * seen); }

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

    /// @param found     of its corners and its middle
    /// @param nearest   to its middle; -1: not known
    /// @param harmless  mm; a bound of that is good enough
    Found of(const Eigen::Matrix3d& triangle, Found found, int nearest, double harmless) const
    {
        constexpr int most_pieces = 1'000'000; // then what is left is bounded by the way from its
                                               // middle
        const auto enough = [&] { return std::max(harmless, sharp_enough(found.seen, precision_)); };
        if (nearest >= 0) // mostly one face is near enough to all of it
            if (const double bound = bound_of({triangle.col(0), triangle.col(1), triangle.col(2)}, nearest);
                bound <= enough()) {
                found.bound = std::max(bound, found.seen);
                return found;
            }
        std::vector<Polygon> waiting = {{triangle.col(0), triangle.col(1), triangle.col(2)}};
        int pieces = 0;
        while (!waiting.empty()) {
            const Polygon piece = std::move(waiting.back());
            ++pieces;
            waiting.pop_back();
            const Eigen::Vector3d middle = middle_of(piece);
            const ClosestPoint to_middle = see(middle, found);
            const double bound = bound_of(piece, to_middle.face);
            if (bound <= enough()) {
                found.bound = std::max(found.bound, bound);
                continue;
            }
            double radius = 0;
            for (const Eigen::Vector3d& p : piece)
                radius = std::max(radius, (p - middle).norm());
            // no distance changes faster than the way
            const double sure = std::min(bound, to_middle.distance + radius);
            if (sure <= enough() || pieces >= most_pieces) {
                found.bound = std::max(found.bound, sure);
                continue;
            }
            const size_t before = waiting.size();
            Polygon inside = piece;
            for (const Side& side : sides_[size_t(to_middle.face)]) {
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
                      double harmless, const Progress& progress)
{
    const size_t faces = size_t(from.triangles());
    MeshDistance result;
    result.of_face = result.seen_of_face = Eigen::VectorXd::Zero(from.triangles());
    result.place = Eigen::Matrix3Xd::Zero(3, from.triangles());
    result.nearest.assign(faces, -1);
    measure_again(result, std::vector<char>(faces, 1), from, to, search, precision, harmless, progress);
    return result;
}

void measure_again(MeshDistance& distance, const std::vector<char>& again, const TriMesh& from, const TriMesh& to,
                   const ClosestPointSearch& search, double precision, double harmless, const Progress& progress)
{
    constexpr const char* step = "measuring the distance of both meshes";
    std::vector<int> face;
    std::vector<char> corner(size_t(from.vertices()), 0);
    for (int f = 0; f < from.triangles(); ++f)
        if (again[size_t(f)]) {
            face.push_back(f);
            for (const int v : from.triangle.col(f))
                corner[size_t(v)] = 1;
        }
    Eigen::VectorXd at_vertex = Eigen::VectorXd::Zero(from.vertices());
    for_each_in_parts(from.vertices(), progress.part(0, 0.2), step, [&](int v) {
        if (corner[size_t(v)])
            at_vertex[v] = search.nearest(from.position.col(v)).distance;
    });
    for_each_in_parts(int(face.size()), progress.part(0.2, 0.4), step, [&](int i) {
        const int f = face[size_t(i)];
        const Eigen::Matrix3d t = from.position(Eigen::all, from.triangle.col(f));
        const ClosestPoint middle = search.nearest(t.rowwise().mean());
        distance.nearest[size_t(f)] = middle.face;
        distance.seen_of_face[f] = middle.distance;
        distance.place.col(f) = t.rowwise().mean();
        for (int k = 0; k < 3; ++k)
            if (const double away = at_vertex[from.triangle(k, f)]; away > distance.seen_of_face[f]) {
                distance.seen_of_face[f] = away;
                distance.place.col(f) = t.col(k);
            }
    });
    // No face with a smaller bound than what was seen somewhere makes the largest bound larger.
    const double good_enough = std::min(harmless, distance.seen_of_face.maxCoeff());
    const FaceDistance measured(to, search, precision);
    face.clear();
    for (int f = 0; f < from.triangles(); ++f)
        if (again[size_t(f)] ||
            distance.of_face[f] > std::max(good_enough, sharp_enough(distance.seen_of_face[f], precision)))
            face.push_back(f);
    constexpr int at_a_time = 16384;
    for (int first = 0; first < int(face.size()); first += at_a_time) {
        progress.checkpoint(0.4 + 0.6 * double(first) / double(face.size()), step);
        parallel_for(std::min(at_a_time, int(face.size()) - first), [&](int i) {
            const int f = face[size_t(first + i)];
            const FaceDistance::Found found = measured.of(from.position(Eigen::all, from.triangle.col(f)),
                                                          {0, distance.seen_of_face[f], distance.place.col(f)},
                                                          distance.nearest[size_t(f)], good_enough);
            distance.of_face[f] = found.bound;
            distance.seen_of_face[f] = found.seen;
            distance.place.col(f) = found.where;
        });
    }
    distance.bound = distance.of_face.maxCoeff(&distance.face);
    int worst;
    distance.seen = distance.seen_of_face.maxCoeff(&worst);
    distance.where = distance.place.col(worst);
}

} // namespace spia
