#include "engine/mesh/mesh_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "engine/mesh/orient2d.h"
#include "engine/mesh/vectors.h"

namespace spia {

namespace {

using Point = Eigen::Vector2d;
using Triangle = std::array<int, 3>;

constexpr double growth = 1.25;          // of the spacing from one ring of points to the next
constexpr double flip_tolerance = 1e-10; // sine of what the angles against an edge exceed pi: keeps
                                         // flips from cycling
constexpr int most_passes = 60;

double doubled_area(const Point& a, const Point& b, const Point& c) { return cross(b - a, c - a); }

/// Doubled area over the squared longest edge: 0.87 for an equilateral triangle, 0 or less for a
/// flat or turned one.
double shape(const Point& a, const Point& b, const Point& c)
{
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return longest > 0 ? doubled_area(a, b, c) / longest : 0.0;
}

/// Cuts ears, the best shaped first, from a closed row of points.
class EarClipper {
public:
    explicit EarClipper(const Eigen::Matrix2Xd& outline) : outline_(outline)
    {
        const int n = int(outline.cols());
        for (int i = 0; i < n; ++i) {
            next_.push_back((i + 1) % n);
            previous_.push_back((i + n - 1) % n);
        }
        quality_.assign(size_t(n), 0);
    }

    /// @return n - 2 triangles, or none when the row is not a simple counter-clockwise polygon
    std::vector<Triangle> clip()
    {
        std::vector<Triangle> triangles;
        rate_all();
        for (int left = int(next_.size()); left > 3; --left) {
            int ear = best_ear();
            if (ear < 0) {
                rate_all(); // a cut may free an ear that is not next to it
                ear = best_ear();
            }
            if (ear < 0)
                return {};
            triangles.push_back({previous_[ear], ear, next_[ear]});
            const int before = previous_[ear], after = next_[ear];
            next_[before] = after;
            previous_[after] = before;
            next_[ear] = -1;
            start_ = before;
            rate(before);
            rate(after);
        }
        triangles.push_back({previous_[start_], start_, next_[start_]});
        if (doubled_area(point(previous_[start_]), point(start_), point(next_[start_])) < 0)
            return {};
        return triangles;
    }

private:
    Point point(int i) const { return outline_.col(i); }

    void rate_all()
    {
        int i = start_;
        do {
            rate(i);
            i = next_[i];
        } while (i != start_);
    }

    void rate(int i)
    {
        const Point a = point(previous_[i]), b = point(i), c = point(next_[i]);
        quality_[i] = shape(a, b, c);
        if (quality_[i] <= 0)
            return;
        for (int k = next_[next_[i]]; k != previous_[i]; k = next_[k]) {
            const Point p = point(k);
            const bool covered = doubled_area(a, b, p) >= 0 && doubled_area(b, c, p) >= 0 && doubled_area(c, a, p) >= 0;
            if (covered && p != a && p != b && p != c) {
                quality_[i] = 0;
                return;
            }
        }
    }

    int best_ear() const
    {
        int best = -1;
        int i = start_;
        do {
            if (quality_[i] > (best < 0 ? 0 : quality_[best]))
                best = i;
            i = next_[i];
        } while (i != start_);
        return best;
    }

    const Eigen::Matrix2Xd& outline_;
    std::vector<int> next_, previous_;
    std::vector<double> quality_; // shape of the ear, 0 if it is none
    int start_ = 0;
};

/// Triangles that know their neighbours: edge k of a triangle runs from corner k to corner k + 1.
class Patch {
public:
    /// @param spacing  wanted around each point
    Patch(const Eigen::Matrix2Xd& point, std::vector<double> spacing, std::vector<Triangle> triangles)
        : spacing_(std::move(spacing)), triangle_(std::move(triangles))
    {
        for (const auto& p : point.colwise())
            point_.emplace_back(p);
        std::map<std::pair<int, int>, int> face_of_edge;
        for (int t = 0; t < int(triangle_.size()); ++t)
            for (int k = 0; k < 3; ++k)
                face_of_edge[{triangle_[t][k], triangle_[t][(k + 1) % 3]}] = t;
        for (const Triangle& t : triangle_) {
            neighbour_.emplace_back();
            for (int k = 0; k < 3; ++k) {
                const auto other = face_of_edge.find({t[(k + 1) % 3], t[k]});
                neighbour_.back()[k] = other == face_of_edge.end() ? -1 : other->second;
            }
        }
    }

    /// Flips edges until every one is locally Delaunay. A flat triangle disappears on the way.
    void make_delaunay()
    {
        std::vector<int> open;
        for (int t = int(triangle_.size()) - 1; t >= 0; --t)
            open.push_back(t);
        // Each flip lowers the paraboloid lifted over the points, so the loop ends; the bound is
        // against rounding.
        for (size_t left = 100 * triangle_.size() + 1000; !open.empty() && left > 0; --left) {
            const int t = open.back();
            open.pop_back();
            for (int k = 0; k < 3; ++k) {
                const int u = neighbour_[t][k];
                if (u >= 0 && wants_flip(t, k)) {
                    flip(t, k);
                    open.push_back(t);
                    open.push_back(u);
                    break;
                }
            }
        }
    }

    /// Puts a point into every triangle that is large against the spacing at its corners. @return
    /// whether there was one
    bool refine()
    {
        const int count = int(triangle_.size());
        for (int t = 0; t < count; ++t) {
            const auto [a, b, c] = triangle_[t];
            const Point centre = (point_[a] + point_[b] + point_[c]) / 3;
            const double spacing = growth * (spacing_[a] + spacing_[b] + spacing_[c]) / 3;
            bool large = shape(point_[a], point_[b], point_[c]) > flip_tolerance;
            for (const int v : {a, b, c})
                large = large && std::sqrt(2.0) * (centre - point_[v]).norm() > std::max(spacing, spacing_[v]);
            if (large)
                split(t, centre, spacing);
        }
        return int(triangle_.size()) > count;
    }

    bool all_positive() const
    {
        return std::all_of(triangle_.begin(), triangle_.end(), [&](const Triangle& t) {
            return doubled_area(point_[t[0]], point_[t[1]], point_[t[2]]) > 0;
        });
    }

    PlanarMesh mesh() const
    {
        PlanarMesh result{Eigen::Matrix2Xd(2, point_.size()), Eigen::Matrix3Xi(3, triangle_.size())};
        for (size_t i = 0; i < point_.size(); ++i)
            result.position.col(Eigen::Index(i)) = point_[i];
        for (size_t t = 0; t < triangle_.size(); ++t)
            result.triangle.col(Eigen::Index(t)) << triangle_[t][0], triangle_[t][1], triangle_[t][2];
        return result;
    }

private:
    int edge_to(int t, int u) const
    {
        return int(std::find(neighbour_[t].begin(), neighbour_[t].end(), u) - neighbour_[t].begin());
    }

    void replace_neighbour(int t, int old_one, int new_one)
    {
        if (t >= 0)
            neighbour_[t][edge_to(t, old_one)] = new_one;
    }

    bool wants_flip(int t, int k) const
    {
        const int u = neighbour_[t][k];
        const Point a = point_[triangle_[t][k]], b = point_[triangle_[t][(k + 1) % 3]];
        const Point c = point_[triangle_[t][(k + 2) % 3]], d = point_[triangle_[u][(edge_to(u, t) + 2) % 3]];
        const double sine = cross(a - c, b - c) * (b - d).dot(a - d) + cross(b - d, a - d) * (a - c).dot(b - c);
        const double scale = (a - c).norm() * (b - c).norm() * (a - d).norm() * (b - d).norm();
        return sine < -flip_tolerance * scale && doubled_area(a, d, c) > 0 && doubled_area(d, b, c) > 0;
    }

    void flip(int t, int k)
    {
        const int u = neighbour_[t][k], l = edge_to(u, t);
        const int a = triangle_[t][k], b = triangle_[t][(k + 1) % 3];
        const int c = triangle_[t][(k + 2) % 3], d = triangle_[u][(l + 2) % 3];
        const int bc = neighbour_[t][(k + 1) % 3], ca = neighbour_[t][(k + 2) % 3];
        const int ad = neighbour_[u][(l + 1) % 3], db = neighbour_[u][(l + 2) % 3];
        triangle_[t] = {a, d, c};
        neighbour_[t] = {ad, u, ca};
        triangle_[u] = {d, b, c};
        neighbour_[u] = {db, bc, t};
        replace_neighbour(ad, u, t);
        replace_neighbour(bc, t, u);
    }

    void split(int t, const Point& centre, double spacing)
    {
        const int m = int(point_.size()), second = int(triangle_.size()), third = second + 1;
        point_.push_back(centre);
        spacing_.push_back(spacing);
        const auto [a, b, c] = triangle_[t];
        const auto [ab, bc, ca] = neighbour_[t];
        triangle_[t] = {a, b, m};
        neighbour_[t] = {ab, second, third};
        triangle_.push_back({b, c, m});
        neighbour_.push_back({bc, third, t});
        triangle_.push_back({c, a, m});
        neighbour_.push_back({ca, t, second});
        replace_neighbour(bc, t, second);
        replace_neighbour(ca, t, third);
    }

    std::vector<Point> point_;
    std::vector<double> spacing_;
    std::vector<Triangle> triangle_;
    std::vector<std::array<int, 3>> neighbour_; // -1 beyond the outline
};

/// Whether two segments have a place in common that is none of their ends.
bool cross_each_other(const Point& a, const Point& b, const Point& c, const Point& d)
{
    if (a == c || a == d || b == c || b == d)
        return false;
    const int at_c = orient2d(a, b, c), at_d = orient2d(a, b, d), at_a = orient2d(c, d, a), at_b = orient2d(c, d, b);
    return at_c * at_d <= 0 && at_a * at_b <= 0 && (at_c != 0 || at_d != 0);
}

/// A polygon with holes as one row of its points, which goes along lines to the holes and back.
class JoinedRings {
public:
    explicit JoinedRings(const std::vector<Eigen::Matrix2Xd>& rings)
    {
        for (const Eigen::Matrix2Xd& ring : rings) {
            ring_.emplace_back();
            for (const auto& p : ring.colwise()) {
                ring_.back().push_back(int(point_.size()));
                point_.emplace_back(p);
            }
        }
    }
    const std::vector<Point>& points() const { return point_; }

    /// Numbers of the points; empty if a hole cannot be joined.
    std::vector<int> row() const
    {
        std::vector<int> row = ring_.front();
        std::vector<char> joined(ring_.size(), 0);
        joined[0] = 1;
        for (size_t left = ring_.size() - 1; left > 0; --left) {
            double best = std::numeric_limits<double>::infinity();
            size_t at = 0, hole = 0, start = 0;
            for (size_t h = 1; h < ring_.size(); ++h)
                for (size_t k = 0; !joined[h] && k < ring_[h].size(); ++k)
                    for (size_t i = 0; i < row.size(); ++i) {
                        const double length = (point(row[i]) - point(ring_[h][k])).norm();
                        if (length < best && leads_inside(row, i, ring_[h][k]) &&
                            free(row, joined, row[i], ring_[h][k])) {
                            best = length;
                            at = i;
                            hole = h;
                            start = k;
                        }
                    }
            if (hole == 0)
                return {};
            joined[hole] = 1;
            std::vector<int> along;
            for (size_t k = 0; k <= ring_[hole].size(); ++k)
                along.push_back(ring_[hole][(start + k) % ring_[hole].size()]);
            along.push_back(row[at]);
            row.insert(row.begin() + std::ptrdiff_t(at) + 1, along.begin(), along.end());
        }
        return row;
    }

private:
    std::vector<Point> point_;
    std::vector<std::vector<int>> ring_;

    const Point& point(int i) const { return point_[size_t(i)]; }

    /// From a corner of the row into the sheet.
    bool leads_inside(const std::vector<int>& row, size_t i, int to) const
    {
        const Point &before = point(row[(i + row.size() - 1) % row.size()]), &at = point(row[i]),
                    &after = point(row[(i + 1) % row.size()]), &goal = point(to);
        const bool left = orient2d(at, after, goal) > 0, right = orient2d(before, at, goal) > 0;
        return orient2d(before, at, after) > 0 ? left && right : left || right;
    }

    bool free(const std::vector<int>& row, const std::vector<char>& joined, int from, int to) const
    {
        const auto met = [&](const std::vector<int>& ring) {
            for (size_t i = 0; i < ring.size(); ++i)
                if (cross_each_other(point(from), point(to), point(ring[i]), point(ring[(i + 1) % ring.size()])))
                    return true;
            return false;
        };
        if (met(row))
            return false;
        for (size_t h = 1; h < ring_.size(); ++h)
            if (!joined[h] && met(ring_[h]))
                return false;
        return true;
    }
};

} // namespace

PlanarMesh triangulate_polygon(const std::vector<Eigen::Matrix2Xd>& rings)
{
    const JoinedRings joined(rings);
    const std::vector<Point>& points = joined.points();
    PlanarMesh none{Eigen::Matrix2Xd(2, points.size()), Eigen::Matrix3Xi(3, 0)};
    for (size_t i = 0; i < points.size(); ++i)
        none.position.col(Eigen::Index(i)) = points[i];
    const std::vector<int> row = joined.row();
    if (row.size() < 3)
        return none;
    const Eigen::Matrix2Xd outline = none.position(Eigen::all, row);
    std::vector<Triangle> ears = EarClipper(outline).clip();
    if (ears.empty())
        return none;
    for (Triangle& ear : ears)
        for (int& corner : ear)
            corner = row[size_t(corner)];
    Patch patch(none.position, std::vector<double>(points.size(), 0), std::move(ears));
    patch.make_delaunay();
    return patch.all_positive() ? patch.mesh() : none;
}

PlanarMesh mesh_polygon(const Eigen::Matrix2Xd& outline)
{
    std::vector<Triangle> ears = EarClipper(outline).clip();
    if (ears.empty())
        return {outline, Eigen::Matrix3Xi(3, 0)};
    const Eigen::Index n = outline.cols();
    std::vector<double> spacing;
    for (Eigen::Index i = 0; i < n; ++i) {
        const double before = (outline.col(i) - outline.col((i + n - 1) % n)).norm();
        const double after = (outline.col((i + 1) % n) - outline.col(i)).norm();
        spacing.push_back((before + after) / 2);
    }
    Patch patch(outline, std::move(spacing), std::move(ears));
    patch.make_delaunay();
    if (!patch.all_positive())
        return {outline, Eigen::Matrix3Xi(3, 0)};
    for (int pass = 0; pass < most_passes && patch.refine(); ++pass)
        patch.make_delaunay();
    return patch.mesh();
}

} // namespace spia
