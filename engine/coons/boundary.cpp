#include "engine/coons/boundary.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>
#include <numeric>

#include "engine/core/error.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/flat/outline.h"
#include "engine/mesh/topology.h"

namespace spia {

namespace {

// of the perimeter
constexpr std::array<double, 6> turning_lengths = {0.0015, 0.003, 0.006, 0.012, 0.024, 0.04};
constexpr int most_candidates = 96;  // all their quadruples are compared: 3.3 million
constexpr int even_candidates = 32;  // of these, spread evenly for smooth outlines
constexpr double weight_balance = 4; // against a score of at most 1 per corner
constexpr double weight_square = 0.5;
constexpr double weight_straight = 4; // a cell cannot have a corner where the outline is straight
                                      // or turns inwards
constexpr int finalists = 256;        // of these quadruples, looked at more closely
constexpr double straight = 0.5;      // of the turning of a circle as long as the outline, over the
                                      // same length

std::vector<int> outline_of(const Blank& blank, const TriMesh& part)
{
    const auto loops = boundary_loops(part);
    return loops[size_t(outer_loop(loops, blank.position))];
}

/// 1 where the outline turns by a right angle, less for blunt and for needle-like corners, below 0
/// where it cannot be one.
double corner_score(const Outline& outline, int i)
{
    const double right_angle = std::numbers::pi / 2;
    double score = 0;
    bool turns_out = true;
    for (const double reach : turning_lengths) {
        const double turn = outline.turning(i, reach * outline.perimeter(), reach * outline.perimeter());
        const double excess = std::max(0.0, turn - right_angle);
        score += (turn - 1.5 * excess) / right_angle / turning_lengths.size();
        turns_out = turns_out && turn > straight * 2 * std::numbers::pi * reach;
    }
    return turns_out ? score : score - weight_straight;
}

/// What four corners at the given lengths along the outline are worth, apart from their angles.
/// Squares, so that moving one corner at a time leads to the best place.
double side_score(const std::array<double, 4>& length, double perimeter)
{
    std::array<double, 4> side;
    for (size_t k = 0; k < 4; ++k) {
        side[k] = length[(k + 1) % 4] - length[k];
        if (side[k] < 0)
            side[k] += perimeter;
    }
    const double u = side[0] + side[2], v = side[1] + side[3];
    if (std::min(u, v) <= 0)
        return -10;
    const double unbalance_u = (side[0] - side[2]) / u, unbalance_v = (side[1] - side[3]) / v,
                 oblong = (u - v) / (u + v);
    return -weight_balance * (unbalance_u * unbalance_u + unbalance_v * unbalance_v) - weight_square * oblong * oblong;
}

struct Quadruple {
    std::array<int, 4> corner; ///< places on the outline, rising
    double worth;
};

/// Whether the outline turns outwards at each corner between the first border nodes of a grid of
/// usual density.
bool cells_fit(const Outline& outline, const std::array<int, 4>& corner)
{
    constexpr double cells = 40, least_turn = 0.01; // radians
    std::array<double, 4> step;
    for (size_t k = 0; k < 4; ++k) {
        step[k] = outline.length_at(corner[(k + 1) % 4]) - outline.length_at(corner[k]);
        step[k] = (step[k] < 0 ? step[k] + outline.perimeter() : step[k]) / cells;
    }
    for (size_t k = 0; k < 4; ++k)
        if (outline.turning(corner[k], step[(k + 3) % 4], step[k]) < least_turn)
            return false;
    return true;
}

/// Evenly spread vertices, then the sharpest ones, no two of these within half a percent of the
/// perimeter.
std::vector<int> candidates(const Outline& outline, const std::vector<double>& score)
{
    std::vector<int> chosen;
    std::vector<char> taken(size_t(outline.size()), 0);
    const auto take = [&](int i) {
        if (!taken[size_t(i)])
            chosen.push_back(i);
        taken[size_t(i)] = 1;
    };
    double next = 0; // evenly by length, whatever the mesh size
    for (int i = 0; i < outline.size(); ++i)
        if (outline.length_at(i) >= next) {
            take(i);
            next += outline.perimeter() / even_candidates;
        }
    std::vector<int> by_score(size_t(outline.size()));
    std::iota(by_score.begin(), by_score.end(), 0);
    std::stable_sort(by_score.begin(), by_score.end(),
                     [&](int a, int b) { return score[size_t(a)] > score[size_t(b)]; });
    std::vector<int> sharp;
    for (const int i : by_score) {
        if (int(chosen.size()) >= most_candidates)
            break;
        const bool apart = std::all_of(sharp.begin(), sharp.end(), [&](int other) {
            const double gap = std::abs(outline.length_at(i) - outline.length_at(other));
            return std::min(gap, outline.perimeter() - gap) >= 0.005 * outline.perimeter();
        });
        if (apart) {
            sharp.push_back(i);
            take(i);
        }
    }
    for (int i = 0; chosen.size() < 4; ++i)
        take(i);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

} // namespace

std::array<int, 4> propose_corners(const Blank& blank, const TriMesh& part)
{
    const std::vector<int> loop = outline_of(blank, part);
    const Outline outline(loop, blank.position);
    const int n = outline.size();
    if (n < 4)
        throw InputError(fmt::format("the outline of the blank has {} vertices, a quad grid needs four corners; refine "
                                     "the mesh of the part",
                                     n));
    std::vector<double> score(static_cast<size_t>(n));
    for (int i = 0; i < n; ++i)
        score[size_t(i)] = corner_score(outline, i);

    const auto worth = [&](const std::array<int, 4>& c) {
        double sum = side_score(
            {outline.length_at(c[0]), outline.length_at(c[1]), outline.length_at(c[2]), outline.length_at(c[3])},
            outline.perimeter());
        for (const int i : c)
            sum += score[size_t(i)];
        return sum;
    };
    const std::vector<int> choice = candidates(outline, score);
    const size_t m = choice.size();
    std::vector<Quadruple> best; // a heap with the worst in front
    const auto worse_last = [](const Quadruple& a, const Quadruple& b) {
        return a.worth != b.worth ? a.worth > b.worth : a.corner < b.corner;
    };
    for (size_t a = 0; a < m; ++a)
        for (size_t b = a + 1; b < m; ++b)
            for (size_t c = b + 1; c < m; ++c)
                for (size_t d = c + 1; d < m; ++d) {
                    const std::array<int, 4> corner = {choice[a], choice[b], choice[c], choice[d]};
                    const Quadruple here{corner, worth(corner)};
                    if (best.size() == finalists) {
                        if (!worse_last(here, best.front()))
                            continue;
                        std::pop_heap(best.begin(), best.end(), worse_last);
                        best.pop_back();
                    }
                    best.push_back(here);
                    std::push_heap(best.begin(), best.end(), worse_last);
                }
    std::sort_heap(best.begin(), best.end(), worse_last);
    const auto fit =
        std::find_if(best.begin(), best.end(), [&](const Quadruple& q) { return cells_fit(outline, q.corner); });
    Quadruple chosen = fit != best.end() ? *fit : best.front();

    // The candidates are sparse: let each corner walk along the outline while that pays. Each step
    // raises the worth, so it ends; the order of the corners is kept.
    for (bool moved = true; moved;) {
        moved = false;
        for (size_t k = 0; k < 4; ++k)
            for (const int step : {1, n - 1}) {
                Quadruple next = chosen;
                next.corner[k] = (next.corner[k] + step) % n;
                if (std::count(next.corner.begin(), next.corner.end(), next.corner[k]) > 1)
                    continue;
                next.worth = worth(next.corner);
                if (next.worth > chosen.worth && cells_fit(outline, next.corner) >= cells_fit(outline, chosen.corner)) {
                    chosen = next;
                    moved = true;
                }
            }
    }
    std::array<int, 4> corners = chosen.corner;
    const auto height = [&](int i) { return blank.position.col(loop[size_t(i)]).sum(); };
    const auto lowest =
        std::min_element(corners.begin(), corners.end(), [&](int a, int b) { return height(a) < height(b); });
    std::rotate(corners.begin(), lowest, corners.end());
    return {loop[size_t(corners[0])], loop[size_t(corners[1])], loop[size_t(corners[2])], loop[size_t(corners[3])]};
}

BlankBoundary split_boundary(const Blank& blank, const TriMesh& part, const std::array<int, 4>& corners,
                             const std::vector<int>& file_number)
{
    const auto number = [&](int v) { return file_number.empty() ? v : file_number[size_t(v)]; };
    const std::vector<int> loop = outline_of(blank, part);
    const int n = int(loop.size());
    std::array<int, 4> place;
    for (size_t k = 0; k < 4; ++k) {
        const auto found = std::find(loop.begin(), loop.end(), corners[k]);
        if (found == loop.end())
            throw InputError(fmt::format("corner vertex {} is not on the outer boundary of the blank; pick "
                                         "one of its boundary vertices",
                                         number(corners[k])));
        if (std::count(corners.begin(), corners.end(), corners[k]) > 1)
            throw InputError(fmt::format("vertex {} is given as a corner twice; four different ones are needed",
                                         number(corners[k])));
        place[k] = int(found - loop.begin());
    }
    // counter-clockwise from the first
    const auto steps = [&](size_t k) { return (place[k] - place[0] + n) % n; };
    if (steps(1) > steps(2) && steps(2) > steps(3))
        std::swap(place[1], place[3]); // clockwise
    else if (!(steps(1) < steps(2) && steps(2) < steps(3))) {
        std::array<int, 4> sorted = place;
        std::sort(sorted.begin() + 1, sorted.end(),
                  [&](int a, int b) { return (a - place[0] + n) % n < (b - place[0] + n) % n; });
        throw InputError(
            fmt::format("the corners do not follow each other along the boundary; give them as {},{},{},{}",
                        number(loop[size_t(sorted[0])]), number(loop[size_t(sorted[1])]),
                        number(loop[size_t(sorted[2])]), number(loop[size_t(sorted[3])])));
    }

    BlankBoundary boundary;
    for (size_t k = 0; k < 4; ++k) {
        boundary.corner[k] = loop[size_t(place[k])];
        double length = 0;
        for (int i = place[k];; i = (i + 1) % n) {
            boundary.side[k].push_back(loop[size_t(i)]);
            if (i == place[(k + 1) % 4])
                break;
            length += (blank.position.col(loop[size_t((i + 1) % n)]) - blank.position.col(loop[size_t(i)])).norm();
        }
        if (!(length > 0))
            throw InputError(
                fmt::format("the side from corner {} to corner {} has no length in the blank; choose corners "
                            "farther apart",
                            number(boundary.corner[k]), number(loop[size_t(place[(k + 1) % 4])])));
    }
    return boundary;
}

Eigen::VectorXd chord_parameters(const std::vector<int>& side, const Eigen::Matrix2Xd& plane)
{
    Eigen::VectorXd chord(side.size());
    chord[0] = 0;
    for (size_t i = 1; i < side.size(); ++i)
        chord[Eigen::Index(i)] = chord[Eigen::Index(i) - 1] + (plane.col(side[i]) - plane.col(side[i - 1])).norm();
    chord /= chord[chord.size() - 1];
    return chord;
}

SidePoint point_on_side(const std::vector<int>& side, const Eigen::VectorXd& chord, double t)
{
    const auto next = std::upper_bound(chord.begin() + 1, chord.end() - 1, t);
    const Eigen::Index i = next - chord.begin() - 1;
    const double edge = chord[i + 1] - chord[i];
    const double weight = edge > 0 ? std::clamp((t - chord[i]) / edge, 0.0, 1.0) : 0;
    return {side[size_t(i)], side[size_t(i) + 1], weight};
}

} // namespace spia
