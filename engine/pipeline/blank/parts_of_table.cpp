#include "engine/pipeline/blank/parts_of_table.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/mesh/topology.h"

namespace spia {

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
    std::vector<char> result;
    for (size_t k = 0; k < map.bends.size(); ++k) {
        const Bend& bend = map.bends[k];
        const bool edge =
            bend.faces == 0 && bend.b >= 0 && std::abs(bend.angle) < sharp && (of_bend(bend.a) || of_bend(bend.b));
        result.push_back(bend.faces == 0 ? edge : inside[k] > mostly * whole[k] || whole[k] < small * beside[k]);
    }
    return result;
}

} // namespace spia
