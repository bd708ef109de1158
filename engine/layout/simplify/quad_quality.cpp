#include "engine/layout/simplify/quad_quality.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/layout/plane_lines.h"
#include "engine/mesh/orient2d.h"

namespace spia {

namespace {

constexpr size_t most_grid_lines = 48; // of a grid along a side

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Least sine of the four corners.
double straight_quality(const std::array<Eigen::Vector2d, 4>& corner)
{
    std::array<Eigen::Vector2d, 4> edge;
    std::array<double, 4> norm;
    for (size_t k = 0; k < 4; ++k) {
        edge[k] = corner[(k + 1) % 4] - corner[k];
        norm[k] = edge[k].norm();
    }
    double least = 1;
    for (size_t k = 0; k < 4; ++k) {
        const size_t before = (k + 3) % 4;
        const double lengths = norm[before] * norm[k];
        least = std::min(least, lengths > 0 ? cross(edge[before], edge[k]) / lengths : -1);
    }
    return least;
}

/// Shares of two opposite sides, in the direction of the first: even ones, one next to each corner
/// for the angle there, and the kinks of both as far as there is room.
struct Shares {
    std::array<double, most_grid_lines> t;
    size_t count = 0;
};

void add_kinks(const QuadSide& side, bool backwards, Shares& shares)
{
    if (!side.arc || side.arc->kink.empty())
        return;
    const auto& kink = side.arc->kink;
    const double low = std::min(side.from, side.to), high = std::max(side.from, side.to), whole = side.arc->whole();
    const auto add_between = [&](double from, double to, double around) {
        const auto begin = std::upper_bound(kink.begin(), kink.end(), from - around),
                   end = std::lower_bound(kink.begin(), kink.end(), to - around);
        const long most = long(most_grid_lines / 3), step = std::max(1L, (end - begin + most - 1) / most);
        for (auto it = begin; it < end && shares.count < most_grid_lines; it += std::min<long>(step, end - it)) {
            const double t = (*it + around - side.from) / (side.to - side.from);
            shares.t[shares.count++] = backwards ? 1 - t : t;
        }
    };
    add_between(low, high, 0);
    if (high > whole) // of a closed arc, once more around
        add_between(low, high, whole);
}

Shares shares_of(const QuadSide& side, const QuadSide& opposite, int cells)
{
    constexpr double next = 1.0 / 96; // to a corner, so that an arc hardly turns up to there
    Shares result;
    if (!side.arc && !opposite.arc) { // ruled along both: cells as long as these are seen at their
                                      // ends
        result.t[result.count++] = 0;
        result.t[result.count++] = 1;
        return result;
    }
    for (int i = 0; i <= cells; ++i)
        result.t[result.count++] = double(i) / cells;
    result.t[result.count++] = next;
    result.t[result.count++] = 1 - next;
    add_kinks(side, false, result);
    add_kinks(opposite, true, result);
    const auto begin = result.t.begin(), end = begin + long(result.count);
    std::sort(begin, end);
    constexpr double same = 1e-3;
    result.count = size_t(std::unique(begin, end, [](double a, double b) { return b - a < same; }) - begin);
    result.t[result.count - 1] = 1;
    return result;
}

using Row = std::array<Eigen::Vector2d, most_grid_lines>;

void sample(const Quad& quad, size_t k, const Shares& shares, bool backwards, Row& row)
{
    const QuadSide& side = quad.side[k];
    const Eigen::Vector2d a = quad.corner[k], b = quad.corner[(k + 1) % 4];
    for (size_t i = 0; i < shares.count; ++i) {
        const double t = backwards ? 1 - shares.t[i] : shares.t[i];
        row[i] = t <= 0     ? a
                 : t >= 1   ? b
                 : side.arc ? side.arc->at(side.from + t * (side.to - side.from))
                            : a + t * (b - a);
    }
}

using Net = std::array<Row, most_grid_lines>; ///< [j][i]: i along side 0, j along side 1

/// Sides blended into the face [Coons 1967].
void blend(const Quad& quad, const Shares& along, const Shares& up, Net& net)
{
    std::array<Row, 4> side;
    for (size_t k = 0; k < 4; ++k)
        sample(quad, k, k % 2 == 0 ? along : up, k >= 2, side[k]);
    const auto& corner = quad.corner;
    for (size_t j = 0; j < up.count; ++j)
        for (size_t i = 0; i < along.count; ++i) {
            const double u = along.t[i], v = up.t[j];
            net[j][i] = (1 - v) * side[0][i] + v * side[2][i] + (1 - u) * side[3][j] + u * side[1][j] -
                        (1 - u) * (1 - v) * corner[0] - u * (1 - v) * corner[1] - u * v * corner[2] -
                        (1 - u) * v * corner[3];
        }
}

double least_of_cells(const Net& net, size_t m, size_t n)
{
    std::array<std::array<double, most_grid_lines>, most_grid_lines> along, up; // lengths of edges
    for (size_t j = 0; j <= n; ++j)
        for (size_t i = 0; i < m; ++i)
            along[j][i] = (net[j][i + 1] - net[j][i]).norm();
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i <= m; ++i)
            up[j][i] = (net[j + 1][i] - net[j][i]).norm();
    double least = 1;
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < m; ++i) {
            const Eigen::Vector2d low = net[j][i + 1] - net[j][i], high = net[j + 1][i + 1] - net[j + 1][i],
                                  left = net[j + 1][i] - net[j][i], right = net[j + 1][i + 1] - net[j][i + 1];
            const double l = along[j][i], h = along[j + 1][i], a = up[j][i], b = up[j][i + 1];
            if (!(l > 0 && h > 0 && a > 0 && b > 0))
                return -1;
            least = std::min({least, cross(low, left) / (l * a), cross(low, right) / (l * b),
                              cross(high, left) / (h * a), cross(high, right) / (h * b)});
        }
    return least;
}

} // namespace

QuadQuality quad_quality(const Quad& quad, int cells)
{
    const double straight = straight_quality(quad.corner);
    if (std::none_of(quad.side.begin(), quad.side.end(), [](const QuadSide& side) { return side.arc; }))
        return {straight, 1}; // bilinear: the sines at its corners bound those within
    const double limit = 1.5 * straight + 0.1;
    if (limit < -0.5) // far from a face: the grid need not be laid
        return {limit, 1};
    Net net;
    const Shares along = shares_of(quad.side[0], quad.side[2], cells),
                 up = shares_of(quad.side[1], quad.side[3], cells);
    blend(quad, along, up, net);
    const size_t m = along.count - 1, n = up.count - 1;
    return {std::min(limit, least_of_cells(net, m, n)), int(m * n)};
}

namespace {

/// The points of a side; those of an arc between the two corners with it.
void points_of(const Quad& quad, size_t k, std::vector<Eigen::Vector2d>& points)
{
    const QuadSide& side = quad.side[k];
    points.clear();
    points.push_back(quad.corner[k]);
    if (side.arc) {
        const auto& length = side.arc->length;
        const double same = same_place * side.arc->whole(), low = std::min(side.from, side.to) + same,
                     high = std::max(side.from, side.to) - same;
        for (const double around : {0.0, side.arc->whole()}) {
            const auto begin = std::upper_bound(length.begin(), length.end() - 1, low - around),
                       end = std::lower_bound(length.begin(), length.end() - 1, high - around);
            for (auto it = begin; it < end; ++it)
                points.push_back(side.arc->plane.col(it - length.begin()));
        }
        if (side.from > side.to)
            std::reverse(points.begin() + 1, points.end());
    }
    points.push_back(quad.corner[(k + 1) % 4]);
}

bool boxes_apart(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c, const Eigen::Vector2d& d)
{
    return std::max(a.x(), b.x()) < std::min(c.x(), d.x()) || std::max(c.x(), d.x()) < std::min(a.x(), b.x()) ||
           std::max(a.y(), b.y()) < std::min(c.y(), d.y()) || std::max(c.y(), d.y()) < std::min(a.y(), b.y());
}

/// Two rows of points of which the first ends where the second begins, if they are neighbours.
bool rows_cross(const std::vector<Eigen::Vector2d>& p, const std::vector<Eigen::Vector2d>& q, bool neighbours)
{
    for (size_t i = 0; i + 1 < p.size(); ++i)
        for (size_t j = 0; j + 1 < q.size(); ++j) {
            if (boxes_apart(p[i], p[i + 1], q[j], q[j + 1]))
                continue;
            if (neighbours && i + 2 == p.size() && j == 0) { // they meet: do they lie on each other?
                if (orient2d(p[i], p[i + 1], q[1]) == 0 && (p[i] - p[i + 1]).dot(q[1] - q[0]) > 0)
                    return true;
            } else if (segments_meet(p[i], p[i + 1], q[j], q[j + 1]))
                return true;
        }
    return false;
}

} // namespace

bool sides_cross(const Quad& quad)
{
    if (std::none_of(quad.side.begin(), quad.side.end(), [](const QuadSide& side) { return side.arc; }))
        return false; // its quality says it
    std::array<std::vector<Eigen::Vector2d>, 4> row;
    for (size_t k = 0; k < 4; ++k)
        points_of(quad, k, row[k]);
    for (size_t k = 0; k < 4; ++k)
        if (rows_cross(row[k], row[(k + 1) % 4], true))
            return true;
    return rows_cross(row[0], row[2], false) || rows_cross(row[1], row[3], false);
}

double quad_aspect(const Quad& quad)
{
    std::array<double, 4> length;
    for (size_t k = 0; k < 4; ++k)
        length[k] = quad.side[k].length(quad.corner[k], quad.corner[(k + 1) % 4]);
    const double a = length[0] + length[2], b = length[1] + length[3];
    return std::max(a, b) / std::max(std::min(a, b), 1e-9 * std::max(a, b));
}

double quad_energy(double quality, double aspect, double good)
{
    // Prices against one patch, chosen on 13 blanks: with them no patch of a simplified layout is
    // worse than it had to be to save another one, and none is a splinter.
    constexpr double shape = 0.6, corner = 4, bad = 0.12, folded = 8, per_fold = 30, slender = 4, splinter = 0.25;
    double result = 1 + shape * (1 - quality) * (1 - quality);
    if (quality < good)
        result += corner * (good - quality) / good;
    if (quality < bad)
        result += folded + per_fold * (bad - quality);
    if (aspect > slender)
        result += splinter * std::log(aspect / slender);
    return result;
}

} // namespace spia
