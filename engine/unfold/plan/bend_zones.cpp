#include "engine/unfold/plan/bend_zones.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/fit/cylinder_fit.h"
#include "engine/mesh/topology.h"
#include "engine/unfold/plan/free_ends.h"
#include "engine/unfold/plan/strip_cylinders.h"

namespace spia {
namespace {

using std::numbers::pi;

double nearest_turn(double angle, double to) { return angle - 2 * pi * std::round((angle - to) / (2 * pi)); }

/// Faces outside a zone that go on from it nearly as it ends.
std::vector<int> faces_beyond(const Eigen::Matrix3Xd& normal, const Eigen::Matrix3Xi& neighbour, const BendZone& zone)
{
    constexpr double level = 0.98; // of the cosine, 11 degrees: a vertex of the rim that lies off
                                   // the flat tilts triangles beside it
    std::vector<int> reached;
    std::set<int> seen(zone.face.begin(), zone.face.end());
    const auto level_with = [&](int f, int g) {
        return normal.col(f).dot(normal.col(g)) > level * normal.col(f).norm() * normal.col(g).norm();
    };
    for (const int f : zone.face)
        for (int k = 0; k < 3; ++k)
            if (const int g = neighbour(k, f); g >= 0 && seen.insert(g).second)
                reached.push_back(g);
    for (size_t i = 0; i < reached.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (const int g = neighbour(k, reached[i]); g >= 0 && level_with(reached[i], g) && seen.insert(g).second)
                reached.push_back(g);
    return reached;
}

/// Between two holes that cross its end askew no corner may lie where a bend ends, but the flat
/// beside it tells: it touches the cylinder there.
void end_on_flats(const TriMesh& part, const Eigen::Matrix3Xi& neighbour, BendZone& zone)
{
    const Eigen::Matrix3Xd normal = area_vectors(part);
    const Eigen::Matrix<double, 3, 2> frame = across(zone.axis);
    const double middle = (zone.from + zone.to) / 2;
    // that tells of each end
    Eigen::Vector2d end(zone.from, zone.to), largest = Eigen::Vector2d::Zero();
    for (const int f : faces_beyond(normal, neighbour, zone)) {
        const Eigen::Vector3d n = normal.col(f).normalized();
        const double from_axis = (part.position.col(part.triangle(0, f)) - zone.point).dot(n);
        constexpr double touches = 1e-9; // of the radius: a triangle that is tilted by 4e-5 rad is
                                         // farther off
        if (std::abs(std::abs(from_axis) - zone.radius) > touches * zone.radius + 2 * zone.measured ||
            std::abs(n.dot(zone.axis)) > touches + 2 * zone.measured / zone.radius)
            continue;
        const Eigen::Vector2d to_it = frame.transpose() * (from_axis > 0 ? n : Eigen::Vector3d(-n));
        const double angle = nearest_turn(std::atan2(to_it.y(), to_it.x()), middle), size = normal.col(f).norm();
        const int which = angle < middle ? 0 : 1;
        if (size > largest[which]) {
            largest[which] = size;
            end[which] = angle;
        }
    }
    constexpr double near = 0.3; // of the angle: as far as rims go past the end of the smallest
                                 // bends
    const double much = near * (zone.to - zone.from);
    if (std::abs(end[0] - zone.from) < much)
        zone.from = end[0];
    if (std::abs(end[1] - zone.to) < much)
        zone.to = end[1];
}

/// mm, from the cylinder.
double median_off(const TriMesh& part, const BendZone& zone, const std::set<int>& corners)
{
    std::vector<double> off;
    for (const int v : corners) {
        const Eigen::Vector3d from = part.position.col(v) - zone.point;
        off.push_back(std::abs((from - from.dot(zone.axis) * zone.axis).norm() - zone.radius));
    }
    std::ranges::sort(off);
    return off.empty() ? 0 : off[off.size() / 2];
}

/// Angles of all corners without jumps, from face to face; and what follows from them.
void measure(const TriMesh& part, const Eigen::Matrix3Xi& neighbour, BendZone& zone)
{
    const Eigen::Matrix<double, 3, 2> frame = across(zone.axis);
    std::sort(zone.face.begin(), zone.face.end());
    const auto index = [&](int f) {
        const auto at = std::lower_bound(zone.face.begin(), zone.face.end(), f);
        return at != zone.face.end() && *at == f ? int(at - zone.face.begin()) : -1;
    };
    zone.turn.assign(zone.face.size(), Eigen::Vector3d::Zero());
    std::vector<double> off;
    std::vector<char> seen(zone.face.size(), 0);
    std::vector<int> reached{0};
    seen[0] = 1;
    double start = 0;
    const auto place = [&](int i, double near) {
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector2d p =
                frame.transpose() * (part.position.col(part.triangle(k, zone.face[size_t(i)])) - zone.point);
            off.push_back(std::abs(p.norm() - zone.radius));
            zone.turn[size_t(i)][k] = nearest_turn(std::atan2(p.y(), p.x()), near);
            near = zone.turn[size_t(i)][k]; // a triangle spans less than a half turn
        }
    };
    place(0, start);
    while (!reached.empty()) {
        const int i = reached.back();
        reached.pop_back();
        for (int k = 0; k < 3; ++k) {
            const int f = zone.face[size_t(i)], next = neighbour(k, f);
            const int j = next < 0 ? -1 : index(next);
            if (j < 0 || seen[size_t(j)])
                continue;
            // From a corner that both have.
            const int shared = part.triangle(k, f);
            place(j, 0);
            for (int c = 0; c < 3; ++c)
                if (part.triangle(c, next) == shared) {
                    const double shift = zone.turn[size_t(i)][k] - zone.turn[size_t(j)][c];
                    zone.turn[size_t(j)].array() += 2 * pi * std::round(shift / (2 * pi));
                }
            seen[size_t(j)] = 1;
            reached.push_back(j);
        }
    }
    std::sort(off.begin(), off.end());
    zone.off = off[off.size() * 3 / 4];
    const double middle_off = off[off.size() / 2];
    size_t kept = 0; // what only a corner joins to the rest would have angles of its own
    for (size_t i = 0; i < zone.face.size(); ++i)
        if (seen[i]) {
            zone.face[kept] = zone.face[i];
            zone.turn[kept++] = zone.turn[i];
        }
    zone.face.resize(kept);
    zone.turn.resize(kept);
    std::set<int> common;
    for (const int f : zone.face)
        for (int k = 0; k < 3; ++k)
            if (const int next = neighbour(k, f); next >= 0 && index(next) < 0)
                common.insert({part.triangle(k, f), part.triangle((k + 1) % 3, f)});
    // Where the slanted rim of a hole crosses the border of the bend, corners lie beside the
    // cylinder, or on it beyond the border. Where it ends is what corners on it say that it has in
    // common with the sheet beside it; at a free edge any.
    const double on = 4 * middle_off + 1e-7 * zone.radius + 2 * zone.measured + // 4e-4 rad beyond
                      std::min(zone.sewn, 4 * median_off(part, zone, common));  // the border is farther
    double from = std::numeric_limits<double>::infinity(), to = -from;
    zone.from = from;
    zone.to = to;
    for (size_t i = 0; i < zone.face.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector2d p =
                frame.transpose() * (part.position.col(part.triangle(k, zone.face[i])) - zone.point);
            if (std::abs(p.norm() - zone.radius) > on)
                continue;
            zone.from = std::min(zone.from, zone.turn[i][k]);
            zone.to = std::max(zone.to, zone.turn[i][k]);
            if (common.count(part.triangle(k, zone.face[i]))) {
                from = std::min(from, zone.turn[i][k]);
                to = std::max(to, zone.turn[i][k]);
            }
        }
    constexpr double near = 0.1; // of the angle; farther in it is a notch that ends within the bend
    const double much = near * (zone.to - zone.from);
    zone.from = from - zone.from < much ? from : zone.from;
    zone.to = zone.to - to < much ? to : zone.to;
    end_on_flats(part, neighbour, zone);
}

/// Whether the faces' own normals point away from the axis.
bool bulges(const TriMesh& part, const Eigen::Matrix3Xd& normal, const BendZone& zone)
{
    double out = 0;
    for (const int f : zone.face) {
        const Eigen::Vector3d from =
            Eigen::Vector3d(part.position(Eigen::all, part.triangle.col(f)).rowwise().mean()) - zone.point;
        out += normal.col(f).dot((from - from.dot(zone.axis) * zone.axis).normalized());
    }
    return out > 0;
}

/// Pieces of one bend that holes or notches part: on one cylinder between the same angles.
void join_pieces(const TriMesh& part, const Eigen::Matrix3Xi& neighbour, std::vector<BendZone>& zones)
{
    constexpr double alike = 1e-3; // radians, and of the radius
    std::vector<BendZone> joined;
    for (BendZone& zone : zones) {
        bool taken = false;
        for (size_t i = 0; i < joined.size() && !taken; ++i) {
            BendZone& to = joined[i];
            const Eigen::Vector3d off = zone.point - to.point;
            if (zone.bulging != to.bulging || std::abs(zone.radius - to.radius) > alike * to.radius ||
                zone.axis.cross(to.axis).norm() > alike ||
                (off - off.dot(to.axis) * to.axis).norm() > alike * to.radius)
                continue;
            BendZone other = zone; // told around the other's axis
            other.point = to.point;
            other.axis = to.axis;
            measure(part, neighbour, other);
            const double shift = nearest_turn(other.from, to.from) - other.from;
            if (other.face.size() != zone.face.size() || std::abs(other.from + shift - to.from) > alike ||
                std::abs(other.to + shift - to.to) > alike)
                continue;
            for (size_t k = 0; k < other.face.size(); ++k) {
                const auto at = std::lower_bound(to.face.begin(), to.face.end(), other.face[k]) - to.face.begin();
                to.face.insert(to.face.begin() + at, other.face[k]);
                to.turn.insert(to.turn.begin() + at, (other.turn[k].array() + shift).matrix());
            }
            to.off = std::max(to.off, other.off);
            taken = true;
        }
        if (!taken)
            joined.push_back(std::move(zone));
    }
    zones = std::move(joined);
}

/// Whether it goes over into the sheet beside it along its axis, at one of its ends at least. Walls
/// of drawn sheet are cylinders, too, but end all around them.
bool ends_straight(const TriMesh& part, const Eigen::Matrix3Xi& neighbour, const BendZone& zone)
{
    constexpr double parallel = 0.09; // the sine of 5 degrees: of edges whose vertices are a little
                                      // off
    double straight = 0, askew = 0;
    for (const int f : zone.face)
        for (int k = 0; k < 3; ++k) {
            const int g = neighbour(k, f);
            if (g < 0 || std::binary_search(zone.face.begin(), zone.face.end(), g))
                continue;
            const Eigen::Vector3d edge =
                part.position.col(part.triangle((k + 1) % 3, f)) - part.position.col(part.triangle(k, f));
            (edge.cross(zone.axis).norm() > parallel * edge.norm() ? askew : straight) += edge.norm();
        }
    constexpr double one_end = 0.25; // of both; a notch there may leave the other one to triangles
                                     // that are askew
    return straight >= one_end * (straight + askew);
}

/// The radius with which the flats on both sides touch the cylinder; nothing if they do not.
std::optional<double> radius_by_flats(const TriMesh& part, const Eigen::Matrix3Xi& neighbour,
                                      const Eigen::Matrix3Xd& normal, const BendZone& zone)
{
    constexpr double square = 1e-6, alike = 1e-6; // the sine of an angle; of the radius
    constexpr double near = 0.02;                 // of the radius: vertices on chords of up to 20
                                                  // degrees are off by less
    const Eigen::Matrix<double, 3, 2> frame = across(zone.axis);
    const double middle = (zone.from + zone.to) / 2;
    std::array<double, 2> area{0, 0}, radius{0, 0};
    for (const int f : faces_beyond(normal, neighbour, zone)) {
        const Eigen::Vector3d n = normal.col(f).normalized();
        const double from_axis = (part.position.col(part.triangle(0, f)) - zone.point).dot(n);
        if (std::abs(n.dot(zone.axis)) > square || std::abs(std::abs(from_axis) - zone.radius) > near * zone.radius)
            continue;
        const Eigen::Vector2d to_it = frame.transpose() * (from_axis > 0 ? n : Eigen::Vector3d(-n));
        const auto side = size_t(nearest_turn(std::atan2(to_it.y(), to_it.x()), middle) < middle ? 0 : 1);
        if (normal.col(f).norm() > area[side]) {
            area[side] = normal.col(f).norm();
            radius[side] = std::abs(from_axis);
        }
    }
    if (!(area[0] > 0) || !(area[1] > 0) || std::abs(radius[0] - radius[1]) > alike * zone.radius)
        return std::nullopt;
    return (radius[0] + radius[1]) / 2;
}

/// The triangles of a remeshed part lie across the lines where a bend begins and ends: all that
/// have a corner within it belong to it, and those that are not touched lie in the flats, which
/// tell where these lines are.
/// @param taken  #F: faces of zones
/// @returns whether there are flats on both sides
bool between_flats(const TriMesh& part, const Eigen::Matrix3Xi& neighbour, const Eigen::Matrix3Xd& normal,
                   BendZone& zone, std::vector<char>& taken)
{
    constexpr double within = 1e-3, near = 0.02; // of the angle; of the radius
    const Eigen::Matrix<double, 3, 2> frame = across(zone.axis);
    const double middle = (zone.from + zone.to) / 2, most = (0.5 - within) * (zone.to - zone.from);
    const auto inside = [&](int v) {
        const Eigen::Vector2d p = frame.transpose() * (part.position.col(v) - zone.point);
        return std::abs(p.norm() - zone.radius) < near * zone.radius &&
               std::abs(nearest_turn(std::atan2(p.y(), p.x()), middle) - middle) < most;
    };
    for (size_t i = 0; i < zone.face.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (const int g = neighbour(k, zone.face[i]); g >= 0 && !taken[size_t(g)])
                if (const auto corner = part.triangle.col(g); std::any_of(corner.begin(), corner.end(), inside)) {
                    taken[size_t(g)] = 1;
                    zone.face.push_back(g);
                }
    std::sort(zone.face.begin(), zone.face.end());
    const auto radius = radius_by_flats(part, neighbour, normal, zone);
    if (!radius)
        return false;
    zone.radius = *radius;
    measure(part, neighbour, zone);
    std::vector<double> off; // beyond it corners lie in the flats
    for (size_t i = 0; i < zone.face.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (zone.turn[i][k] >= zone.from && zone.turn[i][k] <= zone.to)
                off.push_back(std::abs(
                    (frame.transpose() * (part.position.col(part.triangle(k, zone.face[i])) - zone.point)).norm() -
                    zone.radius));
    if (off.empty())
        return false;
    std::sort(off.begin(), off.end());
    zone.off = off[off.size() * 3 / 4];
    return true;
}

/// Takes walls of drawn sheet away.
void keep_bends(const TriMesh& part, const Eigen::Matrix3Xi& neighbour, const Eigen::Matrix3Xd& normal,
                std::vector<BendZone>& zones)
{
    std::optional<FreeEnds> ends; // mostly not needed
    std::vector<char> taken(size_t(part.triangles()), 0);
    for (const BendZone& zone : zones)
        for (const int f : zone.face)
            taken[size_t(f)] = 1;
    std::erase_if(zones, [&](BendZone& zone) {
        if (ends_straight(part, neighbour, zone))
            return false;
        if (!ends)
            ends.emplace(part);
        return !ends->of(zone) || !between_flats(part, neighbour, normal, zone, taken);
    });
}

} // namespace

std::vector<BendZone> stated_zones(const TriMesh& part, const std::vector<StatedSurface>& surface, double sewn)
{
    const Eigen::Matrix3Xi neighbour = face_neighbours(part.triangles(), edge_uses(part.triangle));
    const Eigen::Matrix3Xd normal = area_vectors(part);
    DisjointSets together(size_t(part.triangles()));
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            if (const int g = neighbour(k, f); g > f && same_cylinder(surface[size_t(f)], surface[size_t(g)]))
                together.join(f, g);
    std::vector<BendZone> zones;
    std::vector<int> number(size_t(part.triangles()), -1);
    for (int f = 0; f < part.triangles(); ++f) {
        const StatedSurface& s = surface[size_t(f)];
        if (s.kind != StatedSurface::Kind::cylinder)
            continue;
        int& zone = number[size_t(together.root(f))];
        if (zone < 0) {
            zone = int(zones.size());
            BendZone fresh{};
            fresh.point = s.point;
            fresh.axis = s.direction;
            fresh.stated = s.off > 0 ? 0 : s.radius;
            fresh.measured = s.off;
            fresh.sewn = sewn;
            zones.push_back(fresh);
        }
        zones[size_t(zone)].face.push_back(f);
    }
    for (BendZone& zone : zones) {
        zone.bulging = bulges(part, normal, zone);
        // The mesh may be another side of the sheet than the CAD face: where its vertices are is
        // what they say.
        std::vector<double> radius;
        for (const int f : zone.face)
            for (int k = 0; k < 3; ++k) {
                const Eigen::Vector3d from = part.position.col(part.triangle(k, f)) - zone.point;
                radius.push_back((from - from.dot(zone.axis) * zone.axis).norm());
            }
        std::nth_element(radius.begin(), radius.begin() + long(radius.size() / 2), radius.end());
        zone.radius = radius[radius.size() / 2];
        measure(part, neighbour, zone);
    }
    keep_bends(part, neighbour, normal, zones);
    join_pieces(part, neighbour, zones);
    return zones;
}

std::vector<BendZone> fitted_zones(const TriMesh& part, const BendMap& map, bool of_solid)
{
    constexpr double most_off = 2e-3; // of the radius: vertices of meshes are rounded
    const Eigen::Matrix3Xi neighbour = face_neighbours(part.triangles(), edge_uses(part.triangle));
    const Eigen::Matrix3Xd normal = area_vectors(part);
    std::vector<BendZone> zones;
    std::vector<char> taken(size_t(part.triangles()), 0);
    const auto take = [&](const FittedCylinder& cylinder, std::vector<int> faces) {
        BendZone zone{};
        zone.point = cylinder.point;
        zone.axis = cylinder.axis;
        zone.radius = cylinder.radius;
        zone.face = std::move(faces);
        for (const int f : zone.face)
            taken[size_t(f)] = 1;
        zone.bulging = bulges(part, normal, zone);
        measure(part, neighbour, zone);
        zones.push_back(std::move(zone));
    };
    for (StripCylinder& strips : strip_cylinders(part, normal, neighbour, of_solid))
        take(strips.cylinder, std::move(strips.face));
    for (size_t b = 0; b < map.bends.size(); ++b) {
        if (map.bends[b].faces == 0 || map.bends[b].b < 0)
            continue;
        FaceSet faces = map.faces_of(map.label_of_bend(b));
        std::erase_if(faces, [&](int f) { return bool(taken[size_t(f)]); });
        auto cylinder = cylinder_of(part, normal, neighbour, faces);
        // Of a band that is too broad the faces farthest off go first.
        for (int round = 0; round < 4 && cylinder && cylinder->off > most_off * cylinder->radius; ++round) {
            const double within = std::max(cylinder->off / 2, most_off * cylinder->radius);
            std::erase_if(faces, [&](int f) { return !lies_on(part, *cylinder, f, within); });
            cylinder = cylinder_of(part, normal, neighbour, faces);
        }
        if (!cylinder || cylinder->off > most_off * cylinder->radius)
            continue;
        std::vector<int> grown(faces.begin(), faces.end());
        std::set<int> in(grown.begin(), grown.end());
        for (size_t i = 0; i < grown.size(); ++i)
            for (int k = 0; k < 3; ++k)
                if (const int g = neighbour(k, grown[i]); g >= 0 && !in.count(g) && !taken[size_t(g)] &&
                                                          lies_on(part, *cylinder, g, most_off * cylinder->radius)) {
                    in.insert(g);
                    grown.push_back(g);
                }
        take(*cylinder, std::move(grown));
    }
    join_pieces(part, neighbour, zones);
    return zones;
}

void take_radii(const std::vector<BendZone>& zones, BendMap& map)
{
    for (size_t b = 0; b < map.bends.size(); ++b) {
        Bend& bend = map.bends[b];
        const int label = map.label_of_bend(b);
        for (const BendZone& zone : zones) {
            const auto common = std::ranges::count_if(zone.face, [&](int f) { return map.label[f] == label; });
            if (label >= 0 && 2 * common > bend.faces)
                bend.radius = zone.radius;
        }
    }
}

} // namespace spia
