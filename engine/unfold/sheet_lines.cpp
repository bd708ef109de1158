#include "engine/unfold/sheet_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <map>

#include "engine/core/error.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/segment_distance.h"

namespace spia {
namespace {

using Segment = std::array<int, 2>; ///< numbers of points

/// Joins segments to lines; where more than two meet a line ends. In the order of their smallest
/// points.
std::vector<std::vector<int>> chained(const std::vector<Segment>& segments)
{
    std::map<int, std::vector<int>> at;
    for (size_t s = 0; s < segments.size(); ++s)
        for (const int p : segments[s])
            at[p].push_back(int(s));
    std::vector<char> used(segments.size(), 0);
    const auto walk = [&](int from, int segment) {
        std::vector<int> line = {from};
        for (int next = segment; next >= 0;) {
            used[size_t(next)] = 1;
            const Segment& s = segments[size_t(next)];
            const int to = s[0] == line.back() ? s[1] : s[0];
            line.push_back(to);
            next = -1;
            if (at[to].size() == 2)
                for (const int other : at[to])
                    if (!used[size_t(other)])
                        next = other;
        }
        return line;
    };
    std::vector<std::vector<int>> lines;
    for (const bool ends_first : {true, false}) // then what is left are closed ones
        for (const auto& [point, around] : at)
            if (!ends_first || around.size() != 2)
                for (const int s : around)
                    if (!used[size_t(s)])
                        lines.push_back(walk(point, s));
    std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
        return *std::min_element(a.begin(), a.end()) < *std::min_element(b.begin(), b.end());
    });
    return lines;
}

/// What lies at one place but for rounding is one point: lines that run through a vertex cross
/// several edges there.
SheetLine line_of(std::string name, std::vector<int> points, const Eigen::Matrix3Xd& position)
{
    constexpr double same = 1e-9; // of the line
    const Eigen::Matrix3Xd all = position(Eigen::all, points);
    const double close = same * (all.rowwise().maxCoeff() - all.rowwise().minCoeff()).norm();
    const auto one = [&](int a, int b) { return (position.col(a) - position.col(b)).norm() <= close; };
    points.erase(std::unique(points.begin(), points.end(), one), points.end());
    const bool closed = points.size() > 2 && one(points.front(), points.back());
    if (closed)
        points.pop_back();
    return {std::move(name), position(Eigen::all, points), closed};
}

Eigen::Matrix3Xd in_space(const Eigen::Matrix2Xd& flat)
{
    Eigen::Matrix3Xd space = Eigen::Matrix3Xd::Zero(3, flat.cols());
    space.topRows(2) = flat;
    return space;
}

/// Where a value of the vertices is one half, in straight pieces through the faces.
std::vector<SheetLine> half_way(const std::string& name, const TriMesh& part, const FaceSet& faces,
                                const Eigen::Matrix2Xd& flat, const std::map<int, double>& value)
{
    std::map<Segment, int> number; // of a point on an edge
    std::vector<Eigen::Vector3d> points;
    std::vector<Segment> pieces;
    for (const int f : faces) {
        std::vector<int> crossed;
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax({part.triangle(k, f), part.triangle((k + 1) % 3, f)});
            const Segment edge = {low, high};
            const double a = value.at(edge[0]) - 0.5, b = value.at(edge[1]) - 0.5;
            if ((a < 0) == (b < 0))
                continue;
            const auto [entry, is_new] = number.try_emplace(edge, int(points.size()));
            if (is_new) {
                const Eigen::Vector2d p = flat.col(edge[0]) + a / (a - b) * (flat.col(edge[1]) - flat.col(edge[0]));
                points.emplace_back(p[0], p[1], 0);
            }
            crossed.push_back(entry->second);
        }
        if (crossed.size() == 2)
            pieces.push_back({crossed[0], crossed[1]});
    }
    Eigen::Matrix3Xd position(3, Eigen::Index(points.size()));
    for (size_t p = 0; p < points.size(); ++p)
        position.col(Eigen::Index(p)) = points[p];
    std::vector<SheetLine> lines;
    for (const auto& chain : chained(pieces))
        // else it touches a vertex only
        if (SheetLine line = line_of(name, chain, position); line.point.cols() > 1)
            lines.push_back(std::move(line));
    return lines;
}

} // namespace

double length(const SheetLine& line)
{
    double sum = 0;
    for (Eigen::Index k = 0; k < line.point.cols() - (line.closed ? 0 : 1); ++k)
        sum += (line.point.col((k + 1) % line.point.cols()) - line.point.col(k)).norm();
    return sum;
}

void require_flat(const TriMesh& part, const Eigen::Matrix2Xd& flat)
{
    if (flat.cols() != part.position.cols() || !flat.allFinite())
        throw InputError(fmt::format("the blank has {} places, the part {} vertices; unfold this part first",
                                     flat.cols(), part.vertices()));
}

std::vector<SheetLine> trim_lines(const TriMesh& part, const Eigen::Matrix3Xd& state, const FaceSet& freed)
{
    if (state.cols() != part.position.cols())
        throw InputError("the state is none of this part; it has not a place for each vertex");
    std::vector<Segment> rim;
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin == 1 && std::binary_search(freed.begin(), freed.end(), uses[begin].face))
            rim.push_back({uses[begin].low, uses[begin].high});
    });
    std::vector<SheetLine> lines;
    for (const auto& chain : chained(rim))
        lines.push_back(line_of(fmt::format("trim {}", lines.size() + 1), chain, state));
    return lines;
}

std::vector<SheetLine> bend_lines(const TriMesh& part, const BendMap& map, const Eigen::Matrix2Xd& flat)
{
    require_flat(part, flat);
    const Eigen::Matrix3Xd space = in_space(flat);
    std::map<std::pair<int, int>, std::vector<Segment>> border; // of two labels
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin == 2)
            border[std::minmax({map.label[uses[begin].face], map.label[uses[end - 1].face]})].push_back(
                {uses[begin].low, uses[begin].high});
    });
    std::vector<FaceSet> faces_of(map.regions.size() + map.bends.size());
    for (int f = 0; f < part.triangles(); ++f)
        faces_of[size_t(map.label[f])].push_back(f);
    std::vector<SheetLine> lines;
    const auto add = [&](const std::string& name, const std::vector<Segment>& segments) {
        for (const auto& chain : chained(segments))
            lines.push_back(line_of(name, chain, space));
    };
    for (size_t k = 0; k < map.bends.size(); ++k) {
        const Bend& bend = map.bends[k];
        const int label = int(map.regions.size() + k);
        if (bend.faces == 0) {
            add(map.name(label), border[{bend.a, bend.b}]);
            continue;
        }
        if (bend.b < 0) {
            add(fmt::format("{}, {}", map.name(label), map.name(bend.a)), border[{bend.a, label}]);
            continue;
        }
        const std::vector<Segment>&from = border[{bend.a, label}], &to = border[{bend.b, label}];
        if (from.empty() || to.empty())
            continue;
        const FaceSet& faces = faces_of[size_t(label)];
        const SegmentDistance to_from(flat, from), to_to(flat, to);
        std::map<int, double> share; // 0 at region a, 1 at region b
        for (const int f : faces)
            for (const int v : part.triangle.col(f)) {
                if (share.count(v))
                    continue;
                const double a = to_from(flat.col(v)), b = to_to(flat.col(v));
                share[v] = a + b > 0 ? a / (a + b) : 0.5;
            }
        for (SheetLine& line : half_way(map.name(label), part, faces, flat, share))
            lines.push_back(std::move(line));
        add(fmt::format("{}, {}", map.name(label), map.name(bend.a)), from);
        add(fmt::format("{}, {}", map.name(label), map.name(bend.b)), to);
    }
    return lines;
}

} // namespace spia
