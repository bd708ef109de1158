#include "engine/mesh/solid/holes/round_holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/fit/plane_regions.h"
#include "engine/mesh/solid/holes/hole_limits.h"

namespace spia {
namespace {

constexpr double through = 0.9,
                 beyond = 1.1; // of the thickness: planes lie as far apart as it says, but for
                               // chords of bends

constexpr double along_axis = 1 - 1e-5; // 0.3 degrees

/// A circular hole in a plane.
struct Mouth {
    int plane;
    RoundEdge circle;
    std::vector<FaceEdge> edge;
};

class RoundHoleSearch {
public:
    RoundHoleSearch(const TriMesh& solid, const Eigen::Matrix3Xd& normal, double thickness)
        : solid_(solid), normal_(normal), thickness_(thickness), same_(same_in_hole * thickness),
          neighbour_(face_neighbours(solid.triangles(), edge_uses(solid.triangle))),
          planes_(plane_regions(solid, normal, neighbour_, same_))
    {
        int largest = 0;
        if (normal.cols() > 0)
            normal.colwise().norm().maxCoeff(&largest);
        outwards_ =
            normal.cols() > 0 && along(largest, 0).cross(along(largest, 1)).dot(normal.col(largest)) < 0 ? -1 : 1;
    }

    std::vector<RoundHole> holes()
    {
        std::vector<RoundHole> found;
        std::vector<char> taken(size_t(solid_.triangles()), 0);
        for (const Mouth& mouth : mouths()) {
            const auto of_other = [&](const FaceEdge& at) { return taken[size_t(at.next)] != 0; };
            if (std::ranges::any_of(mouth.edge, of_other))
                continue; // found from its other end
            if (std::optional<RoundHole> hole = followed(mouth)) {
                for (const int f : hole->wall)
                    taken[size_t(f)] = 1;
                found.push_back(std::move(*hole));
            }
        }
        return found;
    }

private:
    const TriMesh& solid_;
    const Eigen::Matrix3Xd& normal_;
    double thickness_, same_; ///< mm
    double outwards_ = 1;     ///< -1: triangles go around clockwise, seen from outside
    Eigen::Matrix3Xi neighbour_;
    PlaneRegions planes_;
    double depth_ = 0;         ///< mm, of the hole that is being followed
    std::vector<char> inside_; ///< per triangle: of the wall that is being followed

    auto place(int v) const { return solid_.position.col(v); }
    Eigen::Vector3d along(int f, int k) const
    {
        return place(solid_.triangle((k + 1) % 3, f)) - place(solid_.triangle(k, f));
    }
    double altitude(int f) const { return spia::altitude(solid_, f, normal_.col(f)); }
    int plane(int f) const { return planes_.of[size_t(f)]; }

    std::vector<Mouth> mouths() const
    {
        std::vector<Mouth> found;
        auto borders = borders_of(planes_, solid_, neighbour_);
        for (size_t p = 0; p < borders.size(); ++p)
            for (std::vector<FaceEdge>& loop : borders[p])
                if (const auto circle = hole_in_plane(loop, planes_.direction.col(Eigen::Index(p))))
                    found.push_back({int(p), *circle, std::move(loop)});
        return found;
    }
    int end_of(const FaceEdge& at) const { return solid_.triangle((at.k + 1) % 3, at.face); }

    /// The plane is around the circle, so its edges go clockwise.
    std::optional<RoundEdge> hole_in_plane(const std::vector<FaceEdge>& loop, const Eigen::Vector3d& direction) const
    {
        Eigen::Matrix3Xd corner(3, Eigen::Index(loop.size()));
        for (size_t i = 0; i < loop.size(); ++i)
            corner.col(Eigen::Index(i)) = place(solid_.triangle(loop[i].k, loop[i].face));
        auto circle = round_edge(corner, direction, same_);
        if (!circle)
            return std::nullopt;
        double turn = 0;
        for (Eigen::Index i = 0; i < corner.cols(); ++i)
            turn += (corner.col(i) - circle->centre)
                        .cross(corner.col((i + 1) % corner.cols()) - circle->centre)
                        .dot(circle->axis);
        return outwards_ * turn < 0 ? circle : std::nullopt;
    }

    /// The plane of the other skin, seen from a mouth.
    bool on_other_skin(int f, const RoundEdge& mouth) const
    {
        if (planes_.direction.col(plane(f)).dot(mouth.axis) > -along_axis)
            return false;
        return std::ranges::all_of(solid_.triangle.col(f), [&](int v) {
            const double h = mouth.height(place(v));
            return h < -through * thickness_ && h > -beyond * thickness_;
        });
    }

    /// Whether a triangle may be a chord of a surface of revolution about the axis, seen from the
    /// axis.
    bool revolved(int f, const RoundEdge& mouth) const
    {
        constexpr double chord = 0.3; // half of one of 35 degrees, which circles have at most
        const double high = altitude(f);
        if (high < same_)
            return true;
        const Eigen::Vector3d n = normal_.col(f).normalized(),
                              out = mouth.off_axis(solid_.position(Eigen::all, solid_.triangle.col(f)).rowwise().mean())
                                        .normalized();
        const double rounding = same_ / high;
        return n.dot(out) < 5e-3 + rounding && std::abs(n.dot(mouth.axis.cross(out))) < chord + rounding;
    }

    /// Whether a triangle of the wall goes on beyond its edge from corner k on: smoothly, or with a
    /// kink, which is along a circle. Over the hollow side of a bend a countersink is cut on beyond
    /// the plane of the skin: there at one angle with the axis, for the bend's skin is none of it.
    /// @param own  the triangle's normal, or of a sliver that of the last one before it
    bool goes_on(int f, int k, const Eigen::Vector3d& own, const RoundEdge& mouth) const
    {
        constexpr double smooth = 0.966;  // the cosine of 15 degrees: chords of 0.2 radians turn by
                                          // less
        constexpr double flattest = 0.95; // of a cone of 143 degrees
        constexpr double farthest = 2;    // of the thickness: necks and drawn walls go on like that
                                          // as well
        const int next = neighbour_(k, f);
        double low = 0;
        for (const int v : solid_.triangle.col(next)) {
            const double h = mouth.height(place(v));
            if (h > same_)
                return false;
            low = std::min(low, h);
        }
        if (altitude(next) < same_)
            return true;
        const Eigen::Vector3d n = normal_.col(next).normalized();
        if (low < -through * thickness_ && n.dot(mouth.axis) < -flattest)
            return false;
        const Eigen::Vector3d a = place(solid_.triangle(k, f)), b = place(end_of({f, k, next}));
        const bool ring = std::abs(mouth.height(a) - mouth.height(b)) < same_ &&
                          std::abs(mouth.off_axis(a).norm() - mouth.off_axis(b).norm()) < same_;
        if (low > -depth_ - same_)
            return ring || n.dot(own) > smooth;
        if (low < -farthest * thickness_)
            return false;
        if (ring && n.dot(mouth.axis) > flattest)
            return true; // where the tool ended: the bend hangs over it
        const double same_angle = std::min(unevenness(f, mouth), unevenness(next, mouth));
        return (n.dot(own) > smooth && std::abs((n - own).dot(mouth.axis)) < same_angle) ||
               of_one_cylinder(f, next, mouth);
    }

    /// Low chords of a cylinder lean any way where they end at a bend's skin; their corners do not.
    /// A triangle of that skin with all corners on the cylinder would lie within the hole.
    bool of_one_cylinder(int f, int g, const RoundEdge& mouth) const
    {
        const double radius = mouth.off_axis(place(solid_.triangle(0, f))).norm();
        return std::ranges::all_of(std::array{f, g}, [&](int each) {
            return std::ranges::all_of(solid_.triangle.col(each), [&](int v) {
                return std::abs(mouth.off_axis(place(v)).norm() - radius) < same_;
            });
        });
    }

    /// How far chords between circles may be off the angle of their cone: by the height of their
    /// arcs over them, as a cosine.
    double unevenness(int f, const RoundEdge& mouth) const
    {
        constexpr double rounding = 0.03;
        const Eigen::Vector3d out =
            mouth.off_axis(solid_.position(Eigen::all, solid_.triangle.col(f)).rowwise().mean());
        const Eigen::Vector3d around = mouth.axis.cross(out.normalized());
        double chord = 0;
        for (int k = 0; k < 3; ++k)
            chord = std::max(chord, std::abs(along(f, k).dot(around)));
        return rounding + chord * chord / (8 * out.norm() * std::max(altitude(f), same_));
    }

    /// How far below a mouth the plane of the other skin is, mm: of several, with marks in it, the
    /// farthest; 0: there is none.
    double depth_below(const RoundEdge& mouth) const
    {
        double most = 0;
        for (Eigen::Index p = 0; p < planes_.level.size(); ++p)
            if (planes_.direction.col(p).dot(mouth.axis) < -along_axis)
                if (const double depth = mouth.axis.dot(mouth.centre) + planes_.level[p]; depth < beyond * thickness_)
                    most = std::max(most, depth);
        return most;
    }

    std::optional<RoundHole> followed(const Mouth& mouth)
    {
        depth_ = depth_below(mouth.circle);
        if (depth_ < through * thickness_)
            return std::nullopt;
        RoundHole hole;
        hole.mouth = mouth.circle;
        const auto may_enter = [&](int f) {
            return plane(f) != mouth.plane && !on_other_skin(f, mouth.circle) && revolved(f, mouth.circle);
        };
        inside_.resize(size_t(solid_.triangles()), 0);
        std::vector<Eigen::Vector3d> own; // per triangle of the wall
        const auto enter = [&](int f, const Eigen::Vector3d& before) {
            inside_[size_t(f)] = 1;
            hole.wall.push_back(f);
            own.push_back(altitude(f) < same_ ? before : Eigen::Vector3d(normal_.col(f).normalized()));
        };
        bool complete = true;
        for (const FaceEdge& at : mouth.edge) {
            complete &= may_enter(at.next) && goes_on(at.face, at.k, mouth.circle.axis, mouth.circle);
            if (complete && !inside_[size_t(at.next)])
                enter(at.next, mouth.circle.axis);
        }
        for (size_t i = 0; i < hole.wall.size() && complete; ++i)
            for (int k = 0; k < 3 && complete; ++k) {
                const int f = hole.wall[i], next = neighbour_(k, f);
                complete = next >= 0;
                if (complete && !inside_[size_t(next)] && may_enter(next) && goes_on(f, k, own[i], mouth.circle))
                    enter(next, own[i]);
            }
        const bool good = complete && goes_through(mouth, hole);
        for (const int f : hole.wall)
            inside_[size_t(f)] = 0;
        std::sort(hole.wall.begin(), hole.wall.end());
        return good ? std::optional(std::move(hole)) : std::nullopt;
    }

    /// What the wall ends at: its mouth, the other skin at one radius, and else convex edges.
    bool goes_through(const Mouth& mouth, RoundHole& hole) const
    {
        std::vector<int> end;
        for (const int f : hole.wall)
            for (int k = 0; k < 3; ++k) {
                const int next = neighbour_(k, f);
                if (inside_[size_t(next)])
                    continue;
                if (on_other_skin(next, mouth.circle)) {
                    hole.beyond.push_back(next);
                    end.insert(end.end(), {solid_.triangle(k, f), solid_.triangle((k + 1) % 3, f)});
                } else if (plane(next) != mouth.plane) {
                    hole.whole = false;
                    if (outwards_ * normal_.col(f).cross(normal_.col(next)).dot(along(f, k)) <= 0)
                        return false;
                } else if (std::abs(mouth.circle.off_axis(place(solid_.triangle(k, f))).norm() - mouth.circle.radius) >
                           same_)
                    return false; // it comes back to its skin
            }
        if (end.empty())
            return false;
        std::ranges::sort(hole.beyond);
        for (const int v : end)
            hole.far += mouth.circle.off_axis(place(v)).norm() / double(end.size());
        const auto off = [&](int v) { return std::abs(mouth.circle.off_axis(place(v)).norm() - hole.far) > same_; };
        return std::ranges::none_of(end, off) &&
               (!hole.whole || mouth.circle.surrounded(solid_.position(Eigen::all, end)));
    }
};

} // namespace

std::vector<RoundHole> round_holes(const TriMesh& solid, const Eigen::Matrix3Xd& normal, double thickness)
{
    return RoundHoleSearch(solid, normal, thickness).holes();
}

} // namespace spia
