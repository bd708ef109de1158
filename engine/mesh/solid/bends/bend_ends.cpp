#include "engine/mesh/solid/bends/bend_ends.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace spia {
namespace {

/// Cuts triangles along a line across the plane.
class Cut {
public:
    /// @param on  mm, vertices as near as that to the line are on it
    Cut(const PlaneTriangles& before, double u, double on) : before_(before), u_(u), on_(on), after_(before)
    {
        after_.triangle.clear();
    }

    /// @returns nothing where a fixed edge would have to be cut
    std::optional<PlaneTriangles> result(const std::set<EdgeKey>& fixed)
    {
        for (const PlaneTriangle& t : before_.triangle)
            if (!cut(t, fixed))
                return std::nullopt;
        return std::move(after_);
    }

private:
    const PlaneTriangles& before_;
    double u_, on_;
    PlaneTriangles after_;
    std::map<EdgeKey, int> at_; ///< the new vertex of an edge

    int side(int v) const
    {
        const double beyond = before_.at[size_t(v)].x() - u_;
        return std::abs(beyond) <= on_ ? 0 : beyond < 0 ? -1 : 1;
    }
    int between(int i, int j)
    {
        const auto [found, fresh] = at_.try_emplace(edge_key(i, j), int(after_.at.size()));
        if (fresh) {
            const Eigen::Vector2d x = before_.at[size_t(i)], y = before_.at[size_t(j)];
            const double share = (u_ - x.x()) / (y.x() - x.x());
            after_.add({u_, x.y() + share * (y.y() - x.y())}, i);
        }
        return found->second;
    }
    bool cut(const PlaneTriangle& t, const std::set<EdgeKey>& fixed)
    {
        size_t k = 0; // the corner that is alone on its side, or on the line between the others
        const std::array<int, 3> s{side(t.corner[0]), side(t.corner[1]), side(t.corner[2])};
        while (k < 3 && !(s[(k + 1) % 3] * s[(k + 2) % 3] < 0 && s[k] == 0) &&
               !(s[k] * s[(k + 1) % 3] < 0 && s[k] * s[(k + 2) % 3] < 0))
            ++k;
        if (k == 3) {
            after_.triangle.push_back(t);
            return true;
        }
        const int a = t.corner[k], b = t.corner[(k + 1) % 3], c = t.corner[(k + 2) % 3];
        if (s[k] == 0 ? fixed.contains(edge_key(b, c))
                      : fixed.contains(edge_key(a, b)) || fixed.contains(edge_key(a, c)))
            return false;
        if (s[k] == 0) {
            const int m = between(b, c);
            after_.triangle.push_back({{a, b, m}, t.source});
            after_.triangle.push_back({{a, m, c}, t.source});
        } else
            cut_off(a, b, c, t.source);
        return true;
    }
    /// Corner a from the others.
    void cut_off(int a, int b, int c, int source)
    {
        const int m = between(a, b), n = between(a, c);
        const auto apart = [&](int i, int j) { return (after_.at[size_t(i)] - after_.at[size_t(j)]).norm(); };
        after_.triangle.push_back({{a, m, n}, source});
        if (apart(m, c) < apart(b, n)) {
            after_.triangle.push_back({{m, b, c}, source});
            after_.triangle.push_back({{m, c, n}, source});
        } else {
            after_.triangle.push_back({{m, b, n}, source});
            after_.triangle.push_back({{b, c, n}, source});
        }
    }
};

/// Whether a triangle across the line is a chord of too much of the bend.
bool too_wide(const UnrolledBend& bend, const PlaneTriangles& triangles, double u)
{
    constexpr double widest = 20 * std::numbers::pi / 180;
    return std::ranges::any_of(triangles.triangle, [&](const PlaneTriangle& t) {
        double low = 1e300, high = -1e300;
        for (const int v : t.corner) {
            low = std::min(low, triangles.at[size_t(v)].x());
            high = std::max(high, triangles.at[size_t(v)].x());
        }
        return low < u && u < high && bend.skin.turn(low, high) > widest;
    });
}

/// Triangles of the flat are called by one of the flat, of the cylinder by one of that.
void name_surfaces(const MiddleOfSolid& part, const UnrolledBend& bend, PlaneTriangles& triangles)
{
    const auto middle_u = [](const PlaneTriangles& of, const auto& t) {
        return (of.at[size_t(t[0])].x() + of.at[size_t(t[1])].x() + of.at[size_t(t[2])].x()) / 3;
    };
    std::map<int, int> zone; // per triangle of the solid, as it was
    std::array<int, 3> first{-1, -1, -1};
    for (size_t f = 0; f < bend.on.size(); ++f)
        if (bend.on[f]) {
            const double u = middle_u(bend.triangles, part.middle.mesh.triangle.col(Eigen::Index(f)));
            const int s = part.middle.source_face[f], at = bend.on[f] == 1 ? 0 : bend.skin.zone(u);
            zone[s] = at;
            if (first[size_t(at + 1)] < 0)
                first[size_t(at + 1)] = s;
        }
    for (PlaneTriangle& t : triangles.triangle) {
        const int at = bend.skin.zone(middle_u(triangles, t.corner));
        if (zone.at(t.source) != at && first[size_t(at + 1)] >= 0)
            t.source = first[size_t(at + 1)];
    }
}

} // namespace

std::optional<PlaneTriangles> cut_at_bend_ends(const MiddleOfSolid& part, const UnrolledBend& bend,
                                               PlaneTriangles triangles)
{
    std::vector<double> ends = bend.skin.seams();
    if (ends.size() != 2)
        return std::nullopt;
    std::ranges::sort(ends);
    const double on = 0.3 * part.within; // else the digits of STL make slivers along the ends
    const auto cut_at = [&](double u) {
        auto cut = Cut(triangles, u, on).result(bend.fixed);
        if (cut)
            triangles = std::move(*cut);
        return cut.has_value();
    };
    for (const double u : ends)
        if (!cut_at(u))
            return std::nullopt;
    constexpr double apart = 15 * std::numbers::pi / 180;
    const int strips = int(std::ceil((ends[1] - ends[0]) / bend.cylinder.radius / apart));
    for (int i = 1; i < strips; ++i)
        if (const double u = ends[0] + (ends[1] - ends[0]) * i / strips; too_wide(bend, triangles, u) && !cut_at(u))
            return std::nullopt;
    name_surfaces(part, bend, triangles);
    return triangles;
}

} // namespace spia
