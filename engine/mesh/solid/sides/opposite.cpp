#include "engine/mesh/solid/sides/opposite.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mesh/pick.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using Weighted = std::vector<std::pair<double, double>>;

constexpr int most_cuts = 12; // of a side of a triangle

int cuts(const TriMesh& mesh, int face, double spacing)
{
    double longest = 0;
    for (int k = 0; k < 3; ++k)
        longest = std::max(
            longest,
            (mesh.position.col(mesh.triangle((k + 1) % 3, face)) - mesh.position.col(mesh.triangle(k, face))).norm());
    return int(std::clamp(std::ceil(longest / spacing), 1., double(most_cuts)));
}

/// Middles of the n * n similar parts of each triangle.
std::vector<Opposite> places(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, double spacing)
{
    const long most = 200'000 + 2L * mesh.triangles();
    for (;; spacing *= 1.5) {
        long count = 0, coarsest = 0;
        for (int f = 0; f < mesh.triangles(); ++f) {
            const long n = cuts(mesh, f, spacing);
            count += n * n;
            coarsest = std::max(coarsest, n);
        }
        if (count <= most || coarsest == 1)
            break;
    }
    std::vector<Opposite> result;
    for (int f = 0; f < mesh.triangles(); ++f) {
        const int n = cuts(mesh, f, spacing);
        const Eigen::Vector3d a = mesh.position.col(mesh.triangle(0, f)),
                              u = (mesh.position.col(mesh.triangle(1, f)) - a) / n,
                              v = (mesh.position.col(mesh.triangle(2, f)) - a) / n;
        const double part = normal.col(f).norm() / (n * n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                result.push_back({f, a + u * (i + 1.0 / 3) + v * (j + 1.0 / 3), part});
                if (i + j < n - 1)
                    result.push_back({f, a + u * (i + 2.0 / 3) + v * (j + 2.0 / 3), part});
            }
    }
    return result;
}

/// Of sorted values those within a ratio that have the most weight. @returns [first, last)
std::pair<size_t, size_t> heaviest(const Weighted& sorted, size_t from, size_t to, double ratio)
{
    std::pair<size_t, size_t> best{from, from};
    double weight = 0, most = -1;
    for (size_t first = from, last = from; first < to; ++first) {
        for (; last < to && sorted[last].first <= ratio * sorted[first].first; ++last)
            weight += sorted[last].second;
        if (weight > most * (1 + 1e-12)) { // not by rounding
            most = weight;
            best = {first, last};
        }
        weight -= sorted[first].second;
    }
    return best;
}

} // namespace

std::vector<Opposite> opposites(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, double spacing,
                                const Progress& progress)
{
    std::vector<Opposite> result = places(mesh, normal, spacing);
    progress.checkpoint(0.1, "looking through the sheet");
    const RayPicker rays(mesh);
    const double off = 1e-7 * bounding_diagonal(mesh); // the ray must not meet the face it comes
                                                       // from
    constexpr int chunk = 50'000;
    const auto count = int(result.size());
    for (int first = 0; first < count; first += chunk) {
        progress.checkpoint(0.1 + 0.9 * first / count, "looking through the sheet");
        parallel_for(std::min(chunk, count - first), [&](int i) {
            Opposite& at = result[size_t(first + i)];
            const Eigen::Vector3d inwards = -normal.col(at.face).normalized();
            if (inwards.isZero())
                return;
            const RayHit hit = rays.first(at.place + off * inwards, inwards);
            if (hit.face < 0 || hit.face == at.face)
                return;
            at.hit = hit.face;
            at.distance = hit.distance + off;
            at.facing = normal.col(hit.face).normalized().dot(inwards);
        });
    }
    return result;
}

double quantile(Weighted weighted, double share)
{
    std::sort(weighted.begin(), weighted.end());
    double whole = 0, below = 0;
    for (const auto& [value, weight] : weighted)
        whole += weight;
    for (const auto& [value, weight] : weighted)
        if ((below += weight) >= share * whole)
            return value;
    return weighted.back().first;
}

double main_distance(const std::vector<Opposite>& places, const std::vector<char>& counts)
{
    constexpr double facing = 0.9;
    Weighted found;
    for (size_t i = 0; i < places.size(); ++i)
        if (counts[i] && places[i].hit >= 0 && places[i].facing > facing)
            found.emplace_back(places[i].distance, places[i].area);
    if (found.empty())
        return 0;
    std::sort(found.begin(), found.end());
    const auto [from, to] = heaviest(found, 0, found.size(), 1.1);
    const auto [first, last] = heaviest(found, from, to, 1.02);
    // Flat walls are parallel and have one distance, to rounding; between chords of bends it
    // spreads.
    constexpr double parallel = 1 - 1e-9, least = 0.1;
    Weighted flat;
    double weight = 0, of_flat = 0;
    for (size_t i = first; i < last; ++i)
        weight += found[i].second;
    for (size_t i = 0; i < places.size(); ++i)
        if (counts[i] && places[i].hit >= 0 && places[i].facing > parallel &&
            places[i].distance >= found[first].first && places[i].distance <= found[last - 1].first)
            flat.emplace_back(places[i].distance, places[i].area);
    if (!flat.empty()) {
        std::sort(flat.begin(), flat.end());
        const auto [low, high] = heaviest(flat, 0, flat.size(), 1 + 1e-5);
        for (size_t i = low; i < high; ++i)
            of_flat += flat[i].second;
        if (of_flat >= least * weight)
            return quantile({flat.begin() + long(low), flat.begin() + long(high)}, 0.5);
    }
    return quantile({found.begin() + long(first), found.begin() + long(last)}, 0.5);
}

} // namespace spia
