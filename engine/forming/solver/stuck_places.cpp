#include "engine/forming/solver/stuck_places.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "engine/core/small_sparse.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Faces under travelling tools, piece by piece; in a piece they hang together by vertices.
std::vector<std::vector<int>> pieces(const TriMesh& part, const Eigen::VectorXd& travelling)
{
    DisjointSets sets(size_t(part.vertices()));
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 1; a < 3 && travelling[f] > 0; ++a)
            sets.join(part.triangle(0, f), part.triangle(a, f));
    std::map<int, std::vector<int>> faces; // by the root of their vertices
    for (int f = 0; f < part.triangles(); ++f)
        if (travelling[f] > 0)
            faces[sets.root(part.triangle(0, f))].push_back(f);
    std::vector<std::vector<int>> result;
    for (auto& [unused, piece] : faces)
        result.push_back(std::move(piece));
    return result;
}

/// The vertex of a piece that the tool touches first and that sticks.
int middle_vertex(const TriMesh& part, const std::vector<int>& piece, const Eigen::Matrix2Xd& X,
                  const Eigen::Vector3d& up)
{
    const Eigen::Matrix3Xd area_vector = area_vectors(part);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero(), plain = sum;
    double weight = 0;
    for (const int f : piece) {
        const Eigen::Vector2d middle = corners(X, part.triangle.col(f)).rowwise().mean();
        const double size = area_vector.col(f).norm(), facing = std::max(0., area_vector.col(f).dot(up) / size),
                     share = size * std::pow(facing, 8); // the flat bottom far before its walls
        sum += share * middle;
        weight += share;
        plain += middle / double(piece.size());
    }
    const Eigen::Vector2d middle = weight > 0 ? Eigen::Vector2d(sum / weight) : plain;
    int nearest = part.triangle(0, piece.front());
    for (const int f : piece)
        for (const int v : part.triangle.col(f))
            if ((X.col(v) - middle).squaredNorm() < (X.col(nearest) - middle).squaredNorm())
                nearest = v;
    return nearest;
}

/// Length on the part along the rays from the middle, at the vertices of a piece. mm, by vertex of
/// the part
std::map<int, double> lengths_outwards(const TriMesh& part, const std::vector<Element>& element,
                                       const std::vector<int>& piece, const Eigen::Matrix2Xd& X, int middle)
{
    constexpr double across = 1e-2; // weight of changes across the rays
    std::map<int, int> row;         // of the unknowns
    for (const int f : piece)
        for (const int v : part.triangle.col(f))
            row.emplace(v, 0);
    row.erase(middle);
    int rows = 0;
    for (auto& [unused, number] : row)
        number = rows++;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rows);
    for (const int f : piece) {
        const Element& e = element[size_t(f)];
        const auto corner = corners(X, part.triangle.col(f));
        const Eigen::Matrix2d F = inverse_gradient(e, corner).inverse();
        const Eigen::Vector2d arm = corner.rowwise().mean() - X.col(middle), out = arm.normalized();
        const Eigen::Matrix<double, 2, 3> gradient = F.transpose() * e.gradient; // on the blank
        const Eigen::RowVector3d along = out.transpose() * gradient,
                                 round = Eigen::RowVector2d(-out[1], out[0]) * gradient;
        const double weight = e.area, stretch = (F * out).norm();
        for (int a = 0; a < 3; ++a) {
            const auto i = row.find(part.triangle(a, f));
            if (i == row.end())
                continue;
            right[i->second] += weight * along[a] * stretch;
            for (int b = 0; b < 3; ++b)
                if (const auto k = row.find(part.triangle(b, f)); k != row.end())
                    entries.emplace_back(i->second, k->second,
                                         weight * (along[a] * along[b] + across * round[a] * round[b]));
        }
    }
    Eigen::SparseMatrix<double> matrix(rows, rows);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd length = SparseLdlt(matrix).solve(right);
    std::map<int, double> result{{middle, 0}};
    for (const auto& [v, number] : row)
        result[v] = length[number];
    return result;
}

} // namespace

Eigen::Matrix2Xd stuck_places(const TriMesh& part, const std::vector<Element>& element, const ExternalForces& external,
                              const Eigen::Matrix2Xd& X)
{
    Eigen::Matrix2Xd stuck = X;
    if (external.travelling.size() == 0)
        return stuck;
    const Eigen::Vector3d up = external.plane.col(0).cross(external.plane.col(1));
    for (const std::vector<int>& piece : pieces(part, external.travelling)) {
        const int middle = middle_vertex(part, piece, X, up);
        const Eigen::Vector2d seen = external.plane.transpose() * part.position.col(middle);
        for (const auto& [v, length] : lengths_outwards(part, element, piece, X, middle)) {
            const Eigen::Vector2d arm = X.col(v) - X.col(middle);
            stuck.col(v) = seen;
            if (v != middle)
                stuck.col(v) += arm * (length / arm.norm());
        }
    }
    return stuck;
}

} // namespace spia
