#include "engine/mesh/solid/border/askew_wall.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

namespace spia {
namespace {

Eigen::Vector3d normal_of(const TriMesh& solid, int f)
{
    const Eigen::Matrix3d c = solid.position(Eigen::all, solid.triangle.col(f));
    return (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0)).normalized();
}

/// Whether an edge goes along the sheet rather than through it: not from skin to skin, however
/// flat.
bool along_sheet(const TriMesh& solid, int f, int k, const SheetPlane& sheet)
{
    constexpr double most = 0.4, much = 0.9; // sine of 24 degrees; of the thickness
    const Eigen::Vector3d edge =
        solid.position.col(solid.triangle((k + 1) % 3, f)) - solid.position.col(solid.triangle(k, f));
    const double through = std::abs(edge.dot(sheet.normal));
    return through < most * edge.norm() && through < much * 2 * sheet.half;
}

constexpr double smooth = 0.9;  // cosine of 25 degrees
constexpr double level = 0.996; // sine of 85 degrees: what leans more is a skin

/// Between which some triangles are, mm, and the middle of the sheet.
struct Heights {
    double low = 0, high = 0;

    void take(const TriMesh& solid, int face, const SheetPlane& sheet)
    {
        for (const int v : solid.triangle.col(face)) {
            low = std::min(low, sheet.height(solid.position.col(v)));
            high = std::max(high, sheet.height(solid.position.col(v)));
        }
    }
};

/// Whether a triangle may be of a wall of the sheet, whose foot may be in the bend beside the flat.
bool beside_sheet(const TriMesh& solid, int face, const SheetPlane& sheet)
{
    constexpr double much = 12; // half thicknesses: as far as a wall at 85 degrees leads
    return std::ranges::all_of(solid.triangle.col(face), [&](int v) {
        return std::abs(sheet.height(solid.position.col(v))) <= much * sheet.half;
    });
}

/// Triangles around one that hold, over edges at which these two belong together.
std::vector<int> grown(const Eigen::Matrix3Xi& neighbour, int face, const auto& holds, const TriMesh& solid,
                       const auto& together)
{
    std::vector<int> result{face};
    std::set<int> known{face};
    for (size_t i = 0; i < result.size(); ++i)
        for (const int next : neighbour.col(result[i]))
            if (next >= 0 && !known.contains(next) && holds(next) &&
                together(normal_of(solid, result[i]), normal_of(solid, next))) {
                known.insert(next);
                result.push_back(next);
            }
    return result;
}

/// Whether what goes on smoothly from a triangle ends at a square wall, along the sheet.
bool of_chamfer(const TriMesh& solid, const Eigen::Matrix3Xi& neighbour, int face, const SheetPlane& sheet)
{
    const std::vector<int> faces = grown(
        neighbour, face, [&](int f) { return sheet.holds(solid, f); }, solid,
        [&](const auto& a, const auto& b) { return a.dot(b) > smooth && std::abs(b.dot(sheet.normal)) < level; });
    return std::ranges::any_of(faces, [&](int f) {
        for (int k = 0; k < 3; ++k)
            if (const int next = neighbour(k, f);
                next >= 0 && std::abs(normal_of(solid, next).dot(sheet.normal)) <= square_lean &&
                normal_of(solid, f).dot(normal_of(solid, next)) <= smooth && along_sheet(solid, f, k, sheet))
                return true;
        return false;
    });
}

} // namespace

bool SheetPlane::holds(const TriMesh& solid, int face) const
{
    constexpr double rounding = 1e-6;
    return std::ranges::all_of(solid.triangle.col(face),
                               [&](int v) { return std::abs(height(solid.position.col(v))) <= (1 + rounding) * half; });
}

AskewWall askew_wall(const TriMesh& solid, const Eigen::Matrix3Xi& neighbour, int face, const SheetPlane& sheet)
{
    constexpr double alike = 0.02;     // of the sine: what turns away is the wall of a bend beside the flat
    constexpr double most_of_it = 0.6; // of the thickness: its chamfers take less
    const double lean = normal_of(solid, face).dot(sheet.normal);
    if (std::abs(lean) <= square_lean || std::abs(lean) >= level)
        return {{face}};
    AskewWall wall{grown(
        neighbour, face, [&](int f) { return beside_sheet(solid, f, sheet); }, solid,
        [&](const auto& a, const auto& b) {
            return a.dot(b) > smooth && std::abs(b.dot(sheet.normal) - lean) < alike;
        })};
    Heights own;
    for (const int f : wall.face) {
        constexpr double same = 0.9999; // cosine of 0.8 degrees
        own.take(solid, f, sheet);
        wall.plane &= normal_of(solid, f).dot(normal_of(solid, face)) > same;
    }
    Heights with_chamfers = own;
    for (const int f : wall.face)
        for (int k = 0; k < 3; ++k)
            if (const int next = neighbour(k, f);
                next >= 0 && sheet.holds(solid, next) && along_sheet(solid, f, k, sheet))
                with_chamfers.take(solid, next, sheet);
    constexpr double nearly = 0.98;
    wall.crosses = own.low < 0 && own.high > 0 && own.high - own.low > most_of_it * 2 * sheet.half &&
                   std::min(with_chamfers.high, -with_chamfers.low) > nearly * sheet.half &&
                   !of_chamfer(solid, neighbour, face, sheet);
    return wall;
}

} // namespace spia
