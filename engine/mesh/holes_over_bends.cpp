#include "engine/mesh/holes_over_bends.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/unrolled_skin.h"
#include "engine/mesh/vectors.h"

namespace spia {
namespace {

using Kind = StatedSurface::Kind;
using Corner = std::array<int, 3>;

/// A place of the unrolled bend, and of which triangle of the solid it is a part.
struct Part {
    Corner corner;
    int source;
};

/// One bend with the flats beside it, while it is looked at. Nothing of the middle surface changes before all is sound.
class Bend {
public:
    Bend(const SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet, const Eigen::Matrix3Xd& normal,
         const std::vector<StatedSurface>& surface, const std::vector<EdgeUse>& solid_uses)
        : middle_(middle), solid_(solid), sheet_(sheet), normal_(normal), surface_(surface), solid_uses_(solid_uses),
          within_(1e-3 * sheet.thickness)
    {
    }

    /// @param on  the bend's cylinder on the outer skin
    /// @returns whether holes were put over it
    bool lay(const StatedSurface& on)
    {
        if (!unroll(on) || !find_holes() || !move())
            return false;
        const std::vector<Part> parts = part_;
        const std::vector<Eigen::Vector2d> at = at_;
        divide_rims();
        if (cut() && sound())
            return true;
        part_ = parts; // needles of a rim with many vertices are cut into triangles without area
        at_ = at;
        source_.clear();
        return cut() && sound();
    }
    /// Those of the middle surface that new ones take the place of.
    const std::vector<char>& replaced() const { return inside_; }
    const std::vector<Part>& parts() const { return part_; }
    /// mm, of vertices from the first of the middle surface on
    std::vector<std::pair<int, Eigen::Vector3d>> moved() const
    {
        std::vector<std::pair<int, Eigen::Vector3d>> result;
        for (const int v : on_rim_)
            result.emplace_back(v, skin_->in_space(at_[size_t(v)]));
        return result;
    }
    std::vector<std::pair<int, Eigen::Vector3d>> added() const ///< with the number of the solid's vertex
    {
        std::vector<std::pair<int, Eigen::Vector3d>> result;
        for (size_t i = 0; i < source_.size(); ++i)
            result.emplace_back(source_[i], skin_->in_space(at_[size_t(middle_.mesh.vertices()) + i]));
        return result;
    }
    const std::vector<int>& walls() const { return walls_; }
    /// How many vertices of the rims had gone straight in.
    int straight() const { return straight_; }

private:
    struct Hole {
        StatedSurface wall;
        std::vector<int> rim; ///< vertices of the middle surface
    };
    const SkinMesh& middle_;
    const TriMesh& solid_;
    const ThinSolid& sheet_;
    const Eigen::Matrix3Xd& normal_; ///< per triangle of the solid, area vectors outwards
    const std::vector<StatedSurface>& surface_;
    const std::vector<EdgeUse>& solid_uses_;
    double within_; ///< mm, what vertices may be off: meshes have the digits of STL
    std::optional<UnrolledSkin> skin_;
    StatedSurface cylinder_;          ///< of the middle surface
    std::vector<StatedSurface> flat_; ///< likewise
    std::vector<char> inside_;        ///< per triangle of the middle surface: 1 + its surface, 0 cylinder, else flat
    std::vector<Eigen::Vector2d> at_, from_; ///< per vertex; where it was first, straight below the outer skin
    std::vector<Part> part_;
    std::set<std::pair<int, int>> border_, fixed_; ///< edges of the region: of the sheet; to the rest of the skin
    std::vector<Hole> hole_;
    std::vector<int> on_rim_, walls_, source_;
    std::map<std::pair<int, int>, size_t> hole_at_; ///< per edge of the border
    double way_round_ = 1;                          ///< of triangles in the unrolled plane
    int straight_ = 0;

    static std::pair<int, int> key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
    Eigen::Vector3d outer(int v) const { return solid_.position.col(middle_.source_vertex[size_t(v)]); }

    bool lies_in(int f, const StatedSurface& plane) const
    {
        const int s = middle_.source_face[size_t(f)];
        if (surface_[size_t(s)].kind == Kind::cylinder)
            return false; // a narrow triangle of another bend, beside its end
        return normal_.col(s).dot(plane.direction) > 0 && std::ranges::all_of(middle_.mesh.triangle.col(f), [&](int v) {
                   return std::abs((outer(v) - plane.point).dot(plane.direction)) <= within_;
               });
    }

    static constexpr double same_way = 0.9998; // of normals of one flat; 1 degree

    /// Triangles of the solid that go on evenly from the cylinder, the largest first: the narrow ones right beside it tell their plane only
    /// as well as the digits of STL do over their width.
    std::vector<int> flats_beside(const std::vector<int>& faces, const Eigen::Matrix3Xi& beside) const
    {
        const auto source = [&](int f) { return middle_.source_face[size_t(f)]; };
        std::vector<int> next;
        std::vector<char> seen = inside_;
        for (const int f : faces)
            for (const int g : beside.col(f))
                if (g >= 0 && !std::exchange(seen[size_t(g)], 1))
                    next.push_back(g);
        for (size_t i = 0; i < next.size(); ++i)
            for (const int g : beside.col(next[i]))
                if (g >= 0 && !seen[size_t(g)] &&
                    normal_.col(source(next[i])).normalized().dot(normal_.col(source(g)).normalized()) > same_way) {
                    seen[size_t(g)] = 1;
                    next.push_back(g);
                }
        std::ranges::transform(next, next.begin(), source);
        std::ranges::stable_sort(next, std::greater(), [&](int f) { return normal_.col(f).norm(); });
        return next;
    }

    /// The cylinder, the flats that touch it, and what is connected to it on those.
    bool unroll(const StatedSurface& on)
    {
        const Eigen::Matrix3Xi beside = face_neighbours(middle_.mesh.triangles(), edge_uses(middle_.mesh.triangle));
        inside_.assign(size_t(middle_.mesh.triangles()), 0);
        std::vector<int> faces;
        for (int f = 0; f < middle_.mesh.triangles(); ++f)
            if (same_cylinder(surface_[size_t(middle_.source_face[size_t(f)])], on)) {
                faces.push_back(f);
                inside_[size_t(f)] = 1;
            }
        std::vector<StatedSurface> plane;
        for (const int s : flats_beside(faces, beside)) {
            const StatedSurface flat{Kind::plane, solid_.position.col(solid_.triangle(0, s)),
                                     normal_.col(s).normalized(), 0, 0};
            if (plane.size() < 2 && surface_[size_t(s)].kind != Kind::cylinder &&
                std::abs(flat.direction.dot(on.direction)) < 1e-4 &&
                std::abs(std::abs((on.point - flat.point).dot(flat.direction)) - on.radius) < within_ &&
                std::ranges::none_of(plane,
                                     [&](const StatedSurface& p) { return p.direction.dot(flat.direction) > same_way; }))
                plane.push_back(flat);
        }
        for (size_t i = 0; i < faces.size(); ++i)
            for (const int g : beside.col(faces[i]))
                for (size_t p = 0; g >= 0 && !inside_[size_t(g)] && p < plane.size(); ++p)
                    if (lies_in(g, plane[p])) {
                        inside_[size_t(g)] = char(2 + p);
                        faces.push_back(g);
                    }
        if (plane.size() != 2 || faces.empty())
            return false;
        return flatten(on, plane, faces);
    }

    bool flatten(const StatedSurface& on, std::vector<StatedSurface> plane, const std::vector<int>& faces)
    {
        const double half = sheet_.thickness / 2;
        const int first = middle_.source_face[size_t(faces.front())];
        const Eigen::Vector3d mean = solid_.position(Eigen::all, solid_.triangle.col(first)).rowwise().mean();
        const bool hollow = normal_at(on, mean, normal_.col(first)).dot(mean - on.point) < 0;
        cylinder_ = on;
        cylinder_.radius += hollow ? half : -half;
        if (!(cylinder_.radius > within_))
            return false;
        std::vector<StatedSurface> surfaces{cylinder_};
        for (StatedSurface& p : plane) {
            p.point -= half * p.direction;
            surfaces.push_back(p);
        }
        flat_ = plane;
        std::vector<int> vertices;
        for (const int f : faces)
            for (const int v : middle_.mesh.triangle.col(f))
                vertices.push_back(v);
        std::ranges::sort(vertices);
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        Eigen::Matrix3Xd below(3, middle_.mesh.vertices());
        for (const int f : faces)
            for (const int v : middle_.mesh.triangle.col(f)) {
                const int kind = inside_[size_t(f)] - 1;
                const Eigen::Vector3d from = outer(v) - on.point,
                                      out = (from - from.dot(on.direction) * on.direction).normalized();
                const Eigen::Vector3d inwards = kind > 0 ? Eigen::Vector3d(-flat_[size_t(kind - 1)].direction)
                                                : hollow ? out
                                                         : Eigen::Vector3d(-out);
                below.col(v) = outer(v) + half * inwards;
            }
        skin_ = UnrolledSkin::of(surfaces, below(Eigen::all, vertices), within_);
        if (!skin_)
            return false;
        at_.assign(size_t(middle_.mesh.vertices()), {});
        from_ = at_;
        for (const int v : vertices) {
            const auto start = skin_->flat(below.col(v));
            if (!start)
                return false;
            from_[size_t(v)] = *start;
            const auto end = skin_->flat(middle_.mesh.position.col(v));
            at_[size_t(v)] = end ? *end : Eigen::Vector2d::Constant(std::nan(""));
        }
        for (const int f : faces) {
            const auto t = middle_.mesh.triangle.col(f);
            part_.push_back({{t[0], t[1], t[2]}, middle_.source_face[size_t(f)]});
        }
        double sum = 0;
        for (const Part& p : part_)
            sum += area(p.corner, from_);
        way_round_ = sum > 0 ? 1 : -1;
        return true;
    }

    double area(const Corner& t, const std::vector<Eigen::Vector2d>& at) const
    {
        const Eigen::Vector2d& a = at[size_t(t[0])];
        return way_round_ * cross(at[size_t(t[1])] - a, at[size_t(t[2])] - a) / 2;
    }

    /// @returns whether there is one whose rim is elsewhere than it was put
    bool find_holes()
    {
        std::map<int, std::vector<int>> next;
        const std::vector<EdgeUse> uses = edge_uses(middle_.mesh.triangle);
        for_each_edge(uses, [&](size_t begin, size_t end) {
            const EdgeUse& use = uses[begin];
            if (end == begin + 1 && inside_[size_t(use.face)]) {
                border_.insert(key(use.low, use.high));
                next[use.low].push_back(use.high);
                next[use.high].push_back(use.low);
            } else if (end == begin + 2 && !inside_[size_t(use.face)] != !inside_[size_t(uses[begin + 1].face)])
                fixed_.insert(key(use.low, use.high));
        });
        std::set<int> seen;
        for (const auto& [start, _] : next) {
            if (seen.contains(start))
                continue;
            std::vector<int> loop;
            bool whole = true;
            for (int v = start, before = -1; seen.insert(v).second;) {
                loop.push_back(v);
                whole &= next[v].size() == 2;
                const int to = next[v].size() == 2 && next[v][0] == before ? next[v][1] : next[v][0];
                before = std::exchange(v, to);
            }
            if (whole && loop.size() > 2)
                take_hole(loop);
        }
        return !hole_.empty();
    }

    /// The triangles of the solid across the rim; some narrow ones of a mesh count to a skin.
    std::vector<int> across(const std::vector<int>& loop) const
    {
        std::vector<int> result;
        for (size_t i = 0; i < loop.size(); ++i) {
            const auto [low, high] =
                key(middle_.source_vertex[size_t(loop[i])], middle_.source_vertex[size_t(loop[(i + 1) % loop.size()])]);
            auto use = std::lower_bound(
                solid_uses_.begin(), solid_uses_.end(), std::pair(low, high),
                [](const EdgeUse& u, const auto& wanted) { return std::pair(u.low, u.high) < wanted; });
            for (; use != solid_uses_.end() && use->low == low && use->high == high; ++use)
                if (sheet_.side[size_t(use->face)] == SheetSide::rim)
                    result.push_back(use->face);
        }
        return result;
    }

    std::optional<StatedSurface> wall_of(const std::vector<int>& rim) const
    {
        if (rim.empty())
            return std::nullopt;
        if (const StatedSurface& first = surface_[size_t(rim.front())]; first.kind == Kind::cylinder)
            return std::ranges::all_of(rim, [&](int f) { return same_cylinder(surface_[size_t(f)], first); })
                       ? std::optional(first)
                       : std::nullopt;
        std::set<int> vertices;
        for (const int f : rim)
            for (const int v : solid_.triangle.col(f))
                vertices.insert(v);
        const std::vector<int> places(vertices.begin(), vertices.end());
        return cylinder_through(solid_.position(Eigen::all, places), normal_(Eigen::all, rim), within_);
    }

    void take_hole(const std::vector<int>& loop)
    {
        const std::vector<int> rim = across(loop);
        const auto wall = wall_of(rim);
        const auto elsewhere_too = [&](const std::pair<int, int>& edge) {
            return std::ranges::find(loop, edge.first) != loop.end() ||
                   std::ranges::find(loop, edge.second) != loop.end();
        };
        if (!wall || std::ranges::any_of(fixed_, elsewhere_too))
            return;
        constexpr double few = 0.25;
        if (double(rim.size()) < (1 - few) * double(loop.size()) || std::ranges::any_of(loop, [&](int v) {
                return std::abs(off(*wall, outer(v)).norm() - wall->radius) > within_;
            }))
            return;
        double turns = 0;
        for (size_t i = 0; i < loop.size(); ++i) {
            const Eigen::Vector3d a = off(*wall, outer(loop[i])), b = off(*wall, outer(loop[(i + 1) % loop.size()]));
            turns += std::atan2(a.cross(b).dot(wall->direction), a.dot(b));
        }
        if (std::abs(turns) < std::numbers::pi)
            return; // a notch with a round end
        std::vector<Eigen::Vector2d> target;
        constexpr double share = 0.005; // of the thickness; nearer the rim was met well enough
        const double off_by = share * sheet_.thickness;
        bool elsewhere = false, over = false;
        for (const int v : loop) {
            const auto place = meets(*wall, outer(v));
            if (!place)
                return;
            target.push_back(*place);
            elsewhere |= !((*place - at_[size_t(v)]).norm() <= off_by);
            over |= skin_->zone(place->x()) == 0 || skin_->zone(from_[size_t(v)].x()) == 0;
        }
        if (!elsewhere || !over)
            return;
        for (size_t i = 0; i < loop.size(); ++i) {
            straight_ += (at_[size_t(loop[i])] - from_[size_t(loop[i])]).norm() <= within_;
            at_[size_t(loop[i])] = target[i];
            hole_at_[key(loop[i], loop[(i + 1) % loop.size()])] = hole_.size();
        }
        hole_.push_back({*wall, loop});
        on_rim_.insert(on_rim_.end(), loop.begin(), loop.end());
        walls_.insert(walls_.end(), rim.begin(), rim.end());
    }

    static Eigen::Vector3d off(const StatedSurface& cylinder, const Eigen::Vector3d& place)
    {
        const Eigen::Vector3d from = place - cylinder.point;
        return from - from.dot(cylinder.direction) * cylinder.direction;
    }

    /// Where the line of the wall through a place meets the middle surface.
    std::optional<Eigen::Vector2d> meets(const StatedSurface& wall, const Eigen::Vector3d& place) const
    {
        const Eigen::Vector3d &d = wall.direction, u = off(cylinder_, place),
                              w = d - d.dot(cylinder_.direction) * cylinder_.direction;
        std::vector<double> ways;
        for (const StatedSurface& p : flat_)
            ways.push_back((p.point - place).dot(p.direction) / d.dot(p.direction));
        const double a = w.squaredNorm(), b = u.dot(w), c = u.squaredNorm() - cylinder_.radius * cylinder_.radius;
        if (b * b >= a * c && a > 0)
            for (const double root : {-1., 1.})
                ways.push_back((-b + root * std::sqrt(b * b - a * c)) / a);
        constexpr double most = 3; // thicknesses
        double best = most * sheet_.thickness;
        std::optional<Eigen::Vector2d> result;
        for (const double way : ways) {
            const Eigen::Vector3d to = place + way * d;
            if (!(std::abs(way) < best))
                continue;
            if (const auto flat = skin_->flat(to); flat && (skin_->in_space(*flat) - to).norm() <= within_) {
                best = std::abs(way);
                result = flat;
            }
        }
        return result;
    }

    /// In small steps, with other diagonals where triangles would turn over.
    bool move()
    {
        const std::vector<Eigen::Vector2d> to = at_;
        for (const Part& p : part_)
            for (const int v : p.corner)
                if (!to[size_t(v)].allFinite())
                    return false;
        constexpr int steps = 64; // of about a thickness: less than chords of a rim are long
        for (int step = 1; step <= steps; ++step) {
            const double share = double(step) / steps;
            for (size_t v = 0; v < to.size(); ++v)
                at_[v] = (1 - share) * from_[v] + share * to[v];
            turn_diagonals();
        }
        return std::ranges::all_of(part_, [&](const Part& p) { return area(p.corner, at_) > 0; });
    }
    bool sound() const
    {
        constexpr double least = 3e-6; // the doctor calls 1e-6 no area
        return std::ranges::all_of(part_, [&](const Part& p) { return quality(p.corner) > least; });
    }

    void turn_diagonals()
    {
        constexpr int rounds = 50;
        for (int round = 0; round < rounds; ++round) {
            std::vector<Corner> corners;
            for (const Part& p : part_)
                corners.push_back(p.corner);
            const std::vector<EdgeUse> uses = edge_uses(corners);
            std::vector<char> done(part_.size(), 0);
            std::set<std::pair<int, int>> edges;
            for (const EdgeUse& use : uses)
                edges.insert({use.low, use.high});
            bool any = false;
            for_each_edge(uses, [&](size_t begin, size_t end) {
                if (end == begin + 2 && !done[size_t(uses[begin].face)] && !done[size_t(uses[begin + 1].face)] &&
                    turn_diagonal(uses[begin], uses[begin + 1], edges)) {
                    done[size_t(uses[begin].face)] = done[size_t(uses[begin + 1].face)] = 1;
                    any = true;
                }
            });
            if (!any)
                return;
        }
    }
    /// Where a triangle is next to nothing or less, and is not with the other diagonal.
    bool turn_diagonal(const EdgeUse& one, const EdgeUse& other, std::set<std::pair<int, int>>& edges)
    {
        Corner &s = part_[size_t(one.face)].corner, &t = part_[size_t(other.face)].corner;
        const auto k = size_t(one.corner);
        const int a = s[k], b = s[(k + 1) % 3], c = s[(k + 2) % 3], d = t[(size_t(other.corner) + 2) % 3];
        const Corner first{a, d, c}, second{d, b, c};
        const double before = std::min(quality(s), quality(t)), after = std::min(quality(first), quality(second));
        constexpr double thin = 0.02; // of an angle's sine, about
        if (c == d || before > thin || after <= before + 1e-9 || edges.contains(key(c, d)))
            return false;
        s = first;
        t = second;
        edges.insert(key(c, d));
        return true;
    }
    double quality(const Corner& t) const
    {
        double longest = 0;
        for (size_t k = 0; k < 3; ++k)
            longest = std::max(longest, (at_[size_t(t[(k + 1) % 3])] - at_[size_t(t[k])]).squaredNorm());
        return longest > 0 ? 2 * area(t, at_) / longest : 0;
    }

    int add(const Eigen::Vector2d& place, int like)
    {
        at_.push_back(place);
        source_.push_back(source_of(like));
        return int(at_.size()) - 1;
    }
    int source_of(int v) const
    {
        const int own = middle_.mesh.vertices();
        return v < own ? middle_.source_vertex[size_t(v)] : source_[size_t(v - own)];
    }

    /// Chords of the rims as round_border() has them.
    void divide_rims()
    {
        constexpr double least = 1e-4; // of the height over the longest edge: the doctor calls 1e-6 no area
        const std::vector<Part> before = std::exchange(part_, {});
        for (const Part& p : before) {
            size_t k = 0;
            while (k < 3 && !hole_at_.contains(key(p.corner[k], p.corner[(k + 1) % 3])))
                ++k;
            const size_t begin = part_.size(), vertices = at_.size();
            if (k < 3)
                divide(p, k);
            if (k == 3 || part_.size() == begin ||
                !std::all_of(part_.begin() + long(begin), part_.end(),
                             [&](const Part& q) { return quality(q.corner) > least; })) {
                part_.resize(begin);
                at_.resize(vertices);
                source_.resize(vertices - size_t(middle_.mesh.vertices()));
                part_.push_back(p);
            }
        }
    }
    void divide(const Part& p, size_t k)
    {
        const int a = p.corner[k], b = p.corner[(k + 1) % 3], c = p.corner[(k + 2) % 3];
        const StatedSurface& wall = hole_[hole_at_.at(key(a, b))].wall;
        const Eigen::Vector3d from = skin_->in_space(at_[size_t(a)]), to = skin_->in_space(at_[size_t(b)]),
                              u = off(wall, from), v = off(wall, to);
        const double angle = std::atan2(u.cross(v).dot(wall.direction), u.dot(v));
        constexpr double finest = 3 * std::numbers::pi / 180;
        const int pieces = std::max(1, int(std::ceil(std::abs(angle) / finest - 1e-6)));
        int last = a;
        for (int i = 1; i < pieces; ++i) {
            const double share = double(i) / pieces;
            const Eigen::Vector3d out = Eigen::AngleAxisd(share * angle, wall.direction) * u.normalized() * wall.radius;
            const Eigen::Vector3d axis =
                wall.point + ((1 - share) * from + share * to - wall.point).dot(wall.direction) * wall.direction;
            const auto place = meets(wall, axis + out);
            if (!place)
                return;
            const int now = add(*place, a);
            part_.push_back({{last, now, c}, p.source});
            last = now;
        }
        part_.push_back({{last, b, c}, p.source});
    }

    /// Where flat and cylinder meet, and where a triangle would be a chord of too much of the bend.
    bool cut()
    {
        std::vector<double> seams = skin_->seams();
        std::ranges::sort(seams);
        if (seams.size() != 2)
            return false;
        for (const double u : seams)
            if (!cut_at(u))
                return false;
        constexpr double widest = 20 * std::numbers::pi / 180, apart = 15 * std::numbers::pi / 180;
        const double turn = (seams[1] - seams[0]) / cylinder_.radius;
        const int strips = int(std::ceil(turn / apart));
        for (int i = 1; i < strips; ++i) {
            const double u = seams[0] + (seams[1] - seams[0]) * i / strips;
            const bool wide = std::ranges::any_of(part_, [&](const Part& p) {
                double low = 1e300, high = -1e300;
                for (const int v : p.corner) {
                    low = std::min(low, at_[size_t(v)].x());
                    high = std::max(high, at_[size_t(v)].x());
                }
                return low < u && u < high && skin_->turn(low, high) > widest;
            });
            if (wide && !cut_at(u))
                return false;
        }
        name_surfaces();
        return true;
    }

    bool cut_at(double u)
    {
        const double on = 0.3 * within_; // else the digits of STL make slivers along the ends
        std::map<std::pair<int, int>, int> at;
        const auto side = [&](int v) {
            const double beyond = at_[size_t(v)].x() - u;
            return std::abs(beyond) <= on ? 0 : beyond < 0 ? -1 : 1;
        };
        const std::vector<Part> before = std::exchange(part_, {});
        for (const Part& p : before) {
            size_t k = 0; // the corner that is alone on its side, or on the line between the others
            const std::array<int, 3> s{side(p.corner[0]), side(p.corner[1]), side(p.corner[2])};
            while (k < 3 && !(s[(k + 1) % 3] * s[(k + 2) % 3] < 0 && s[k] == 0) &&
                   !(s[k] * s[(k + 1) % 3] < 0 && s[k] * s[(k + 2) % 3] < 0))
                ++k;
            if (k == 3) {
                part_.push_back(p);
                continue;
            }
            const int a = p.corner[k], b = p.corner[(k + 1) % 3], c = p.corner[(k + 2) % 3];
            const auto between = [&](int i, int j) {
                const auto [found, fresh] = at.try_emplace(key(i, j), int(at_.size()));
                if (fresh) {
                    const Eigen::Vector2d x = at_[size_t(i)], y = at_[size_t(j)];
                    const double share = (u - x.x()) / (y.x() - x.x());
                    add({u, x.y() + share * (y.y() - x.y())}, i);
                }
                return found->second;
            };
            if ((s[k] != 0 && (fixed_.contains(key(a, b)) || fixed_.contains(key(a, c)))) ||
                (s[k] == 0 && fixed_.contains(key(b, c))))
                return false;
            if (s[k] == 0) {
                const int m = between(b, c);
                part_.push_back({{a, b, m}, p.source});
                part_.push_back({{a, m, c}, p.source});
                continue;
            }
            const int m = between(a, b), n = between(a, c);
            part_.push_back({{a, m, n}, p.source});
            if ((at_[size_t(m)] - at_[size_t(c)]).norm() < (at_[size_t(b)] - at_[size_t(n)]).norm()) {
                part_.push_back({{m, b, c}, p.source});
                part_.push_back({{m, c, n}, p.source});
            } else {
                part_.push_back({{m, b, n}, p.source});
                part_.push_back({{b, c, n}, p.source});
            }
        }
        return true;
    }

    /// Triangles of the flat are called by one of the flat, of the cylinder by one of that.
    void name_surfaces()
    {
        std::map<int, int> zone; // per triangle of the solid, as it was
        std::array<int, 3> first{-1, -1, -1};
        for (size_t f = 0; f < inside_.size(); ++f)
            if (inside_[f]) {
                const auto t = middle_.mesh.triangle.col(Eigen::Index(f));
                const double u = (from_[size_t(t[0])].x() + from_[size_t(t[1])].x() + from_[size_t(t[2])].x()) / 3;
                const int s = middle_.source_face[f], at = inside_[f] == 1 ? 0 : skin_->zone(u);
                zone[s] = at;
                if (first[size_t(at + 1)] < 0)
                    first[size_t(at + 1)] = s;
            }
        for (Part& p : part_) {
            const double u =
                (at_[size_t(p.corner[0])].x() + at_[size_t(p.corner[1])].x() + at_[size_t(p.corner[2])].x()) / 3;
            const int at = skin_->zone(u);
            if (zone.at(p.source) != at && first[size_t(at + 1)] >= 0)
                p.source = first[size_t(at + 1)];
        }
    }
};

/// The middle surface with a bend's triangles and vertices, in the order of the solid's.
void put_in(SkinMesh& middle, const Bend& bend)
{
    for (const auto& [v, place] : bend.moved())
        middle.mesh.position.col(v) = place;
    std::vector<int> source = middle.source_vertex;
    const auto added = bend.added();
    Eigen::Matrix3Xd position(3, middle.mesh.vertices() + Eigen::Index(added.size()));
    position.leftCols(middle.mesh.vertices()) = middle.mesh.position;
    for (size_t i = 0; i < added.size(); ++i) {
        position.col(middle.mesh.vertices() + Eigen::Index(i)) = added[i].second;
        source.push_back(added[i].first);
    }
    std::vector<int> order(source.size()), place(source.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](int v) { return source[size_t(v)]; });
    for (size_t i = 0; i < order.size(); ++i)
        place[size_t(order[i])] = int(i);
    std::vector<Part> parts = bend.parts();
    for (int f = 0; f < middle.mesh.triangles(); ++f)
        if (const auto t = middle.mesh.triangle.col(f); !bend.replaced()[size_t(f)])
            parts.push_back({{t[0], t[1], t[2]}, middle.source_face[size_t(f)]});
    std::ranges::stable_sort(parts, {}, &Part::source);
    middle.mesh.position = position(Eigen::all, order);
    middle.source_vertex.clear();
    for (const int v : order)
        middle.source_vertex.push_back(source[size_t(v)]);
    middle.mesh.triangle.resize(3, Eigen::Index(parts.size()));
    middle.source_face.clear();
    for (size_t f = 0; f < parts.size(); ++f) {
        for (size_t k = 0; k < 3; ++k)
            middle.mesh.triangle(Eigen::Index(k), Eigen::Index(f)) = place[size_t(parts[f].corner[k])];
        middle.source_face.push_back(parts[f].source);
    }
}

} // namespace

std::vector<int> holes_over_bends(SkinMesh& middle, const TriMesh& solid, const ThinSolid& sheet,
                                  const std::vector<StatedSurface>& surface)
{
    std::vector<StatedSurface> cylinders;
    for (const int f : middle.source_face)
        if (const StatedSurface& s = surface[size_t(f)];
            s.kind == Kind::cylinder &&
            std::ranges::none_of(cylinders, [&](const StatedSurface& c) { return same_cylinder(c, s); }))
            cylinders.push_back(s);
    const Eigen::Matrix3Xd normal = sheet.flipped * area_vectors(solid);
    const std::vector<EdgeUse> uses = edge_uses(solid.triangle);
    std::vector<int> walls;
    for (const StatedSurface& cylinder : cylinders) {
        Bend bend(middle, solid, sheet, normal, surface, uses);
        if (!bend.lay(cylinder))
            continue;
        put_in(middle, bend);
        middle.straightened = std::max(0, middle.straightened - bend.straight());
        walls.insert(walls.end(), bend.walls().begin(), bend.walls().end());
    }
    std::ranges::sort(walls);
    return walls;
}

} // namespace spia
