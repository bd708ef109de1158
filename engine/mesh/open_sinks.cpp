#include "engine/mesh/open_sinks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// A triangle across the sheet, of a wall beside a skin.
struct LeaningFace {
    Eigen::Vector3d up;        ///< unit, of the skin; of the inner one turned over
    double lean;               ///< sine, of the triangle's normal over the plane of the skin
    std::optional<bool> outer; ///< it is beside the outer skin, or the inner one; else beside neither
};

constexpr double same_lean = 0.08; // of sines; 5 degrees

/// Of the triangles that lean, in any row of their wall; nothing for the others.
std::vector<std::optional<LeaningFace>> leaning_faces(const ThinSolid& sheet, const Eigen::Matrix3Xd& normal,
                                                      const Eigen::Matrix3Xi& neighbour)
{
    constexpr double square = 0.17, flat = 0.985; // sines of 10 and of 80 degrees
    std::vector<std::optional<LeaningFace>> result(size_t(normal.cols()));
    for (int f = 0; f < int(normal.cols()); ++f)
        for (int k = 0; k < 3 && sheet.side[size_t(f)] == SheetSide::rim; ++k) {
            const int next = neighbour(k, f);
            if (next < 0 || sheet.side[size_t(next)] == SheetSide::rim)
                continue;
            const bool outer = sheet.side[size_t(next)] == SheetSide::outer;
            const Eigen::Vector3d up = (outer ? 1 : -1) * normal.col(next).normalized();
            const double lean = normal.col(f).normalized().dot(up);
            if (std::abs(lean) > square && std::abs(lean) < flat)
                result[size_t(f)] = LeaningFace{up, lean, outer};
        }
    std::vector<int> reached;
    for (size_t f = 0; f < result.size(); ++f)
        if (result[f])
            reached.push_back(int(f));
    for (size_t i = 0; i < reached.size(); ++i) // further rows of triangles of the same wall
        for (const int next : neighbour.col(reached[i])) {
            if (next < 0 || sheet.side[size_t(next)] != SheetSide::rim || result[size_t(next)])
                continue;
            LeaningFace as = *result[size_t(reached[i])];
            const double lean = normal.col(next).normalized().dot(as.up);
            if (std::abs(lean - as.lean) >= same_lean)
                continue;
            as.lean = lean;
            as.outer.reset();
            result[size_t(next)] = as;
            reached.push_back(next);
        }
    return result;
}

/// The faces of each wall that leans at one angle, ascending.
std::map<int, std::vector<int>> walls_at_one_angle(const std::vector<std::optional<LeaningFace>>& leaning,
                                                   const Eigen::Matrix3Xi& neighbour)
{
    DisjointSets together(leaning.size());
    for (size_t f = 0; f < leaning.size(); ++f)
        for (const int next : neighbour.col(Eigen::Index(f)))
            if (leaning[f] && next >= 0 && leaning[size_t(next)] &&
                std::abs(leaning[f]->lean - leaning[size_t(next)]->lean) < same_lean)
                together.join(int(f), next);
    std::map<int, std::vector<int>> first;
    for (size_t f = 0; f < leaning.size(); ++f)
        if (leaning[f])
            first[together.root(int(f))].push_back(int(f));
    std::map<int, std::vector<int>> walls; // by their first faces
    for (auto& [root, wall] : first)
        walls.emplace(wall.front(), std::move(wall));
    return walls;
}

/// Whether the wall is in flat sheet, turns around an axis and faces it.
bool is_hollow_cone(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const std::vector<int>& wall,
                    const std::vector<std::optional<LeaningFace>>& leaning)
{
    constexpr double one_plane = 1 - 1e-6; // 0.1 degrees
    constexpr double turning = 0.985;      // the mean of unit vectors over an arc of 35 degrees is as long
    const Eigen::Vector3d up = leaning[size_t(wall.front())]->up;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero(), centre = mean;
    double size = 0;
    const auto across = [&](int f) {
        const Eigen::Vector3d n = normal.col(f);
        return Eigen::Vector3d((n - n.dot(up) * up).normalized());
    };
    const auto middle = [&](int f) {
        return Eigen::Vector3d(solid.position(Eigen::all, solid.triangle.col(f)).rowwise().mean());
    };
    for (const int f : wall) {
        if (leaning[size_t(f)]->up.dot(up) < one_plane)
            return false;
        const double own = normal.col(f).norm();
        mean += own * across(f);
        centre += own * middle(f);
        size += own;
    }
    if (mean.norm() > turning * size)
        return false;
    centre /= size;
    double outwards = 0;
    for (const int f : wall)
        outwards += normal.col(f).norm() * across(f).dot(middle(f) - centre);
    return outwards < 0;
}

} // namespace

std::vector<OpenSink> open_sinks(const TriMesh& solid, const ThinSolid& sheet, const std::vector<SunkHole>& told)
{
    const Eigen::Matrix3Xd normal = sheet.flipped * area_vectors(solid);
    const Eigen::Matrix3Xi neighbour = face_neighbours(solid.triangles(), edge_uses(solid.triangle));
    const auto leaning = leaning_faces(sheet, normal, neighbour);
    std::vector<OpenSink> found;
    for (const auto& [first, wall] : walls_at_one_angle(leaning, neighbour)) {
        const auto has = [&](const SunkHole& hole) { return std::ranges::binary_search(wall, hole.face); };
        if (std::ranges::any_of(told, has) || !is_hollow_cone(solid, normal, wall, leaning))
            continue;
        const auto beside = [&](bool outer) {
            return std::ranges::any_of(wall, [&](int f) { return leaning[size_t(f)]->outer == outer; });
        };
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        for (const int f : wall)
            place += solid.position(Eigen::all, solid.triangle.col(f)).rowwise().mean() / double(wall.size());
        found.push_back({first, place, !(beside(true) && beside(false))});
    }
    return found;
}

} // namespace spia
