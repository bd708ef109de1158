#include "engine/unfold/target/height_spline.h"

#include <algorithm>
#include <cmath>

namespace spia {
namespace {

/// Where a coordinate is on the knots: its cell and the share of it.
struct OnKnots {
    Eigen::Index cell;
    double share;
};

OnKnots on_knots(double knots, Eigen::Index cells)
{
    const double cell = std::clamp(std::floor(knots), 0., double(cells - 1));
    return {Eigen::Index(cell), std::clamp(knots - cell, 0., 1.)};
}

} // namespace

CellSplines cell_splines(double t)
{
    const double u = 1 - t;
    CellSplines out;
    out.value << u * u * u, 3 * t * t * t - 6 * t * t + 4, 3 * u * u * u - 6 * u * u + 4, t * t * t;
    out.first << -3 * u * u, 9 * t * t - 12 * t, 12 * u - 9 * u * u, 3 * t * t;
    out.second << 6 * u, 18 * t - 12, 18 * u - 12, 6 * t;
    for (Eigen::Vector4d* each : {&out.value, &out.first, &out.second})
        *each /= 6;
    return out;
}

Height height_at(const HeightFace& face, const Eigen::Vector2d& place)
{
    const Eigen::Vector2d knots = (place - face.corner) / face.spacing;
    const OnKnots x = on_knots(knots[0], face.coefficient.rows() - 3),
                  y = on_knots(knots[1], face.coefficient.cols() - 3);
    const CellSplines bx = cell_splines(x.share), by = cell_splines(y.share);
    const Eigen::Matrix4d c = face.coefficient.block<4, 4>(x.cell, y.cell);
    Height out{bx.value.dot(c * by.value),
               Eigen::Vector2d(bx.first.dot(c * by.value), bx.value.dot(c * by.first)) / face.spacing};
    const Eigen::Vector2d inside =
        face.corner + face.spacing * Eigen::Vector2d(double(x.cell) + x.share, double(y.cell) + y.share);
    const Eigen::Vector2d beyond = place - inside;
    if (beyond.isZero(0))
        return out;
    // Straight on from the border; across a corner the twist goes on, too, so that the slope is the
    // value's own everywhere.
    const double twist = bx.first.dot(c * by.first) / (face.spacing * face.spacing);
    out.value += out.slope.dot(beyond) + twist * beyond[0] * beyond[1];
    if (beyond[0] != 0)
        out.slope[1] += twist * beyond[0];
    if (beyond[1] != 0)
        out.slope[0] += twist * beyond[1];
    return out;
}

} // namespace spia
