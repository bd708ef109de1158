#include "engine/coons/carry_field.h"

#include <algorithm>
#include <fmt/core.h>
#include <set>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/small_sparse.h"

namespace spia {

namespace {

/// The values at all vertices of the filled mesh: the mean of the neighbours at those of the fill.
Eigen::VectorXd over_fill(const FilledMesh& filled, const Eigen::VectorXd& at_vertices)
{
    const int known = filled.part_vertices, unknown = filled.mesh.vertices() - known;
    Eigen::VectorXd all(known + unknown);
    all.head(known) = at_vertices;
    if (unknown == 0)
        return all;
    std::set<std::pair<int, int>> edges;
    for (int f = filled.part_triangles; f < filled.mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            edges.insert(std::minmax(filled.mesh.triangle(k, f), filled.mesh.triangle((k + 1) % 3, f)));
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknown);
    for (const auto& edge : edges)
        for (const auto& [here, other] : {edge, std::pair(edge.second, edge.first)}) {
            if (here < known)
                continue;
            entries.emplace_back(here - known, here - known, 1);
            if (other < known)
                right[here - known] += at_vertices[other];
            else
                entries.emplace_back(here - known, other - known, -1);
        }
    Eigen::SparseMatrix<double> matrix(unknown, unknown);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const SparseLdlt solver(matrix);
    if (!solver.ok())
        throw SolveError("a field cannot be continued over the holes of the part; fill its holes before");
    all.tail(unknown) = solver.solve(right);
    return all;
}

} // namespace

Eigen::VectorXd carry_field(const FilledMesh& filled, const Eigen::VectorXd& at_vertices,
                            const std::vector<MeshPoint>& place)
{
    if (at_vertices.size() != filled.part_vertices || !at_vertices.allFinite())
        throw InputError(
            fmt::format("a field has not one finite value for each of the {} vertices of the part; solve the "
                        "part again",
                        filled.part_vertices));
    const Eigen::VectorXd all = over_fill(filled, at_vertices);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(place.size()));
    for (size_t n = 0; n < place.size(); ++n) {
        if (place[n].face < 0)
            throw InputError(fmt::format("node {} has no place on the part; lift the grid again", n));
        for (int k = 0; k < 3; ++k)
            if (place[n].barycentric[k] != 0)
                result[Eigen::Index(n)] += place[n].barycentric[k] * all[filled.mesh.triangle(k, place[n].face)];
    }
    return result;
}

} // namespace spia
