#include "engine/pipeline/blank/parts_of_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Per sharp bend of the map the share of its length that a bend of the table is beside: there it
/// is an edge of a chord, also where the chord counts to the region of the flat beside it.
std::vector<double> beside_chords(const TriMesh& part, const BendMap& map, const std::vector<int>& bend_of)
{
    std::map<std::pair<int, int>, std::pair<double, double>> length; // by regions: of all, beside chords
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end != begin + 2)
            return;
        const int f = uses[begin].face, g = uses[begin + 1].face;
        auto& [all, beside] = length[std::minmax(map.label[f], map.label[g])];
        const double edge = (part.position.col(uses[begin].low) - part.position.col(uses[begin].high)).norm();
        all += edge;
        beside += bend_of[size_t(f)] >= 0 || bend_of[size_t(g)] >= 0 ? edge : 0;
    });
    std::vector<double> share;
    for (const Bend& bend : map.bends) {
        const auto at = bend.faces == 0 ? length.find({bend.a, bend.b}) : length.end();
        share.push_back(at == length.end() ? 0 : at->second.second / at->second.first);
    }
    return share;
}

} // namespace

std::vector<int> bends_in_table(const BendMap& map, const BendTable& table, std::vector<char>& taken)
{
    std::vector<int> result(map.bends.size(), -1);
    taken.assign(table.bends.size(), 0);
    for (size_t j = 0; j < table.bends.size(); ++j) {
        if (table.bends[j].sharp)
            continue;
        std::map<int, int> faces_of; // label
        for (const int f : table.bends[j].faces)
            ++faces_of[map.label[f]];
        const auto most = std::max_element(faces_of.begin(), faces_of.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        if (most == faces_of.end() || most->first < int(map.regions.size()))
            continue;
        int& bend = result[size_t(most->first) - map.regions.size()];
        if (bend >= 0)
            continue; // two cylinders beside each other, which the map takes for one bend: the
                      // second is drawn by itself
        bend = int(j);
        taken[j] = 1;
    }
    return result;
}

std::vector<char> parts_of_table(const TriMesh& part, const BendMap& map, const BendTable& table)
{
    constexpr double mostly = 0.5, small = 0.1; // of the area, and of that of the bend beside it
    constexpr double sharp = 0.6;               // radians: chords of one bend turn by less
    std::vector<int> bend_of(size_t(part.triangles()), -1), at(size_t(part.vertices()), -1);
    std::vector<double> size(table.bends.size(), 0);
    const Eigen::VectorXd area = area_vectors(part).colwise().norm() / 2;
    for (size_t j = 0; j < table.bends.size(); ++j)
        for (const int f : table.bends[j].sharp ? std::vector<int>{} : table.bends[j].faces) {
            bend_of[size_t(f)] = int(j);
            size[j] += area[f];
            for (const int v : part.triangle.col(f))
                at[size_t(v)] = int(j);
        }
    std::vector<double> whole(map.bends.size(), 0), inside(whole.size(), 0), beside(whole.size(), 0);
    for (int f = 0; f < part.triangles(); ++f) {
        const int k = map.label[f] - int(map.regions.size());
        if (k < 0)
            continue;
        whole[size_t(k)] += area[f];
        inside[size_t(k)] += bend_of[size_t(f)] >= 0 ? area[f] : 0;
        for (const int v : part.triangle.col(f))
            if (const int j = at[size_t(v)]; j >= 0)
                beside[size_t(k)] = std::max(beside[size_t(k)], size[size_t(j)]);
    }
    // A sharp bend has no faces: it lies between those of its two regions, one of which is a piece
    // of a bend.
    std::vector<double> region(map.regions.size(), 0), in_bend(region), by_region(region);
    for (int f = 0; f < part.triangles(); ++f)
        if (const auto r = size_t(map.label[f]); r < region.size()) {
            region[r] += area[f];
            in_bend[r] += bend_of[size_t(f)] >= 0 ? area[f] : 0;
            for (const int v : part.triangle.col(f))
                if (const int j = at[size_t(v)]; j >= 0)
                    by_region[r] = std::max(by_region[r], size[size_t(j)]);
        }
    const auto of_bend = [&](int r) {
        return in_bend[size_t(r)] > mostly * region[size_t(r)] || region[size_t(r)] < small * by_region[size_t(r)];
    };
    const std::vector<double> chords = beside_chords(part, map, bend_of);
    std::vector<char> result;
    for (size_t k = 0; k < map.bends.size(); ++k) {
        const Bend& bend = map.bends[k];
        const bool edge = bend.faces == 0 && bend.b >= 0 && std::abs(bend.angle) < sharp &&
                          (of_bend(bend.a) || of_bend(bend.b) || chords[k] > mostly);
        result.push_back(bend.faces == 0 ? edge : inside[k] > mostly * whole[k] || whole[k] < small * beside[k]);
    }
    return result;
}

} // namespace spia
