#include "engine/mesh/smooth_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"

namespace spia {

namespace {

/// Faces around vertices and how the sheet turns near them.
class Turns {
public:
    Turns(const TriMesh& mesh, double crease)
        : mesh_(mesh), crease_(crease), normal(area_vectors(mesh)),
          neighbour(face_neighbours(mesh.triangles(), edge_uses(mesh.triangle))), around(size_t(mesh.vertices()))
    {
        normal.colwise().normalize();
        for (int f = 0; f < mesh.triangles(); ++f)
            for (int k = 0; k < 3; ++k)
                around[size_t(mesh.triangle(k, f))].push_back(f);
    }

    double across(int f, int k) const
    {
        const int g = neighbour(k, f);
        return g < 0 ? 0 : angle_between(normal.col(f), normal.col(g));
    }

    /// By how much faces that touch a face, on its side of creases, are turned against all of
    /// `beside`.
    /// @param about, reach  corners of the face beyond that distance from the vertex do not count:
    ///                      long triangles of a plane reach as far as other bends
    double roughness(int f, const std::vector<int>& beside, int about = -1, double reach = 0) const
    {
        double result = 0;
        for (int k = 0; k < 3; ++k)
            for (const int h : around[size_t(mesh_.triangle(k, f))]) {
                if (angle_between(normal.col(h), normal.col(f)) > crease_)
                    continue;
                if (about >= 0 && (mesh_.position.col(mesh_.triangle(k, f)) - mesh_.position.col(about)).norm() > reach)
                    break;
                double least = std::numbers::pi;
                for (const int g : beside)
                    least = std::min(least, angle_between(normal.col(h), normal.col(g)));
                result = std::max(result, least);
            }
        return result;
    }

private:
    const TriMesh& mesh_;
    double crease_;

public:
    Eigen::Matrix3Xd normal;
    Eigen::Matrix3Xi neighbour;
    std::vector<std::vector<int>> around;
};

constexpr double level_angle = 0.01; // radians; facets of one plane in files of few decimals
constexpr double isolated = 0.2;     // the turns beside a crease over its own, at most

/// 3 by #F: 1 where the edge from corner k is one of the part.
Eigen::Matrix3Xi creases(const TriMesh& mesh, const Turns& turns, double crease)
{
    Eigen::Matrix3Xi result = Eigen::Matrix3Xi::Zero(3, mesh.triangles());
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int g = turns.neighbour(k, f);
            if (g < f)
                continue;
            const double turn = turns.across(f, k);
            bool is = turn > crease;
            if (!is && turn > 3 * level_angle) {
                const std::vector<int> both = {f, g};
                const double most = std::max(level_angle, isolated * turn);
                is = turns.roughness(f, both) < most && turns.roughness(g, both) < most;
            }
            if (!is)
                continue;
            result(k, f) = 1;
            for (int l = 0; l < 3; ++l)
                if (turns.neighbour(l, g) == f)
                    result(l, g) = 1;
        }
    return result;
}

double corner_angle(const TriMesh& mesh, int f, int k)
{
    const Eigen::Vector3d at = mesh.position.col(mesh.triangle(k, f)),
                          a = mesh.position.col(mesh.triangle((k + 1) % 3, f)) - at,
                          b = mesh.position.col(mesh.triangle((k + 2) % 3, f)) - at;
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

int corner_of(const TriMesh& mesh, int f, int v)
{
    return mesh.triangle(0, f) == v ? 0 : mesh.triangle(1, f) == v ? 1 : 2;
}

/// Triangles around a vertex that are not parted by creases.
struct Fan {
    int vertex = -1;
    std::vector<int> face;
    bool known = true;      ///< the normal: it runs all around the vertex, or was led on to it
    bool flat = false;      ///< some of it is, and decides
    Eigen::Vector3d normal; ///< unit
};

/// Whether a corner of a triangle, other than a vertex, is at the border or at a crease.
bool at_rim(const TriMesh& mesh, const std::vector<char>& rim, int f, int v)
{
    for (int k = 0; k < 3; ++k)
        if (mesh.triangle(k, f) != v && rim[size_t(mesh.triangle(k, f))])
            return true;
    return false;
}

Fan fan_around(const TriMesh& mesh, const Turns& turns, const Eigen::Matrix3Xi& creased, const std::vector<char>& rim,
               int v, std::vector<int>& left)
{
    Fan fan;
    fan.vertex = v;
    fan.face.push_back(left.back());
    left.pop_back();
    for (size_t i = 0; i < fan.face.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const int f = fan.face[i], g = turns.neighbour(k, f);
            if (mesh.triangle(k, f) != v && mesh.triangle((k + 1) % 3, f) != v)
                continue;
            if (g < 0 || creased(k, f))
                fan.known = false;
            else if (const auto found = std::find(left.begin(), left.end(), g); found != left.end()) {
                fan.face.push_back(g);
                left.erase(found);
            }
        }
    double shortest = std::numeric_limits<double>::infinity(); // edge at the vertex
    for (const int f : fan.face)
        for (int k = 0; k < 3; ++k)
            if (mesh.triangle(k, f) != v)
                shortest = std::min(shortest, (mesh.position.col(mesh.triangle(k, f)) - mesh.position.col(v)).norm());
    constexpr double around = 3; // of that edge
    std::vector<double> own, rough;
    for (const int f : fan.face)
        own.push_back(turns.roughness(f, fan.face, v, around * shortest));
    for (const int f : fan.face) { // triangles of one facet are alike
        rough.push_back(0);
        for (size_t i = 0; i < fan.face.size(); ++i)
            if (angle_between(turns.normal.col(f), turns.normal.col(fan.face[i])) < level_angle)
                rough.back() = std::max(rough.back(), own[i]);
    }
    const double most = *std::ranges::max_element(rough);
    const double least = std::max(level_angle, isolated * most);
    for (size_t i = 0; i < fan.face.size(); ++i) {
        // Beside a rim nothing is seen behind a triangle. Chords of an arc turn as much to the last
        // one as before, to a flat half as much.
        constexpr double as_before = 0.75;
        double turn = 0;
        for (const int g : fan.face)
            turn = std::max(turn, angle_between(turns.normal.col(fan.face[i]), turns.normal.col(g)));
        if (rough[i] < least && turn > as_before * most && turn > level_angle && at_rim(mesh, rim, fan.face[i], v))
            rough[i] = most;
    }
    fan.flat = std::any_of(rough.begin(), rough.end(), [&](double r) { return r < least; });
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < fan.face.size(); ++i)
        if (!fan.flat || rough[i] < least)
            sum += corner_angle(mesh, fan.face[i], corner_of(mesh, fan.face[i], v)) * turns.normal.col(fan.face[i]);
    fan.normal = sum.normalized();
    return fan;
}

/// Fans at the corners of triangles.
struct Fans {
    std::vector<Fan> fan;
    std::vector<std::array<int, 3>> of; ///< per triangle at its corners

    /// Of the vertices at the other corners of a fan's triangles, those whose normals are known.
    std::vector<const Fan*> around(const Fan& own) const
    {
        std::vector<const Fan*> result;
        for (const int f : own.face)
            for (const int at : of[size_t(f)])
                if (const Fan& other = fan[size_t(at)]; other.vertex != own.vertex && other.known)
                    result.push_back(&other);
        return result;
    }
};

/// Where triangles are on one side of a vertex only, their mean is the normal some way inside. It is
/// led on straight from the nearest vertex whose normal is known and the one behind it; nothing
/// where there are none.
std::optional<Eigen::Vector3d> led_on(const TriMesh& mesh, const Fan& fan, const Fans& fans)
{
    const Eigen::Vector3d at = mesh.position.col(fan.vertex);
    const auto way_to = [&](const Fan* other) { return Eigen::Vector3d(mesh.position.col(other->vertex) - at); };
    const std::vector<const Fan*> inside = fans.around(fan);
    if (inside.empty())
        return std::nullopt;
    const Fan* next = *std::ranges::min_element(inside, {}, [&](const Fan* f) { return way_to(f).norm(); });
    const Eigen::Vector3d way = way_to(next);
    const Fan* behind = nullptr;
    double straightest = 0.9; // the cosine of 25 degrees
    for (const Fan* other : fans.around(*next)) {
        const Eigen::Vector3d on = way_to(other) - way;
        if (const double cosine = on.normalized().dot(way.normalized()); cosine > straightest) {
            straightest = cosine;
            behind = other;
        }
    }
    if (!behind)
        return std::nullopt;
    // No further than twice as far as is known, nor turned by more than a fine mesh turns.
    constexpr double furthest = 2, most = 0.4;
    const double further = way.norm() / (way_to(behind) - way).norm();
    const Eigen::Vector3d normal = (next->normal + further * (next->normal - behind->normal)).normalized();
    if (further > furthest || !(angle_between(normal, fan.normal) < most))
        return std::nullopt;
    return normal;
}

} // namespace

std::vector<Eigen::Matrix3d> smooth_normals(const TriMesh& mesh, double crease,
                                            const std::vector<Eigen::Matrix3f>& given)
{
    const Turns turns(mesh, crease);
    const Eigen::Matrix3Xi creased = creases(mesh, turns, crease);
    std::vector<char> rim(size_t(mesh.vertices()), 0);
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            if (turns.neighbour(k, f) < 0 || creased(k, f))
                rim[size_t(mesh.triangle(k, f))] = rim[size_t(mesh.triangle((k + 1) % 3, f))] = 1;
    Fans fans;
    fans.of.resize(size_t(mesh.triangles()));
    for (int v = 0; v < mesh.vertices(); ++v)
        for (std::vector<int> left = turns.around[size_t(v)]; !left.empty();) {
            fans.fan.push_back(fan_around(mesh, turns, creased, rim, v, left));
            for (const int f : fans.fan.back().face)
                fans.of[size_t(f)][size_t(corner_of(mesh, f, v))] = int(fans.fan.size()) - 1;
        }
    for (int pass = 0; pass < 2; ++pass) { // corners of the border come after their neighbours
        std::vector<std::pair<size_t, Eigen::Vector3d>> found;
        for (size_t i = 0; i < fans.fan.size(); ++i)
            if (!fans.fan[i].known && !fans.fan[i].flat)
                if (const auto normal = led_on(mesh, fans.fan[i], fans))
                    found.emplace_back(i, *normal);
        for (const auto& [i, normal] : found) {
            fans.fan[i].normal = normal;
            fans.fan[i].known = true;
        }
    }
    std::vector<Eigen::Matrix3d> result(size_t(mesh.triangles()));
    for (const Fan& fan : fans.fan)
        for (const int f : fan.face)
            result[size_t(f)].col(corner_of(mesh, f, fan.vertex)) = fan.normal;
    if (given.empty())
        return result;
    const auto is_given = [&](int f, int k) { return !given[size_t(f)].col(k).isZero(); };
    for (const Fan& fan : fans.fan) { // triangles beside those whose normals are known have them as well
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const int f : fan.face)
            if (const int k = corner_of(mesh, f, fan.vertex); is_given(f, k))
                sum += given[size_t(f)].col(k).cast<double>();
        if (sum.isZero())
            continue;
        for (const int f : fan.face) {
            const int k = corner_of(mesh, f, fan.vertex);
            result[size_t(f)].col(k) = is_given(f, k)
                                           ? Eigen::Vector3d(given[size_t(f)].col(k).cast<double>().normalized())
                                           : sum.normalized();
        }
    }
    return result;
}

namespace {

/// Cubic triangles over those of a mesh: PN triangles [Vlachos et al. 2001], but that an edge between
/// triangles with different normals, at a crease or at two CAD faces, has one curve for both.
class CurvedMesh {
public:
    CurvedMesh(const TriMesh& mesh, const std::vector<Eigen::Matrix3d>& normal)
        : mesh_(mesh), normal_(normal), neighbour_(face_neighbours(mesh.triangles(), edge_uses(mesh.triangle)))
    {
    }

    Eigen::Vector3d at(int f, const Eigen::Vector3d& u) const
    {
        Eigen::Vector3d place = Eigen::Vector3d::Zero(), mean = Eigen::Vector3d::Zero(), centre = mean;
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3d corner = mesh_.position.col(mesh_.triangle(i, f));
            place += u[i] * u[i] * u[i] * corner;
            centre += corner / 3;
            for (int j = 0; j < 3; ++j)
                if (i != j) {
                    const Eigen::Vector3d b = near(f, i, j);
                    place += 3 * u[i] * u[i] * u[j] * b;
                    mean += b / 6;
                }
        }
        return place + 6 * u.prod() * (mean + (mean - centre) / 2);
    }

private:
    /// A third of the way from corner i of a face to corner j.
    Eigen::Vector3d near(int f, int i, int j) const
    {
        const Eigen::Vector3d a = mesh_.position.col(mesh_.triangle(i, f)),
                              way = Eigen::Vector3d(mesh_.position.col(mesh_.triangle(j, f))) - a;
        Eigen::Vector3d n = normal_[size_t(f)].col(i);
        const int k = (i + 1) % 3 == j ? i : j, g = neighbour_(k, f);
        if (g >= 0) {
            const Eigen::Vector3d m = normal_[size_t(g)].col(corner_of(mesh_, g, mesh_.triangle(i, f)));
            constexpr double same = 1e-3, runs_along = 0.7; // radians; the cosine of 45 degrees
            const Eigen::Vector3d d = n.cross(m), along = d.normalized();
            if (d.norm() > same && std::abs(along.dot(way)) > runs_along * way.norm()) // a crease
                return a + way.dot(along) * along / 3;
            n = (n + m).normalized();
        }
        return a + (way - way.dot(n) * n) / 3;
    }

    const TriMesh& mesh_;
    const std::vector<Eigen::Matrix3d>& normal_;
    Eigen::Matrix3Xi neighbour_;
};

constexpr std::array shares = {0.25, 0.5, 0.75}; // of an edge; the middle alone may lie on a curve
                                                 // that waves

/// Triangles of the mesh, halved at their edges.
class Halving {
public:
    Halving(const TriMesh& mesh, const CurvedMesh& curved, double chord) : curved_(curved), chord_(chord)
    {
        for (int v = 0; v < mesh.vertices(); ++v)
            position_.push_back(mesh.position.col(v));
        for (int f = 0; f < mesh.triangles(); ++f)
            piece_.push_back(
                {f, {mesh.triangle(0, f), mesh.triangle(1, f), mesh.triangle(2, f)}, Eigen::Matrix3d::Identity()});
    }

    /// mm, by how much the edges miss the curved triangles.
    double farthest() const
    {
        double result = 0;
        for (const Piece& piece : piece_)
            for (int k = 0; k < 3; ++k)
                result = std::max(result, missed(piece, k));
        return result;
    }

    /// Every edge that misses them by too much, once. @returns whether there was one
    bool halve()
    {
        middle_.clear();
        for (const Piece& piece : piece_)
            for (int k = 0; k < 3; ++k) {
                const auto key = edge(piece, k);
                if (middle_.contains(key) || missed(piece, k) <= chord_)
                    continue;
                middle_.emplace(key, int(position_.size()));
                position_.push_back(curved_.at(piece.face, between(piece, k, 0.5)));
            }
        if (middle_.empty())
            return false;
        std::vector<Piece> whole;
        whole.swap(piece_);
        for (const Piece& piece : whole)
            divide(piece);
        return true;
    }

    SmoothMesh result(double chord) const
    {
        SmoothMesh result;
        result.chord = chord;
        result.mesh.position.resize(3, Eigen::Index(position_.size()));
        for (size_t v = 0; v < position_.size(); ++v)
            result.mesh.position.col(Eigen::Index(v)) = position_[v];
        result.mesh.triangle.resize(3, Eigen::Index(piece_.size()));
        for (size_t t = 0; t < piece_.size(); ++t) {
            for (int k = 0; k < 3; ++k)
                result.mesh.triangle(k, Eigen::Index(t)) = piece_[t].vertex[size_t(k)];
            result.face.push_back(piece_[t].face);
            result.barycentric.push_back(piece_[t].barycentric);
        }
        return result;
    }

private:
    struct Piece {
        int face;
        std::array<int, 3> vertex;
        Eigen::Matrix3d barycentric; ///< of the corners, columns, in the face
    };

    static std::pair<int, int> edge(const Piece& piece, int k)
    {
        return std::minmax(int(piece.vertex[size_t(k)]), int(piece.vertex[size_t(k + 1) % 3]));
    }

    static Eigen::Vector3d between(const Piece& piece, int k, double share)
    {
        return (1 - share) * piece.barycentric.col(k) + share * piece.barycentric.col((k + 1) % 3);
    }

    double missed(const Piece& piece, int k) const
    {
        const Eigen::Vector3d &a = position_[size_t(piece.vertex[size_t(k)])],
                              &b = position_[size_t(piece.vertex[size_t(k + 1) % 3])];
        const Eigen::Vector3d along = (b - a).normalized();
        double result = 0;
        for (const double share : shares) {
            const Eigen::Vector3d way = curved_.at(piece.face, between(piece, k, share)) - a;
            result = std::max(result, (way - way.dot(along) * along).norm());
        }
        return result;
    }

    /// At the middles of its edges that have one: into two, three or four.
    void divide(const Piece& piece)
    {
        std::array<int, 3> middle;
        int count = 0;
        for (int k = 0; k < 3; ++k) {
            const auto found = middle_.find(edge(piece, k));
            middle[size_t(k)] = found == middle_.end() ? -1 : found->second;
            count += found != middle_.end();
        }
        // Corners 0 to 2, then the middles of the edges 0-1, 1-2, 2-0.
        const auto add = [&](int a, int b, int c) {
            Piece part{piece.face, {}, {}};
            for (int i = 0; const int corner : {a, b, c}) {
                part.vertex[size_t(i)] = corner < 3 ? piece.vertex[size_t(corner)] : middle[size_t(corner) - 3];
                part.barycentric.col(i++) =
                    corner < 3 ? Eigen::Vector3d(piece.barycentric.col(corner)) : between(piece, corner - 3, 0.5);
            }
            piece_.push_back(part);
        };
        if (count == 0)
            add(0, 1, 2);
        else if (count == 3) {
            for (int k = 0; k < 3; ++k)
                add(k, 3 + k, 3 + (k + 2) % 3);
            add(3, 4, 5);
        } else
            for (int k = 0; k < 3; ++k) {
                const int i = k, j = (k + 1) % 3, top = (k + 2) % 3;
                const bool here = middle[size_t(i)] >= 0, next = middle[size_t(j)] >= 0,
                           last = middle[size_t(top)] >= 0;
                if (count == 1 && here) {
                    add(i, 3 + i, top);
                    add(3 + i, j, top);
                }
                if (count == 2 && here && next && !last) {
                    add(3 + i, j, 3 + j);
                    add(i, 3 + i, 3 + j);
                    add(i, 3 + j, top);
                }
            }
    }

    const CurvedMesh& curved_;
    double chord_;
    std::vector<Eigen::Vector3d> position_;
    std::vector<Piece> piece_;
    std::map<std::pair<int, int>, int> middle_; ///< per edge of pieces that is halved
};

} // namespace

MeshPoint SmoothMesh::in_facets(const MeshPoint& place) const
{
    MeshPoint result = place;
    result.face = face[size_t(place.face)];
    result.barycentric = barycentric[size_t(place.face)] * place.barycentric;
    return result;
}

Eigen::MatrixXd SmoothMesh::at_vertices(const TriMesh& from, const Eigen::MatrixXd& value) const
{
    Eigen::MatrixXd result(value.rows(), mesh.vertices());
    for (int t = 0; t < mesh.triangles(); ++t)
        for (int k = 0; k < 3; ++k) {
            auto here = result.col(mesh.triangle(k, t));
            here.setZero();
            for (int c = 0; c < 3; ++c)
                if (const double share = barycentric[size_t(t)](c, k); share != 0)
                    here += share * value.col(from.triangle(c, face[size_t(t)]));
        }
    return result;
}

SmoothMesh smooth_mesh(const TriMesh& mesh, const SmoothMeshOptions& options, const std::vector<Eigen::Matrix3f>& given)
{
    const std::vector<Eigen::Matrix3d> normal = smooth_normals(mesh, options.crease, given);
    const CurvedMesh curved(mesh, normal);
    Halving halving(mesh, curved, options.chord);
    const double chord = halving.farthest();
    for (int k = 0; k < options.most_halvings && halving.halve(); ++k)
        ;
    return halving.result(chord);
}

} // namespace spia
