#include "engine/mesh/counterbores.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/round_edge.h"

namespace spia {
namespace {

class Floors {
public:
    Floors(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const SurfacePieces& pieces,
           const std::vector<PieceSide>& side, double thickness)
        : solid_(solid), normal_(normal), pieces_(pieces), side_(side), same_(1e-3 * thickness),
          neighbour_(face_neighbours(solid.triangles(), edge_uses(solid.triangle))), together_(size_t(pieces.count())),
          level_(size_t(pieces.count())), size_(size_t(pieces.count()), 0)
    {
        for (const PieceContact& c : pieces.contact)
            if (side[size_t(c.a)] == side[size_t(c.b)]) {
                together_.join(c.a, c.b);
                if (c.smooth == c.length())
                    level_.join(c.a, c.b);
            }
        for (int p = 0; p < pieces.count(); ++p)
            size_[size_t(together_.root(p))] += pieces.area[size_t(p)];
        for (int p = 0; p < pieces.count(); ++p)
            if (int& best = skin(side_[size_t(p)]); together_.root(p) == p && side_[size_t(p)] != PieceSide::rim &&
                                                    (best < 0 || size_[size_t(p)] > size_[size_t(best)]))
                best = p;
    }

    /// With their walls, which may have been taken for skin.
    std::vector<char> found(double least)
    {
        std::vector<double> size(size_t(pieces_.count()), 0);
        for (int p = 0; p < pieces_.count(); ++p)
            size[size_t(level_.root(p))] += pieces_.area[size_t(p)];
        std::vector<char> result(size_t(pieces_.count()), 0);
        for (int p = 0; p < pieces_.count(); ++p)
            if (level_.root(p) == p && side_[size_t(p)] != PieceSide::rim && size[size_t(p)] > least &&
                is_floor(p, size[size_t(p)])) {
                for (int q = p; q < pieces_.count(); ++q)
                    result[size_t(q)] |= level_.root(q) == p;
                for (const int f : walls_)
                    result[size_t(pieces_.piece[size_t(f)])] = 1;
            }
        return result;
    }

private:
    /// From one triangle to that beyond its edge from corner k on.
    struct Border {
        int face, k, beyond;
    };

    const TriMesh& solid_;
    const Eigen::Matrix3Xd& normal_;
    const SurfacePieces& pieces_;
    const std::vector<PieceSide>& side_;
    double
        same_; ///< mm, how far what is round may be off: single precision of STL is 1e-3 of usual thicknesses at most
    Eigen::Matrix3Xi neighbour_;
    DisjointSets together_;     ///< pieces of one side that hang together
    DisjointSets level_;        ///< those of them that go on from each other smoothly
    std::vector<int> walls_;    ///< triangles of the floor that is looked at
    std::vector<double> size_;  ///< of those, mm2
    int one_ = -1, other_ = -1; ///< the largest of each side: its skin

    int& skin(PieceSide side) { return side == PieceSide::one ? one_ : other_; }
    int level(int f) { return level_.root(pieces_.piece[size_t(f)]); }
    int group(int f) { return together_.root(pieces_.piece[size_t(f)]); }
    PieceSide side(int f) const { return side_[size_t(pieces_.piece[size_t(f)])]; }
    Eigen::Vector3d end(const Border& at, int i) const
    {
        return solid_.position.col(solid_.triangle((at.k + i) % 3, at.face));
    }

    bool is_floor(int root, double size)
    {
        constexpr double plane = 1 - 1e-6; // 0.1 degrees
        Eigen::Vector3d up = Eigen::Vector3d::Zero();
        std::vector<Border> border;
        for (int f = 0; f < solid_.triangles(); ++f) {
            if (level(f) != root)
                continue;
            up += normal_.col(f);
            for (int k = 0; k < 3; ++k)
                if (const int g = neighbour_(k, f); g < 0)
                    return false;
                else if (level(g) != root)
                    border.push_back({f, k, g});
        }
        if (up.norm() < plane * size)
            return false;
        walls_.clear();
        const std::vector<std::vector<Border>> loops = loops_of(border);
        if (loops.size() != 2)
            return false;
        const auto a = circle(loops[0], up), b = circle(loops[1], up);
        if (!a || !b || a->off_axis(b->centre).norm() > same_ || std::abs(a->height(b->centre)) > same_)
            return false;
        const bool first = a->radius > b->radius;
        return goes_up_to_the_skin(root, first ? loops[0] : loops[1], first ? *a : *b) &&
               goes_through(root, first ? loops[1] : loops[0], first ? *b : *a);
    }

    /// Edges that hang together at their ends.
    std::vector<std::vector<Border>> loops_of(const std::vector<Border>& border) const
    {
        DisjointSets together(size_t(solid_.vertices()));
        for (const Border& at : border)
            together.join(solid_.triangle(at.k, at.face), solid_.triangle((at.k + 1) % 3, at.face));
        std::map<int, std::vector<Border>> loops;
        for (const Border& at : border)
            loops[together.root(solid_.triangle(at.k, at.face))].push_back(at);
        std::vector<std::vector<Border>> result;
        for (auto& [root, loop] : loops)
            result.push_back(std::move(loop));
        return result;
    }

    std::optional<RoundEdge> circle(const std::vector<Border>& loop, const Eigen::Vector3d& axis) const
    {
        Eigen::Matrix3Xd places(3, Eigen::Index(loop.size())); // each corner begins one edge
        for (size_t i = 0; i < loop.size(); ++i)
            places.col(Eigen::Index(i)) = end(loop[i], 0);
        return round_edge(places, axis, same_);
    }

    /// The triangles beyond a loop of a floor on the cylinder through its circle, seen from the axis; none if one right beyond it is not,
    /// or is on the wrong side of the floor. @param way  1: above the floor; -1: below it
    std::vector<int> wall(int root, const std::vector<Border>& loop, const RoundEdge& circle, double way)
    {
        constexpr double square = 0.1; // 6 degrees: a chord of a cylinder is square to the floor but for rounding
        const auto on_it = [&](int f) {
            const Eigen::Vector3d n = normal_.col(f);
            Eigen::Vector3d out = Eigen::Vector3d::Zero();
            double above = 0;
            for (const int v : solid_.triangle.col(f)) {
                const Eigen::Vector3d off = circle.off_axis(solid_.position.col(v));
                if (std::abs(off.norm() - circle.radius) > same_)
                    return false;
                above += way * circle.height(solid_.position.col(v));
                out += off;
            }
            return above > same_ && std::abs(n.dot(circle.axis)) <= square * n.norm() && n.dot(out) <= 0;
        };
        std::vector<int> faces;
        std::vector<char> seen(size_t(solid_.triangles()), 0);
        for (const Border& at : loop) {
            if (!on_it(at.beyond))
                return {};
            if (!std::exchange(seen[size_t(at.beyond)], char(1)))
                faces.push_back(at.beyond);
        }
        for (size_t i = 0; i < faces.size(); ++i)
            for (int k = 0; k < 3; ++k)
                if (const int g = neighbour_(k, faces[i]); g >= 0 && !seen[size_t(g)] && level(g) != root && on_it(g)) {
                    seen[size_t(g)] = 1;
                    faces.push_back(g);
                }
        walls_.insert(walls_.end(), faces.begin(), faces.end());
        return faces;
    }

    /// Whether the wall ends all around at one height.
    bool goes_up_to_the_skin(int root, const std::vector<Border>& loop, const RoundEdge& circle)
    {
        std::vector<int> faces = wall(root, loop, circle, 1);
        std::sort(faces.begin(), faces.end());
        std::optional<double> height;
        for (const int f : faces)
            for (int k = 0; k < 3; ++k) {
                const int g = neighbour_(k, f);
                if (g >= 0 && (level(g) == root || std::binary_search(faces.begin(), faces.end(), g)))
                    continue;
                for (const int i : {0, 1}) {
                    const double here = circle.height(end({f, k, g}, i));
                    if (std::abs(here - height.value_or(here)) > same_)
                        return false;
                    height = here;
                }
            }
        return height.has_value();
    }

    /// Whether the other skin can be reached from the wall but over the floor and its skin.
    bool goes_through(int root, const std::vector<Border>& loop, const RoundEdge& circle)
    {
        const int own = skin(side(loop.front().face)), opposite = own == one_ ? other_ : one_;
        std::vector<int> faces = wall(root, loop, circle, -1);
        std::vector<char> seen(size_t(solid_.triangles()), 0);
        for (const int f : faces)
            seen[size_t(f)] = 1;
        for (size_t i = 0; i < faces.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const int g = neighbour_(k, faces[i]);
                if (g < 0 || level(g) == root || group(g) == own || seen[size_t(g)])
                    continue;
                if (group(g) == opposite)
                    return true;
                seen[size_t(g)] = 1;
                faces.push_back(g);
            }
        return false;
    }
};

} // namespace

std::vector<char> counterbore_floors(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const SurfacePieces& pieces,
                                     const std::vector<PieceSide>& side, double thickness, double least)
{
    return Floors(solid, normal, pieces, side, thickness).found(least);
}

} // namespace spia
