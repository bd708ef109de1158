#include "engine/mesh/cut/ring_strain.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/infinity.h"

namespace spia {
namespace {

using Eigen::Vector3d;

constexpr int levels = 24;

/// Length of the lines at the distances (i + 1/2) / levels * reach.
std::array<double, levels> level_lengths(const FrontMarch& march)
{
    std::array<double, levels> length{};
    const TriMesh& part = march.part();
    const double step = march.end() / levels;
    for (const int f : march.crossed_faces()) {
        std::array<double, 3> t;
        for (int k = 0; k < 3; ++k)
            t[size_t(k)] = march.distance(part.triangle(k, f));
        const auto [low, high] = std::minmax({t[0], t[1], t[2]});
        const int from = std::max(0, int(std::ceil(low / step - 0.5)));
        for (int i = from; i < levels && (i + 0.5) * step < high; ++i) {
            const double level = (i + 0.5) * step;
            std::array<Vector3d, 2> end;
            int ends = 0;
            for (int k = 0; k < 3 && ends < 2; ++k) {
                const double p = t[size_t(k)], q = t[size_t((k + 1) % 3)];
                if ((p <= level) == (q <= level))
                    continue;
                const double share = (level - p) / (q - p);
                end[size_t(ends++)] = (1 - share) * part.position.col(part.triangle(k, f)) +
                                      share * part.position.col(part.triangle((k + 1) % 3, f));
            }
            if (ends == 2)
                length[size_t(i)] += (end[1] - end[0]).norm();
        }
    }
    return length;
}

} // namespace

RingStrain ring_strain(FrontMarch& march, const std::vector<int>& loop, const std::vector<char>& stop)
{
    march.run(loop, stop);
    RingStrain result;
    result.reach = march.end();
    if (!(march.end() > 0))
        return result;
    const auto length = level_lengths(march);
    result.widest = *std::max_element(length.begin(), length.end());
    // Near the hole the line has its waves, near the next loop it is torn: neither says anything of
    // the ring.
    constexpr int first = 1, last = levels - 2;
    std::vector<double> turn, size; // integral of ds / l, logarithm of l
    double sum = 0;
    for (int i = 0; i <= last; ++i) {
        if (!(length[size_t(i)] > 0))
            return result;
        const double step = march.end() / levels / length[size_t(i)];
        sum += step / 2;
        if (i >= first) {
            turn.push_back(sum);
            size.push_back(std::log(length[size_t(i)]));
        }
        sum += step / 2;
    }
    const auto spread = [&](double around) { // the fan's angle
        double low = infinity, high = -infinity;
        for (size_t i = 0; i < turn.size(); ++i) {
            const double scale = around * turn[i] - size[i];
            low = std::min(low, scale);
            high = std::max(high, scale);
        }
        return high - low;
    };
    constexpr double full = 2 * std::numbers::pi;
    result.ring = std::min(spread(full), spread(-full)); // the hole may be the outer edge of the
                                                         // blank
    result.fan = result.ring;
    constexpr int fans = 64;
    for (int i = -fans; i <= fans; ++i)
        result.fan = std::min(result.fan, spread(full * i / fans));
    return result;
}

} // namespace spia
