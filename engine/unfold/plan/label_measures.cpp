#include "engine/unfold/plan/label_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace spia {

Eigen::Vector3d middle(const TriMesh& part, int face)
{
    return part.position(Eigen::all, part.triangle.col(face)).rowwise().mean();
}

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

std::vector<Eigen::Vector3d> places(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& number,
                                    size_t count)
{
    const std::vector<double> area = areas_of(turns, number, count);
    std::vector<Eigen::Vector3d> mean(count, Eigen::Vector3d::Zero()), result(count);
    std::vector<double> nearest(count, std::numeric_limits<double>::infinity());
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

} // namespace spia
