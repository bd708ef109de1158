#include "engine/coons/adapt_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/coons/graded_lines.h"
#include "engine/coons/lift.h"
#include "engine/coons/locate_nodes.h"
#include "engine/coons/place_border.h"
#include "engine/coons/untangle.h"
#include "engine/coons/untangle_on_blank.h"

namespace spia {
namespace {

constexpr int attempts = 3;   // each with half the share
constexpr int looks = 3;      // the first grid sees a narrow bend as one turn between two lines
constexpr double flat = 1e-6; // of the diagonal; chords that are off by less bend by rounding

/// Of the lifted grid at each node.
struct Normals {
    Eigen::Matrix3Xd unit;     ///< zero where there is none
    std::vector<char> on_part; ///< 1: all nodes that it was taken from lie on the part, none on
                               ///< what fills a hole
};

Normals normals(const LiftResult& lift)
{
    const QuadGrid& grid = lift.lifted;
    Normals result{Eigen::Matrix3Xd::Zero(3, grid.nodes()), std::vector<char>(size_t(grid.nodes()), 0)};
    for (int j = 0; j <= grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i) {
            const auto node = [&](int a, int b) {
                return grid.node(std::clamp(a, 0, grid.columns), std::clamp(b, 0, grid.rows));
            };
            const std::array<int, 5> around = {node(i - 1, j), node(i + 1, j), node(i, j - 1), node(i, j + 1),
                                               node(i, j)};
            const Eigen::Vector3d along_u = grid.position.col(around[1]) - grid.position.col(around[0]),
                                  along_v = grid.position.col(around[3]) - grid.position.col(around[2]);
            result.unit.col(around[4]) = along_u.cross(along_v).stableNormalized();
            result.on_part[size_t(around[4])] =
                std::none_of(around.begin(), around.end(), [&](int n) { return lift.on_fill[size_t(n)]; });
        }
    return result;
}

/// Per interval between columns (or rows) the root of the length times the turn of the normal from
/// one to the other, the largest of all rows: lines that share it out evenly have chords that are
/// off alike, by an eighth of its square. What fills holes is no part: beside one an interval is
/// looked at only where holes are everywhere along it; the fill goes on smoothly there.
Eigen::VectorXd turns(const LiftResult& lift, bool along_u)
{
    const QuadGrid& grid = lift.lifted;
    const Normals normal = normals(lift);
    const int intervals = along_u ? grid.columns : grid.rows, lines = along_u ? grid.rows : grid.columns;
    Eigen::VectorXd result = Eigen::VectorXd::Zero(intervals);
    for (int k = 0; k < intervals; ++k) {
        double on_part = -1, beside_holes = 0;
        for (int l = 0; l <= lines; ++l) {
            const int a = along_u ? grid.node(k, l) : grid.node(l, k),
                      b = along_u ? grid.node(k + 1, l) : grid.node(l, k + 1);
            const Eigen::Vector3d m = normal.unit.col(a), n = normal.unit.col(b);
            if (lift.on_fill[size_t(a)] || lift.on_fill[size_t(b)] || m.isZero(0) || n.isZero(0))
                continue;
            const double turn =
                std::atan2(m.cross(n).norm(), m.dot(n)) * (grid.position.col(b) - grid.position.col(a)).norm();
            beside_holes = std::max(beside_holes, turn);
            if (normal.on_part[size_t(a)] && normal.on_part[size_t(b)])
                on_part = std::max(on_part, turn);
        }
        result[k] = on_part >= 0 ? on_part : beside_holes;
    }
    const double diagonal = (grid.position.rowwise().maxCoeff() - grid.position.rowwise().minCoeff()).norm();
    if (result.maxCoeff() / 8 < flat * diagonal) // of an arc, the chord is off by an eighth of turn
                                                 // times length
        result.setZero();
    return result.cwiseSqrt();
}

/// The value between those at whole numbers.
double between(const Eigen::VectorXd& value, double at)
{
    const Eigen::Index k = std::clamp(Eigen::Index(at), Eigen::Index(0), value.size() - 2);
    return value[k] + (at - double(k)) * (value[k + 1] - value[k]);
}

/// Of a weight per interval between lines at rising places in [0, 1], the weight over even
/// intervals.
Eigen::VectorXd over_even(const Eigen::VectorXd& weight, const Eigen::VectorXd& line)
{
    constexpr int fine = 16;
    Eigen::VectorXd result = Eigen::VectorXd::Zero(fine * weight.size());
    const double width = 1. / double(result.size());
    for (Eigen::Index k = 0; k < weight.size(); ++k) {
        const double density = weight[k] / (line[k + 1] - line[k]);
        for (auto s = Eigen::Index(line[k] / width); s < result.size() && double(s) * width < line[k + 1]; ++s)
            result[s] +=
                density * (std::min(line[k + 1], double(s + 1) * width) - std::max(line[k], double(s) * width));
    }
    return result;
}

/// The grid at places u x v of its own lines, both from 0 to 1.
GridResult at_lines(const BlankSearch& blank, const BlankBoundary& boundary, const GridResult& grid,
                    const Eigen::VectorXd& u, const Eigen::VectorXd& v)
{
    GridResult result = grid;
    const int m = grid.planar.columns, n = grid.planar.rows;
    const Eigen::VectorXd at_u = u * m, at_v = v * n;
    for (size_t k = 0; k < 4; ++k) {
        const Eigen::VectorXd& at = k % 2 == 0 ? at_u : at_v;
        const Eigen::Index last = at.size() - 1;
        for (Eigen::Index i = 1; i < last; ++i)
            result.border[k][i] = between(grid.border[k], k < 2 ? at[i] : at[last] - at[last - i]);
    }
    place_border(*grid.filled, boundary, result.border, result.planar, result.place);
    for (int j = 1; j < n; ++j)
        for (int i = 1; i < m; ++i) {
            const int a = std::min(int(at_u[i]), m - 1), b = std::min(int(at_v[j]), n - 1);
            const double s = at_u[i] - a, t = at_v[j] - b;
            const auto node = [&](int di, int dj) {
                return grid.planar.position.col(grid.planar.node(a + di, b + dj));
            };
            result.planar.position.col(result.planar.node(i, j)) =
                (1 - t) * ((1 - s) * node(0, 0) + s * node(1, 0)) + t * ((1 - s) * node(0, 1) + s * node(1, 1));
        }
    locate_nodes(blank, result);
    return result;
}

/// Worse than half as good as before.
bool is_spoilt(const GridResult& grid, const GridResult& before)
{
    return !is_sound(grid) || grid.quality.min_scaled_jacobian < before.quality.min_scaled_jacobian / 2;
}

/// The last look that did not spoil the grid; the grid itself if none.
GridResult graded_grid(const BlankSearch& blank, const BlankBoundary& boundary, double share, const GridResult& grid,
                       const Progress& progress)
{
    const int m = grid.planar.columns, n = grid.planar.rows;
    Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(m + 1, 0, 1), v = Eigen::VectorXd::LinSpaced(n + 1, 0, 1);
    UntangleOptions untangling;
    untangling.keep_spacing = true;
    GridResult best = grid;
    for (int look = 0; look < looks; ++look) {
        const Progress here = progress.part(double(look) / looks, double(look + 1) / looks);
        here.checkpoint(0, "spacing the lines of the grid");
        const LiftResult lifted = lift(best);
        u = graded_lines(over_even(turns(lifted, true), u), m, share);
        v = graded_lines(over_even(turns(lifted, false), v), n, share);
        GridResult graded = at_lines(blank, boundary, grid, u, v);
        if (!is_sound(graded))
            untangle_on_blank(blank, graded, here, untangling);
        graded.route = grid.route; // its cells are those of that way
        if (is_spoilt(graded, grid))
            break;
        graded.line_grading = share;
        best = std::move(graded);
    }
    return best;
}

/// Whether the part bends between lines that can move.
bool has_bends(const GridResult& grid)
{
    const LiftResult lifted = lift(grid);
    return (grid.planar.columns > 1 && turns(lifted, true).maxCoeff() > 0) ||
           (grid.planar.rows > 1 && turns(lifted, false).maxCoeff() > 0);
}

} // namespace

bool grade_lines(const BlankSearch& blank, const BlankBoundary& boundary, double share, GridResult& grid,
                 const Progress& progress)
{
    grid.no_bends = !has_bends(grid);
    if (grid.no_bends)
        return false;
    for (int attempt = 0; attempt < attempts; ++attempt, share /= 2) {
        const Progress here = progress.part(double(attempt) / attempts, double(attempt + 1) / attempts);
        GridResult graded = graded_grid(blank, boundary, share, grid, here);
        if (graded.line_grading > 0) {
            grid = std::move(graded);
            return true;
        }
    }
    return false;
}

bool even_cells(const BlankSearch& blank, GridResult& grid, const Progress& progress)
{
    if (grid.planar.columns < 2 || grid.planar.rows < 2)
        return false;
    GridResult evened = grid;
    UntangleOptions options;
    options.keep_spacing = true;
    untangle_on_blank(blank, evened, progress, options);
    if (is_spoilt(evened, grid))
        return false;
    evened.route = grid.route; // nothing had to be untangled
    evened.evened = true;
    grid = std::move(evened);
    return true;
}

} // namespace spia
