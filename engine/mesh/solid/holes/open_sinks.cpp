#include "engine/mesh/solid/holes/open_sinks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/small_dense.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/solid/fit/plane_regions.h"
#include "engine/mesh/solid/holes/open_counterbores.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double least_lean = 0.17, most_lean = 0.985; // sines of 10 and of 80 degrees
constexpr double same_lean = 0.08;                     // of sines; 5 degrees
constexpr double one_plane = 1 - 1e-6;                 // 0.1 degrees

bool leans(double lean) { return std::abs(lean) > least_lean && std::abs(lean) < most_lean; }

/// A wall across the sheet that leans at one angle against the skin beside its first face.
struct Wall {
    Eigen::Vector3d up;    ///< unit, of that skin; of the inner one turned over
    double lean;           ///< sine, of the first face's normal over the plane of the skin
    std::vector<int> face; ///< ascending
};

class SinkSearch {
public:
    SinkSearch(const TriMesh& solid, const ThinSolid& sheet)
        : solid_(solid), sheet_(sheet), normal_(sheet.flipped * area_vectors(solid)),
          neighbour_(face_neighbours(solid.triangles(), edge_uses(solid.triangle))), up_(sheet.side.size()),
          in_(sheet.side.size(), 0), done_(sheet.side.size(), 0)
    {
        find_ups();
    }

    std::vector<OpenSink> sinks(const std::vector<SunkHole>& told)
    {
        std::vector<OpenSink> found;
        const auto take = [&](const Wall& wall) {
            if (std::ranges::none_of(told, [&](const SunkHole& hole) { return is_of(wall, hole); }))
                found.push_back(sink_of(wall));
        };
        for (size_t f = 0; f < up_.size(); ++f) {
            if (!may_begin(f) || !beside_skin(int(f)))
                continue;
            const Wall wall = wall_from(int(f));
            const bool sink = is_hollow_cone(wall);
            for (const int each : wall.face)
                if (sink || in_its_plane(each, wall))
                    done_[size_t(each)] = sink ? taken : asked;
            if (sink)
                take(wall);
        }
        std::ranges::replace(done_, asked, char(0));
        for (size_t f = 0; f < up_.size(); ++f)
            if (may_begin(f))
                if (const auto wall = cone_over_bend(int(f)))
                    take(*wall);
        return found;
    }

    std::vector<OpenSink> counterbores(const std::vector<SunkHole>& told) const
    {
        std::vector<OpenSink> found;
        for (const OpenCounterbore& each : open_counterbores(solid_, normal_, sheet_.thickness)) {
            const Wall wall{Eigen::Vector3d::Zero(), 0, each.wall};
            const auto has = [&](const SunkHole& hole) { return is_of(wall, hole); };
            const auto on_outer = [&](int f) { return touches(f, SheetSide::outer); };
            if (std::ranges::none_of(told, has))
                found.push_back({each.wall.front(), each.place,
                                 std::ranges::any_of(each.wall, on_outer) ? SheetSide::outer : SheetSide::inner, true,
                                 true});
        }
        return found;
    }

private:
    const TriMesh& solid_;
    const ThinSolid& sheet_;
    Eigen::Matrix3Xd normal_; ///< area vectors, outwards
    Eigen::Matrix3Xi neighbour_;
    /// Per face across the sheet near a skin: the skin's normal, of the inner one turned over.
    std::vector<std::optional<Eigen::Vector3d>> up_;
    /// Per face: it is of the wall that is being followed; of one before.
    std::vector<char> in_, done_;
    static constexpr char asked = 1, taken = 2; ///< of that: it was no sink; it was one

    bool may_begin(size_t f) const { return up_[f] && !done_[f] && leans(unit(int(f)).dot(*up_[f])); }

    Eigen::Vector3d unit(int f) const { return normal_.col(f).normalized(); }
    Eigen::Vector3d middle(int f) const { return solid_.position(Eigen::all, solid_.triangle.col(f)).rowwise().mean(); }
    bool rim(int f) const { return f >= 0 && sheet_.side[size_t(f)] == SheetSide::rim; }
    bool touches(int f, SheetSide skin) const
    {
        return std::ranges::any_of(neighbour_.col(f),
                                   [&](int next) { return next >= 0 && sheet_.side[size_t(next)] == skin; });
    }
    bool beside_skin(int f) const { return touches(f, SheetSide::outer) || touches(f, SheetSide::inner); }

    void find_ups()
    {
        std::vector<int> reached;
        for (int f = 0; f < int(up_.size()); ++f)
            for (const int next : neighbour_.col(f))
                if (rim(f) && next >= 0 && !rim(next)) {
                    if (!up_[size_t(f)])
                        reached.push_back(f);
                    up_[size_t(f)] = (sheet_.side[size_t(next)] == SheetSide::outer ? 1 : -1) * unit(next);
                }
        for (size_t i = 0; i < reached.size(); ++i) // further rows of triangles of the same wall
            for (const int next : neighbour_.col(reached[i])) {
                const Eigen::Vector3d up = *up_[size_t(reached[i])];
                if (!rim(next) || up_[size_t(next)] || std::abs((unit(next) - unit(reached[i])).dot(up)) >= same_lean)
                    continue;
                up_[size_t(next)] = up;
                reached.push_back(next);
            }
    }

    /// A cone is of one angle with its axis over a bend as well, where the skin turns away.
    Wall wall_from(int seed)
    {
        Wall wall{*up_[size_t(seed)], unit(seed).dot(*up_[size_t(seed)]), {seed}};
        in_[size_t(seed)] = 1;
        for (size_t i = 0; i < wall.face.size(); ++i)
            for (const int next : neighbour_.col(wall.face[i])) {
                if (!rim(next) || in_[size_t(next)])
                    continue;
                const double lean = unit(next).dot(wall.up);
                if (!leans(lean) || std::abs(lean - unit(wall.face[i]).dot(wall.up)) >= same_lean)
                    continue;
                in_[size_t(next)] = 1;
                wall.face.push_back(next);
            }
        for (const int f : wall.face)
            in_[size_t(f)] = 0;
        std::ranges::sort(wall.face);
        return wall;
    }
    bool in_its_plane(int f, const Wall& wall) const
    {
        return up_[size_t(f)] && up_[size_t(f)]->dot(wall.up) > one_plane;
    }

    /// Whether the wall turns around an axis and faces it, beside flat sheet.
    bool is_hollow_cone(const Wall& wall) const
    {
        constexpr double turning = 0.985; // mean of unit vectors over an arc of 35 degrees
        std::vector<int> here;
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        double size = 0;
        for (const int f : wall.face)
            if (in_its_plane(f, wall)) {
                const Eigen::Vector3d n = normal_.col(f);
                mean += n.norm() * (n - n.dot(wall.up) * wall.up).normalized();
                size += n.norm();
                here.push_back(f);
            }
        return mean.norm() <= turning * size && hollow(here, wall.up) && !is_straight(wall);
    }

    /// How the faces of a wall lie about one axis.
    struct Turning {
        Eigen::Vector3d axis;   ///< unit; that from which their normals deviate least
        double lean;            ///< sine, of their mean normal over the plane across it
        bool even;              ///< all lean so
        Eigen::Matrix3Xd round; ///< their normals without the part along the axis
    };

    Turning turning_of(const std::vector<int>& face) const
    {
        constexpr double slivers = 0.05; // of the area
        Eigen::Matrix3Xd n = normal_(Eigen::all, face).colwise().normalized();
        const Eigen::RowVectorXd size = normal_(Eigen::all, face).colwise().norm();
        const Eigen::Vector3d mean = n * size.transpose() / size.sum();
        const Eigen::Matrix3Xd from = n.colwise() - mean;
        const Eigen::Vector3d axis = eigen_pairs(from * size.asDiagonal() * from.transpose()).vector.col(0);
        const Eigen::RowVectorXd off = (axis.transpose() * from).cwiseAbs();
        n -= axis * (axis.transpose() * n);
        return {axis, mean.dot(axis), (off.array() > same_lean).select(size, 0).sum() < slivers * size.sum(),
                std::move(n)};
    }

    /// The faces of a wall across the sheet that go on smoothly from these ones, ascending.
    std::vector<int> smooth_from(std::vector<int> face, const auto& may_take) const
    {
        constexpr double smooth = 0.906; // 25 degrees, as CutOffHoles has it
        for (size_t i = 0; i < face.size(); ++i)
            for (const int next : neighbour_.col(face[i]))
                if (rim(next) && unit(next).dot(unit(face[i])) >= smooth && may_take(next))
                    face.push_back(next);
        std::ranges::sort(face);
        return face;
    }

    /// Whether it is of a wall along one axis: of a hole that is drilled askew, or through a bend,
    /// whose skin leans against it.
    bool is_straight(const Wall& wall) const
    {
        std::vector<char> in(up_.size(), 0);
        for (const int f : wall.face)
            in[size_t(f)] = 1;
        const std::vector<int> all =
            smooth_from(wall.face, [&](int next) { return !std::exchange(in[size_t(next)], char(1)); });
        const Turning about = turning_of(all);
        return about.even && std::abs(about.lean) < least_lean;
    }

    /// Where no skin beside a wall is plane its own faces say about which axis it is a cone.
    std::optional<Wall> cone_over_bend(int seed)
    {
        constexpr double steepest = 0.7;  // cosine of 45 degrees
        constexpr double turning = 0.955; // as above, over an arc of 60 degrees
        done_[size_t(seed)] = asked;
        Wall wall{Eigen::Vector3d::Zero(), 0,
                  smooth_from({seed}, [&](int next) { return !std::exchange(done_[size_t(next)], asked); })};
        Eigen::Vector3d up = Eigen::Vector3d::Zero();
        for (const int f : wall.face)
            if (up_[size_t(f)])
                up += *up_[size_t(f)] * normal_.col(f).norm();
        const Turning about = turning_of(wall.face);
        const double turned = about.axis.dot(up) < 0 ? -1 : 1;
        wall.up = turned * about.axis;
        wall.lean = turned * about.lean;
        const Eigen::RowVectorXd size = normal_(Eigen::all, wall.face).colwise().norm();
        const bool turns = (about.round.colwise().normalized() * size.transpose()).norm() < turning * size.sum();
        const bool cone = about.even && turns && leans(wall.lean) && wall.up.dot(up) > steepest * up.norm();
        return cone && hollow(wall.face, wall.up) ? std::optional(wall) : std::nullopt;
    }

    /// Whether faces look towards their middle, seen along an axis.
    bool hollow(const std::vector<int>& face, const Eigen::Vector3d& axis) const
    {
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        double size = 0, outwards = 0;
        for (const int f : face) {
            centre += normal_.col(f).norm() * middle(f);
            size += normal_.col(f).norm();
        }
        for (const int f : face) {
            const Eigen::Vector3d n = normal_.col(f), from = middle(f) - centre / size;
            outwards += n.norm() * (n - n.dot(axis) * axis).normalized().dot(from);
        }
        return outwards < 0;
    }

    bool is_of(const Wall& wall, const SunkHole& hole) const
    {
        constexpr double rounding = 1e-6;
        return std::ranges::binary_search(wall.face, hole.face) || std::ranges::all_of(wall.face, [&](int f) {
                   const Eigen::Vector3d from = middle(f) - hole.centre;
                   return from.cross(hole.inwards).norm() < (1 + rounding) * hole.diameter / 2 &&
                          std::abs(from.dot(hole.inwards)) < (1 + rounding) * sheet_.thickness;
               });
    }

    OpenSink sink_of(const Wall& wall) const
    {
        const SheetSide wide = wall.lean > 0 ? SheetSide::outer : SheetSide::inner,
                        narrow = wall.lean > 0 ? SheetSide::inner : SheetSide::outer;
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        for (const int f : wall.face)
            place += middle(f) / double(wall.face.size());
        const bool through = std::ranges::any_of(wall.face, [&](int f) { return touches(f, narrow); });
        return {wall.face.front(), place, wide, !through};
    }
};

} // namespace

std::vector<OpenSink> open_sinks(const TriMesh& solid, const ThinSolid& sheet, const std::vector<SunkHole>& told)
{
    SinkSearch search(solid, sheet);
    std::vector<OpenSink> found = search.sinks(told);
    for (OpenSink& each : search.counterbores(told))
        found.push_back(std::move(each));
    return found;
}

} // namespace spia
