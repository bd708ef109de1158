#include "engine/mesh/solid/border/sheet_section.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/face_neighbours.h"

namespace spia {

SheetSection::SheetSection(const TriMesh& solid, double thickness)
    : solid_(solid), neighbour_(face_neighbours(solid.triangles(), edge_uses(solid.triangle))), rays_(solid),
      half_(thickness / 2)
{
    double volume = 0;
    for (int f = 0; f < solid.triangles(); ++f)
        volume += corners(f).determinant();
    inside_out_ = volume < 0;
}

bool SheetSection::matter(const BorderPlace& at, double outwards) const
{
    return matter(at.place + outwards * at.outward, (outwards > 0 ? 0.98 : 1.02) * half_ * at.normal);
}

bool SheetSection::ends(const BorderPlace& at, double tolerance) const
{
    constexpr int places = 8;
    const auto free = [&](int k) { return !matter(at, tolerance * k / places); };
    bool beyond = free(places);
    for (int k = 1; k < places && !beyond; ++k) // a slit narrower than that, and sheet again
        beyond = free(k);
    if (!beyond)
        return false;
    for (int k = places; k >= 0; --k)
        if (matter(at, -tolerance * k / places))
            return true;
    return false;
}

bool SheetSection::steps_to_another_leg(const BorderPlace& at, double tolerance) const
{
    // Near the root the step is small; sheet that goes on climbs less the nearer it is looked at.
    constexpr double near = 0.05, steep = 0.5; // of the tolerance, to both sides; of that: 14 degrees
    const double reach = 3 * half_, aside = near * tolerance;
    const auto step = [&](double way) { // mm, of the outermost matter on that side of the middle
        const auto down_to = [&](double outwards) {
            const Eigen::Vector3d up = way * reach * at.normal;
            return 2 * reach * rays_.first(at.place + outwards * at.outward + up, -2 * up).distance;
        };
        return way * (down_to(-aside) - down_to(aside));
    };
    const double above = step(1), below = step(-1); // not finite where there is no matter
    return std::isfinite(above) && std::isfinite(below) && above * below > 0 &&
           std::min(std::abs(above), std::abs(below)) > steep * aside;
}

double SheetSection::to_the_end(const BorderPlace& at, double first, double most, int digits) const
{
    const bool inside = matter(at, first);
    double from = inside ? first : -first, to = 2 * from;
    while (matter(at, to) == inside) {
        if (std::abs(to) > most)
            return std::copysign(most, to);
        from = to;
        to *= 2;
    }
    for (int k = 0; k < digits; ++k) {
        const double half = (from + to) / 2;
        (matter(at, half) == inside ? from : to) = half;
    }
    return (from + to) / 2;
}

double SheetSection::facets(const BorderPlace& at, double within) const
{
    double result = 0;
    for (const int f : near(at.place, within))
        for (int k = 0; k < 3; ++k) {
            const int other = neighbour_(k, f);
            if (other < 0)
                continue;
            const Eigen::Vector3d n = normal(f), edge = corners(f).col((k + 1) % 3) - corners(f).col(k);
            constexpr double through = 0.5; // cosine of 60 degrees; a rounding turns along the border
            if (std::abs(edge.dot(at.normal)) < through * edge.norm())
                continue;
            const double turn = std::atan2(n.cross(normal(other)).norm(), n.dot(normal(other)));
            constexpr double smooth = std::numbers::pi / 6; // a circle of twelve chords
            if (turn < smooth)
                // the shorter chord: flat sheet beside an arc is none
                result =
                    std::max(result, std::min(n.norm(), normal(other).norm()) / edge.norm() / 2 * std::tan(turn / 4));
        }
    return result;
}

bool SheetSection::halfway_along_a_wall(const BorderPlace& at, double end, double within) const
{
    const SheetPlane sheet{at.place, at.normal, half_};
    return std::ranges::any_of(near(at.place, within), [&](int f) {
        if (crosses_askew(f, sheet))
            return true;
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

std::optional<double> SheetSection::to_askew_wall(const BorderPlace& at) const
{
    constexpr double least = 0.17, most = 0.996; // sines of 10 and of 85 degrees, of what a wall leans
    constexpr double faces = 0.1, on = 1e-3;     // cosine; of half the thickness
    const double reach = half_ * most / std::sqrt(1 - most * most);
    const SheetPlane sheet{at.place, at.normal, half_};
    std::optional<double> nearest;
    for (const double way : {1., -1.}) {
        const double start = -way * on * half_;
        const RayHit hit = rays_.first(at.place + start * at.outward, way * reach * at.outward);
        if (hit.face < 0 || hit.distance > 1)
            continue;
        const Eigen::Vector3d n = (inside_out_ ? -1 : 1) * normal(hit.face).normalized();
        const double lean = std::abs(n.dot(at.normal)), off = start + way * hit.distance * reach;
        if (lean > least && lean < most && n.dot(at.outward) > faces * std::sqrt(1 - lean * lean) &&
            (!nearest || std::abs(off) < std::abs(*nearest)) &&
            askew_wall(solid_, neighbour_, hit.face, sheet).crosses_plane())
            nearest = off;
    }
    return nearest;
}

bool SheetSection::crosses_askew(int face, const SheetPlane& sheet) const
{
    if (askew_wall(solid_, neighbour_, face, sheet).crosses)
        return true;
    constexpr double smooth = 0.9; // cosine of 25 degrees
    const Eigen::Vector3d n = normal(face).normalized();
    return std::ranges::any_of(neighbour_.col(face), [&](int next) {
        return next >= 0 && n.dot(normal(next).normalized()) > smooth && sheet.holds(solid_, next) &&
               askew_wall(solid_, neighbour_, next, sheet).crosses;
    });
}

bool SheetSection::square_wall(const BorderPlace& at, double within) const
{
    constexpr double square = 0.02, outwards = 0.5; // sine of 1 degree; cosine of 60
    return std::ranges::any_of(near(at.place, half_), [&](int f) {
        const Eigen::Vector3d n = (inside_out_ ? -1 : 1) * normal(f).normalized();
        return std::abs(n.dot(at.normal)) <= square && n.dot(at.outward) > outwards &&
               std::abs(n.dot(corners(f).col(0) - at.place)) <= within;
    });
}

bool SheetSection::matter(const Eigen::Vector3d& place, const Eigen::Vector3d& half) const
{
    const RayHit hit = rays_.first(place + half, -2 * half);
    return hit.face >= 0 && (hit.distance <= 1 || (normal(hit.face).dot(half) < 0) != inside_out_);
}

Eigen::Matrix3d SheetSection::corners(int face) const
{
    Eigen::Matrix3d result;
    for (int k = 0; k < 3; ++k)
        result.col(k) = solid_.position.col(solid_.triangle(k, face));
    return result;
}

Eigen::Vector3d SheetSection::normal(int face) const
{
    const Eigen::Matrix3d c = corners(face);
    return (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0));
}

std::vector<int> SheetSection::near(const Eigen::Vector3d& place, double within) const
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
} // namespace spia
