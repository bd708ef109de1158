#include "engine/exchange/lines/blank_outline.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/exchange/sheet_field_list.h"
#include "engine/mesh/topology.h"

namespace spia {

std::vector<std::vector<int>> outline_vertices(const TriMesh& part, const Blank& blank)
{
    require_blank_of(part, blank);
    std::vector<std::vector<int>> loops = boundary_loops(part);
    if (loops.empty())
        throw InputError("the part has no boundary, so its blank has no outline");
    const auto size = [&](const std::vector<int>& loop) {
        return std::abs(signed_area(blank.position(Eigen::all, loop)));
    };
    const auto outer =
        std::max_element(loops.begin(), loops.end(), [&](const auto& a, const auto& b) { return size(a) < size(b); });
    std::rotate(loops.begin(), outer, outer + 1);
    return loops;
}

std::vector<OutlineLoop> blank_outline(const TriMesh& part, const Blank& blank)
{
    std::vector<OutlineLoop> loops;
    for (const std::vector<int>& loop : outline_vertices(part, blank))
        loops.push_back(blank.position(Eigen::all, loop));
    return loops;
}

double signed_area(const OutlineLoop& loop)
{
    double doubled = 0;
    for (Eigen::Index i = 0; i < loop.cols(); ++i) {
        const Eigen::Vector2d a = loop.col(i) - loop.col(0), b = loop.col((i + 1) % loop.cols()) - loop.col(0);
        doubled += a.x() * b.y() - a.y() * b.x();
    }
    return doubled / 2;
}

void require_outline(const std::vector<OutlineLoop>& loops)
{
    if (loops.empty())
        throw InputError("there is no outline to write; flatten the part first");
    for (size_t i = 0; i < loops.size(); ++i)
        if (loops[i].cols() < 3 || !loops[i].allFinite())
            throw InputError(
                fmt::format("loop {} of the outline does not have three finite points; flatten the part again", i));
}

} // namespace spia
