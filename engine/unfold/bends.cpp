#include "engine/unfold/bends.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>

#include "engine/core/error.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/unfold/sheet_pieces.h"
#include "engine/unfold/turns.h"

namespace spia {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();

void require_sheet(const TriMesh& part, const SheetTurns& turns)
{
    if (part.triangles() == 0)
        throw InputError("the part has no faces; there is nothing to split at bends");
    for (int f = 0; f < part.triangles(); ++f)
        if (!(turns.area[f] > 0) || !std::isfinite(turns.area[f]))
            throw InputError(fmt::format("face {} has no area; weld or remove it before looking for bends", f));
    if (turns.rim.size() + 2 * turns.edge.size() != 3 * size_t(part.triangles()))
        throw InputError("an edge belongs to more than two faces; examine the part and separate it there");
}

Eigen::Vector3d middle(const TriMesh& part, int face)
{
    return part.position(Eigen::all, part.triangle.col(face)).rowwise().mean();
}

/// How a face of a bend is reached from a region: the way along which the sheet turns.
struct Way {
    int region = -1;
    double length = far; ///< mm
    int edge = -1;       ///< the last edge of the way, towards this face
    int before = -1;     ///< the face before it
};

/// The two nearest regions of every face of a bend.
using Ways = std::vector<std::array<Way, 2>>;

/// Dijkstra from all regions at once; each face is reached by two regions at most. @param region #F, -1 on bends
Ways ways_from_regions(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& region)
{
    struct Visit {
        double length;
        int face, from, edge, before;
        bool operator>(const Visit& o) const
        {
            return std::tie(length, face, from, edge) > std::tie(o.length, o.face, o.from, o.edge);
        }
    };
    std::priority_queue<Visit, std::vector<Visit>, std::greater<>> queue;
    const auto step = [&](int f, int e) { return turns.height(turns.edge[size_t(e)], f) / 3; }; // to the edge
    for (int e = 0; e < int(turns.edge.size()); ++e) {
        const EdgeTurn& edge = turns.edge[size_t(e)];
        for (const auto& [f, g] : {std::pair(edge.face, edge.twin), std::pair(edge.twin, edge.face)})
            if (region[size_t(f)] >= 0 && region[size_t(g)] < 0)
                queue.push({step(g, e), g, region[size_t(f)], e, f});
    }
    Ways ways(region.size());
    while (!queue.empty()) {
        const Visit now = queue.top();
        queue.pop();
        std::array<Way, 2>& here = ways[size_t(now.face)];
        if (here[0].region == now.from || here[1].region >= 0)
            continue;
        here[here[0].region < 0 ? 0 : 1] = {now.from, now.length, now.edge, now.before};
        for (int k = turns.first[size_t(now.face)]; k < turns.first[size_t(now.face) + 1]; ++k) {
            const int e = turns.at[size_t(k)];
            const EdgeTurn& edge = turns.edge[size_t(e)];
            const int g = edge.face == now.face ? edge.twin : edge.face;
            if (region[size_t(g)] >= 0)
                continue;
            queue.push({now.length + (middle(part, g) - middle(part, now.face)).norm(), g, now.from, e, now.face});
        }
    }
    return ways;
}

/// Bends: connected faces of bends between the same two regions. Small ones are given to the neighbour in the network.
/// @returns per face its bend, -1 on regions
std::vector<int> split_networks(const SheetTurns& turns, const std::vector<int>& region, const Ways& ways, double least,
                                std::vector<std::pair<int, int>>& pairs)
{
    const auto pair = [&](int f) {
        const int a = ways[size_t(f)][0].region, b = ways[size_t(f)][1].region;
        return b < 0 ? std::pair(a, b) : std::minmax({a, b});
    };
    const int count = int(region.size());
    std::vector<std::pair<int, int>> of(region.size());
    for (int f = 0; f < count; ++f)
        of[size_t(f)] = pair(f);
    std::vector<int> number(region.size(), -1);
    for (;;) {
        DisjointSets sets(region.size());
        const auto both_bent = [&](const EdgeTurn& e) {
            return region[size_t(e.face)] < 0 && region[size_t(e.twin)] < 0;
        };
        for (const EdgeTurn& e : turns.edge)
            if (both_bent(e) && of[size_t(e.face)] == of[size_t(e.twin)])
                sets.join(e.face, e.twin);
        std::map<int, double> area;
        for (int f = 0; f < count; ++f)
            if (region[size_t(f)] < 0)
                area[sets.root(f)] += turns.area[f];
        std::map<int, std::map<int, double>> border;
        for (const EdgeTurn& e : turns.edge)
            if (both_bent(e))
                if (const int p = sets.root(e.face), q = sets.root(e.twin); p != q) {
                    border[p][q] += e.length;
                    border[q][p] += e.length;
                }
        int smallest = -1;
        for (const auto& [p, size] : area)
            if (size < least && border.count(p) && (smallest < 0 || size < area[smallest]))
                smallest = p;
        if (smallest < 0) {
            std::map<int, int> numbers;
            for (const auto& [p, size] : area) {
                numbers[p] = int(pairs.size());
                pairs.push_back(of[size_t(p)]);
            }
            for (int f = 0; f < count; ++f)
                if (region[size_t(f)] < 0)
                    number[size_t(f)] = numbers[sets.root(f)];
            return number;
        }
        const auto& beside = border[smallest];
        const int to = std::max_element(beside.begin(), beside.end(), [](const auto& x, const auto& y) {
                           return x.second < y.second;
                       })->first;
        const auto taken = of[size_t(to)];
        std::vector<int> moved;
        for (int f = 0; f < count; ++f)
            if (region[size_t(f)] < 0 && sets.root(f) == smallest)
                moved.push_back(f);
        for (const int f : moved)
            of[size_t(f)] = taken;
    }
}

/// The turns along a way, as of a rotation, and all of them added without their signs.
struct Turned {
    Eigen::Vector3d net = Eigen::Vector3d::Zero();
    double bulging = 0, all = 0;
    void over(const EdgeTurn& e, bool from_face)
    {
        net += (from_face ? 1 : -1) * e.turn * e.axis;
        bulging += e.bulging ? e.turn : -e.turn;
        all += e.turn;
    }
};

struct BendMeasure {
    double to_a = 0, to_b = 0;             ///< mm, of the borders
    double weight = 0, angle = 0, all = 0; ///< of the ways across, by the length of the border they begin at
};

/// The turns on the way from a face of a bend back to a region; none if that is no region of the bend.
std::optional<Turned> way_back(const SheetTurns& turns, const std::vector<int>& region, const Ways& ways, int face,
                               int towards)
{
    Turned turned;
    for (int at = face; region[size_t(at)] < 0;) {
        const auto& both = ways[size_t(at)];
        const Way* way = both[0].region == towards ? &both[0] : both[1].region == towards ? &both[1] : nullptr;
        if (!way)
            return std::nullopt;
        const EdgeTurn& e = turns.edge[size_t(way->edge)];
        turned.over(e, e.face == at);
        at = way->before;
    }
    return turned;
}

/// Across every bend from each of its borders to the other one; a border counts by its length along the axis of the turn, so
/// that it does not matter whether the mesh follows it or zigzags about it.
void measure_bends(const SheetTurns& turns, const std::vector<int>& region, const std::vector<int>& bend,
                   const Ways& ways, std::vector<Bend>& bends)
{
    std::vector<BendMeasure> measure(bends.size());
    const auto across = [&](int f, const EdgeTurn& border, int towards, double& length) {
        std::optional<Turned> turned = way_back(turns, region, ways, f, towards);
        if (!turned)
            return;
        if (border.twin != border.face)
            turned->over(border, border.twin == f);
        const double net = turned->net.norm(), along = border.axis.dot(turned->net);
        const double weight = border.length * (net > 0.1 ? std::abs(along) / net : 1);
        length += weight;
        BendMeasure& m = measure[size_t(bend[size_t(f)])];
        m.weight += weight;
        m.angle += weight * std::copysign(net, turned->bulging);
        m.all += weight * turned->all;
    };
    for (const EdgeTurn& e : turns.edge)
        for (const auto& [f, g] : {std::pair(e.face, e.twin), std::pair(e.twin, e.face)}) {
            const int k = bend[size_t(f)], r = region[size_t(g)];
            if (k < 0 || r < 0)
                continue;
            const Bend& of = bends[size_t(k)];
            BendMeasure& m = measure[size_t(k)];
            if (of.b < 0 && r == of.a)
                m.to_a += e.length;
            else if (r == of.a)
                across(f, e, of.b, m.to_a);
            else if (r == of.b)
                across(f, e, of.a, m.to_b);
        }
    for (const EdgeTurn& e : turns.rim)
        if (const int k = bend[size_t(e.face)]; k >= 0 && bends[size_t(k)].b < 0)
            across(e.face, e, bends[size_t(k)].a, measure[size_t(k)].to_b);
    for (size_t k = 0; k < bends.size(); ++k) {
        const BendMeasure& m = measure[k];
        bends[k].length = m.to_a > 0 && m.to_b > 0 ? (m.to_a + m.to_b) / 2 : m.to_a + m.to_b;
        bends[k].angle = m.weight > 0 ? m.angle / m.weight : 0;
        const double turn = m.weight > 0 ? m.all / m.weight : 0;
        bends[k].radius = turn > 0 && bends[k].length > 0 ? bends[k].area / (bends[k].length * turn) : 0;
    }
}

/// Sharp edges between two regions that touch without a band.
std::vector<Bend> sharp_bends(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& region)
{
    std::map<std::pair<int, int>, Bend> found;
    std::map<std::pair<int, int>, double> longest;
    for (const EdgeTurn& e : turns.edge) {
        const int r = region[size_t(e.face)], s = region[size_t(e.twin)];
        if (r < 0 || s < 0 || r == s)
            continue;
        const std::pair key = std::minmax({r, s});
        Bend& bend =
            found.try_emplace(key, Bend{key.first, key.second, 0, 0, 0, 0, 0, Eigen::Vector3d::Zero()}).first->second;
        bend.length += e.length;
        bend.angle += e.length * (e.bulging ? e.turn : -e.turn);
        if (e.length > longest[key]) {
            longest[key] = e.length;
            bend.place = (middle(part, e.face) + middle(part, e.twin)) / 2;
        }
    }
    std::vector<Bend> result;
    for (auto& [key, bend] : found) {
        bend.angle /= bend.length;
        result.push_back(bend);
    }
    std::stable_sort(result.begin(), result.end(), [](const Bend& x, const Bend& y) { return x.length > y.length; });
    return result;
}

/// Numbers from the largest down; equally large ones (to rounding) in the order of their first face.
std::vector<int> by_area(const std::vector<double>& area)
{
    std::vector<int> order(area.size()), rank(area.size());
    std::iota(order.begin(), order.end(), 0);
    const double total = std::accumulate(area.begin(), area.end(), 0.0);
    const auto rounded = [&](int i) { return std::llround(area[size_t(i)] / total * 1e9); };
    std::stable_sort(order.begin(), order.end(), [&](int i, int k) { return rounded(i) > rounded(k); });
    for (size_t k = 0; k < order.size(); ++k)
        rank[size_t(order[k])] = int(k);
    return rank;
}

std::vector<double> areas_of(const SheetTurns& turns, const std::vector<int>& number, size_t count)
{
    std::vector<double> area(count, 0);
    for (size_t f = 0; f < number.size(); ++f)
        if (number[f] >= 0)
            area[size_t(number[f])] += turns.area[Eigen::Index(f)];
    return area;
}

/// The middle of the face that is nearest to the mean place, per number.
std::vector<Eigen::Vector3d> places(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& number,
                                    size_t count)
{
    const std::vector<double> area = areas_of(turns, number, count);
    std::vector<Eigen::Vector3d> mean(count, Eigen::Vector3d::Zero()), result(count);
    std::vector<double> nearest(count, far);
    for (int pass = 0; pass < 2; ++pass)
        for (int f = 0; f < part.triangles(); ++f) {
            const int k = number[size_t(f)];
            if (k < 0)
                continue;
            const Eigen::Vector3d at = middle(part, f);
            if (pass == 0)
                mean[size_t(k)] += turns.area[f] / area[size_t(k)] * at;
            else if (const double d = (at - mean[size_t(k)]).norm(); d < nearest[size_t(k)]) {
                nearest[size_t(k)] = d;
                result[size_t(k)] = at;
            }
        }
    return result;
}

struct Bands {
    std::vector<int> of; ///< #F, into bends; -1 on regions
    std::vector<Bend> bends;
};

Bands find_bands(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& region, double least)
{
    const Ways ways = ways_from_regions(part, turns, region);
    std::vector<std::pair<int, int>> pairs;
    Bands bands{split_networks(turns, region, ways, least, pairs), std::vector<Bend>(pairs.size())};
    const std::vector<int> order = by_area(areas_of(turns, bands.of, pairs.size()));
    for (int& k : bands.of)
        k = k < 0 ? -1 : order[size_t(k)];
    const std::vector<double> area = areas_of(turns, bands.of, pairs.size());
    const std::vector<Eigen::Vector3d> place = places(part, turns, bands.of, pairs.size());
    for (size_t k = 0; k < pairs.size(); ++k) {
        const auto n = size_t(order[k]);
        bands.bends[n] = {pairs[k].first,
                          pairs[k].second,
                          int(std::count(bands.of.begin(), bands.of.end(), int(n))),
                          area[n],
                          0,
                          0,
                          0,
                          place[n]};
    }
    measure_bends(turns, region, bands.of, ways, bands.bends);
    return bands;
}

/// What is curved more within a region, but ends there or at the rim without a definite turn, belongs to the region.
bool give_dents(const Bands& bands, std::vector<int>& region)
{
    constexpr double definite = 0.5; // radians
    bool given = false;
    for (size_t f = 0; f < region.size(); ++f) {
        if (region[f] >= 0)
            continue;
        const Bend& bend = bands.bends[size_t(bands.of[f])];
        if (bend.b < 0 && std::abs(bend.angle) < definite) {
            region[f] = bend.a;
            given = true;
        }
    }
    return given;
}

std::vector<SheetRegion> measured_regions(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& region,
                                          size_t count)
{
    const std::vector<double> area = areas_of(turns, region, count);
    const std::vector<Eigen::Vector3d> place = places(part, turns, region, count);
    std::vector<SheetRegion> result;
    for (size_t r = 0; r < count; ++r)
        result.push_back({0, area[r], 0, Eigen::Vector3d::Zero(), place[r]});
    for (int f = 0; f < part.triangles(); ++f)
        if (const int r = region[size_t(f)]; r >= 0) {
            ++result[size_t(r)].faces;
            result[size_t(r)].normal += turns.area[f] / area[size_t(r)] * turns.normal.col(f);
        }
    for (SheetRegion& r : result) {
        r.flatness = r.normal.norm();
        r.normal.normalize();
    }
    return result;
}

/// Per face of a region how far its farthest vertex is from the plane in which most of the region lies. @returns nothing if
/// there is none
std::vector<double> off_plane(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& faces, double most)
{
    constexpr double share = 0.7; // of the area, that has to lie in the plane
    constexpr int passes = 15;
    std::vector<double> off(faces.size(), 0);
    std::vector<size_t> order(faces.size());
    std::iota(order.begin(), order.end(), size_t(0));
    double total = 0;
    for (const int f : faces)
        total += turns.area[f];
    double within = far;
    for (int pass = 0; pass < passes; ++pass) {
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
        double sum = 0;
        for (size_t k = 0; k < faces.size(); ++k)
            if (off[k] <= within) {
                centre += turns.area[faces[k]] * middle(part, faces[k]);
                sum += turns.area[faces[k]];
            }
        centre /= sum;
        for (size_t k = 0; k < faces.size(); ++k)
            if (off[k] <= within)
                for (const int v : part.triangle.col(faces[k])) {
                    const Eigen::Vector3d arm = part.position.col(v) - centre;
                    moments += turns.area[faces[k]] * arm * arm.transpose();
                }
        const Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().col(0);
        for (size_t k = 0; k < faces.size(); ++k) {
            off[k] = 0;
            for (const int v : part.triangle.col(faces[k]))
                off[k] = std::max(off[k], std::abs(normal.dot(part.position.col(v) - centre)));
        }
        std::stable_sort(order.begin(), order.end(), [&](size_t i, size_t k) { return off[i] < off[k]; });
        double inner = 0;
        for (const size_t k : order) {
            inner += turns.area[faces[k]];
            within = off[k];
            if (inner >= share * total)
                break;
        }
        within = std::max(within, most);
    }
    return within > most ? std::vector<double>() : off;
}

/// Faces of plane regions that only lead to a bend: on a mesh that does not follow the bend lines, they lie across them.
void give_borders(const TriMesh& part, const SheetTurns& turns, double most, int regions, std::vector<int>& region)
{
    std::vector<char> leaves(region.size(), 0);
    for (int r = 0; r < regions; ++r) {
        std::vector<int> faces;
        for (size_t f = 0; f < region.size(); ++f)
            if (region[f] == r)
                faces.push_back(int(f));
        const std::vector<double> off = off_plane(part, turns, faces, most);
        for (size_t k = 0; k < off.size(); ++k)
            leaves[size_t(faces[k])] = off[k] > most;
    }
    std::vector<int> queue;
    for (size_t f = 0; f < region.size(); ++f)
        if (region[f] < 0)
            queue.push_back(int(f));
    for (size_t next = 0; next < queue.size(); ++next)
        for (int k = turns.first[size_t(queue[next])]; k < turns.first[size_t(queue[next]) + 1]; ++k) {
            const EdgeTurn& e = turns.edge[size_t(turns.at[size_t(k)])];
            const int g = e.face == queue[next] ? e.twin : e.face;
            if (region[size_t(g)] >= 0 && leaves[size_t(g)]) {
                region[size_t(g)] = -1;
                queue.push_back(g);
            }
        }
}

} // namespace

BendMap find_bends(const TriMesh& part, const BendLimits& limits)
{
    if (!(limits.curvature > 0) || !(limits.sharp > 0) || !(limits.least_area >= 0 && limits.least_area < 1))
        throw InputError("the limits of bends must be positive, the least area a share below 1");
    const SheetTurns turns = sheet_turns(part);
    require_sheet(part, turns);
    const double side = std::sqrt(turns.area.sum());
    const SheetPieces pieces = sheet_pieces(turns, side, limits);

    std::vector<int> region(size_t(part.triangles()), -1), number(pieces.is_region.size(), -1);
    int regions = 0;
    for (size_t p = 0; p < number.size(); ++p)
        if (pieces.is_region[p])
            number[p] = regions++;
    for (size_t f = 0; f < region.size(); ++f)
        region[f] = number[size_t(pieces.piece[f])];
    give_borders(part, turns, limits.off_plane * side, regions, region);
    const std::vector<int> rank = by_area(areas_of(turns, region, size_t(regions)));
    for (int& r : region)
        r = r < 0 ? -1 : rank[size_t(r)];

    BendMap result;
    result.side = side;
    result.smoothed = turns.smoothed;
    const double least = limits.least_area * side * side * (turns.smoothed ? 5 : 1);
    Bands bands = find_bands(part, turns, region, least);
    if (give_dents(bands, region))
        bands = find_bands(part, turns, region, least);
    result.regions = measured_regions(part, turns, region, size_t(regions));
    result.bends = bands.bends;
    for (const Bend& sharp : sharp_bends(part, turns, region))
        result.bends.push_back(sharp);
    result.label.resize(part.triangles());
    for (int f = 0; f < part.triangles(); ++f)
        result.label[f] = region[size_t(f)] >= 0 ? region[size_t(f)] : regions + bands.of[size_t(f)];
    return result;
}

FaceSet BendMap::faces_of(int wanted) const
{
    FaceSet faces;
    for (int f = 0; f < int(label.size()); ++f)
        if (label[f] == wanted)
            faces.push_back(f);
    return faces;
}

double BendMap::area_of(int wanted) const
{
    const auto k = size_t(wanted);
    return k < regions.size() ? regions[k].area : bends[k - regions.size()].area;
}

std::string BendMap::name(int wanted) const
{
    return wanted < int(regions.size()) ? fmt::format("region {}", wanted + 1)
                                        : fmt::format("bend {}", wanted - int(regions.size()) + 1);
}

} // namespace spia
