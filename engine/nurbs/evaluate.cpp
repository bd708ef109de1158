#include "engine/nurbs/evaluate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>

#include "engine/nurbs/basis.h"

namespace spia {

Eigen::Vector3d SurfacePoint::normal() const
{
    const Eigen::Vector3d cross = S_u.cross(S_v);
    // Along a collapsed side S_u is not zero but the rounding of large numbers; it points anywhere.
    constexpr double lost = 1e-10;
    if (!(cross.norm() > lost * (S_u.squaredNorm() + S_v.squaredNorm())))
        return Eigen::Vector3d::Zero();
    return cross.normalized();
}

SurfacePoint evaluate(const NurbsSurface& surface, double u, double v)
{
    const int p = surface.degree_u, q = surface.degree_v;
    assert(int(surface.knots_u.size()) == surface.count_u + p + 1);
    assert(int(surface.knots_v.size()) == surface.count_v + q + 1);
    u = std::clamp(u, surface.knots_u[size_t(p)], surface.knots_u[size_t(surface.count_u)]);
    v = std::clamp(v, surface.knots_v[size_t(q)], surface.knots_v[size_t(surface.count_v)]);
    const BasisValues N = basis(surface.knots_u, p, u), M = basis(surface.knots_v, q, v);

    // The surface of (weight * point, weight) in four dimensions, A = (w S, w), and its
    // derivatives.
    Eigen::Vector4d A = Eigen::Vector4d::Zero(), A_u = A, A_v = A, A_uu = A, A_uv = A, A_vv = A;
    for (int j = 0; j <= q; ++j) {
        Eigen::Vector4d row = Eigen::Vector4d::Zero(), row_u = row, row_uu = row;
        for (int i = 0; i <= p; ++i) {
            const int c = surface.index(N.first + i, M.first + j);
            const double w = surface.weight[c];
            Eigen::Vector4d point;
            point << w * surface.control.col(c), w;
            row += N.value[size_t(i)] * point;
            row_u += N.first_derivative[size_t(i)] * point;
            row_uu += N.second_derivative[size_t(i)] * point;
        }
        A += M.value[size_t(j)] * row;
        A_u += M.value[size_t(j)] * row_u;
        A_uu += M.value[size_t(j)] * row_uu;
        A_v += M.first_derivative[size_t(j)] * row;
        A_uv += M.first_derivative[size_t(j)] * row_u;
        A_vv += M.second_derivative[size_t(j)] * row;
    }

    // Differentiate w S = A and solve for the derivatives of S.
    const double w = A[3];
    SurfacePoint s;
    s.position = A.head<3>() / w;
    s.S_u = (A_u.head<3>() - A_u[3] * s.position) / w;
    s.S_v = (A_v.head<3>() - A_v[3] * s.position) / w;
    s.S_uu = (A_uu.head<3>() - 2 * A_u[3] * s.S_u - A_uu[3] * s.position) / w;
    s.S_uv = (A_uv.head<3>() - A_u[3] * s.S_v - A_v[3] * s.S_u - A_uv[3] * s.position) / w;
    s.S_vv = (A_vv.head<3>() - 2 * A_v[3] * s.S_v - A_vv[3] * s.position) / w;
    return s;
}

} // namespace spia
