#include "app/viewer/views/isolines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace spia::viewer {
namespace {

/// A piece of a line within one face; its ends lie on edges of the mesh, known by their two
/// vertices.
struct Piece {
    std::array<uint64_t, 2> edge;
    std::array<Eigen::Vector3d, 2> end;
};

uint64_t edge_of(int a, int b) { return uint64_t(std::min(a, b)) << 32 | uint64_t(std::max(a, b)); }

/// Always from the lower vertex, so that both faces of an edge find the same place to the last bit.
Eigen::Vector3d crossing(const Eigen::Matrix3Xd& position, const Eigen::VectorXd& value, double level, int a, int b)
{
    if (a > b)
        std::swap(a, b);
    const double t = (level - value[a]) / (value[b] - value[a]);
    return (1 - t) * position.col(a) + t * position.col(b);
}

/// By level. A vertex of just that value counts as above, so a line never ends in a vertex.
std::vector<std::vector<Piece>> pieces_of(const Eigen::Matrix3Xd& position, const Eigen::Matrix3Xi& triangle,
                                          const Eigen::VectorXd& value, const std::vector<double>& level)
{
    std::vector<std::vector<Piece>> pieces(level.size());
    for (Eigen::Index f = 0; f < triangle.cols(); ++f) {
        const Eigen::Vector3i corner = triangle.col(f);
        const double a = value[corner[0]], b = value[corner[1]], c = value[corner[2]];
        const double low = std::min({a, b, c}), high = std::max({a, b, c});
        if (!std::isfinite(a + b + c) || !(low < high))
            continue;
        const auto first = std::upper_bound(level.begin(), level.end(), low);
        for (auto at = first; at != level.end() && *at <= high; ++at) {
            const std::array<bool, 3> above{a >= *at, b >= *at, c >= *at};
            const int alone = above[1] == above[2] ? 0 : above[0] == above[2] ? 1 : 2;
            const int tip = corner[alone], left = corner[(alone + 1) % 3], right = corner[(alone + 2) % 3];
            pieces[size_t(at - level.begin())].push_back(
                {{edge_of(tip, left), edge_of(tip, right)},
                 {crossing(position, value, *at, tip, left), crossing(position, value, *at, tip, right)}});
        }
    }
    return pieces;
}

/// Ends on the same edge belong together. @return per end (2 * piece + 0 or 1) the other one; -1:
/// the line ends here
std::vector<int> partners(const std::vector<Piece>& pieces)
{
    std::vector<std::pair<uint64_t, int>> ends;
    for (size_t i = 0; i < pieces.size(); ++i)
        for (size_t k = 0; k < 2; ++k)
            ends.emplace_back(pieces[i].edge[k], int(2 * i + k));
    std::sort(ends.begin(), ends.end());
    std::vector<int> partner(ends.size(), -1);
    for (size_t i = 0; i + 1 < ends.size(); ++i)
        if (ends[i].first == ends[i + 1].first) {
            partner[size_t(ends[i].second)] = ends[i + 1].second;
            partner[size_t(ends[i + 1].second)] = ends[i].second;
            ++i;
        }
    return partner;
}

void join(const std::vector<Piece>& pieces, double level, std::vector<Isoline>& lines)
{
    const std::vector<int> partner = partners(pieces);
    std::vector<char> used(pieces.size(), 0);
    std::vector<Eigen::Vector3d> row;
    const auto follow = [&](int end) { // into the piece at this end, and on
        row.assign(1, pieces[size_t(end / 2)].end[size_t(end % 2)]);
        while (end >= 0 && !used[size_t(end / 2)]) {
            used[size_t(end / 2)] = 1;
            const int other = end ^ 1;
            row.push_back(pieces[size_t(other / 2)].end[size_t(other % 2)]);
            end = partner[size_t(other)];
        }
        Isoline line{level, Eigen::Matrix3Xd(3, Eigen::Index(row.size()))};
        for (size_t i = 0; i < row.size(); ++i)
            line.point.col(Eigen::Index(i)) = row[i];
        lines.push_back(std::move(line));
    };
    for (int end = 0; end < int(partner.size()); ++end)
        if (partner[size_t(end)] < 0 && !used[size_t(end / 2)])
            follow(end);
    for (int end = 0; end < int(partner.size()); end += 2) // what is left is closed
        if (!used[size_t(end / 2)])
            follow(end);
}

/// A line on the screen as far as it is in the view: pixels and depth, and the length up to each
/// point.
struct Run {
    double value;
    std::vector<glm::dvec3> point;
    std::vector<double> length{};

    glm::dvec3 at(double along) const
    {
        const auto next = std::upper_bound(length.begin() + 1, length.end() - 1, along);
        const size_t i = size_t(next - length.begin());
        const double step = length[i] - length[i - 1];
        return glm::mix(point[i - 1], point[i], step > 0 ? std::clamp((along - length[i - 1]) / step, 0., 1.) : 0.);
    }
};

/// The part of a piece within the view, as shares of the piece; nothing if it is outside.
bool clip(const glm::dvec3& a, const glm::dvec3& b, glm::dvec2 size, double& from, double& to)
{
    from = 0, to = 1;
    for (int k = 0; k < 2; ++k) {
        const double step = b[k] - a[k];
        if (step == 0 && (a[k] < 0 || a[k] > size[k]))
            return false;
        if (step == 0)
            continue;
        const double one = -a[k] / step, other = (size[k] - a[k]) / step;
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
    }
    return from < to;
}

std::vector<Run> runs_of(const std::vector<Isoline>& lines, const Camera& camera, glm::dvec2 size, double shortest)
{
    std::vector<Run> runs;
    Run run;
    const auto finish = [&] {
        run.length.assign(1, 0);
        for (size_t i = 1; i < run.point.size(); ++i)
            run.length.push_back(run.length.back() +
                                 glm::length(glm::dvec2(run.point[i]) - glm::dvec2(run.point[i - 1])));
        if (run.length.back() >= shortest)
            runs.push_back(run);
        run.point.clear();
    };
    for (const Isoline& line : lines) {
        run.value = line.value;
        glm::dvec3 last(0);
        for (Eigen::Index i = 0; i < line.point.cols(); ++i) {
            const glm::dvec3 here = pixel_of(camera, line.point.col(i), size);
            double from, to;
            if (i > 0 && !std::isnan(last.x) && !std::isnan(here.x) && clip(last, here, size, from, to)) {
                if (from > 0)
                    finish();
                if (run.point.empty())
                    run.point.push_back(glm::mix(last, here, from));
                run.point.push_back(glm::mix(last, here, to));
                if (to < 1)
                    finish();
            } else if (!run.point.empty())
                finish();
            last = here;
        }
        finish();
    }
    std::stable_sort(runs.begin(), runs.end(),
                     [](const Run& a, const Run& b) { return a.length.back() > b.length.back(); });
    return runs;
}

} // namespace

std::vector<Isoline> isolines(const Eigen::Matrix3Xd& position, const Eigen::Matrix3Xi& triangle,
                              const Eigen::VectorXd& value, const std::vector<double>& level)
{
    std::vector<Isoline> lines;
    const auto pieces = pieces_of(position, triangle, value, level);
    for (size_t k = 0; k < level.size(); ++k)
        join(pieces[k], level[k], lines);
    return lines;
}

std::vector<IsolineLabel> isoline_labels(const std::vector<Isoline>& lines, const Camera& camera, glm::dvec2 size,
                                         const std::function<std::pair<std::string, glm::dvec2>(double)>& text,
                                         const Hidden& hidden, const std::vector<PixelBox>& taken, double scale)
{
    const double shortest = 80 * scale, spacing = 260 * scale, step = 14 * scale, apart = 90 * scale, air = 8 * scale;
    constexpr int most_per_level = 5, looks = 8; // looks: how often it is asked whether a place is
                                                 // hidden
    std::vector<PixelBox> full = taken;
    std::vector<IsolineLabel> labels;
    struct OfLevel {
        double value;
        std::vector<glm::dvec2> place;
    };
    std::vector<OfLevel> levels;
    for (const Run& run : runs_of(lines, camera, size, shortest)) {
        auto level = std::find_if(levels.begin(), levels.end(), [&](const OfLevel& l) { return l.value == run.value; });
        if (level == levels.end())
            level = levels.insert(levels.end(), {run.value, {}});
        const auto [words, extent] = text(run.value);
        const double whole = run.length.back();
        const int slots = std::max(1, int(whole / spacing));
        for (int slot = 0; slot < slots && int(level->place.size()) < most_per_level; ++slot) {
            struct Spot {
                double along, cost;
            };
            std::vector<Spot> spots;
            const double length = whole / slots, middle = (slot + 0.5) * length;
            for (double away = 0; away <= 0.4 * length; away += step)
                for (const double along : {middle - away, middle + away}) {
                    // Where the line bends under the text, nobody sees which way it goes on.
                    const double reach = 0.5 * extent.x + air;
                    const double a = std::max(0., along - reach), b = std::min(whole, along + reach);
                    const double straight = glm::length(glm::dvec2(run.at(b)) - glm::dvec2(run.at(a))) / (b - a);
                    if (straight > 0.8)
                        spots.push_back({along, away / length + 2 * (1 - straight)});
                }
            std::stable_sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) { return a.cost < b.cost; });
            int looked = 0;
            for (const Spot& spot : spots) {
                const glm::dvec3 place = run.at(spot.along);
                const PixelBox box = around(glm::dvec2(place), extent);
                if (!inside(box, size) || meets_any(grown(box, air), full) ||
                    std::any_of(level->place.begin(), level->place.end(),
                                [&](glm::dvec2 p) { return glm::length(p - glm::dvec2(place)) < apart; }))
                    continue;
                if (hidden(place)) {
                    if (++looked >= looks)
                        break;
                    continue;
                }
                labels.push_back({words, box});
                full.push_back(box);
                level->place.push_back(place);
                break;
            }
        }
    }
    return labels;
}

} // namespace spia::viewer
