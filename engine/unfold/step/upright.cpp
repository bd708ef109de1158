#include "engine/unfold/step/upright.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/mesh/fill_holes.h"
#include "engine/mesh/orient2d.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double quarter = std::numbers::pi / 2;

/// The corners of the smallest convex shape around some places, counter-clockwise. [Andrew 1979]
Eigen::Matrix2Xd convex_hull(const Eigen::Matrix2Xd& places)
{
    std::vector<Eigen::Index> order(size_t(places.cols()));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
        return places(0, a) < places(0, b) || (places(0, a) == places(0, b) && places(1, a) < places(1, b));
    });
    std::vector<Eigen::Index> hull;
    const auto chain = [&](auto from, auto to) {
        const size_t first = hull.size();
        for (; from != to; ++from) {
            while (hull.size() >= first + 2 &&
                   orient2d(places.col(hull[hull.size() - 2]), places.col(hull.back()), places.col(*from)) <= 0)
                hull.pop_back();
            hull.push_back(*from);
        }
        hull.pop_back(); // the other chain begins with it
    };
    chain(order.begin(), order.end());
    chain(order.rbegin(), order.rend());
    return places(Eigen::all, hull);
}

Eigen::Matrix2d turn_onto_x(const Eigen::Vector2d& direction)
{
    const Eigen::Vector2d x = direction.normalized();
    return (Eigen::Matrix2d() << x[0], x[1], -x[1], x[0]).finished();
}

Eigen::Matrix2d turn_onto_x(double angle) { return turn_onto_x(Eigen::Vector2d(std::cos(angle), std::sin(angle))); }

/// Width and height of the box.
Eigen::Vector2d box_of(const Eigen::Matrix2d& turn, const Eigen::Matrix2Xd& hull)
{
    const Eigen::Matrix2Xd turned = turn * hull;
    return turned.rowwise().maxCoeff() - turned.rowwise().minCoeff();
}

/// An edge of the outline: its direction from 0 to a quarter turn (what is square to it counts
/// alike), and its length.
struct Side {
    double angle, length;
};

/// Edges whose directions lie within a window.
struct Window {
    double angle;  ///< their mean one, weighted by length
    double length; ///< of them together
};

/// The windows of a width that hold most, each as long as the longest but for `nearly`.
std::vector<Window> longest_windows(const std::vector<Side>& sides, double width, double nearly)
{
    const size_t count = sides.size();
    std::vector<Window> windows;
    double longest = 0;
    // A sum that goes on forward and back would depend on where it begins; the prefix sums of one
    // walk round do not drift.
    std::vector<double> length(2 * count + 1, 0), moment(2 * count + 1, 0);
    const auto angle = [&](size_t i) { return sides[i % count].angle + (i >= count ? quarter : 0); };
    for (size_t i = 0; i < 2 * count; ++i) {
        length[i + 1] = length[i] + sides[i % count].length;
        moment[i + 1] = moment[i] + sides[i % count].length * (angle(i) - sides[0].angle);
    }
    for (size_t first = 0, last = 0; first < count; ++first) {
        last = std::max(last, first);
        while (last < first + count && angle(last) <= angle(first) + width)
            ++last;
        const double sum = length[last] - length[first];
        if (sum < nearly * longest)
            continue;
        longest = std::max(longest, sum);
        windows.push_back({sides[0].angle + (moment[last] - moment[first]) / sum, sum});
    }
    std::erase_if(windows, [&](const Window& window) { return window.length < nearly * longest; });
    return windows;
}

/// The directions, to a quarter turn, along which the longest straight edges lie; none: no straight
/// edge is long.
std::vector<double> straight_directions(const Eigen::Matrix2Xd& rim)
{
    constexpr double straight =
        1 * std::numbers::pi / 180; // edges of a drawn blank bend by less where they look straight
    constexpr double exact = straight / 50, mostly = 0.5; // edges of a bracket; else it is their
                                                          // mean
    constexpr double least = 0.25;                        // of the outline
    constexpr double nearly = 0.98;                       // as long: the smaller box decides
                                                          // between them
    std::vector<Side> sides;
    double whole = 0;
    for (Eigen::Index k = 0; k < rim.cols(); ++k) {
        const Eigen::Vector2d edge = rim.col((k + 1) % rim.cols()) - rim.col(k);
        if (edge.norm() == 0)
            continue;
        whole += edge.norm();
        const double angle = std::fmod(std::atan2(edge[1], edge[0]) + 4 * quarter, quarter);
        sides.push_back({angle, edge.norm()});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.angle < b.angle; });
    if (sides.empty())
        return {};
    std::vector<double> directions;
    for (const Window& wide : longest_windows(sides, straight, nearly)) {
        if (wide.length < least * whole)
            continue;
        std::vector<Side> inside;
        for (Side side : sides) {
            const double off = std::remainder(side.angle - wide.angle, quarter);
            side.angle = wide.angle + off;
            if (std::abs(off) <= straight)
                inside.push_back(side);
        }
        std::sort(inside.begin(), inside.end(), [](const Side& a, const Side& b) { return a.angle < b.angle; });
        const std::vector<Window> narrow = longest_windows(inside, exact, 1);
        directions.push_back(!narrow.empty() && narrow.front().length >= mostly * wide.length ? narrow.front().angle
                                                                                              : wide.angle);
    }
    return directions;
}

/// Those of some directions whose box is the smallest: several where the shape is symmetric, of a
/// round one a few.
std::vector<double> smallest_boxes(const std::vector<double>& directions, const Eigen::Matrix2Xd& hull)
{
    constexpr double rounding = 1e-9;
    constexpr size_t enough = 8;
    std::vector<double> size;
    for (const double angle : directions)
        size.push_back(box_of(turn_onto_x(angle), hull).prod());
    const double least = *std::min_element(size.begin(), size.end());
    std::vector<double> best;
    for (size_t k = 0; k < size.size() && best.size() < enough; ++k) {
        const bool known = std::any_of(best.begin(), best.end(), [&](double angle) {
            return std::abs(std::remainder(angle - directions[k], quarter)) < rounding;
        });
        if (!known && size[k] <= least * (1 + rounding))
            best.push_back(directions[k]);
    }
    return best;
}

std::vector<double> directions_of_edges(const Eigen::Matrix2Xd& hull)
{
    std::vector<double> directions;
    for (Eigen::Index k = 0; k < hull.cols(); ++k) {
        const Eigen::Vector2d edge = hull.col((k + 1) % hull.cols()) - hull.col(k);
        directions.push_back(std::atan2(edge[1], edge[0]));
    }
    return directions;
}

/// What tells two ways round of one shape apart, the first first; each about 1 or less.
using ShapeKey = std::array<double, 8>;

/// Of the blank's area, about the middle of its box, in units of the longer side.
ShapeKey key_of(const TriMesh& part, const Eigen::Matrix2Xd& flat)
{
    const Eigen::Vector2d low = flat.rowwise().minCoeff(), high = flat.rowwise().maxCoeff(), middle = (low + high) / 2;
    const double side = (high - low).maxCoeff();
    double area = 0, xx = 0, yy = 0, y = 0, x = 0, yyy = 0, xxx = 0, xxy = 0, xyy = 0;
    // Exact up to the third power. [Strang and Fix 1973, rule of 4 points]
    constexpr double weight[] = {-27. / 48, 25. / 48, 25. / 48, 25. / 48};
    constexpr double share[4][3] = {{1. / 3, 1. / 3, 1. / 3}, {0.6, 0.2, 0.2}, {0.2, 0.6, 0.2}, {0.2, 0.2, 0.6}};
    for (int f = 0; f < part.triangles(); ++f) {
        Eigen::Matrix<double, 2, 3> corner = flat(Eigen::all, part.triangle.col(f));
        corner = (corner.colwise() - middle) / side;
        const Eigen::Vector2d a = corner.col(1) - corner.col(0), b = corner.col(2) - corner.col(0);
        const double face = (a[0] * b[1] - a[1] * b[0]) / 2;
        area += face;
        for (int k = 0; k < 4; ++k) {
            const Eigen::Vector2d p = corner * Eigen::Map<const Eigen::Vector3d>(share[k]);
            const double w = weight[k] * face;
            x += w * p[0];
            y += w * p[1];
            xx += w * p[0] * p[0];
            yy += w * p[1] * p[1];
            xxx += w * p[0] * p[0] * p[0];
            xxy += w * p[0] * p[0] * p[1];
            xyy += w * p[0] * p[1] * p[1];
            yyy += w * p[1] * p[1] * p[1];
        }
    }
    const Eigen::Vector2d size = high - low;
    ShapeKey key = {(size[0] - size[1]) / side, xx - yy, -y, -x, -yyy, -xxx, -xxy, -xyy};
    for (size_t k = 1; k < key.size() && area > 0; ++k)
        key[k] /= area;
    return key;
}

/// One way round.
struct Way {
    Eigen::Matrix2d turn;
    ShapeKey key;
};

/// The ways round from which the rule chooses.
std::vector<Way> ways_round(const TriMesh& part, const Eigen::Matrix2Xd& flat, const Eigen::Matrix2Xd& rim,
                            const std::optional<Eigen::Vector2d>& rolling)
{
    const Eigen::Matrix2Xd hull = convex_hull(rim); // far fewer places, most often
    std::vector<Eigen::Matrix2d> straight;
    if (rolling)
        straight = {turn_onto_x(*rolling)};
    else {
        std::vector<double> directions = straight_directions(rim);
        if (directions.empty())
            directions = directions_of_edges(hull);
        for (const double angle : smallest_boxes(directions, hull))
            straight.push_back(turn_onto_x(angle));
    }
    const Eigen::Matrix2d by_quarter = (Eigen::Matrix2d() << 0, 1, -1, 0).finished();
    std::vector<Way> ways;
    for (Eigen::Matrix2d turn : straight)
        for (int k = 0; k < 4; ++k, turn = by_quarter * turn)
            if (!rolling || k % 2 == 0)
                ways.push_back({turn, key_of(part, turn * flat)});
    return ways;
}

/// How near two turns are, up to a factor the cosine of what lies between them.
double likeness(const Eigen::Matrix2d& a, const Eigen::Matrix2d& b) { return a.cwiseProduct(b).sum(); }

/// The way that the rule takes. @param moment of where the shape came to lie with itself as it is:
/// of symmetric ways the one nearest to that is taken
Way chosen_way(std::vector<Way> ways, const Eigen::Matrix2d& moment)
{
    constexpr double alike = 1e-6; // what a solver leaves of a symmetry is less
    for (size_t k = 0; k < ShapeKey{}.size() && ways.size() > 1; ++k) {
        double most = -std::numeric_limits<double>::infinity();
        for (const Way& way : ways)
            most = std::max(most, way.key[k]);
        std::erase_if(ways, [&](const Way& way) { return way.key[k] < most - alike; });
    }
    return *std::max_element(ways.begin(), ways.end(), [&](const Way& a, const Way& b) {
        return likeness(a.turn, moment) < likeness(b.turn, moment);
    });
}

Eigen::Matrix2Xd rim_of(const std::vector<std::vector<int>>& loops, const Eigen::Matrix2Xd& flat)
{
    return flat(Eigen::all, loops[size_t(outer_loop(loops, flat))]);
}

Eigen::Matrix2Xd from_corner(Eigen::Matrix2Xd flat)
{
    const Eigen::Vector2d low = flat.rowwise().minCoeff();
    return flat.colwise() - low;
}

} // namespace

Eigen::Matrix2d upright_turn(const TriMesh& part, const Eigen::Matrix2Xd& flat,
                             const std::optional<Eigen::Vector2d>& rolling)
{
    const auto loops = boundary_loops(part);
    if (loops.empty())
        return Eigen::Matrix2d::Identity();
    const Eigen::Matrix2Xd centred = flat.colwise() - flat.rowwise().mean();
    return chosen_way(ways_round(part, flat, rim_of(loops, flat), rolling), centred * centred.transpose()).turn;
}

Eigen::Matrix2Xd upright(const TriMesh& part, const Eigen::Matrix2Xd& flat,
                         const std::optional<Eigen::Vector2d>& rolling)
{
    return from_corner(upright_turn(part, flat, rolling) * flat);
}

LiveUpright::LiveUpright(const TriMesh& part, const Eigen::Matrix2Xd& seen,
                         const std::optional<Eigen::Vector2d>& rolling)
    : part_(part), rolling_(rolling), loops_(boundary_loops(part)), mass_(Eigen::VectorXd::Zero(part.vertices()))
{
    const Eigen::Matrix3Xd normal = area_vectors(part);
    for (int f = 0; f < part.triangles(); ++f)
        for (const int v : part.triangle.col(f))
            mass_[v] += normal.col(f).norm();
    mass_ /= mass_.sum();
    look_at(seen);
}

void LiveUpright::look_at(const Eigen::Matrix2Xd& shape)
{
    const Eigen::Vector2d middle = shape * mass_;
    seen_ = (shape.colwise() - middle) * mass_.asDiagonal();
}

Eigen::Matrix2Xd LiveUpright::operator()(const Eigen::Matrix2Xd& flat)
{
    if (loops_.empty())
        return flat;
    // The turn that brings the shape nearest to where it is seen is the rotation in this moment.
    // [Kabsch 1976 in the plane]
    const Eigen::Matrix2d moment = seen_ * flat.transpose();
    Eigen::Matrix2d turn;
    if (!std::exchange(any_, true))
        turn = chosen_way(ways_round(part_, flat, rim_of(loops_, flat), rolling_), moment).turn;
    else
        turn = Eigen::Rotation2Dd(std::atan2(moment(1, 0) - moment(0, 1), moment(0, 0) + moment(1, 1)));
    look_at(turn * flat);
    return from_corner(turn * flat);
}

} // namespace spia
