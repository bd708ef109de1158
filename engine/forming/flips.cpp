#include "engine/forming/flips.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/mesh/orient2d.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

bool flipped(const Eigen::Vector3i& face, const Eigen::Matrix2Xd& X)
{
    return !(orient2d(X.col(face[0]), X.col(face[1]), X.col(face[2])) > 0);
}

} // namespace

int flipped_triangles(const Eigen::Matrix3Xi& triangle, const Eigen::Matrix2Xd& X)
{
    int count = 0;
    for (Eigen::Index f = 0; f < triangle.cols(); ++f)
        count += flipped(triangle.col(f), X);
    return count;
}

bool one_to_one_around_vertices(const TriMesh& part, const Eigen::Matrix2Xd& X)
{
    if (!X.allFinite() || flipped_triangles(part.triangle, X) > 0)
        return false;
    Eigen::VectorXd angle = Eigen::VectorXd::Zero(part.vertices());
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 0; a < 3; ++a) {
            const int v = part.triangle(a, f);
            const Eigen::Vector2d p = X.col(part.triangle((a + 1) % 3, f)) - X.col(v);
            const Eigen::Vector2d q = X.col(part.triangle((a + 2) % 3, f)) - X.col(v);
            angle[v] += std::atan2(cross(p, q), p.dot(q));
        }
    return angle.maxCoeff() < 3 * std::numbers::pi; // around an inner vertex a multiple of 2 pi
}

std::optional<Eigen::Matrix2Xd> mended(const TriMesh& part, Eigen::Matrix2Xd X)
{
    constexpr int most_rings = 8, sweeps = 30;
    constexpr double few = 1e-3; // of the triangles
    const auto count = flipped_triangles(part.triangle, X);
    if (!X.allFinite() || count > few * part.triangles())
        return std::nullopt;
    std::vector<char> border(size_t(part.vertices()), 0), moves(size_t(part.vertices()), 0);
    for (const std::vector<int>& loop : boundary_loops(part))
        for (const int v : loop)
            border[size_t(v)] = 1;
    for (int f = 0; f < part.triangles(); ++f)
        if (flipped(part.triangle.col(f), X))
            for (int a = 0; a < 3; ++a)
                moves[size_t(part.triangle(a, f))] = 1;
    for (int ring = 0; ring < most_rings; ++ring) {
        std::vector<char> reached = moves;
        std::vector<int> face; // with a vertex that moves
        for (int f = 0; f < part.triangles(); ++f)
            if (moves[size_t(part.triangle(0, f))] || moves[size_t(part.triangle(1, f))] ||
                moves[size_t(part.triangle(2, f))]) {
                face.push_back(f);
                for (int a = 0; a < 3; ++a)
                    reached[size_t(part.triangle(a, f))] = 1;
            }
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, X.cols());
            for (const int f : face)
                for (int a = 0; a < 3; ++a)
                    for (int b = 1; b < 3; ++b)
                        sum.col(part.triangle(a, f)) += X.col(part.triangle((a + b) % 3, f)).homogeneous();
            for (int v = 0; v < part.vertices(); ++v)
                if (moves[size_t(v)] && !border[size_t(v)])
                    X.col(v) = sum.col(v).hnormalized();
        }
        if (one_to_one_around_vertices(part, X))
            return X;
        moves = std::move(reached);
    }
    return std::nullopt;
}

} // namespace spia
