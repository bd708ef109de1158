#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/layout/plane_graph.h"
#include "engine/layout/plane_lines.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/flat/outline.h"
#include "engine/mesh/topology.h"

namespace spia {

namespace {

using std::numbers::pi;

/// Places in a loop, rising.
using Places = std::vector<int>;

/// Whether a length of the loop is within a distance of one of its places.
bool is_near(const Outline& outline, const Places& places, double length, double distance)
{
    return std::any_of(places.begin(), places.end(), [&](int j) {
        const double away = std::abs(length - outline.length_at(j));
        return std::min(away, outline.perimeter() - away) < distance;
    });
}

/// The sharpest place of every stretch of a loop that turns by more than `corner` over a share of
/// it to both sides.
Places corners(const Outline& outline, double corner, double share)
{
    const int n = outline.size();
    const double reach = share * outline.perimeter();
    std::vector<double> turn(static_cast<size_t>(n));
    for (int i = 0; i < n; ++i)
        turn[size_t(i)] = std::abs(outline.turning(i, reach, reach));
    Places result;
    for (int i = 0; i < n; ++i) {
        bool sharpest = turn[size_t(i)] > corner;
        for (const int step : {1, n - 1}) // over the reach to both sides
            for (int j = (i + step) % n; sharpest && j != i; j = (j + step) % n) {
                double away = std::abs(outline.length_at(j) - outline.length_at(i));
                away = std::min(away, outline.perimeter() - away);
                if (away > 1.5 * reach)
                    break;
                sharpest = turn[size_t(j)] < turn[size_t(i)] || (turn[size_t(j)] == turn[size_t(i)] && j > i);
            }
        if (sharpest)
            result.push_back(i);
    }
    return result;
}

/// The place of the loop next to a length.
int place_at(const Outline& outline, double length)
{
    length = std::fmod(length + outline.perimeter(), outline.perimeter());
    int best = 0;
    double least = outline.perimeter();
    for (int i = 0; i < outline.size(); ++i) {
        double away = std::abs(outline.length_at(i) - length);
        away = std::min(away, outline.perimeter() - away);
        if (away < least) {
            least = away;
            best = i;
        }
    }
    return best;
}

/// Radians, without sign, that an arc turns from place a to place b.
double turn_between(const Outline& outline, const std::vector<int>& loop, const Eigen::Matrix2Xd& plane, int a, int b)
{
    const int n = outline.size();
    double turn = 0;
    const auto at = [&](int i) -> Eigen::Vector2d { return plane.col(loop[size_t((i % n + n) % n)]); };
    for (int i = a + 1; i < (b > a ? b : b + n); ++i) {
        const Eigen::Vector2d d = at(i) - at(i - 1), e = at(i + 1) - at(i);
        turn += std::atan2(d.x() * e.y() - d.y() * e.x(), d.dot(e));
    }
    return std::abs(turn);
}

/// Whether a loop turns at a vertex itself, not over some length.
bool is_sharp(const std::vector<int>& loop, const Eigen::Matrix2Xd& plane, int i, double corner_turn)
{
    const int n = int(loop.size());
    const Eigen::Vector2d at = plane.col(loop[size_t(i)]), in = at - plane.col(loop[size_t((i + n - 1) % n)]),
                          out = plane.col(loop[size_t((i + 1) % n)]) - at;
    return std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out))) > corner_turn;
}

struct LoopPlaces {
    std::vector<int> loop;
    Places place;
};

Places places_of(const std::vector<int>& loop, const Eigen::Matrix2Xd& plane, bool hole, double corner_turn,
                 const std::vector<double>& corner_reach, double spacing, const std::vector<int>& forced,
                 bool only_forced)
{
    const Outline outline(loop, plane);
    const int n = int(loop.size());
    Places places;
    for (int i = 0; i < n; ++i)
        if (std::find(forced.begin(), forced.end(), loop[size_t(i)]) != forced.end())
            places.push_back(i);
    if (only_forced)
        return places;
    Places found;
    for (const double share : corner_reach) { // not right beside a forced one, nor one that was
                                              // found already
        const Places before = found;
        for (const int i : corners(outline, corner_turn, share))
            if (!is_near(outline, before, outline.length_at(i), 1.5 * share * outline.perimeter()) &&
                (is_sharp(loop, plane, i, corner_turn) ? std::find(places.begin(), places.end(), i) == places.end()
                                                       : !is_near(outline, places, outline.length_at(i),
                                                                  1.5 * corner_reach.back() * outline.perimeter())))
                found.push_back(i);
    }
    places.insert(places.end(), found.begin(), found.end());
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    if (places.empty()) { // a smooth loop begins low on the left
        int low = 0;
        for (int i = 1; i < n; ++i)
            if (plane.col(loop[size_t(i)]).sum() < plane.col(loop[size_t(low)]).sum())
                low = i;
        places = {low};
    }
    Places more = places;
    std::vector<std::pair<double, int>> pieces; // per arc
    for (size_t k = 0; k < places.size(); ++k) {
        const int a = places[k], b = places[(k + 1) % places.size()];
        double length = outline.length_at(b) - outline.length_at(a);
        if (length <= 0)
            length += outline.perimeter();
        const double turn = places.size() == 1 ? 2 * pi : turn_between(outline, loop, plane, a, b);
        const int by_turn = std::max(1, int(std::ceil(turn / (100 * pi / 180) - 1e-9)));
        pieces.emplace_back(length, std::max(by_turn, hole ? 1 : std::max(1, int(std::lround(length / spacing)))));
    }
    const auto total = [&] {
        int sum = 0;
        for (const auto& piece : pieces)
            sum += piece.second;
        return sum;
    };
    while (total() < 4)
        ++std::max_element(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) {
              return a.first / a.second < b.first / b.second;
          })->second;
    for (size_t k = 0; k < places.size(); ++k)
        for (int i = 1; i < pieces[k].second; ++i)
            more.push_back(place_at(outline, outline.length_at(places[k]) + pieces[k].first * i / pieces[k].second));
    std::sort(more.begin(), more.end());
    more.erase(std::unique(more.begin(), more.end()), more.end());
    return more;
}

/// An even number of vertices gives an even number of triangles: the longest arc of the outline
/// gets one more.
void make_even(std::vector<LoopPlaces>& loops, size_t outer, const Eigen::Matrix2Xd& plane)
{
    size_t count = 0;
    for (const LoopPlaces& loop : loops)
        count += loop.place.size();
    if (count % 2 == 0)
        return;
    LoopPlaces& rim = loops[outer];
    const Outline outline(rim.loop, plane);
    double longest = 0, middle = 0;
    for (size_t k = 0; k < rim.place.size(); ++k) {
        const double a = outline.length_at(rim.place[k]);
        double length = outline.length_at(rim.place[(k + 1) % rim.place.size()]) - a;
        if (length <= 0)
            length += outline.perimeter();
        if (length > longest) {
            longest = length;
            middle = a + length / 2;
        }
    }
    const int place = place_at(outline, middle);
    if (std::find(rim.place.begin(), rim.place.end(), place) == rim.place.end())
        rim.place.insert(std::upper_bound(rim.place.begin(), rim.place.end(), place), place);
}

void require_plain(const std::vector<std::vector<int>>& loops, const Blank& blank, const std::vector<int>& file_number)
{
    const auto crossing = outline_crossings(loops, blank.position);
    if (crossing.empty())
        return;
    const int v = crossing.front().edge[0];
    throw InputError(
        fmt::format("the blank overlaps itself, or its border touches itself, near boundary vertex {}: it cannot be "
                    "divided into patches; cut the part there into two",
                    file_number.empty() ? v : file_number[size_t(v)]));
}

} // namespace

double vertex_spacing(const TriMesh& part, const Blank& blank, const LayoutOptions& options)
{
    const auto loops = boundary_loops(part);
    double sheet = 0;
    for (const auto& loop : loops)
        for (size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
            sheet += 0.5 * (blank.position(0, loop[j]) * blank.position(1, loop[i]) -
                            blank.position(0, loop[i]) * blank.position(1, loop[j]));
    return options.spacing * std::sqrt(sheet / std::max<double>(1, double(loops.size()) - 1));
}

PlaneGraph border_graph(const TriMesh& part, const Blank& blank, const LayoutOptions& options,
                        const std::vector<int>& forced, bool only_forced, bool close_corners)
{
    const auto loops = boundary_loops(part);
    const size_t outer = size_t(outer_loop(loops, blank.position));
    require_plain(loops, blank, options.file_number);
    const double spacing = vertex_spacing(part, blank, options);
    std::vector<double> corner_reach = {0.02}; // of a loop's length
    if (close_corners)
        corner_reach.push_back(0.005); // two corners side by side as well
    std::vector<LoopPlaces> chosen;
    for (size_t l = 0; l < loops.size(); ++l)
        chosen.push_back({loops[l], places_of(loops[l], blank.position, l != outer, options.corner_deg * pi / 180,
                                              corner_reach, spacing, forced, only_forced)});
    if (!only_forced)
        make_even(chosen, outer, blank.position);

    PlaneGraph graph;
    for (const auto& [loop, places] : chosen) {
        const int n = int(loop.size()), first = int(graph.vertex.size()), count = int(places.size());
        if (count < 2)
            throw InputError(
                "each loop of the border needs two corners or more where corners are given; name some on every hole");
        for (const int p : places) {
            graph.vertex.push_back(blank.position.col(loop[size_t(p)]));
            graph.border.push_back(BorderTurn{blank.position.col(loop[size_t((p + n - 1) % n)]),
                                              blank.position.col(loop[size_t((p + 1) % n)])});
        }
        for (int k = 0; k < count; ++k) {
            const int a = places[size_t(k)], b = places[size_t((k + 1) % count)];
            std::vector<int> chain;
            for (int i = a;; i = (i + 1) % n) {
                chain.push_back(loop[size_t(i)]);
                if (i == b && chain.size() > 1)
                    break;
            }
            LayoutCurve curve;
            curve.vertex = {first + k, first + (k + 1) % count};
            curve.plane = blank.position(Eigen::all, chain);
            curve.part = part.position(Eigen::all, chain);
            graph.curve.push_back(std::move(curve));
        }
    }
    return graph;
}

} // namespace spia
