#include "engine/mesh/edge_uses.h"

#include <algorithm>
#include <tuple>

namespace spia {

std::vector<EdgeUse> edge_uses(const Eigen::Ref<const Eigen::Matrix3Xi>& triangle)
{
    if (triangle.size() == 0)
        return {};
    // By the lower vertex with a table of the vertices, as each has but a few edges: a sixth to
    // a third of the time that a sort of all sides takes, and a run asks for the list thirty times.
    std::vector<size_t> end(size_t(triangle.maxCoeff()) + 2, 0);
    const auto each_side = [&](const auto& visit) {
        for (int f = 0; f < triangle.cols(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int a = triangle(k, f), b = triangle((k + 1) % 3, f);
                visit(EdgeUse{std::min(a, b), std::max(a, b), f, k, a < b});
            }
    };
    each_side([&](const EdgeUse& use) { ++end[size_t(use.low) + 1]; });
    for (size_t v = 1; v < end.size(); ++v)
        end[v] += end[v - 1];
    std::vector<EdgeUse> uses(size_t(triangle.size()));
    each_side([&](const EdgeUse& use) { uses[end[size_t(use.low)]++] = use; });
    size_t begin = 0;
    for (size_t v = 0; v + 1 < end.size(); begin = end[v++])
        std::sort(uses.begin() + std::ptrdiff_t(begin), uses.begin() + std::ptrdiff_t(end[v]),
                  [](const EdgeUse& a, const EdgeUse& b) {
                      return std::tie(a.high, a.face, a.corner) < std::tie(b.high, b.face, b.corner);
                  });
    return uses;
}

} // namespace spia
