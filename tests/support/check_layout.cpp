#include "tests/support/check_layout.h"

#include <cmath>
#include <fmt/core.h>
#include <set>
#include <vector>

#include "engine/mesh/topology.h"

namespace spia::shapes {

namespace {

double area_of(const TriMesh& part, const Blank& blank)
{
    double sum = 0;
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Vector2d a = blank.position.col(part.triangle(0, f)),
                              p = blank.position.col(part.triangle(1, f)) - a,
                              q = blank.position.col(part.triangle(2, f)) - a;
        sum += 0.5 * std::abs(p.x() * q.y() - p.y() * q.x());
    }
    return sum;
}

} // namespace

std::string fault_of_layout(const Layout& layout, const TriMesh& part, const Blank& blank)
{
    std::vector<int> uses(layout.curve.size(), 0);
    std::set<int> vertices;
    double area_of_patches = 0;
    for (const LayoutPatch& patch : layout.patch) {
        for (const CurveUse use : patch)
            ++uses[size_t(use.curve)];
        area_of_patches += area(layout, patch);
    }
    for (size_t c = 0; c < uses.size(); ++c) {
        vertices.insert({layout.curve[c].vertex[0], layout.curve[c].vertex[1]});
        if (uses[c] != (layout.curve[c].on_border() ? 1 : 2))
            return fmt::format("curve {} is a side of {} patches", c, uses[c]);
    }
    const int loops = int(boundary_loops(part).size()),
              euler = int(vertices.size()) - int(uses.size()) + int(layout.patch.size());
    if (euler != 2 - loops) // V - E + F of a disk with holes
        return fmt::format("V - E + F is {} where the part has {} loops", euler, loops);
    if (const double sheet = area_of(part, blank); std::abs(area_of_patches - sheet) > 1e-9 * sheet)
        return fmt::format("the patches cover {:.9g} of {:.9g} mm2", area_of_patches, sheet);
    return "";
}

int vertex_near(const Blank& blank, double x, double y)
{
    Eigen::Index v;
    (blank.position.colwise() - Eigen::Vector2d(x, y)).colwise().norm().minCoeff(&v);
    return int(v);
}

} // namespace spia::shapes
