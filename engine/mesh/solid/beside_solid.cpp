#include "engine/mesh/solid/beside_solid.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/pick.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// A place of the border; unit vectors.
struct BorderPlace {
    Eigen::Vector3d place, normal, outward;
};

/// A solid, as lines square to its sheet cut it.
class Section {
public:
    Section(const TriMesh& solid, double thickness)
        : solid_(solid), neighbour_(face_neighbours(solid.triangles(), edge_uses(solid.triangle))), rays_(solid),
          half_(thickness / 2)
    {
        double volume = 0;
        for (int f = 0; f < solid.triangles(); ++f)
            volume += corners(f).determinant();
        inside_out_ = volume < 0;
    }

    /// Whether the line square to the sheet through a place so far outwards meets matter within the
    /// thickness. Beyond the border the faces of another leg that lies on this one do not count;
    /// before it a knife edge at a skin does.
    bool matter(const BorderPlace& at, double outwards) const
    {
        return matter(at.place + outwards * at.outward, (outwards > 0 ? 0.98 : 1.02) * half_ * at.normal);
    }

    /// Whether matter begins within the tolerance inwards, if only that of a thin web, and none is
    /// beyond.
    bool ends(const BorderPlace& at, double tolerance) const
    {
        if (matter(at, tolerance))
            return false;
        constexpr int places = 8;
        for (int k = places; k >= 0; --k)
            if (matter(at, -tolerance * k / places))
                return true;
        return false;
    }

    /// How far the walls beside a place may be from the arcs that they stand for, mm: the height of
    /// an arc over the chord that is one facet.
    double facets(const BorderPlace& at, double within) const
    {
        double result = 0;
        for (const int f : near(at.place, within))
            for (int k = 0; k < 3; ++k) {
                const int other = neighbour_(k, f);
                if (other < 0)
                    continue;
                const Eigen::Vector3d n = normal(f), edge = corners(f).col((k + 1) % 3) - corners(f).col(k);
                const double turn = std::atan2(n.cross(normal(other)).norm(), n.dot(normal(other)));
                constexpr double smooth = std::numbers::pi / 6; // a circle of twelve chords
                if (turn < smooth)
                    result = std::max(result, n.norm() / edge.norm() / 2 * std::tan(turn / 4));
            }
        return result;
    }

    /// Whether the place is on a wall that crosses the whole sheet askew: the wall goes on most of
    /// the way to the skin, or less and less of the solid is left on the way to where it ends, and
    /// that at a skin. Of a chamfer or a sink the wall beyond it is left.
    /// @param end  mm outwards, where the solid ends
    bool halfway_along_a_wall(const BorderPlace& at, double end, double within) const
    {
        return std::ranges::any_of(near(at.place, within), [&](int f) {
            const Eigen::Vector3d n = normal(f).normalized();
            const double along = n.dot(at.normal);
            const Eigen::Vector3d across = n - along * at.normal;
            constexpr double square = 0.02, most = 0.7, nearly = 0.9, inside = 0.8;
            if (!(across.norm() > square)) // a skin
                return false;
            const double to_skin = half_ * std::abs(along) / across.norm();
            return (std::abs(along) > square &&
                    matter(at.place - within * at.outward + most * to_skin * across.normalized(), half_ * at.normal)) ||
                   (end > 0 && !matter(at.place + nearly * end * at.outward, inside * half_ * at.normal));
        });
    }

private:
    /// @param half  mm, of the line
    bool matter(const Eigen::Vector3d& place, const Eigen::Vector3d& half) const
    {
        const RayHit hit = rays_.first(place + half, -2 * half);
        return hit.face >= 0 && (hit.distance <= 1 || (normal(hit.face).dot(half) < 0) != inside_out_);
    }

    Eigen::Matrix3d corners(int face) const
    {
        Eigen::Matrix3d result;
        for (int k = 0; k < 3; ++k)
            result.col(k) = solid_.position.col(solid_.triangle(k, face));
        return result;
    }
    Eigen::Vector3d normal(int face) const
    {
        const Eigen::Matrix3d c = corners(face);
        return (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0));
    }

    std::vector<int> near(const Eigen::Vector3d& place, double within) const
    {
        Eigen::Matrix4Xd box(4, 6);
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
            box.col(2 * k) << axis, within - place[k];
            box.col(2 * k + 1) << -axis, within + place[k];
        }
        std::vector<int> faces = rays_.near(box);
        std::erase_if(faces, [&](int f) {
            const Eigen::Matrix3d c = corners(f);
            return (c * closest_on_triangle(c, place) - place).norm() > within;
        });
        return faces;
    }

    const TriMesh& solid_;
    Eigen::Matrix3Xi neighbour_; ///< as face_neighbours() says
    RayPicker rays_;
    double half_;             ///< mm
    bool inside_out_ = false; ///< its normals lead inwards
};

/// Where the solid ends from a place outwards, mm; `most` at most.
double to_the_end(const Section& section, const BorderPlace& at, double first, double most)
{
    const bool inside = section.matter(at, first);
    double from = inside ? first : -first, to = 2 * from;
    while (section.matter(at, to) == inside) {
        if (std::abs(to) > most)
            return std::copysign(most, to);
        from = to;
        to *= 2;
    }
    constexpr int digits = 10; // of a binary fraction: a thousandth of what is told
    for (int k = 0; k < digits; ++k) {
        const double half = (from + to) / 2;
        (section.matter(at, half) == inside ? from : to) = half;
    }
    return (from + to) / 2;
}

/// Of the vertices of a boundary loop, and in between of the middles of its edges: a corner may be
/// beside its place along one of the walls that meet there.
std::vector<BorderPlace> places_of(const std::vector<int>& loop, const TriMesh& middle, const Eigen::Matrix3Xd& normal)
{
    std::vector<BorderPlace> result;
    const auto place = [&](size_t k) { return Eigen::Vector3d(middle.position.col(loop[k % loop.size()])); };
    for (size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector3d here = place(i), next = place(i + 1), n = normal.col(loop[i]),
                              before = (here - place(i + loop.size() - 1)).cross(n).normalized(),
                              after = (next - here).cross(n).normalized();
        constexpr double cusp = 0.26; // cosine of 75 degrees
        const bool judged = (before + after).norm() > 2 * cusp;
        const Eigen::Vector3d outward = judged ? (before + after).normalized() : Eigen::Vector3d::Zero();
        result.push_back({here, n, outward});
        const Eigen::Vector3d between = (n + normal.col(loop[(i + 1) % loop.size()])).normalized();
        result.push_back({(here + next) / 2, between, (next - here).cross(between).normalized()});
    }
    return result;
}

/// How far a place is beside the border of the solid, mm; 0: it is not.
double beside(const BorderPlace& at, const Section& section, double tolerance, double most)
{
    if (at.outward.isZero() || section.ends(at, tolerance))
        return 0;
    constexpr double nearby = 8; // tolerances
    const double within = tolerance + section.facets(at, nearby * tolerance);
    const double end = to_the_end(section, at, tolerance, most);
    return section.ends(at, within) || section.halfway_along_a_wall(at, end, within) ? 0 : end;
}

} // namespace

std::vector<BesideSolid> beside_solid(const TriMesh& middle, const TriMesh& solid, double thickness, double tolerance)
{
    std::vector<BesideSolid> result;
    const Section section(solid, thickness);
    const Eigen::Matrix3Xd normal = vertex_normals(middle);
    constexpr double most = 8; // thicknesses that are looked at
    for (const std::vector<int>& loop : boundary_loops(middle)) {
        const std::vector<BorderPlace> places = places_of(loop, middle, normal);
        std::vector<double> off;
        off.reserve(places.size());
        for (const BorderPlace& at : places)
            off.push_back(beside(at, section, tolerance, most * thickness));
        // no row runs over the end of the loop
        const auto first = std::ranges::find(off, 0.0) - off.begin();
        const size_t start = first == std::ssize(off) ? 0 : size_t(first);
        bool in_row = false;
        for (size_t k = 0; k < off.size(); ++k) {
            const size_t i = (start + k) % off.size();
            const BesideSolid here{places[i].place, off[i]};
            if (off[i] != 0 && !in_row)
                result.push_back(here);
            else if (off[i] != 0 && std::abs(off[i]) > std::abs(result.back().beside))
                result.back() = here;
            in_row = off[i] != 0;
        }
    }
    return result;
}

} // namespace spia
