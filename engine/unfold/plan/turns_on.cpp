#include "engine/unfold/plan/turns_on.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/fit/cylinder_fit.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// A length of a zone along its axis, mm.
struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double along)
    {
        low = std::min(low, along);
        high = std::max(high, along);
    }
    double length() const { return std::max(0., high - low); }
};

class TurnsOn {
public:
    TurnsOn(const TriMesh& part, const std::vector<BendZone>& zones, double rounding)
        : part_(part), zones_(zones), rounding_(rounding), normal_(area_vectors(part).colwise().normalized()),
          neighbour_(face_neighbours(part.triangles(), edge_uses(part.triangle))),
          zone_of_(size_t(part.triangles()), -1)
    {
        for (size_t z = 0; z < zones.size(); ++z)
            for (const int f : zones[z].face)
                zone_of_[size_t(f)] = int(z);
    }

    bool at(const BendZone& zone) const
    {
        Extent whole;
        for (const int f : zone.face)
            for (const int v : part_.triangle.col(f))
                whole.add(along(zone, v));
        // Beside holes narrow triangles of a flat are tilted; what turns on does so along the bend.
        constexpr double much = 0.5;
        for (const Extent& end : beyond(zone))
            if (end.length() > much * whole.length())
                return true;
        return false;
    }

private:
    const TriMesh& part_;
    const std::vector<BendZone>& zones_;
    double rounding_;
    Eigen::Matrix3Xd normal_;    ///< unit
    Eigen::Matrix3Xi neighbour_; ///< face_neighbours()
    std::vector<int> zone_of_;   ///< per face; -1: of none

    double along(const BendZone& zone, int v) const { return (part_.position.col(v) - zone.point).dot(zone.axis); }

    /// mm, of a face, across the axis
    double breadth(const BendZone& zone, int f) const
    {
        double most = 0;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d edge =
                part_.position.col(part_.triangle((k + 1) % 3, f)) - part_.position.col(part_.triangle(k, f));
            most = std::max(most, edge.cross(zone.axis).norm());
        }
        return most;
    }

    /// On one cylinder, as pieces of one bend are.
    static bool alike(const BendZone& a, const BendZone& b)
    {
        constexpr double share = 0.1; // of the radius: what is measured on few chords is off by that
        return a.bulging == b.bulging && std::abs(a.radius - b.radius) < share * a.radius &&
               a.axis.cross(b.axis).norm() < share && (b.point - a.point).cross(a.axis).norm() < share * a.radius;
    }

    /// Whether a face beyond an end leaves the plane that touches the cylinder there.
    /// @param inwards_only  towards the axis, as chords that go on; else also away from it
    bool leaves(const BendZone& zone, int f, bool at_end, bool inwards_only) const
    {
        const Eigen::Matrix<double, 3, 2> frame = across(zone.axis);
        const double end = at_end ? zone.to : zone.from, way = at_end ? 1 : -1;
        const Eigen::Vector2d out(std::cos(end), std::sin(end)), on = way * Eigen::Vector2d(-out.y(), out.x());
        constexpr double smooth = 0.02; // radians, as where measured_cylinders() goes over into a flat
        for (const int v : part_.triangle.col(f)) {
            const Eigen::Vector2d q = frame.transpose() * (part_.position.col(v) - zone.point) - zone.radius * out;
            const double aside = q.dot(on), off = q.dot(out);
            if (aside <= 0)
                continue;
            const double allowed = 2 * (rounding_ + zone.off + zone.measured);
            if (inwards_only ? -off > allowed : std::abs(off) > allowed + smooth * aside)
                return true;
        }
        return false;
    }

    /// Per end what of it the sheet turns on beyond.
    std::array<Extent, 2> beyond(const BendZone& zone) const
    {
        std::array<Extent, 2> ends;
        double chord = 0; // radians
        for (const Eigen::Vector3d& turn : zone.turn)
            chord = std::max(chord, turn.maxCoeff() - turn.minCoeff());
        constexpr double broader = 1.5, level = 0.05, most_turn = 0.6; // of a chord's breadth; radians
        const double middle = (zone.from + zone.to) / 2, broad = broader * chord * zone.radius;
        std::vector<char> seen(size_t(part_.triangles()), 0);
        std::vector<std::pair<int, bool>> reached;
        for (size_t i = 0; i < zone.face.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const int f = zone.face[i], g = neighbour_(k, f);
                const Eigen::Vector3d edge =
                    part_.position.col(part_.triangle((k + 1) % 3, f)) - part_.position.col(part_.triangle(k, f));
                if (g < 0 || std::ranges::binary_search(zone.face, g) || seen[size_t(g)] ||
                    edge.cross(zone.axis).norm() > level * edge.norm())
                    continue;
                seen[size_t(g)] = 1;
                reached.emplace_back(g, zone.turn[i][k] > middle);
            }
        const size_t beside = reached.size();
        for (size_t i = 0; i < reached.size(); ++i) {
            const auto [f, at_end] = reached[i];
            const int other = zone_of_[size_t(f)];
            const bool narrow = breadth(zone, f) < broad;
            if (other >= 0 ? alike(zone, zones_[size_t(other)])
                           : (narrow || i < beside) && leaves(zone, f, at_end, narrow))
                for (const int v : part_.triangle.col(f))
                    ends[at_end].add(along(zone, v));
            for (int k = 0; k < 3 && narrow && other < 0; ++k)
                if (const int g = neighbour_(k, f);
                    g >= 0 && !seen[size_t(g)] && !std::ranges::binary_search(zone.face, g) &&
                    breadth(zone, g) < broad && std::abs(normal_.col(g).dot(zone.axis)) < level &&
                    normal_.col(f).dot(normal_.col(g)) > std::cos(most_turn)) {
                    seen[size_t(g)] = 1;
                    reached.emplace_back(g, at_end);
                }
        }
        return ends;
    }
};

} // namespace

std::vector<char> turns_on(const TriMesh& part, const std::vector<BendZone>& zones, double rounding)
{
    const TurnsOn search(part, zones, rounding);
    std::vector<char> result;
    for (const BendZone& zone : zones)
        result.push_back(search.at(zone));
    return result;
}

} // namespace spia
