#include "engine/compare/flat_map.h"

#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {

void require_sheet(const TriMesh& part)
{
    if (part.triangles() == 0)
        throw InputError("the part has no faces");
    const int loops = int(boundary_loops(part).size());
    if (loops == 0)
        throw InputError("the part is closed: it has no edge from which it could be unfolded; cut it open");
    const Eigen::Matrix3Xd area_vector = area_vectors(part);
    DisjointSets sets{size_t(part.vertices())};
    std::vector<char> used(size_t(part.vertices()), 0);
    for (int f = 0; f < part.triangles(); ++f) {
        if (!(area_vector.col(f).norm() > 0))
            throw InputError(fmt::format("face {} has no area; weld or remove it (`spia info` says how)", f));
        for (int k = 0; k < 3; ++k) {
            used[size_t(part.triangle(k, f))] = 1;
            sets.join(part.triangle(k, f), part.triangle((k + 1) % 3, f));
        }
    }
    int edges = 0;
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t, size_t) { ++edges; });
    const int root = sets.root(part.triangle(0, 0));
    for (int v = 0; v < part.vertices(); ++v) {
        if (!used[size_t(v)])
            throw InputError(fmt::format("vertex {} belongs to no face; remove it", v));
        if (sets.root(v) != root)
            throw InputError(fmt::format("vertex {} does not hang together with vertex {}: the part is several pieces; "
                                         "unfold them one by one",
                                         v, root));
    }
    const int characteristic = part.vertices() - edges + part.triangles();
    if (characteristic + loops != 2)
        throw InputError(fmt::format("the part has {} handles; cut them open", (2 - loops - characteristic) / 2));
}

double flat_area(const TriMesh& part, const Eigen::Matrix2Xd& flat)
{
    double sum = 0;
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Vector2d a = flat.col(part.triangle(0, f));
        const Eigen::Vector2d p = flat.col(part.triangle(1, f)) - a, q = flat.col(part.triangle(2, f)) - a;
        sum += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
    return sum;
}

void scale_to_area_of(const TriMesh& part, Eigen::Matrix2Xd& flat)
{
    const double size = flat_area(part, flat);
    if (!(size > 0) || !std::isfinite(size))
        throw SolveError("the map has no positive area: most of it is turned over");
    flat *= std::sqrt(area(part) / size);
}

} // namespace spia
