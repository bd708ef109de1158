#include "engine/unfold/plan/region_borders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/small_dense.h"
#include "engine/unfold/plan/label_measures.h"

namespace spia {
namespace {

/// Per face of a region how far its farthest vertex is from the plane in which most of the region
/// lies. @returns nothing if there is none
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
    double within = std::numeric_limits<double>::infinity();
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
        const Eigen::Vector3d normal = eigen_pairs(moments).vector.col(0);
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

} // namespace

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

} // namespace spia
