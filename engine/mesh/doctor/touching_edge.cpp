#include "engine/mesh/doctor/touching_edge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace spia {

std::optional<std::array<int, 4>> touching_edge(std::span<const EdgeUse> uses, const std::vector<Triangle>& triangle,
                                                const std::vector<Eigen::Vector3d>& position)
{
    if (uses.size() != 4)
        return std::nullopt;
    const Eigen::Vector3d& from = position[size_t(uses[0].low)];
    const Eigen::Vector3d along = (position[size_t(uses[0].high)] - from).normalized();
    const Eigen::Vector3d x = along.unitOrthogonal(), y = along.cross(x);
    std::array<double, 4> angle{};
    std::array<int, 4> around{0, 1, 2, 3};
    for (size_t i = 0; i < 4; ++i) {
        const Triangle& t = triangle[size_t(uses[i].face)];
        const int apex = t[0] + t[1] + t[2] - uses[i].low - uses[i].high;
        const Eigen::Vector3d arm = position[size_t(apex)] - from;
        angle[i] = std::atan2(arm.dot(y), arm.dot(x));
    }
    std::sort(around.begin(), around.end(), [&](int i, int j) { return angle[size_t(i)] < angle[size_t(j)]; });
    constexpr double apart = 1e-3; // radians: faces on each other are no touching edge
    for (size_t i = 0; i < 4; ++i) {
        const size_t next = (i + 1) % 4;
        const double turn =
            angle[size_t(around[next])] - angle[size_t(around[i])] + (next == 0 ? 2 * std::numbers::pi : 0);
        if (turn < apart || uses[size_t(around[i])].forward == uses[size_t(around[next])].forward)
            return std::nullopt;
    }
    // Seen along the edge, the inside is behind a face that has the edge forward: the face before
    // it is the other side.
    std::array<int, 4> pairs{};
    size_t at = 0;
    for (size_t i = 0; i < 4; ++i)
        if (uses[size_t(around[i])].forward) {
            pairs[at++] = around[(i + 3) % 4];
            pairs[at++] = around[i];
        }
    return pairs;
}

} // namespace spia
