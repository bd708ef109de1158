#include "engine/mesh/sunk_holes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Where faces across the thickness that hang together meet one skin.
struct Edge {
    std::vector<int> vertex; ///< of the solid, ascending
    std::vector<int> skin;   ///< triangles of the skin
    std::vector<int> wall;   ///< triangles across the thickness
};

/// All faces across the thickness that hang together.
struct Wall {
    std::vector<int> vertex; ///< of the solid, ascending
    Edge outer, inner;
};

void make_set(std::vector<int>& values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// In the order of their first triangles.
std::vector<Wall> walls_of(const TriMesh& solid, const ThinSolid& sheet)
{
    const auto rim = [&](int f) { return sheet.side[size_t(f)] == SheetSide::rim; };
    const std::vector<EdgeUse> uses = edge_uses(solid.triangle);
    DisjointSets together(size_t(solid.triangles()));
    const auto each_edge = [&](const auto& visit) {
        for_each_edge(uses, [&](size_t begin, size_t end) {
            if (end == begin + 2)
                visit(uses[begin], uses[begin + 1]);
        });
    };
    each_edge([&](const EdgeUse& a, const EdgeUse& b) {
        if (rim(a.face) && rim(b.face))
            together.join(a.face, b.face);
    });
    std::map<int, size_t> number;
    std::vector<Wall> walls;
    for (int f = 0; f < solid.triangles(); ++f) {
        if (!rim(f))
            continue;
        const auto [at, added] = number.try_emplace(together.root(f), walls.size());
        if (added)
            walls.emplace_back();
        for (const int v : solid.triangle.col(f))
            walls[at->second].vertex.push_back(v);
    }
    each_edge([&](const EdgeUse& a, const EdgeUse& b) {
        if (rim(a.face) == rim(b.face))
            return;
        const int wall = rim(a.face) ? a.face : b.face, skin = rim(a.face) ? b.face : a.face;
        Wall& found = walls[number.at(together.root(wall))];
        Edge& edge = sheet.side[size_t(skin)] == SheetSide::outer ? found.outer : found.inner;
        edge.vertex.insert(edge.vertex.end(), {a.low, a.high});
        edge.skin.push_back(skin);
        edge.wall.push_back(wall);
    });
    for (Wall& wall : walls)
        for (std::vector<int>* values : {&wall.vertex, &wall.outer.vertex, &wall.inner.vertex})
            make_set(*values);
    return walls;
}

struct Circle {
    Eigen::Vector3d centre, outwards; ///< outwards: unit length, normal of the skin around it
    double radius = 0;

    Eigen::Vector3d off_axis(const Eigen::Vector3d& p) const
    {
        return p - centre - (p - centre).dot(outwards) * outwards;
    }
};

/// Whether directions go all around as the corners of a circle do: it has chords of 30 degrees at most, a polygon with eight corners is one.
bool all_around(std::vector<double> angle)
{
    constexpr double gap = 35 * std::numbers::pi / 180; // as find_curves() has it
    if (angle.empty())
        return false;
    std::sort(angle.begin(), angle.end());
    double widest = angle.front() + 2 * std::numbers::pi - angle.back();
    for (size_t i = 0; i + 1 < angle.size(); ++i)
        widest = std::max(widest, angle[i + 1] - angle[i]);
    return widest <= gap;
}

/// The circle that an edge is on plane skin which lies around it; none: it is another thing.
std::optional<Circle> circle_through(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const Edge& edge,
                                     double thickness)
{
    constexpr size_t least_vertices = 8;
    constexpr double plane = 1 - 1e-6, same = 1e-3; // 0.1 degrees; of the thickness
    if (edge.vertex.size() < least_vertices)
        return std::nullopt;
    Circle circle{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    double size = 0;
    for (const int f : edge.skin) {
        circle.outwards += normal.col(f);
        size += normal.col(f).norm();
    }
    if (circle.outwards.norm() < plane * size)
        return std::nullopt;
    circle.outwards.normalize();
    // x^2 + y^2 = 2 a x + 2 b y + c in the plane, least squares.
    const Eigen::Vector3d x = circle.outwards.unitOrthogonal(), y = circle.outwards.cross(x);
    const Eigen::Matrix3Xd at = solid.position(Eigen::all, edge.vertex);
    const Eigen::Vector3d mean = at.rowwise().mean();
    const Eigen::Matrix3Xd from = at.colwise() - mean;
    Eigen::MatrixX3d a(at.cols(), 3);
    a << 2 * (x.transpose() * from).transpose(), 2 * (y.transpose() * from).transpose(),
        Eigen::VectorXd::Ones(at.cols());
    const Eigen::VectorXd b = a.leftCols<2>().rowwise().squaredNorm() / 4;
    const Eigen::Vector3d fit = a.colPivHouseholderQr().solve(b);
    circle.centre = mean + fit[0] * x + fit[1] * y;
    circle.radius = std::sqrt(std::max(fit[2] + fit.head<2>().squaredNorm(), 0.));
    std::vector<double> angle;
    for (Eigen::Index i = 0; i < at.cols(); ++i) {
        const Eigen::Vector3d way = at.col(i) - circle.centre;
        angle.push_back(std::atan2(way.dot(y), way.dot(x)));
        if (std::abs(circle.off_axis(at.col(i)).norm() - circle.radius) > same * thickness ||
            std::abs(way.dot(circle.outwards)) > same * thickness)
            return std::nullopt;
    }
    double beyond = 0; // of the sheet's own outline the skin is within
    for (const int f : edge.skin)
        beyond +=
            circle.off_axis(solid.position(Eigen::all, solid.triangle.col(f)).rowwise().mean()).norm() - circle.radius;
    return beyond > 0 && all_around(angle) ? std::optional(circle) : std::nullopt;
}

std::optional<SunkHole> sunk(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const Wall& wall, SheetSide side,
                             double thickness)
{
    constexpr double same = 1e-3,
                     wider = 0.02; // of the thickness; a hole that was punched is wider at one side by less
    const Edge& edge = side == SheetSide::outer ? wall.outer : wall.inner;
    const std::optional<Circle> circle = circle_through(solid, normal, edge, thickness);
    if (!circle)
        return std::nullopt;
    double least = std::numeric_limits<double>::infinity();
    for (const int v : wall.vertex)
        least = std::min(least, circle->off_axis(solid.position.col(v)).norm());
    if (least > circle->radius - wider * thickness)
        return std::nullopt;
    double depth = std::numeric_limits<double>::infinity();
    std::vector<double> angle;
    const Eigen::Vector3d x = circle->outwards.unitOrthogonal(), y = circle->outwards.cross(x);
    for (const int v : wall.vertex)
        if (const Eigen::Vector3d out = circle->off_axis(solid.position.col(v));
            out.norm() <= least + same * thickness) {
            depth = std::min(depth, (circle->centre - solid.position.col(v)).dot(circle->outwards));
            angle.push_back(std::atan2(out.dot(y), out.dot(x)));
        }
    double along = 0, size = 0;
    for (const int f : edge.wall) {
        along += std::abs(normal.col(f).dot(circle->outwards));
        size += normal.col(f).norm();
    }
    constexpr double square = 0.1; // 6 degrees
    return SunkHole{side,  circle->centre,         -circle->outwards, 2 * circle->radius, 2 * least,
                    depth, along <= square * size, edge.wall.front(), wall.outer.vertex};
}

} // namespace

std::vector<SunkHole> sunk_holes(const TriMesh& solid, const ThinSolid& sheet)
{
    const Eigen::Matrix3Xd normal = sheet.flipped * area_vectors(solid);
    std::vector<SunkHole> holes;
    for (const Wall& wall : walls_of(solid, sheet)) {
        if (wall.outer.vertex.empty() || wall.inner.vertex.empty())
            continue; // not through the sheet
        for (const SheetSide side : {SheetSide::outer, SheetSide::inner})
            if (auto hole = sunk(solid, normal, wall, side, sheet.thickness))
                holes.push_back(std::move(*hole));
    }
    return holes;
}

int narrow_holes(SkinMesh& middle, const std::vector<SunkHole>& holes)
{
    constexpr double rounding = 1e-12;
    int moved = 0;
    for (const SunkHole& hole : holes)
        for (int v = 0; v < middle.mesh.vertices() && hole.least > 0; ++v) {
            if (!std::binary_search(hole.outer.begin(), hole.outer.end(), middle.source_vertex[size_t(v)]))
                continue;
            auto place = middle.mesh.position.col(v);
            const Eigen::Vector3d way = place - hole.centre, out = way - way.dot(hole.inwards) * hole.inwards;
            const double share = hole.least / 2 / out.norm() - 1;
            if (std::abs(share) <= rounding)
                continue;
            place += share * out;
            ++moved;
        }
    return moved;
}

Eigen::Matrix3Xd circle_of(const SunkHole& hole, Skin surface, double thickness)
{
    constexpr int points = 120; // chords of 3 degrees, as round_border() has them
    const bool same = (surface == Skin::outer) == (hole.skin == SheetSide::outer);
    const double depth = surface == Skin::middle ? thickness / 2 : same ? 0 : thickness;
    const Eigen::Vector3d x = hole.inwards.unitOrthogonal(), y = hole.inwards.cross(x);
    Eigen::Matrix3Xd row(3, points + 1);
    for (int i = 0; i <= points; ++i) {
        const double angle = 2 * std::numbers::pi * (i % points) / points;
        row.col(i) =
            hole.centre + depth * hole.inwards + hole.diameter / 2 * (std::cos(angle) * x + std::sin(angle) * y);
    }
    return row;
}

} // namespace spia
