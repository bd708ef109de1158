#include "engine/exchange/lines/outline_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "engine/core/angle.h"
#include "engine/core/small_dense.h"

namespace spia {
namespace {

using std::numbers::pi;

/// What counts as an arc.
struct ArcLimits {
    double tolerance; ///< mm, of its points
    double chord;     ///< radians of the circle that a chord spans at most
    int chords;       ///< at least
};

/// The circle through some points as least squares have it: exact for exact ones. [Kasa 1976]
struct Circle {
    Eigen::Vector2d centre;
    double radius;
};
Circle circle_through(const Eigen::Matrix2Xd& points)
{
    const Eigen::Vector2d middle = points.rowwise().mean();
    const Eigen::Matrix2Xd p = points.colwise() - middle;
    const double size = std::sqrt(p.squaredNorm() / double(p.cols()));
    Eigen::MatrixX3d A(p.cols(), 3);
    A << (p / size).transpose(), Eigen::VectorXd::Ones(p.cols());
    const Eigen::VectorXd b = (p / size).colwise().squaredNorm().transpose();
    const Eigen::Vector3d x = least_squares(A, b);
    const Eigen::Vector2d centre = x.head<2>() / 2;
    return {middle + size * centre, size * std::sqrt(std::max(x[2] + centre.squaredNorm(), 0.))};
}

class Finder {
public:
    explicit Finder(const OutlineLoop& loop) : loop_(loop), count_(int(loop.cols())), taken_(size_t(count_), 0) {}

    std::optional<Circle> circle(const ArcLimits& limits) const
    {
        const Circle found = circle_through(loop_);
        return is_circle(found, limits) ? std::optional(found) : std::nullopt;
    }

    /// Whether the points go once around it.
    bool is_circle(const Circle& found, const ArcLimits& limits) const
    {
        if (!(found.radius > 0) || !std::isfinite(found.radius))
            return false;
        double turned = 0;
        for (int k = 0; k < count_; ++k) {
            const Eigen::Vector2d a = at(k) - found.centre, b = at(k + 1) - found.centre;
            const double angle = std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
            if (std::abs(a.norm() - found.radius) > limits.tolerance || std::abs(angle) > limits.chord ||
                angle * turned < 0 || angle == 0)
                return false;
            turned += angle;
        }
        return std::abs(std::abs(turned) - 2 * pi) < radians_per_degree;
    }

    /// The ends of an arc that nearly closes say too little of its centre, and nothing if it does,
    /// as a hole that touches the edge of the blank: it becomes two.
    void take_stated(const StatedPiece& stated)
    {
        for (int k = 0; k < stated.edges; ++k)
            taken_[size_t((stated.first + k) % count_)] = 1;
        if (stated.kind != OutlinePiece::Kind::arc) {
            found_.push_back({stated.kind, stated.first, stated.edges});
            return;
        }
        const double turn = turn_around(stated.centre, stated.first, stated.edges);
        constexpr double open = 330 * radians_per_degree; // its ends are half a radius apart
        int half = stated.edges;
        if (std::abs(turn) > open && stated.edges > 1)
            for (half = 1; half + 1 < stated.edges &&
                           std::abs(turn_around(stated.centre, stated.first, half)) < std::abs(turn) / 2;)
                ++half;
        const double first = turn_around(stated.centre, stated.first, half);
        found_.push_back({stated.kind, stated.first, half, std::tan(first / 4)});
        if (half < stated.edges)
            found_.push_back(
                {stated.kind, (stated.first + half) % count_, stated.edges - half, std::tan((turn - first) / 4)});
    }

    /// Lines that go on from one another become one, wherever in the loop.
    /// @param pieces  all of them, in order
    std::vector<OutlinePiece> joined(const std::vector<OutlinePiece>& pieces, double exact) const
    {
        std::vector<OutlinePiece> result;
        const auto goes_on = [&](const OutlinePiece& a, const OutlinePiece& b) {
            return a.kind == OutlinePiece::Kind::line && b.kind == a.kind && a.edges + b.edges < count_ &&
                   line(a.first, a.edges + b.edges, exact);
        };
        for (const OutlinePiece& piece : pieces)
            if (!result.empty() && goes_on(result.back(), piece))
                result.back().edges += piece.edges;
            else
                result.push_back(piece);
        if (result.size() > 2 && goes_on(result.back(), result.front())) {
            result.back().edges += result.front().edges;
            result.erase(result.begin());
        }
        return result;
    }

    /// Takes the runs of edges on an arc or a line that are not yet taken, each as long as it can
    /// be.
    /// @param wider what is looked for later: a run that is much longer then is left for it, for a
    /// piece of a free curve is within a small
    ///              tolerance of a circle, too
    void take_arcs(const ArcLimits& limits, const ArcLimits* wider = nullptr)
    {
        take(
            [&](int from) {
                const int edges = longest_arc(from, limits);
                return wider && much_longer(from, edges, *wider) ? 0 : edges;
            },
            OutlinePiece::Kind::arc);
    }
    void take_lines(double tolerance, const ArcLimits* wider = nullptr)
    {
        take(
            [&](int from) {
                const int edges = longest_line(from, tolerance);
                return wider && much_longer(from, edges, *wider) ? 0 : edges;
            },
            OutlinePiece::Kind::line);
    }

    /// With what is left between: single edges are lines.
    std::vector<OutlinePiece> pieces()
    {
        using Kind = OutlinePiece::Kind;
        std::vector<OutlinePiece> all = found_;
        if (all.empty())
            return {{Kind::points, 0, count_}};
        std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<OutlinePiece> result;
        for (size_t k = 0; k < all.size(); ++k) {
            result.push_back(all[k]);
            const int end = all[k].first + all[k].edges,
                      next = all[(k + 1) % all.size()].first + (k + 1 < all.size() ? 0 : count_);
            if (next > end)
                result.push_back({next - end == 1 ? Kind::line : Kind::points, end % count_, next - end});
        }
        return result;
    }

private:
    Eigen::Vector2d at(int k) const { return loop_.col(k % count_); }

    /// Radians, of a run of edges as seen from a point.
    double turn_around(const Eigen::Vector2d& centre, int first, int edges) const
    {
        double turn = 0;
        for (int k = first; k < first + edges; ++k) {
            const Eigen::Vector2d a = at(k) - centre, b = at(k + 1) - centre;
            turn += std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
        }
        return turn;
    }

    /// How many edges from one on are free.
    int free_from(int from) const
    {
        int edges = 0;
        while (edges < count_ && !taken_[size_t((from + edges) % count_)])
            ++edges;
        return edges;
    }

    /// The longest run that fits, by doubling and halving: what fits for long fits for less. 0:
    /// none of `least` edges
    template <class Fits> int longest(int from, int least, const Fits& fits) const
    {
        const int most = std::min(free_from(from), count_ - 1);
        if (most < least || !fits(least))
            return 0;
        int good = least, step = 1;
        while (good + step <= most && fits(good + step)) {
            good += step;
            step *= 2;
        }
        for (; step > 0; step /= 2)
            if (good + step <= most && fits(good + step))
                good += step;
        return good;
    }

    int longest_line(int from, double tolerance) const
    {
        return longest(from, 2, [&](int edges) { return line(from, edges, tolerance); });
    }

    /// What is straight within the tolerance is no arc.
    int longest_arc(int from, const ArcLimits& limits) const
    {
        const int edges = longest(from, limits.chords, [&](int count) { return arc(from, count, limits) != 0; });
        return edges > 0 && line(from, edges, limits.tolerance) ? 0 : edges;
    }

    bool much_longer(int from, int edges, const ArcLimits& wider) const
    {
        return edges > 0 && 2 * std::max(longest_arc(from, wider), longest_line(from, wider.tolerance)) > 3 * edges + 4;
    }

    /// The bulge of the arc through a run, whose ends it has, if there is one. 0: none
    double arc(int from, int edges, const ArcLimits& limits) const
    {
        const Eigen::Vector2d a = at(from), b = at(from + edges);
        double sign = 0;
        for (int k = 0; k + 1 < edges; ++k) { // all turn one way; chords of one circle by half of
                                              // what both span
            const Eigen::Vector2d u = at(from + k + 1) - at(from + k), v = at(from + k + 2) - at(from + k + 1);
            const double turn = std::atan2(u[0] * v[1] - u[1] * v[0], u.dot(v));
            if (turn == 0 || turn * sign < 0 || std::abs(turn) > limits.chord)
                return 0;
            sign = turn;
        }
        // Seen from a point of the arc its chord has half the angle of the rest of the circle.
        double quarter = 0, weights = 0;
        for (int k = 1; k < edges; ++k) {
            const Eigen::Vector2d u = a - at(from + k), v = b - at(from + k);
            double seen = std::atan2(u[0] * v[1] - u[1] * v[0], u.dot(v));
            if (seen * sign > 0) // beyond a half turn
                seen -= 2 * pi * (seen > 0 ? 1 : -1);
            const double weight = std::min(u.norm(), v.norm());
            quarter += weight * (pi - std::abs(seen)) / 2;
            weights += weight;
        }
        quarter /= weights;
        const double bulge = std::copysign(std::tan(quarter), sign);
        if (!(quarter > 0) || !(quarter < pi / 2) || !((b - a).norm() > 0))
            return 0;
        const Eigen::Vector2d centre = arc_centre(a, b, bulge);
        const double radius = (a - centre).norm();
        std::vector<double> chords;
        chords.reserve(size_t(edges));
        for (int k = 0; k < edges; ++k)
            chords.push_back((at(from + k + 1) - at(from + k)).norm());
        const double longest_chord = *std::max_element(chords.begin(), chords.end());
        std::nth_element(chords.begin(), chords.begin() + edges / 2, chords.end());
        constexpr double alike = 3; // an edge beside an arc is none of its chords
        if (longest_chord > alike * chords[size_t(edges / 2)] ||
            longest_chord > 2 * radius * std::sin(limits.chord / 2))
            return 0;
        for (int k = 0; k <= edges; ++k) {
            const Eigen::Vector2d p = at(from + k) - centre;
            if (!(std::abs(p.norm() - radius) <= limits.tolerance))
                return 0;
        }
        return bulge;
    }

    bool line(int from, int edges, double tolerance) const
    {
        const Eigen::Vector2d a = at(from), b = at(from + edges), way = b - a;
        const double length = way.norm();
        if (!(length > 0))
            return false;
        double along = 0;
        for (int k = 1; k < edges; ++k) {
            const Eigen::Vector2d p = at(from + k) - a;
            const double now = p.dot(way) / length;
            if (std::abs(way[0] * p[1] - way[1] * p[0]) > tolerance * length || now <= along || now >= length)
                return false;
            along = now;
        }
        return true;
    }

    /// From where the first run ends, for that is an end of a run wherever one begins; so none is
    /// cut in two.
    template <class Longest> void take(const Longest& longest_from, OutlinePiece::Kind kind)
    {
        int start = 0;
        for (int k = 0; k < count_; ++k)
            if (const int edges = longest_from(k); edges > 0) {
                start = k + edges;
                break;
            }
        for (int k = start; k < start + count_;) {
            const int from = k % count_;
            const int edges = longest_from(from);
            if (edges == 0) {
                ++k;
                continue;
            }
            OutlinePiece piece{kind, from, edges};
            if (kind == OutlinePiece::Kind::arc)
                // as it was found
                piece.bulge = arc(from, edges, {std::numeric_limits<double>::infinity(), pi, 2});
            found_.push_back(piece);
            for (int e = 0; e < edges; ++e)
                taken_[size_t((from + e) % count_)] = 1;
            k += edges;
        }
    }

    const OutlineLoop& loop_;
    int count_;
    std::vector<char> taken_; ///< per edge
    std::vector<OutlinePiece> found_;
};

} // namespace

Eigen::Vector2d arc_centre(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double bulge)
{
    const Eigen::Vector2d way = b - a, left(-way[1], way[0]);
    return (a + b) / 2 + left * (1 - bulge * bulge) / (4 * bulge);
}

OutlineCurves find_curves(const OutlineLoop& loop, double exact, double tolerance, std::span<const StatedPiece> stated)
{
    const ArcLimits sharp{exact, 35 * radians_per_degree, 3}, loose{tolerance, 20 * radians_per_degree, 5};
    OutlineCurves curves;
    Finder finder(loop);
    const auto as_circle = [&](const Eigen::Vector2d& centre, double radius) {
        curves.circle = true;
        curves.centre = centre;
        curves.radius = radius;
        return curves;
    };
    int known = 0;
    for (const StatedPiece& piece : stated)
        known += piece.edges;
    for (const StatedPiece& piece : stated) // all around, or of a hole that is round beyond what is
                                            // stated, too
        if (piece.kind == OutlinePiece::Kind::arc &&
            (piece.edges == loop.cols() ||
             (known < loop.cols() && finder.is_circle({piece.centre, piece.radius}, loose))))
            return as_circle(piece.centre, piece.radius);
    if (stated.empty())
        for (const ArcLimits& limits : {sharp, loose})
            if (const auto circle = finder.circle(limits))
                return as_circle(circle->centre, circle->radius);
    for (const StatedPiece& piece : stated)
        finder.take_stated(piece);
    const ArcLimits* later = tolerance > exact ? &loose : nullptr;
    finder.take_arcs(sharp, later);
    finder.take_lines(exact, later);
    if (later) {
        finder.take_arcs(loose);
        finder.take_lines(tolerance);
    }
    curves.pieces = stated.empty() ? finder.pieces() : finder.joined(finder.pieces(), exact);
    return curves;
}

} // namespace spia
