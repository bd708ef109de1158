#include "engine/unfold/plan/bend_bands.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "engine/unfold/plan/bend_networks.h"
#include "engine/unfold/plan/label_measures.h"

namespace spia {
namespace {

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
    double weight = 0, angle = 0, all = 0; ///< of the ways across, by the length of the border they
                                           ///< begin at
};

/// The turns on the way from a face of a bend back to a region; none if that is no region of the
/// bend.
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

/// Across every bend from each of its borders to the other one; a border counts by its length along
/// the axis of the turn, so that it does not matter whether the mesh follows it or zigzags about
/// it.
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

} // namespace

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
    std::vector<int> faces(pairs.size(), 0);
    for (const int k : bands.of)
        if (k >= 0)
            ++faces[size_t(k)];
    for (size_t k = 0; k < pairs.size(); ++k) {
        const auto n = size_t(order[k]);
        bands.bends[n] = {pairs[k].first, pairs[k].second, faces[n], area[n], 0, 0, 0, place[n]};
    }
    measure_bends(turns, region, bands.of, ways, bands.bends);
    return bands;
}

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

} // namespace spia
