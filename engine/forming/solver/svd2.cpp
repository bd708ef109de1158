#include "engine/forming/solver/svd2.h"

#include <Eigen/LU>
#include <cmath>

namespace spia {
namespace {

/// Cosine and sine.
struct Turn {
    double c, s;
};

Turn direction(double x, double y, double length) { return length > 0 ? Turn{x / length, y / length} : Turn{1, 0}; }

/// Half of a turn, by the formula that does not cancel.
Turn half(Turn t)
{
    if (t.c >= 0) {
        const double c = std::sqrt(0.5 * (1 + t.c));
        return {c, t.s / (2 * c)};
    }
    const double s = std::copysign(std::sqrt(0.5 * (1 - t.c)), t.s);
    return {t.s / (2 * s), s};
}

Eigen::Matrix2d matrix(Turn t)
{
    Eigen::Matrix2d R;
    R << t.c, -t.s, t.s, t.c;
    return R;
}

} // namespace

Svd2 svd(const Eigen::Matrix2d& G)
{
    // G = [e+f, g-h; g+h, e-f] is a rotation part (e, h), the angle u - v, plus a reflection part
    // (f, g), the angle u + v.
    const double e = 0.5 * (G(0, 0) + G(1, 1)), f = 0.5 * (G(0, 0) - G(1, 1));
    const double g = 0.5 * (G(1, 0) + G(0, 1)), h = 0.5 * (G(1, 0) - G(0, 1));
    const double rotation = std::sqrt(e * e + h * h), reflection = std::sqrt(f * f + g * g);
    const Turn minus = direction(e, h, rotation), plus = direction(f, g, reflection);
    const Turn v = half({plus.c * minus.c + plus.s * minus.s, plus.s * minus.c - plus.c * minus.s});
    const Turn u{minus.c * v.c - minus.s * v.s, minus.s * v.c + minus.c * v.s};
    Svd2 out;
    out.s[0] = rotation + reflection;
    // the difference of the two would cancel
    out.s[1] = out.s[0] > 0 ? G.determinant() / out.s[0] : 0;
    out.U = matrix(u);
    out.V = matrix(v);
    return out;
}

} // namespace spia
