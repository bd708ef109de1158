#include "engine/mesh/solid/border/move_in_flats.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/fit/plane_triangles.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

class MovedFlats {
public:
    MovedFlats(const SkinMesh& surface, const std::vector<FlatMove>& moves)
        : surface_(surface), mesh_(surface.mesh), tolerance_(1e-6 * bounding_diagonal(mesh_)), goal_(mesh_.position),
          neighbour_(face_neighbours(mesh_.triangles(), edge_uses(mesh_.triangle))),
          face_at_(size_t(mesh_.vertices()), -1)
    {
        for (const FlatMove& move : moves)
            goal_.col(move.vertex) = move.to;
        for (int f = 0; f < mesh_.triangles(); ++f)
            for (const int v : mesh_.triangle.col(f))
                face_at_[size_t(v)] = f;
    }

    /// The triangles of the flat that a vertex is on, once all are moved.
    std::vector<int> around(const FlatMove& move) const
    {
        std::vector<char> in(size_t(mesh_.triangles()), 0);
        std::vector<int> flat;
        const auto take = [&](int f) {
            if (f >= 0 && !in[size_t(f)] && is_on(f, move)) {
                in[size_t(f)] = 1;
                flat.push_back(f);
            }
        };
        take(face_at_[size_t(move.vertex)]);
        for (size_t i = 0; i < flat.size(); ++i)
            for (const int next : neighbour_.col(flat[i]))
                take(next);
        std::ranges::sort(flat);
        return flat;
    }

    /// Its triangles with their vertices moved, in their order; nothing if some turn over.
    std::optional<std::vector<PlaneTriangle>> moved_triangles(const std::vector<int>& flat,
                                                              const Eigen::Vector3d& normal) const
    {
        const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
        const auto laid = [&](const Eigen::Vector3d& p) { return Eigen::Vector2d(x.dot(p), y.dot(p)); };
        PlaneTriangles plane;
        plane.source_vertex = surface_.source_vertex;
        std::vector<Eigen::Vector2d> to;
        for (int v = 0; v < mesh_.vertices(); ++v) {
            plane.at.push_back(laid(mesh_.position.col(v)));
            to.push_back(laid(goal_.col(v)));
        }
        double total = 0;
        for (const int f : flat) {
            const auto t = mesh_.triangle.col(f);
            plane.triangle.push_back({{t[0], t[1], t[2]}, surface_.source_face[size_t(f)]});
            total += area(plane, plane.triangle.back().corner);
        }
        plane.way_round = total < 0 ? -1 : 1;
        PlaneTriangles at_once = plane;
        at_once.at = to;
        if (std::ranges::all_of(at_once.triangle, [&](const auto& t) { return area(at_once, t.corner) > 0; }))
            return at_once.triangle;
        const auto step_by_step = moved(std::move(plane), to);
        return step_by_step ? std::optional(step_by_step->triangle) : std::nullopt;
    }

private:
    const SkinMesh& surface_;
    const TriMesh& mesh_;
    double tolerance_;      ///< mm
    Eigen::Matrix3Xd goal_; ///< per vertex, those that do not move as well
    Eigen::Matrix3Xi neighbour_;
    std::vector<int> face_at_; ///< per vertex one that it is of

    bool is_on(int f, const FlatMove& move) const
    {
        return std::ranges::all_of(mesh_.triangle.col(f), [&](int v) {
            return std::abs((goal_.col(v) - move.to).dot(move.normal)) <= tolerance_;
        });
    }
};

/// The one that is still about where it went; -1: none, a later step has put it elsewhere.
int vertex_of(const SkinMesh& middle, const StraightVertex& straight)
{
    const std::vector<int>& source = middle.source_vertex;
    const auto [begin, end] = std::equal_range(source.begin(), source.end(), straight.source_vertex);
    for (auto at = begin; at != end; ++at)
        if (const auto v = at - source.begin();
            (middle.mesh.position.col(v) - straight.place).norm() < straight.beside() / 2)
            return int(v);
    return -1;
}

} // namespace

std::vector<FlatMove> move_in_flats(SkinMesh& surface, const std::vector<FlatMove>& moves)
{
    const SkinMesh before = surface;
    const MovedFlats flats(before, moves);
    std::vector<char> done(size_t(before.mesh.vertices()), 0), kept = done;
    std::vector<FlatMove> not_made;
    for (const FlatMove& move : moves) {
        if (!done[size_t(move.vertex)]) {
            const std::vector<int> flat = flats.around(move);
            const auto triangles = flats.moved_triangles(flat, move.normal);
            for (size_t i = 0; i < flat.size(); ++i)
                for (Eigen::Index k = 0; k < 3; ++k) {
                    const int v = before.mesh.triangle(k, flat[i]);
                    done[size_t(v)] = 1;
                    kept[size_t(v)] = !triangles;
                    if (triangles)
                        surface.mesh.triangle(k, flat[i]) = (*triangles)[i].corner[size_t(k)];
                }
        }
        if (kept[size_t(move.vertex)])
            not_made.push_back(move);
        else
            surface.mesh.position.col(move.vertex) = move.to;
    }
    return not_made;
}

void settle_in_flats(SkinMesh& middle)
{
    const auto moved = [&](const StraightVertex& v) { return vertex_of(middle, v) < 0; };
    std::erase_if(middle.straightened, moved);
    const Eigen::Matrix3Xd normal = area_vectors(middle.mesh).colwise().normalized();
    std::vector<Eigen::Vector3d> flat(size_t(middle.mesh.vertices()), Eigen::Vector3d::Zero());
    std::vector<char> bent(size_t(middle.mesh.vertices()), 0); // those beside a flat would turn over
    constexpr double parallel = 1 - 1e-6;                      // 0.1 degrees
    for (int f = 0; f < middle.mesh.triangles(); ++f)
        for (const int v : middle.mesh.triangle.col(f)) {
            bent[size_t(v)] |= !flat[size_t(v)].isZero() && flat[size_t(v)].dot(normal.col(f)) < parallel;
            flat[size_t(v)] = normal.col(f);
        }
    const double tolerance = 1e-6 * bounding_diagonal(middle.mesh);
    std::vector<FlatMove> moves;
    for (const StraightVertex& straight : middle.straightened) {
        const int v = vertex_of(middle, straight);
        const Eigen::Vector3d &n = flat[size_t(v)], place = middle.mesh.position.col(v);
        if (const double out = (straight.wanted - place).dot(n);
            straight.certain && !bent[size_t(v)] && std::abs(out) <= tolerance)
            moves.push_back({v, straight.wanted - out * n, n});
    }
    move_in_flats(middle, moves);
    std::erase_if(middle.straightened, moved);
}

} // namespace spia
