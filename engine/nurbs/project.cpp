#include "engine/nurbs/project.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/mesh/topology.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/tessellate.h"

namespace spia {

namespace {

/// The rectangle of the parameters.
struct Domain {
    Eigen::Vector2d from, to;

    explicit Domain(const NurbsSurface& s)
        : from(s.knots_u[size_t(s.degree_u)], s.knots_v[size_t(s.degree_v)]),
          to(s.knots_u[size_t(s.count_u)], s.knots_v[size_t(s.count_v)])
    {
    }
    /// Whether a step in this direction would leave the domain at once.
    bool blocks(const Eigen::Vector2d& uv, const Eigen::Vector2d& step, int axis) const
    {
        return (uv[axis] <= from[axis] && step[axis] < 0) || (uv[axis] >= to[axis] && step[axis] > 0);
    }
};

/// The step towards the smallest distance along one parameter, the other one held.
Eigen::Vector2d step_along(int axis, const Eigen::Matrix2d& newton, const Eigen::Matrix2d& gauss,
                           const Eigen::Vector2d& gradient)
{
    const double curvature = newton(axis, axis) > 0 ? newton(axis, axis) : gauss(axis, axis);
    Eigen::Vector2d step = Eigen::Vector2d::Zero();
    if (curvature > 0)
        step[axis] = -gradient[axis] / curvature;
    return step;
}

/// A direction in which |S(u, v) - point|^2 falls and that does not leave the domain at once; zero
/// if there is none.
Eigen::Vector2d descent(const SurfacePoint& s, const Eigen::Vector3d& point, const Eigen::Vector2d& uv,
                        const Domain& domain)
{
    const Eigen::Vector3d r = s.position - point;
    const Eigen::Vector2d gradient(r.dot(s.S_u), r.dot(s.S_v));
    Eigen::Matrix2d gauss, newton;
    gauss << s.S_u.squaredNorm(), s.S_u.dot(s.S_v), s.S_u.dot(s.S_v), s.S_v.squaredNorm();
    newton << r.dot(s.S_uu), r.dot(s.S_uv), r.dot(s.S_uv), r.dot(s.S_vv);
    newton += gauss;

    // Beyond a centre of curvature Newton's matrix is not positive and would lead uphill; where S_u
    // and S_v are parallel not even Gauss's is.
    constexpr double definite = 1e-8;
    const auto positive = [&](const Eigen::Matrix2d& m) {
        return m(0, 0) > 0 && m.determinant() > definite * gauss(0, 0) * gauss(1, 1);
    };
    Eigen::Vector2d step = Eigen::Vector2d::Zero();
    if (positive(newton))
        step = -newton.inverse() * gradient;
    else if (positive(gauss))
        step = -gauss.inverse() * gradient;
    else
        step = step_along(0, newton, gauss, gradient) + step_along(1, newton, gauss, gradient);

    for (int axis = 0; axis < 2; ++axis)
        if (domain.blocks(uv, step, axis)) { // slide along the border
            step = step_along(1 - axis, newton, gauss, gradient);
            if (domain.blocks(uv, step, 1 - axis))
                step.setZero();
        }
    return step;
}

/// From a place of the surface down to a foot of the perpendicular, or to the border.
SurfaceFoot refine(const NurbsSurface& surface, const Eigen::Vector3d& point, Eigen::Vector2d uv, double size)
{
    constexpr int max_steps = 30, max_halvings = 12;
    // Newton's last step squares the error: what is left after a step of this length is rounding.
    const double short_step = 1e-10 * size;
    // Close to the foot the distance hardly changes, but the step is still good for digits of (u,
    // v).
    constexpr double rounding = 1e-14;
    const Domain domain(surface);
    SurfacePoint here = evaluate(surface, uv[0], uv[1]);
    double squared = (here.position - point).squaredNorm();
    bool moving = true;
    for (int i = 0; i < max_steps && moving; ++i) {
        Eigen::Vector2d step = descent(here, point, uv, domain);
        moving = false;
        for (int k = 0; k < max_halvings && !step.isZero(0); ++k, step /= 2) {
            const Eigen::Vector2d next = (uv + step).cwiseMax(domain.from).cwiseMin(domain.to);
            const SurfacePoint there = evaluate(surface, next[0], next[1]);
            const double squared_there = (there.position - point).squaredNorm();
            const double length = (there.position - here.position).norm();
            if (squared_there <= (1 + rounding) * squared) {
                moving = length > short_step;
                here = there;
                uv = next;
                squared = squared_there;
                break;
            }
            if (length <= short_step)
                break; // halving cannot help: we stand at the foot
        }
    }
    return {uv[0], uv[1], here.position, std::sqrt(squared)};
}

} // namespace

SurfaceProjection::SurfaceProjection(const NurbsSurface& surface, int samples_per_span, const Progress& progress)
    : SurfaceProjection(surface, tessellate(surface, samples_per_span, progress.part(0, 0.4)), progress.part(0.4, 1))
{
}

SurfaceProjection::SurfaceProjection(const NurbsSurface& surface, Tessellation&& tessellation, const Progress& progress)
    : surface_(surface), uv_(std::move(tessellation.uv)), triangle_(tessellation.mesh.triangle),
      search_(tessellation.mesh, progress), size_(bounding_diagonal(tessellation.mesh))
{
}

SurfaceFoot SurfaceProjection::nearest(const Eigen::Vector3d& point) const
{
    const ClosestPoint start = search_.nearest(point);
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();
    for (int k = 0; k < 3; ++k)
        uv += start.barycentric[k] * uv_.col(triangle_(k, start.face));
    return refine(surface_, point, uv, size_);
}

} // namespace spia
