#include "engine/mesh/smooth/smooth_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/mesh/smooth/creases.h"
#include "engine/mesh/vectors.h"

namespace spia {

namespace {

double corner_angle(const TriMesh& mesh, int f, int k)
{
    const Eigen::Vector3d at = mesh.position.col(mesh.triangle(k, f));
    return angle_between(mesh.position.col(mesh.triangle((k + 1) % 3, f)) - at,
                         mesh.position.col(mesh.triangle((k + 2) % 3, f)) - at);
}

/// Triangles around a vertex that are not parted by creases.
struct Fan {
    int vertex = -1;
    std::vector<int> face;
    bool known = true;      ///< the normal: it runs all around the vertex, or was led on to it
    bool flat = false;      ///< the sheet goes on flat behind some of it
    Eigen::Vector3d normal; ///< unit
};

/// The one with the last of the triangles left around a vertex, which are taken from them.
Fan fan_around(const SheetTurns& turns, int v, std::vector<int>& left)
{
    const TriMesh& mesh = turns.mesh();
    Fan fan;
    fan.vertex = v;
    fan.face.push_back(left.back());
    left.pop_back();
    for (size_t i = 0; i < fan.face.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const int f = fan.face[i], g = turns.neighbour(f, k);
            if (mesh.triangle(k, f) != v && mesh.triangle((k + 1) % 3, f) != v)
                continue;
            if (g < 0 || turns.creased(f, k))
                fan.known = false;
            else if (const auto found = std::find(left.begin(), left.end(), g); found != left.end()) {
                fan.face.push_back(g);
                left.erase(found);
            }
        }
    return fan;
}

double shortest_edge_at(const TriMesh& mesh, const Fan& fan)
{
    double result = std::numeric_limits<double>::infinity();
    for (const int f : fan.face)
        for (const int v : mesh.triangle.col(f))
            if (v != fan.vertex)
                result = std::min(result, (mesh.position.col(v) - mesh.position.col(fan.vertex)).norm());
    return result;
}

/// Radians, per triangle of a fan by how much the sheet turns on behind it, near the vertex.
/// Triangles of one facet are alike: what is behind one is behind all.
std::vector<double> turns_on(const SheetTurns& turns, const Fan& fan)
{
    constexpr double near = 3; // shortest edges at the vertex
    const double reach = near * shortest_edge_at(turns.mesh(), fan);
    std::vector<double> own;
    for (const int f : fan.face)
        own.push_back(turns.turn_behind(f, fan.face, fan.vertex, reach));
    std::vector<double> result(fan.face.size(), 0), most_within(fan.face.size(), 0);
    for (size_t i = 0; i < fan.face.size(); ++i)
        for (size_t j = 0; j < fan.face.size(); ++j) {
            const double between = angle_between(turns.normal(fan.face[i]), turns.normal(fan.face[j]));
            most_within[i] = std::max(most_within[i], between);
            if (between < SheetTurns::level)
                result[i] = std::max(result[i], own[j]);
        }
    // Where a rim hides what is behind a triangle the turn to it tells: chords of an arc turn as
    // much to the last one as before, to a flat half as much.
    const double most = *std::ranges::max_element(result),
                 least = std::max(SheetTurns::level, SheetTurns::isolated * most);
    constexpr double as_before = 0.75;
    for (size_t i = 0; i < fan.face.size(); ++i) {
        const bool hidden = std::ranges::any_of(turns.mesh().triangle.col(fan.face[i]),
                                                [&](int v) { return v != fan.vertex && turns.at_rim(v); });
        if (hidden && result[i] < least && most_within[i] > std::max(SheetTurns::level, as_before * most))
            result[i] = most;
    }
    return result;
}

/// Of those of its triangles behind which the sheet goes on flat; of all where there are none.
void average(Fan& fan, const SheetTurns& turns)
{
    const std::vector<double> on = turns_on(turns, fan);
    const double least = std::max(SheetTurns::level, SheetTurns::isolated * *std::ranges::max_element(on));
    fan.flat = std::ranges::any_of(on, [&](double turn) { return turn < least; });
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < fan.face.size(); ++i)
        if (const int f = fan.face[i]; !fan.flat || on[i] < least)
            sum += corner_angle(turns.mesh(), f, turns.mesh().corner_of(f, fan.vertex)) * turns.normal(f);
    fan.normal = sum.normalized();
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

Fans fans_of(const SheetTurns& turns)
{
    const TriMesh& mesh = turns.mesh();
    Fans fans;
    fans.of.resize(size_t(mesh.triangles()));
    for (int v = 0; v < mesh.vertices(); ++v)
        for (std::vector<int> left = turns.around(v); !left.empty();) {
            fans.fan.push_back(fan_around(turns, v, left));
            average(fans.fan.back(), turns);
            for (const int f : fans.fan.back().face)
                fans.of[size_t(f)][size_t(mesh.corner_of(f, v))] = int(fans.fan.size()) - 1;
        }
    return fans;
}

/// Where triangles are on one side of a vertex only, their mean is the normal some way inside. It
/// is led on straight from the nearest vertex whose normal is known and the one behind it; nothing
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

void lead_on(Fans& fans, const TriMesh& mesh)
{
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
}

/// Triangles beside those whose normals are known have them as well.
void take_given(std::vector<Eigen::Matrix3d>& normal, const std::vector<Eigen::Matrix3f>& given, const TriMesh& mesh,
                const Fans& fans)
{
    const auto given_at = [&](int f, int k) { return Eigen::Vector3d(given[size_t(f)].col(k).cast<double>()); };
    for (const Fan& fan : fans.fan) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const int f : fan.face)
            sum += given_at(f, mesh.corner_of(f, fan.vertex));
        if (sum.isZero())
            continue;
        for (const int f : fan.face) {
            const int k = mesh.corner_of(f, fan.vertex);
            normal[size_t(f)].col(k) = (given_at(f, k).isZero() ? sum : given_at(f, k)).normalized();
        }
    }
}

} // namespace

std::vector<Eigen::Matrix3d> smooth_normals(const TriMesh& mesh, double crease,
                                            const std::vector<Eigen::Matrix3f>& given)
{
    const SheetTurns turns(mesh, crease);
    Fans fans = fans_of(turns);
    lead_on(fans, mesh);
    std::vector<Eigen::Matrix3d> result(size_t(mesh.triangles()));
    for (const Fan& fan : fans.fan)
        for (const int f : fan.face)
            result[size_t(f)].col(mesh.corner_of(f, fan.vertex)) = fan.normal;
    if (!given.empty())
        take_given(result, given, mesh, fans);
    return result;
}

} // namespace spia
