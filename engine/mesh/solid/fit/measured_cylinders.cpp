#include "engine/mesh/solid/fit/measured_cylinders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/fit/cylinder_fit.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

// A mesher's chords turn by 0.5 rad at most (OpenCASCADE's default; ours 20 degrees), and by more
// than the triangles of one plane do that are rounded to six digits: 1e-4 mm over a width of 0.1
// mm.
constexpr double most_turn = 0.6, least_turn = 1e-3;
constexpr double parallel = 5e-3; // radians: rounded likewise over a length of 0.02 mm and more

/// Triangles of one skin with their corners on one cylinder.
struct Region {
    FittedCylinder cylinder;
    double bulging; ///< 1: the skin's normals, outwards from the solid, point away from the axis;
                    ///< else -1
    SheetSide side;
    std::vector<int> face; ///< ascending
};

/// mm, how far corners may be off: single precision of STL and five digits are 1e-5 to 1e-3 of
/// usual thicknesses, the sagitta of a chord of 3 degrees is 3e-4 of the radius.
double tight(double radius, double thickness) { return 1e-3 * std::min(radius, thickness); }

/// mm, likewise of a cylinder through the first three places, which is not yet the one through all.
double loose(double radius, double thickness) { return std::min(0.01 * radius, 0.02 * thickness); }

/// mm, how far corners may be off that the file's digits move by up to `rounding`, and the cylinder
/// that is fitted to them by as much the other way. Where that is more than of a first cylinder no
/// flat beside a bend could be told from it.
double permitted(double radius, double thickness, double rounding)
{
    return std::max(tight(radius, thickness), std::min(2 * rounding, loose(radius, thickness)));
}

/// One after the other on both skins.
class CylinderSearch {
public:
    CylinderSearch(const TriMesh& solid, const ThinSolid& sheet, double rounding)
        : solid_(solid), sheet_(sheet), rounding_(rounding),
          normal_((sheet.flipped * area_vectors(solid)).colwise().normalized()),
          neighbour_(face_neighbours(solid.triangles(), edge_uses(solid.triangle))),
          diagonal_(bounding_diagonal(solid)), taken_(size_t(solid.triangles()), 0), seen_(taken_.size(), 0)
    {
        for (int f = 0; f < solid.triangles(); ++f)
            for (int k = 0; k < 3; ++k)
                if (const int g = neighbour_(k, f); g >= 0 && (!on_skin(f) || side(f) != side(g)))
                    neighbour_(k, f) = -1;
    }

    std::vector<Region> regions()
    {
        // Surfaces that are curved in two ways have as many seeds as edges, and next to nothing
        // grows from them: what gently curved ones cost is bounded: a dome of 104 000 triangles
        // takes 1.3 s of processor. All bends of 75 meshed brackets are found within it.
        const size_t most_visits = 1'000'000 + 10 * taken_.size();
        // A cylinder has five measures: the more vertices lie on one, the surer it is.
        std::vector<Region> result;
        const std::vector<Seed> all = seeds();
        for (const int least : {24, 8, fewest})
            for (const Seed& seed : all) {
                if (visits_ > most_visits)
                    break;
                least_ = least;
                for (const auto& [f, g] : {std::pair(seed.f, seed.g), {seed.g, seed.f}})
                    if (auto found = tangential(seed, f, g))
                        keep(std::move(*found), result);
                if (auto found = round(seed))
                    keep(std::move(*found), result);
                if (auto found = of_strips(seed))
                    keep(std::move(*found), result);
            }
        return result;
    }

private:
    const TriMesh& solid_;
    const ThinSolid& sheet_;
    double rounding_;            ///< mm, by which the file's digits move corners
    Eigen::Matrix3Xd normal_;    ///< unit, outwards
    Eigen::Matrix3Xi neighbour_; ///< on the same skin
    double diagonal_;
    std::vector<char> taken_;
    std::vector<int> seen_; ///< per triangle the number of the last walk over it
    int walk_ = 0;
    static constexpr int fewest = 6; ///< ends of the edges of two chords
    int least_ = fewest;             ///< vertices of a cylinder that is looked for
    size_t visits_ = 0;

    /// An edge along the axis, perhaps.
    struct Seed {
        int f, g;
        Eigen::Vector3d place, edge; ///< mm, its middle; from end to end
        int beyond_f, beyond_g;      ///< the vertices opposite to it
    };

    SheetSide side(int f) const { return sheet_.side[size_t(f)]; }
    bool on_skin(int f) const { return side(f) != SheetSide::rim; }
    Eigen::Vector3d at(int v) const { return solid_.position.col(v); }
    double turn(int f, int g) const
    {
        return std::atan2(normal_.col(f).cross(normal_.col(g)).norm(), normal_.col(f).dot(normal_.col(g)));
    }
    Eigen::Vector3d middle(int f) const
    {
        return (at(solid_.triangle(0, f)) + at(solid_.triangle(1, f)) + at(solid_.triangle(2, f))) / 3;
    }
    static Eigen::Vector3d outwards(const FittedCylinder& cylinder, const Eigen::Vector3d& place)
    {
        const Eigen::Vector3d from = place - cylinder.point;
        return (from - from.dot(cylinder.axis) * cylinder.axis).normalized();
    }

    /// The longest first: they tell an axis best.
    std::vector<Seed> seeds() const
    {
        std::vector<Seed> result;
        for (int f = 0; f < solid_.triangles(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int g = neighbour_(k, f);
                if (g < f || turn(f, g) < least_turn || turn(f, g) > most_turn)
                    continue;
                const int a = solid_.triangle(k, f), b = solid_.triangle((k + 1) % 3, f);
                int beyond = -1;
                for (const int v : solid_.triangle.col(g))
                    if (v != a && v != b)
                        beyond = v;
                result.push_back({f, g, (at(a) + at(b)) / 2, at(b) - at(a), solid_.triangle((k + 2) % 3, f), beyond});
            }
        std::stable_sort(result.begin(), result.end(),
                         [](const Seed& s, const Seed& t) { return s.edge.squaredNorm() > t.edge.squaredNorm(); });
        return result;
    }

    /// The cylinder that touches the plane of one triangle along the seed, and goes through the far
    /// corner of the other one: the first chord beside a flat.
    std::optional<Region> tangential(const Seed& seed, int flat, int chord)
    {
        if (taken_[size_t(chord)])
            return std::nullopt;
        const Eigen::Vector3d axis = seed.edge.normalized(), n = normal_.col(flat);
        Eigen::Vector3d d = at(chord == seed.f ? seed.beyond_f : seed.beyond_g) - seed.place;
        d -= d.dot(axis) * axis;
        const double below = d.dot(n); // the sagitta
        if (!(std::abs(below) > 0))
            return std::nullopt;
        const double signed_radius = d.squaredNorm() / (2 * below);
        return grown({seed.place + signed_radius * n, axis, std::abs(signed_radius), 0}, {chord});
    }

    /// The cylinder through both triangles: chords.
    std::optional<Region> round(const Seed& seed)
    {
        if (taken_[size_t(seed.f)] || taken_[size_t(seed.g)])
            return std::nullopt;
        const Eigen::Vector3d axis = seed.edge.normalized();
        const Eigen::Matrix<double, 3, 2> frame = across(axis);
        const Eigen::Vector2d p = frame.transpose() * (at(seed.beyond_f) - seed.place),
                              q = frame.transpose() * (at(seed.beyond_g) - seed.place);
        const double twice_area = p.x() * q.y() - p.y() * q.x();
        if (!(std::abs(twice_area) > 0))
            return std::nullopt;
        const Eigen::Vector2d centre = Eigen::Vector2d(q.y() * p.squaredNorm() - p.y() * q.squaredNorm(),
                                                       p.x() * q.squaredNorm() - q.x() * p.squaredNorm()) /
                                       (2 * twice_area);
        return grown({seed.place + frame * centre, axis, centre.norm(), 0}, {seed.f, seed.g});
    }

    /// mm, of a triangle, across an axis
    double breadth(int f, const Eigen::Vector3d& axis) const
    {
        double most = 0;
        for (int k = 0; k < 3; ++k)
            most = std::max(most, (at(solid_.triangle((k + 1) % 3, f)) - at(solid_.triangle(k, f))).cross(axis).norm());
        return most;
    }

    /// Adds those of the skin that can be reached over such as belong to it, the nearest first.
    /// @param belongs  (triangle, the one that it is reached from)
    template <class Belongs> void spread(std::vector<int>& faces, size_t most, const Belongs& belongs)
    {
        ++walk_;
        for (const int f : faces)
            seen_[size_t(f)] = walk_;
        for (size_t i = 0; i < faces.size() && faces.size() < most; ++i)
            for (int k = 0; k < 3; ++k) {
                const int g = neighbour_(k, faces[i]);
                if (g < 0 || taken_[size_t(g)] || seen_[size_t(g)] == walk_)
                    continue;
                seen_[size_t(g)] = walk_;
                ++visits_;
                if (belongs(g, faces[i]))
                    faces.push_back(g);
            }
    }

    /// Triangles around a seed about as broad as the narrower of its own, as chords of one cylinder
    /// are, that turn around the axis only: the nearest first.
    std::vector<int> strips(const Seed& seed, size_t most)
    {
        constexpr double alike = 1.5; // of the breadth
        const Eigen::Vector3d axis = seed.edge.normalized();
        const int first = breadth(seed.f, axis) < breadth(seed.g, axis) ? seed.f : seed.g;
        const double broad = alike * breadth(first, axis);
        std::vector<int> faces{first};
        spread(faces, most, [&](int g, int from) {
            const double wide = breadth(g, axis);
            return wide < broad && turn(from, g) < most_turn &&
                   std::abs(normal_.col(g).dot(axis)) < parallel + 2 * rounding_ / wide;
        });
        return faces;
    }

    /// The cylinder through all strips around a seed: three places tell a radius to a hundredth
    /// only where the sagitta of a chord is a hundred times what the file's digits move them.
    std::optional<Region> of_strips(const Seed& seed)
    {
        constexpr double sure = 100;
        constexpr size_t fewest_faces = 4, most_faces = 512;
        const Eigen::Vector3d axis = seed.edge.normalized();
        const double narrow = std::min(breadth(seed.f, axis), breadth(seed.g, axis));
        if ((taken_[size_t(seed.f)] && taken_[size_t(seed.g)]) || narrow * turn(seed.f, seed.g) / 8 > sure * rounding_)
            return std::nullopt;
        std::vector<int> faces = strips(seed, most_faces);
        for (; faces.size() >= fewest_faces; faces.resize(faces.size() / 2)) {
            const Eigen::Matrix3Xd place = solid_.position(Eigen::all, corners(solid_, faces));
            const auto first = cylinder_along(axis, place);
            const auto fit = first ? fitted(*first, place, Eigen::VectorXd::Zero(place.cols())) : std::nullopt;
            if (!fit || fit->off > permitted(fit->radius, sheet_.thickness, rounding_))
                continue;
            if (auto found = grown(*fit, {faces.front()}))
                return found;
        }
        return std::nullopt;
    }

    bool is_chord(int f, const FittedCylinder& cylinder, double bulging, double within) const
    {
        if (!lies_on(solid_, cylinder, f, within) || !(normal_.col(f).dot(outwards(cylinder, middle(f))) * bulging > 0))
            return false;
        const double least = std::cos(most_turn);
        for (int k = 0; k < 3; ++k)
            if (outwards(cylinder, at(solid_.triangle(k, f)))
                    .dot(outwards(cylinder, at(solid_.triangle((k + 1) % 3, f)))) < least)
                return false;
        return true;
    }

    /// Chords that can be reached from some over such, ascending; none if one of those is no chord.
    std::vector<int> reach(const std::vector<int>& from, const FittedCylinder& cylinder, double bulging, double within)
    {
        const auto chord = [&](int f) { return is_chord(f, cylinder, bulging, within); };
        if (!std::ranges::all_of(from, chord))
            return {};
        std::vector<int> faces = from;
        spread(faces, taken_.size() + 1, [&](int g, int) { return chord(g); });
        std::sort(faces.begin(), faces.end());
        return faces;
    }

    /// All chords of the cylinder around some, and the cylinder that fits them; nothing if it is no
    /// bend.
    std::optional<Region> grown(const FittedCylinder& cylinder, const std::vector<int>& from)
    {
        // Where many corners of flats lie beside the bend the first fit is drawn to them; the first
        // cylinder may be good enough without.
        for (const double first : {1., 0.25, 0.0625})
            if (auto found = refined(cylinder, from, first * loose(cylinder.radius, sheet_.thickness)))
                return found;
        return std::nullopt;
    }

    /// @param within  mm, of corners from the first cylinder
    std::optional<Region> refined(const FittedCylinder& cylinder, const std::vector<int>& from, double within)
    {
        const double bulging = normal_.col(from.front()).dot(outwards(cylinder, middle(from.front()))) > 0 ? 1 : -1;
        // Corners of a flat right beside a bend lie nearly on it, but farther off than the file's
        // digits move those of the bend: the finest distance at which it is a bend is the best.
        constexpr double single = 1e-7, finer = 0.25; // of the diagonal, STL's
        Region region{cylinder, bulging, side(from.front()), {}};
        std::optional<Region> best;
        const auto few = [&](const Region& found) { return int(corners(solid_, found.face).size()) < least_; };
        const double finest = std::max(single * diagonal_, 2 * rounding_);
        for (;; within = std::max(finer * within, finest)) {
            if (!grow(region, from, within) || (!best && few(region)))
                break; // finer there are not more
            if (within <= permitted(region.cylinder.radius, sheet_.thickness, rounding_) &&
                region.cylinder.off <= within && is_bend(region))
                best = region;
            if (region.cylinder.off > finer * within) // else none is far enough from it to draw it away
                region.cylinder = agreed(region);
            if (within <= finest)
                break;
            if (best && region.cylinder.off <= finer * within &&
                std::ranges::any_of(from, [&](int f) { return !lies_on(solid_, region.cylinder, f, finer * within); }))
                return std::nullopt; // a narrow triangle beside the bend, which is found from
                                     // others
        }
        // Where the finest has too few only corners beside the bend made them enough: its turn is
        // later.
        return best && few(*best) ? std::nullopt : best;
    }

    /// The cylinder on which three quarters of the corners lie best: corners of a flat beside the
    /// bend draw the one through all of them away from the bend's own. Least trimmed squares by the
    /// steps of [Rousseeuw, Van Driessen 2006].
    FittedCylinder agreed(const Region& region) const
    {
        constexpr int most_steps = 8, unknowns = 5;
        std::vector<std::pair<double, int>> by_distance; // mm, from the cylinder
        for (const int v : corners(solid_, region.face))
            by_distance.emplace_back(0, v);
        const size_t most = by_distance.size() * 3 / 4;
        std::vector<int> nearest(most);
        FittedCylinder cylinder = region.cylinder;
        if (most < 2 * unknowns)
            return cylinder;
        for (int step = 0; step < most_steps; ++step) {
            for (auto& [off, v] : by_distance)
                off = std::abs(distance_from_axis(cylinder, at(v)) - cylinder.radius);
            std::ranges::sort(by_distance);
            for (size_t i = 0; i < most; ++i)
                nearest[i] = by_distance[i].second;
            const auto fit = fitted(cylinder, solid_.position(Eigen::all, nearest), Eigen::VectorXd::Zero(long(most)));
            if (!fit)
                return region.cylinder;
            const bool still = std::abs(fit->off - cylinder.off) < 0.01 * fit->off;
            cylinder = *fit;
            if (still)
                break;
        }
        return cylinder;
    }

    /// @returns whether there are at least two chords, those that it is to grow from among them
    bool grow(Region& region, const std::vector<int>& from, double within)
    {
        constexpr int most_rounds = 8;
        for (int i = 0; i < most_rounds; ++i) {
            std::vector<int> next = reach(from, region.cylinder, region.bulging, within);
            if (next.size() < 2)
                return false;
            if (next == region.face)
                break;
            region.face = std::move(next);
            const std::vector<int> vertices = corners(solid_, region.face);
            const auto fit = fitted(region.cylinder, solid_.position(Eigen::all, vertices),
                                    Eigen::VectorXd::Zero(Eigen::Index(vertices.size())));
            if (!fit)
                return false;
            region.cylinder = *fit;
        }
        return true;
    }

    /// Whether it ends as a bend does, and is one that was cut into chords.
    bool is_bend(const Region& region) const
    {
        double straight = 0, askew = 0, tangent = 0, goes_on = 0;
        const double within = 2 * permitted(region.cylinder.radius, sheet_.thickness, rounding_);
        // Where two bends meet in a mitre the sheet turns sharply from one to the other; into a
        // corner of drawn sheet it goes over by half a chord.
        constexpr double mitre = most_turn / 2;
        for (const int f : region.face)
            for (int k = 0; k < 3; ++k) {
                const int g = neighbour_(k, f);
                if (g < 0 || std::binary_search(region.face.begin(), region.face.end(), g))
                    continue;
                const Eigen::Vector3d a = at(solid_.triangle(k, f)), b = at(solid_.triangle((k + 1) % 3, f));
                const double length = (b - a).norm();
                if ((b - a).cross(region.cylinder.axis).norm() > parallel * length + within) {
                    askew += turn(f, g) > mitre ? 0 : length;
                    continue;
                }
                straight += length;
                switch (beyond(region, g, a, b)) {
                case Beyond::flat: tangent += length; break;
                case Beyond::chord: goes_on += length; break;
                case Beyond::other: break;
                }
            }
        // Where a hole crosses the end of a bend a narrow triangle may count to the other side; a
        // wall of drawn sheet has an end all around. On one of both ends another bend may follow;
        // not more of this one, whose vertices are rounded too much to tell.
        constexpr double few = 0.05, one_end = 0.4;
        constexpr int two_chords = 3, many = 5; // their ends; a single one touches what was taken
                                                // for it
        const int places = places_around(region), vertices = int(corners(solid_, region.face).size());
        if (askew > few * (straight + askew) || goes_on > few * straight || places < two_chords)
            return false;
        if (vertices < 8) // too few for another than both ends to tell
            return straight > 0 && tangent > (1 - few) * straight;
        return (straight > 0 && tangent > one_end * straight) || places >= many;
    }

    enum class Beyond { flat, chord, other };

    /// What the sheet is on the other side of an edge along the axis: tangential, more of the
    /// cylinder, or bent otherwise. The far corner tells: a narrow triangle of a flat beside the
    /// bend lies nearly on both.
    Beyond beyond(const Region& region, int g, const Eigen::Vector3d& a, const Eigen::Vector3d& b) const
    {
        const FittedCylinder& cylinder = region.cylinder;
        const Eigen::Vector3d far = middle(g) * 3 - a - b;
        const Eigen::Vector3d out = outwards(cylinder, (a + b) / 2), way = far - (a + b) / 2;
        const double off_plane = std::abs(way.dot(out)),
                     off_cylinder = std::abs(distance_from_axis(cylinder, far) - cylinder.radius);
        const double aside = std::abs(way.dot(out.cross(cylinder.axis)));
        constexpr double smooth = 0.02; // radians
        if (off_plane <= off_cylinder + cylinder.off)
            return off_plane <= smooth * aside + cylinder.off ? Beyond::flat : Beyond::other;
        return is_chord(g, cylinder, region.bulging, loose(cylinder.radius, sheet_.thickness)) ? Beyond::chord
                                                                                               : Beyond::other;
    }

    /// At how many angles around the axis there are vertices.
    int places_around(const Region& region) const
    {
        const FittedCylinder& cylinder = region.cylinder;
        const Eigen::Vector3d x = outwards(cylinder, middle(region.face.front())), y = cylinder.axis.cross(x);
        std::vector<double> angle;
        for (const int v : corners(solid_, region.face)) {
            const Eigen::Vector3d out = outwards(cylinder, at(v));
            angle.push_back(std::atan2(y.dot(out), x.dot(out)));
        }
        std::sort(angle.begin(), angle.end());
        // radians, more than vertices may be off
        const double one_place = std::max(5e-3, 2 * rounding_ / cylinder.radius);
        int count = 1;
        for (size_t i = 1; i < angle.size(); ++i)
            count += angle[i] - angle[i - 1] > one_place;
        return count;
    }

    void keep(Region region, std::vector<Region>& into)
    {
        for (const int f : region.face)
            taken_[size_t(f)] = 1;
        into.push_back(std::move(region));
    }
};

/// Those of one bend, or of bends on one line, on both skins.
struct Group {
    std::vector<size_t> region;
    FittedCylinder cylinder; ///< of the first
};

/// The cylinder of the first region that fits all, with the thickness between both skins; nothing
/// if none does.
std::optional<FittedCylinder> common(const TriMesh& solid, double thickness, double rounding,
                                     const std::vector<Region>& regions, const std::vector<size_t>& chosen)
{
    const Region& first = regions[chosen.front()];
    std::vector<int> vertices;
    std::vector<double> shift;
    for (const size_t i : chosen) {
        const std::vector<int> more = corners(solid, regions[i].face);
        vertices.insert(vertices.end(), more.begin(), more.end());
        shift.resize(vertices.size(), regions[i].bulging == first.bulging ? 0 : -first.bulging * thickness);
    }
    const auto fit = fitted(first.cylinder, solid.position(Eigen::all, vertices),
                            Eigen::Map<const Eigen::VectorXd>(shift.data(), Eigen::Index(shift.size())));
    const double inner = fit ? fit->radius - (first.bulging > 0 ? thickness : 0) : 0;
    if (!(inner > 0) || fit->off > permitted(inner, thickness, rounding))
        return std::nullopt;
    return fit;
}

/// Whether they can be of one group: a small one tells its axis only roughly.
bool roughly_coaxial(const Region& a, const Region& b, double thickness)
{
    constexpr double alike = 0.1;
    const double radius = a.cylinder.radius - (a.bulging == b.bulging ? 0 : a.bulging * thickness);
    return std::abs(b.cylinder.radius - radius) < alike * std::max(radius, b.cylinder.radius) &&
           a.cylinder.axis.cross(b.cylinder.axis).norm() < alike &&
           distance_from_axis(a.cylinder, b.cylinder.point) < alike * (a.cylinder.radius + thickness);
}

std::vector<Group> groups_of(const TriMesh& solid, double thickness, double rounding,
                             const std::vector<Region>& regions)
{
    std::vector<Group> groups;
    for (size_t i = 0; i < regions.size(); ++i) {
        bool joined = false;
        for (Group& group : groups) {
            if (joined || !roughly_coaxial(regions[group.region.front()], regions[i], thickness))
                continue;
            std::vector<size_t> together = group.region;
            together.push_back(i);
            if (const auto fit = common(solid, thickness, rounding, regions, together)) {
                group = {std::move(together), *fit};
                joined = true;
            }
        }
        if (!joined)
            groups.push_back({{i}, regions[i].cylinder});
    }
    std::erase_if(groups, [&](const Group& group) {
        const auto on = [&](SheetSide side) {
            return std::ranges::any_of(group.region, [&](size_t i) { return regions[i].side == side; });
        };
        return !on(SheetSide::outer) || !on(SheetSide::inner);
    });
    return groups;
}

} // namespace

std::vector<StatedSurface> measured_cylinders(const TriMesh& solid, const ThinSolid& sheet, double rounding)
{
    std::vector<StatedSurface> surface(size_t(solid.triangles()));
    const std::vector<Region> regions = CylinderSearch(solid, sheet, rounding).regions();
    for (const Group& group : groups_of(solid, sheet.thickness, rounding, regions)) {
        const double bulging = regions[group.region.front()].bulging;
        for (const size_t i : group.region) {
            const double across = regions[i].bulging == bulging ? 0 : -bulging * sheet.thickness;
            for (const int f : regions[i].face)
                surface[size_t(f)] = {StatedSurface::Kind::cylinder, group.cylinder.point, group.cylinder.axis,
                                      group.cylinder.radius + across, group.cylinder.off};
        }
    }
    return surface;
}

} // namespace spia
