#include "engine/mesh/solid/flip_folds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using TwoTriangles = std::array<std::array<int, 3>, 2>;

/// Triangles as the surface shows them that they are chords of.
class Seen {
public:
    Seen(const TriMesh& outer, const SkinMesh& middle, const ThinSolidOptions& options)
        : outer_(outer), middle_(middle), options_(options), normal_(area_vectors(outer))
    {
    }
    bool turned_over(int f) const
    {
        const auto t = outer_.triangle.col(f);
        return !(area(f, f, middle_.mesh.position, {t[0], t[1], t[2]}) > 0);
    }
    const StatedSurface* cylinder(int f) const
    {
        if (options_.surface.empty())
            return nullptr;
        const StatedSurface& s = options_.surface[size_t(middle_.source_face[size_t(f)])];
        return s.kind == StatedSurface::Kind::cylinder ? &s : nullptr;
    }
    /// mm2, of a triangle in the place of two of one surface, or of one; below 0 where it looks the
    /// other way than they do on the outer skin. On a cylinder it is seen unrolled: chords have all
    /// the normals of a bend, and do not tell whether one near its rim turns over.
    double area(int f, int g, const Eigen::Matrix3Xd& position, const std::array<int, 3>& t) const
    {
        Eigen::Matrix3d corner;
        for (int k = 0; k < 3; ++k)
            corner.col(k) = position.col(t[size_t(k)]);
        if (const StatedSurface* on = cylinder(f); on && cylinder(g)) {
            const Eigen::Vector3d middle = corner.rowwise().mean();
            const double bulging = normal_at(*on, middle, normal_.col(f)).dot(middle - on->point) > 0 ? 1 : -1;
            return bulging * unrolled_area(*on, corner);
        }
        const Eigen::Vector3d along = (normal_.col(f) + normal_.col(g)).normalized();
        return (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0)).dot(along) / 2;
    }
    auto normal(int f) const { return normal_.col(f); }

private:
    const TriMesh& outer_;
    const SkinMesh& middle_;
    const ThinSolidOptions& options_;
    Eigen::Matrix3Xd normal_;
};

/// Two triangles at an edge, which takes the other diagonal of both.
struct Flip {
    int one = -1, other = -1;
    TwoTriangles after{};
    double gain = 0; ///< mm2, of the least upright triangle of the middle surface
};

/// The edges of a mesh at one time, for flips.
class FlipSearch {
public:
    FlipSearch(const TriMesh& outer, const SkinMesh& middle, const ThinSolidOptions& options)
        : outer_(outer), middle_(middle), options_(options), seen_(outer, middle, options),
          uses_(edge_uses(outer.triangle)), use_of_(3 * size_t(outer.triangles()))
    {
        for (size_t u = 0; u < uses_.size(); ++u)
            use_of_[3 * size_t(uses_[u].face) + size_t(uses_[u].corner)] = u;
    }
    /// The best one of a triangle: within its CAD face, sound on the outer skin and better on the
    /// middle surface.
    Flip best(int f) const
    {
        Flip best;
        for (int k = 0; k < 3; ++k)
            if (const Flip flip = at(f, k); flip.gain > best.gain)
                best = flip;
        return best;
    }

private:
    const TriMesh& outer_;
    const SkinMesh& middle_;
    const ThinSolidOptions& options_;
    Seen seen_;
    std::vector<EdgeUse> uses_;
    std::vector<size_t> use_of_;

    std::optional<EdgeUse> across(int f, int k) const
    {
        const size_t u = use_of_[3 * size_t(f) + size_t(k)];
        for (const size_t other : {u - 1, u + 1}) // u - 1 of 0 is too large
            if (other < uses_.size() && uses_[other].same_edge(uses_[u]))
                return uses_[other];
        return std::nullopt;
    }
    bool is_edge(int a, int b) const
    {
        const std::pair wanted(std::min(a, b), std::max(a, b));
        const auto found = std::lower_bound(uses_.begin(), uses_.end(), wanted, [](const EdgeUse& use, const auto& w) {
            return std::pair(use.low, use.high) < w;
        });
        return found != uses_.end() && std::pair(found->low, found->high) == wanted;
    }
    bool one_surface(int f, int g) const
    {
        constexpr double alike = 0.985; // 10 degrees
        const StatedSurface *a = seen_.cylinder(f), *b = seen_.cylinder(g);
        if (a && b)
            return same_cylinder(*a, *b);
        if (options_.unit.empty())
            return !a && !b && seen_.normal(f).normalized().dot(seen_.normal(g).normalized()) > alike;
        return options_.unit[size_t(middle_.source_face[size_t(f)])] ==
               options_.unit[size_t(middle_.source_face[size_t(g)])];
    }
    double least(int f, int g, const Eigen::Matrix3Xd& position, const TwoTriangles& triangles) const
    {
        return std::min(seen_.area(f, g, position, triangles[0]), seen_.area(f, g, position, triangles[1]));
    }
    Flip at(int f, int k) const
    {
        const std::optional<EdgeUse> use = across(f, k);
        if (!use || !one_surface(f, use->face))
            return {};
        const auto corner = [&](int face, int i) { return outer_.triangle(i % 3, face); };
        const int a = corner(f, k), b = corner(f, k + 1), c = corner(f, k + 2), d = corner(use->face, use->corner + 2);
        if (c == d || is_edge(c, d))
            return {};
        const Flip flip{f, use->face, {{{a, d, c}, {d, b, c}}}, 0};
        constexpr double speck = 1e-6; // of both triangles' area
        const double size = seen_.normal(f).norm() + seen_.normal(use->face).norm();
        if (least(f, use->face, outer_.position, flip.after) < speck * size)
            return {};
        Flip result = flip;
        result.gain = least(f, use->face, middle_.mesh.position, flip.after) -
                      least(f, use->face, middle_.mesh.position, {{{a, b, c}, {b, a, d}}});
        return result;
    }
};

} // namespace

std::vector<int> turned_over(const TriMesh& outer, const SkinMesh& middle, const ThinSolidOptions& options)
{
    const Seen seen(outer, middle, options);
    std::vector<int> turned;
    for (int f = 0; f < outer.triangles(); ++f)
        if (seen.turned_over(f))
            turned.push_back(f);
    return turned;
}

void flip_folds(TriMesh& outer, SkinMesh& middle, const ThinSolidOptions& options)
{
    constexpr int rounds = 30; // a fan of needles at one vertex takes one for each
    for (int round = 0; round < rounds; ++round) {
        const std::vector<int> turned = turned_over(outer, middle, options);
        if (turned.empty())
            return;
        const FlipSearch search(outer, middle, options);
        std::vector<char> done(size_t(outer.vertices()), 0); // around them edges are no longer
                                                             // those of the search
        bool any = false;
        for (const int f : turned) {
            const Flip flip = search.best(f);
            if (flip.one < 0 || std::ranges::any_of(flip.after, [&](const auto& t) {
                    return std::ranges::any_of(t, [&](int v) { return done[size_t(v)] != 0; });
                }))
                continue;
            for (const auto& [face, t] : {std::pair(flip.one, flip.after[0]), {flip.other, flip.after[1]}})
                for (size_t k = 0; k < 3; ++k) {
                    outer.triangle(Eigen::Index(k), face) = middle.mesh.triangle(Eigen::Index(k), face) = t[k];
                    done[size_t(t[k])] = 1;
                }
            any = true;
        }
        if (!any)
            return;
    }
}

} // namespace spia
