#include "engine/forming/solver/flips.h"

#include <cmath>
#include <numbers>

#include "engine/mesh/orient2d.h"
#include "engine/mesh/vectors.h"

namespace spia {
namespace {

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

} // namespace spia
