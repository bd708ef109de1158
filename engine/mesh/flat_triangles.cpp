#include "engine/mesh/flat_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace spia {
namespace {

using Eigen::Vector3d;

bool has(const Triangle& t, int v) { return t[0] == v || t[1] == v || t[2] == v; }

/// The triangles around each vertex, kept up to date while triangles change.
class Surgery {
public:
    Surgery(std::vector<Triangle>& triangles, const std::vector<Vector3d>& position)
        : triangles_(triangles), position_(position), around_(position.size())
    {
        for (size_t f = 0; f < triangles.size(); ++f)
            for (const int v : triangles[f])
                around_[size_t(v)].push_back(int(f));
        result.removed.assign(triangles.size(), 0);
    }

    FlatRepair result;

    /// So many triangles at one corner are no sheet; searching among them takes their number
    /// squared.
    bool crowded(int f)
    {
        return std::any_of(tri(f).begin(), tri(f).end(), [&](int v) { return around_[size_t(v)].size() > 200; });
    }

    /// Joins the ends of the shortest edge if they lie at one place.
    bool join_needle(int f)
    {
        const int k = extreme_side(f, false);
        const int a = tri(f)[size_t(k)], b = tri(f)[size_t(k + 1) % 3];
        const double longest = side(f, extreme_side(f, true));
        if (side(f, k) > flat_height * longest)
            return false;
        const std::vector<int> sharing = at_edge(a, b);
        if (!std::all_of(sharing.begin(), sharing.end(), [&](int g) { return is_flat(tri(g), position_); }))
            return false; // the short edge is a real one of some small triangle
        const int keep = std::min(a, b), gone = std::max(a, b);
        if (!link_allows_joining(keep, gone, sharing) || joining_folds(keep, gone, sharing))
            return false;
        for (const int g : sharing)
            remove(g);
        for (const int g : around_[size_t(gone)]) {
            std::replace(tri(g).begin(), tri(g).end(), gone, keep);
            around_[size_t(keep)].push_back(g);
        }
        around_[size_t(gone)].clear();
        result.joined += int(sharing.size());
        return true;
    }

    /// Turns the longest edge of a cap into the one that joins its tip with the opposite corner of
    /// the neighbour.
    bool flip_cap(int f)
    {
        const int k = extreme_side(f, true);
        const int a = tri(f)[size_t(k)], b = tri(f)[size_t(k + 1) % 3], c = tri(f)[size_t(k + 2) % 3];
        const std::vector<int> sharing = at_edge(a, b);
        if (sharing.size() != 2)
            return false;
        const int g = sharing[0] == f ? sharing[1] : sharing[0];
        const int d = *std::find_if(tri(g).begin(), tri(g).end(), [&](int v) { return v != a && v != b; });
        if (d == c || is_flat(tri(g), position_) || !at_edge(c, d).empty())
            return false;
        const Triangle one = {a, d, c}, two = {d, b, c};
        if (is_flat(one, position_) || is_flat(two, position_))
            return false;
        const Vector3d side_of_neighbour = area_vector(tri(g));
        if (area_vector(one).dot(side_of_neighbour) <= 0 || area_vector(two).dot(side_of_neighbour) <= 0)
            return false;
        detach(b, f);
        detach(a, g);
        around_[size_t(d)].push_back(f);
        around_[size_t(c)].push_back(g);
        tri(f) = one;
        tri(g) = two;
        ++result.flipped;
        return true;
    }

    /// Leaves out a triangle whose longest edge is a boundary edge.
    bool drop_cap(int f)
    {
        const int k = extreme_side(f, true);
        if (at_edge(tri(f)[size_t(k)], tri(f)[size_t(k + 1) % 3]).size() != 1)
            return false;
        for (const int v : tri(f))
            if (fans_without(v, f) != 1)
                return false;
        remove(f);
        ++result.dropped;
        return true;
    }

private:
    Triangle& tri(int f) { return triangles_[size_t(f)]; }

    double side(int f, int k)
    {
        return (position_[size_t(tri(f)[size_t(k + 1) % 3])] - position_[size_t(tri(f)[size_t(k)])]).norm();
    }

    int extreme_side(int f, bool longest)
    {
        int best = 0;
        for (int k = 1; k < 3; ++k)
            if (longest ? side(f, k) > side(f, best) : side(f, k) < side(f, best))
                best = k;
        return best;
    }

    Vector3d area_vector(const Triangle& t) const
    {
        const Vector3d& a = position_[size_t(t[0])];
        return (position_[size_t(t[1])] - a).cross(position_[size_t(t[2])] - a);
    }

    std::vector<int> at_edge(int a, int b)
    {
        std::vector<int> sharing;
        for (const int f : around_[size_t(a)])
            if (has(tri(f), b))
                sharing.push_back(f);
        return sharing;
    }

    std::vector<int> neighbours(int v)
    {
        std::vector<int> result_;
        for (const int f : around_[size_t(v)])
            for (const int other : tri(f))
                if (other != v)
                    result_.push_back(other);
        std::sort(result_.begin(), result_.end());
        result_.erase(std::unique(result_.begin(), result_.end()), result_.end());
        return result_;
    }

    bool on_boundary(int v)
    {
        for (const int other : neighbours(v))
            if (at_edge(v, other).size() == 1)
                return true;
        return false;
    }

    /// The link condition: a surface stays one if the two ends share no neighbours but the tips of
    /// the removed faces, and no inner edge joins two boundary vertices.
    bool link_allows_joining(int a, int b, const std::vector<int>& sharing)
    {
        if (sharing.size() == 2 && on_boundary(a) && on_boundary(b))
            return false;
        const std::vector<int> near_a = neighbours(a), near_b = neighbours(b);
        std::vector<int> common;
        std::set_intersection(near_a.begin(), near_a.end(), near_b.begin(), near_b.end(), std::back_inserter(common));
        const bool faces_left = around_[size_t(a)].size() + around_[size_t(b)].size() > 2 * sharing.size();
        return faces_left && common.size() == sharing.size();
    }

    bool joining_folds(int keep, int gone, const std::vector<int>& sharing)
    {
        for (const int g : around_[size_t(gone)]) {
            if (std::find(sharing.begin(), sharing.end(), g) != sharing.end() || is_flat(tri(g), position_))
                continue;
            Triangle moved = tri(g);
            std::replace(moved.begin(), moved.end(), gone, keep);
            if (is_flat(moved, position_) || area_vector(moved).dot(area_vector(tri(g))) <= 0)
                return true;
        }
        return false;
    }

    /// In how many fans the triangles at v hang together by edges once f is gone.
    int fans_without(int v, int f)
    {
        std::vector<int> rest = around_[size_t(v)];
        std::erase(rest, f);
        int fans = 0;
        while (!rest.empty()) {
            ++fans;
            std::vector<int> reached = {rest.back()};
            rest.pop_back();
            for (size_t i = 0; i < reached.size(); ++i)
                for (size_t j = rest.size(); j-- > 0;)
                    if (share_edge_at(v, reached[i], rest[j])) {
                        reached.push_back(rest[j]);
                        rest.erase(rest.begin() + long(j));
                    }
        }
        return fans;
    }

    bool share_edge_at(int v, int f, int g)
    {
        return std::any_of(tri(f).begin(), tri(f).end(), [&](int w) { return w != v && has(tri(g), w); });
    }

    void detach(int v, int f) { std::erase(around_[size_t(v)], f); }

    void remove(int f)
    {
        for (const int v : tri(f))
            detach(v, f);
        result.removed[size_t(f)] = 1;
    }

    std::vector<Triangle>& triangles_;
    const std::vector<Vector3d>& position_;
    std::vector<std::vector<int>> around_;
};

} // namespace

bool is_flat(const Triangle& t, const std::vector<Eigen::Vector3d>& position, double height)
{
    const Vector3d &a = position[size_t(t[0])], &b = position[size_t(t[1])], &c = position[size_t(t[2])];
    const double longest = std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    return !((b - a).cross(c - a).norm() > height * longest * longest);
}

FlatRepair repair_flat_triangles(std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& position)
{
    std::vector<int> flat;
    for (size_t f = 0; f < triangles.size(); ++f)
        if (is_flat(triangles[f], position))
            flat.push_back(int(f));
    Surgery surgery(triangles, position);
    const auto still_flat = [&](int f) {
        return !surgery.result.removed[size_t(f)] && is_flat(triangles[size_t(f)], position);
    };
    // One repair can make room for another: go round until a whole round changes nothing. Real
    // parts need a handful of rounds; the limit is for made-up chains that would give up one
    // triangle per round.
    constexpr int rounds = 100;
    bool changed = true;
    for (int round = 0; changed && round < rounds; ++round) {
        changed = false;
        for (const int f : flat)
            if (still_flat(f) && !surgery.crowded(f) &&
                (surgery.join_needle(f) || surgery.flip_cap(f) || surgery.drop_cap(f)))
                changed = true;
        std::erase_if(flat, [&](int f) { return !still_flat(f); });
    }
    surgery.result.left = flat;
    return std::move(surgery.result);
}

} // namespace spia
