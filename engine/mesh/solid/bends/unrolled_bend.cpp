#include "engine/mesh/solid/bends/unrolled_bend.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/fit/cylinder_fit.h"
#include "engine/mesh/solid/off_axis.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using Kind = StatedSurface::Kind;

constexpr double same_way = 0.9998; // of normals of one flat; 1 degree

/// The triangles of the middle surface that are unrolled.
struct Zone {
    std::vector<int> face;
    std::vector<char> on;             ///< as UnrolledBend::on
    std::vector<StatedSurface> plane; ///< of the outer skin
};

Zone on_cylinder(const MiddleOfSolid& part, const StatedSurface& on)
{
    Zone zone;
    zone.on.assign(size_t(part.middle.mesh.triangles()), 0);
    for (int f = 0; f < part.middle.mesh.triangles(); ++f)
        if (same_cylinder(part.surface[size_t(part.middle.source_face[size_t(f)])], on)) {
            zone.face.push_back(f);
            zone.on[size_t(f)] = 1;
        }
    return zone;
}

/// Triangles of the solid that go on evenly from the cylinder, the largest first: the narrow ones
/// right beside it tell their plane only as well as the digits of STL do over their width.
std::vector<int> flats_beside(const MiddleOfSolid& part, const Zone& zone, const Eigen::Matrix3Xi& beside)
{
    const auto source = [&](int f) { return part.middle.source_face[size_t(f)]; };
    std::vector<int> next;
    std::vector<char> seen = zone.on;
    for (const int f : zone.face)
        for (const int g : beside.col(f))
            if (g >= 0 && !std::exchange(seen[size_t(g)], 1))
                next.push_back(g);
    for (size_t i = 0; i < next.size(); ++i)
        for (const int g : beside.col(next[i]))
            if (g >= 0 && !seen[size_t(g)] &&
                part.normal.col(source(next[i])).normalized().dot(part.normal.col(source(g)).normalized()) > same_way) {
                seen[size_t(g)] = 1;
                next.push_back(g);
            }
    std::ranges::transform(next, next.begin(), source);
    std::ranges::stable_sort(next, std::greater(), [&](int f) { return part.normal.col(f).norm(); });
    return next;
}

/// The first two flats that touch the cylinder.
void find_planes(const MiddleOfSolid& part, const StatedSurface& on, const Eigen::Matrix3Xi& beside, Zone& zone)
{
    constexpr double along = 1e-4; // radians, of a flat against the axis, as UnrolledSkin takes it
    for (const int s : flats_beside(part, zone, beside)) {
        const StatedSurface flat{Kind::plane, part.solid.position.col(part.solid.triangle(0, s)),
                                 part.normal.col(s).normalized(), 0, 0};
        if (zone.plane.size() < 2 && part.surface[size_t(s)].kind != Kind::cylinder &&
            std::abs(flat.direction.dot(on.direction)) < along &&
            std::abs(std::abs((on.point - flat.point).dot(flat.direction)) - on.radius) < part.within &&
            std::ranges::none_of(zone.plane,
                                 [&](const StatedSurface& p) { return p.direction.dot(flat.direction) > same_way; }))
            zone.plane.push_back(flat);
    }
}

bool lies_in(const MiddleOfSolid& part, int f, const StatedSurface& plane)
{
    const int s = part.middle.source_face[size_t(f)];
    if (part.surface[size_t(s)].kind == Kind::cylinder)
        return false; // a narrow triangle of another bend, beside its end
    return part.normal.col(s).dot(plane.direction) > 0 &&
           std::ranges::all_of(part.middle.mesh.triangle.col(f), [&](int v) {
               return std::abs((part.outer(v) - plane.point).dot(plane.direction)) <= part.within;
           });
}

/// What is connected to the cylinder on its flats.
void add_flats(const MiddleOfSolid& part, const Eigen::Matrix3Xi& beside, Zone& zone)
{
    for (size_t i = 0; i < zone.face.size(); ++i)
        for (const int g : beside.col(zone.face[i]))
            for (size_t p = 0; g >= 0 && !zone.on[size_t(g)] && p < zone.plane.size(); ++p)
                if (lies_in(part, g, zone.plane[p])) {
                    zone.on[size_t(g)] = char(2 + p);
                    zone.face.push_back(g);
                }
}

/// Whether the outer skin is on the inner side of the bend.
bool is_hollow(const MiddleOfSolid& part, const StatedSurface& on, const Zone& zone)
{
    const int first = part.middle.source_face[size_t(zone.face.front())];
    const Eigen::Vector3d mean = part.solid.position(Eigen::all, part.solid.triangle.col(first)).rowwise().mean();
    return normal_at(on, mean, part.normal.col(first)).dot(mean - on.point) < 0;
}

/// mm, per vertex of the middle surface that is unrolled: half a thickness straight below the outer
/// skin.
Eigen::Matrix3Xd below_skin(const MiddleOfSolid& part, const StatedSurface& on, const Zone& zone, bool hollow)
{
    const double half = part.sheet.thickness / 2;
    Eigen::Matrix3Xd below(3, part.middle.mesh.vertices());
    for (const int f : zone.face)
        for (const int v : part.middle.mesh.triangle.col(f)) {
            const int kind = zone.on[size_t(f)] - 1;
            const Eigen::Vector3d out = off_axis(on, part.outer(v)).normalized();
            const Eigen::Vector3d inwards = kind > 0 ? Eigen::Vector3d(-zone.plane[size_t(kind - 1)].direction)
                                            : hollow ? out
                                                     : Eigen::Vector3d(-out);
            below.col(v) = part.outer(v) + half * inwards;
        }
    return below;
}

PlaneTriangles plane_triangles(const MiddleOfSolid& part, const std::vector<int>& faces,
                               std::vector<Eigen::Vector2d> at)
{
    PlaneTriangles result{std::move(at), part.middle.source_vertex, {}, 1};
    double sum = 0;
    for (const int f : faces) {
        const auto t = part.middle.mesh.triangle.col(f);
        result.triangle.push_back({{t[0], t[1], t[2]}, part.middle.source_face[size_t(f)]});
        sum += area(result, result.triangle.back().corner);
    }
    result.way_round = sum > 0 ? 1 : -1;
    return result;
}

std::optional<UnrolledBend> flattened(const MiddleOfSolid& part, const StatedSurface& on, const Zone& zone)
{
    const double half = part.sheet.thickness / 2;
    const bool hollow = is_hollow(part, on, zone);
    StatedSurface cylinder = on;
    cylinder.radius += hollow ? half : -half;
    if (!(cylinder.radius > part.within))
        return std::nullopt;
    std::vector<StatedSurface> surfaces{cylinder};
    for (StatedSurface p : zone.plane) {
        p.point -= half * p.direction;
        surfaces.push_back(p);
    }
    const std::vector<int> vertices = corners(part.middle.mesh, zone.face);
    const Eigen::Matrix3Xd below = below_skin(part, on, zone, hollow);
    const auto skin = UnrolledSkin::of(surfaces, below(Eigen::all, vertices), part.within);
    if (!skin)
        return std::nullopt;
    std::vector<Eigen::Vector2d> from(size_t(part.middle.mesh.vertices()), Eigen::Vector2d::Zero()), now = from;
    for (const int v : vertices) {
        const auto start = skin->flat(below.col(v));
        if (!start)
            return std::nullopt;
        from[size_t(v)] = *start;
        now[size_t(v)] = skin->flat(part.middle.mesh.position.col(v)).value_or(Eigen::Vector2d::Constant(std::nan("")));
    }
    return UnrolledBend{*skin,
                        cylinder,
                        {surfaces.begin() + 1, surfaces.end()},
                        zone.on,
                        plane_triangles(part, zone.face, std::move(from)),
                        std::move(now),
                        {}};
}

} // namespace

MiddleOfSolid::MiddleOfSolid(const SkinMesh& of, const TriMesh& whole, const ThinSolid& taken_apart,
                             const std::vector<StatedSurface>& surfaces)
    : middle(of), solid(whole), sheet(taken_apart), surface(surfaces),
      normal(taken_apart.flipped * area_vectors(whole)), uses(edge_uses(whole.triangle)),
      within(1e-3 * taken_apart.thickness)
{
}

std::optional<UnrolledBend> unrolled_bend(const MiddleOfSolid& part, const StatedSurface& on)
{
    const std::vector<EdgeUse> uses = edge_uses(part.middle.mesh.triangle);
    const Eigen::Matrix3Xi beside = face_neighbours(part.middle.mesh.triangles(), uses);
    Zone zone = on_cylinder(part, on);
    find_planes(part, on, beside, zone);
    add_flats(part, beside, zone);
    if (zone.plane.size() != 2 || zone.face.empty())
        return std::nullopt;
    auto bend = flattened(part, on, zone);
    if (bend)
        for_each_edge(uses, [&](size_t begin, size_t end) {
            const auto in = [&](size_t use) { return bend->on[size_t(uses[use].face)] != 0; };
            if (end == begin + 2 && in(begin) != in(begin + 1))
                bend->fixed.insert({uses[begin].low, uses[begin].high});
        });
    return bend;
}

} // namespace spia
