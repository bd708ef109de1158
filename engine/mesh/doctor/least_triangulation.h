#pragma once

#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace spia {

/// A closed polygon's corners 0 to n - 1 divided into triangles.
struct Triangulation {
    double cost = 0;                           ///< infinite: there is none
    std::vector<std::array<int, 3>> triangles; ///< n - 2, in the direction of the polygon
};

/// Of all ways to divide a polygon into triangles the one that costs least (G. Klincsek, Minimal
/// triangulations of polygonal domains, 1980). The work grows with the third power of the corners.
/// @param side      cost of a side of the polygon, beside which there is no triangle
/// @param chord     whether two triangles may meet in the line between corners i < j
/// @param triangle  cost of the triangle of corners i < k < j
/// @param join      cost of a triangle and of what is on both its other sides, together: their sum,
/// or the largest
template <typename Chord, typename Triangle, typename Join>
Triangulation least_triangulation(size_t n, double side, Chord chord, Triangle triangle, Join join)
{
    constexpr double infinite = std::numeric_limits<double>::infinity();
    std::vector<double> least(n * n, side); // of the corners i to j with their chord
    std::vector<size_t> third(n * n, 0);
    for (size_t span = 2; span < n; ++span)
        for (size_t i = 0; i + span < n; ++i) {
            const size_t j = i + span;
            double& best = least[i * n + j] = infinite;
            if (span + 1 < n && !chord(i, j))
                continue;
            for (size_t k = i + 1; k < j; ++k) {
                const double with = join(least[i * n + k], least[k * n + j], triangle(i, k, j));
                if (with < best) {
                    best = with;
                    third[i * n + j] = k;
                }
            }
        }
    Triangulation result{least[n - 1], {}};
    if (!(result.cost < infinite))
        return result;
    std::vector<std::pair<size_t, size_t>> open{{0, n - 1}};
    while (!open.empty()) {
        const auto [i, j] = open.back();
        open.pop_back();
        if (j < i + 2)
            continue;
        const size_t k = third[i * n + j];
        result.triangles.push_back({int(i), int(k), int(j)});
        open.emplace_back(i, k);
        open.emplace_back(k, j);
    }
    return result;
}

} // namespace spia
