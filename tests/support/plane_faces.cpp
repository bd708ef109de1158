#include "tests/support/plane_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "engine/mesh/vectors.h"

namespace spia::shapes {
namespace {

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
    return cross(b - a, c - a);
}

/// Whether the open segments cross.
bool cross_each_other(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                      const Eigen::Vector2d& d)
{
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

} // namespace

std::vector<std::array<int, 3>> long_triangles(const PlaneLoop& outer, const std::vector<PlaneLoop>& holes)
{
    PlaneLoop at = outer;
    std::vector<int> ring;
    for (int i = 0; i < int(outer.size()); ++i)
        ring.push_back(i);
    // Holes become part of the outline over bridges, those farthest to the right first.
    struct Hole {
        int first, count;
        double right;
    };
    std::vector<Hole> waiting;
    for (const PlaneLoop& hole : holes) {
        double right = -std::numeric_limits<double>::infinity();
        for (const Eigen::Vector2d& p : hole)
            right = std::max(right, p.x());
        waiting.push_back({int(at.size()), int(hole.size()), right});
        at.insert(at.end(), hole.begin(), hole.end());
    }
    std::sort(waiting.begin(), waiting.end(), [](const Hole& a, const Hole& b) { return a.right > b.right; });
    for (size_t h = 0; h < waiting.size(); ++h) {
        const Hole& hole = waiting[h];
        int from = hole.first;
        for (int i = hole.first; i < hole.first + hole.count; ++i)
            if (at[size_t(i)].x() > at[size_t(from)].x())
                from = i;
        const auto free = [&](size_t k) {
            const Eigen::Vector2d &p = at[size_t(from)], &q = at[size_t(ring[k])];
            for (size_t i = 0; i < ring.size(); ++i)
                if (cross_each_other(p, q, at[size_t(ring[i])], at[size_t(ring[(i + 1) % ring.size()])]))
                    return false;
            for (size_t other = h; other < waiting.size(); ++other)
                for (int i = 0; i < waiting[other].count; ++i)
                    if (cross_each_other(p, q, at[size_t(waiting[other].first + i)],
                                         at[size_t(waiting[other].first + (i + 1) % waiting[other].count)]))
                        return false;
            // And it leaves the outline to its inside.
            const Eigen::Vector2d &before = at[size_t(ring[(k + ring.size() - 1) % ring.size()])],
                                  &after = at[size_t(ring[(k + 1) % ring.size()])];
            const bool convex = turn(before, q, after) >= 0;
            const bool left_of_in = turn(before, q, p) > 0, left_of_out = turn(q, after, p) > 0;
            return convex ? left_of_in && left_of_out : left_of_in || left_of_out;
        };
        size_t best = ring.size();
        for (size_t k = 0; k < ring.size(); ++k)
            if ((best == ring.size() || (at[size_t(ring[k])] - at[size_t(from)]).norm() <
                                            (at[size_t(ring[best])] - at[size_t(from)]).norm()) &&
                free(k))
                best = k;
        if (best == ring.size())
            throw std::logic_error("a hole has no bridge to its outline");
        std::vector<int> way;
        for (int i = 0; i <= hole.count; ++i)
            way.push_back(hole.first + (from - hole.first + i) % hole.count);
        way.push_back(ring[best]);
        ring.insert(ring.begin() + long(best) + 1, way.begin(), way.end());
    }
    std::vector<std::array<int, 3>> result;
    while (ring.size() > 3) {
        const size_t n = ring.size();
        size_t ear = n;
        double best = -1;
        for (size_t i = 0; i < n; ++i) {
            const int ia = ring[(i + n - 1) % n], ib = ring[i], ic = ring[(i + 1) % n];
            const Eigen::Vector2d &a = at[size_t(ia)], &b = at[size_t(ib)], &c = at[size_t(ic)];
            const double area = turn(a, b, c);
            if (area <= 1e-12 * ((b - a).norm() + (c - b).norm()) * (c - a).norm())
                continue;
            bool empty = true;
            for (const int j : ring)
                if (j != ia && j != ib && j != ic) {
                    const Eigen::Vector2d& p = at[size_t(j)];
                    if (p == a || p == b || p == c)
                        continue;
                    empty = empty && !(turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0);
                }
            const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
            if (empty && area / longest > best) {
                best = area / longest;
                ear = i;
            }
        }
        if (ear == n)
            throw std::logic_error("a polygon has no ear");
        result.push_back({ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]});
        ring.erase(ring.begin() + long(ear));
    }
    result.push_back({ring[0], ring[1], ring[2]});
    return result;
}

int PlaneFaces::vertex(const Eigen::Vector3d& place)
{
    std::array<long long, 3> key{};
    for (int k = 0; k < 3; ++k)
        key[size_t(k)] = std::llround(place[k] * 1e7);
    const auto [at, isnew] = number_.try_emplace(key, int(position_.size()));
    if (isnew)
        position_.push_back(place);
    return at->second;
}

void PlaneFaces::add(const Loop& outer, const std::vector<Loop>& holes)
{
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < outer.size(); ++i)
        normal += (outer[i] - outer[0]).cross(outer[(i + 1) % outer.size()] - outer[0]);
    normal.normalize();
    const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
    std::vector<int> corner;
    const auto flat = [&](const Loop& loop) {
        PlaneLoop result;
        for (const Eigen::Vector3d& p : loop) {
            result.emplace_back((p - outer[0]).dot(u), (p - outer[0]).dot(v));
            corner.push_back(vertex(p));
        }
        return result;
    };
    const PlaneLoop around = flat(outer);
    std::vector<PlaneLoop> inside;
    for (const Loop& hole : holes)
        inside.push_back(flat(hole));
    for (const auto& t : long_triangles(around, inside))
        triangle_.push_back({corner[size_t(t[0])], corner[size_t(t[1])], corner[size_t(t[2])]});
}

TriMesh PlaneFaces::mesh() const
{
    TriMesh result;
    result.position.resize(3, Eigen::Index(position_.size()));
    for (size_t i = 0; i < position_.size(); ++i)
        result.position.col(Eigen::Index(i)) = position_[i];
    result.triangle.resize(3, Eigen::Index(triangle_.size()));
    for (size_t i = 0; i < triangle_.size(); ++i)
        result.triangle.col(Eigen::Index(i)) << triangle_[i][0], triangle_[i][1], triangle_[i][2];
    return result;
}

TriMesh divided(TriMesh mesh, int times)
{
    for (; times > 0; --times) {
        std::vector<Eigen::Vector3d> position;
        for (int v = 0; v < mesh.vertices(); ++v)
            position.push_back(mesh.position.col(v));
        std::map<std::pair<int, int>, int> middle;
        const auto between = [&](int a, int b) {
            const auto [at, isnew] = middle.try_emplace(std::minmax(a, b), int(position.size()));
            if (isnew)
                position.push_back((mesh.position.col(a) + mesh.position.col(b)) / 2);
            return at->second;
        };
        TriMesh finer;
        finer.triangle.resize(3, 4 * Eigen::Index(mesh.triangles()));
        for (int f = 0; f < mesh.triangles(); ++f) {
            const int a = mesh.triangle(0, f), b = mesh.triangle(1, f), c = mesh.triangle(2, f);
            const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
            finer.triangle.col(4 * f) << a, ab, ca;
            finer.triangle.col(4 * f + 1) << ab, b, bc;
            finer.triangle.col(4 * f + 2) << ca, bc, c;
            finer.triangle.col(4 * f + 3) << ab, bc, ca;
        }
        finer.position.resize(3, Eigen::Index(position.size()));
        for (size_t v = 0; v < position.size(); ++v)
            finer.position.col(Eigen::Index(v)) = position[v];
        mesh = std::move(finer);
    }
    return mesh;
}

TriMesh extruded(const PlaneLoop& outer, const std::vector<PlaneLoop>& holes, double length)
{
    PlaneFaces faces;
    const auto in_space = [](const PlaneLoop& loop, double y, bool reversed) {
        Loop result;
        for (const Eigen::Vector2d& p : loop)
            result.emplace_back(p.x(), y, p.y());
        if (reversed)
            std::reverse(result.begin(), result.end());
        return result;
    };
    std::vector<Loop> near, far;
    for (const PlaneLoop& hole : holes) {
        near.push_back(in_space(hole, 0, false));
        far.push_back(in_space(hole, length, true));
    }
    faces.add(in_space(outer, 0, false), near); // seen from -y, x to the right and z up
    faces.add(in_space(outer, length, true), far);
    std::vector<PlaneLoop> all = holes;
    all.push_back(outer);
    for (const PlaneLoop& loop : all)
        for (size_t i = 0; i < loop.size(); ++i) {
            const Eigen::Vector2d &a = loop[i], &b = loop[(i + 1) % loop.size()];
            faces.add({{a.x(), 0, a.y()}, {a.x(), length, a.y()}, {b.x(), length, b.y()}, {b.x(), 0, b.y()}});
        }
    return faces.mesh();
}

PlaneLoop sheet_section(const std::vector<ProfilePiece>& pieces, double thickness, int chords)
{
    PlaneLoop left, right;
    Eigen::Vector2d at(0, 0);
    double heading = 0;
    const auto along = [](double angle) { return Eigen::Vector2d(std::cos(angle), std::sin(angle)); };
    // to the right
    const auto across = [](double angle) { return Eigen::Vector2d(std::sin(angle), -std::cos(angle)); };
    const auto mark = [&] {
        left.push_back(at);
        right.push_back(at + thickness * across(heading));
    };
    mark();
    for (const ProfilePiece& piece : pieces) {
        if (piece.length > 0) {
            at += piece.length * along(heading);
            mark();
            continue;
        }
        const double turn_ = piece.angle > 0 ? 1 : -1;
        // of the left side
        const double radius = turn_ > 0 ? piece.radius : piece.radius + thickness;
        const Eigen::Vector2d middle = at - turn_ * radius * across(heading);
        const int n = std::max(1, int(std::ceil(chords * std::abs(piece.angle) / (std::numbers::pi / 2) - 1e-9)));
        const double from = heading;
        for (int i = 1; i <= n; ++i) {
            heading = from + piece.angle * i / n;
            at = middle + turn_ * radius * across(heading);
            mark();
        }
    }
    // Counter-clockwise: the right side forth, the left side back.
    PlaneLoop result = right;
    result.insert(result.end(), left.rbegin(), left.rend());
    return result;
}

PlaneLoop folded_section(int flats, double width, double angle, double thickness)
{
    PlaneLoop left, right;
    Eigen::Vector2d at(0, 0);
    for (int i = 0; i <= flats; ++i) {
        const auto heading = [&](double turned) { return Eigen::Vector2d(std::cos(turned), std::sin(turned)); };
        const bool end = i == 0 || i == flats;
        const double turned = angle * (i == 0 ? 0 : i == flats ? flats - 1 : i - 0.5);
        const Eigen::Vector2d h = heading(turned), aside(-h.y(), h.x());
        const double half = thickness / 2 / (end ? 1 : std::cos(angle / 2));
        left.push_back(at + half * aside);
        right.push_back(at - half * aside);
        at += width * heading(angle * i);
    }
    right.insert(right.end(), left.rbegin(), left.rend());
    return right;
}

PlaneLoop circle(const Eigen::Vector2d& middle, double radius, int corners, bool clockwise)
{
    PlaneLoop result;
    for (int i = 0; i < corners; ++i) {
        const double angle = (clockwise ? -1 : 1) * 2 * std::numbers::pi * i / corners;
        result.push_back(middle + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    return result;
}

TriMesh turned(const PlaneLoop& meridian, int around)
{
    PlaneFaces faces;
    const auto at = [&](size_t i, int k) {
        const double angle = 2 * std::numbers::pi * k / around;
        return Eigen::Vector3d(meridian[i].x() * std::cos(angle), meridian[i].x() * std::sin(angle), meridian[i].y());
    };
    for (size_t i = 0; i + 1 < meridian.size(); ++i) // upwards: the outside is to the right
        for (int k = 0; k < around; ++k) {
            if (meridian[i].x() == 0)
                faces.add({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
            else if (meridian[i + 1].x() == 0)
                faces.add({at(i, k), at(i, k + 1), at(i + 1, k)});
            else {
                faces.add({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
                faces.add({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
            }
        }
    return faces.mesh();
}

} // namespace spia::shapes
