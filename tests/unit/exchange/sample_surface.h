#pragma once
#include <cmath>

#include "engine/nurbs/surface.h"

namespace spia::samples {

inline std::vector<double> uneven_clamped_knots(int degree, int count)
{
    std::vector<double> knots(size_t(degree + 1), 0.0);
    for (int i = 1; i < count - degree; ++i)
        knots.push_back(std::pow(i / double(count - degree), 1.3)); // no short decimal fractions
    knots.insert(knots.end(), size_t(degree + 1), 1.0);
    return knots;
}

/// A doubly curved bicubic surface of the given size in mm, away from the origin, no coordinate a
/// short decimal fraction.
inline NurbsSurface curved_surface(double size, bool rational, int count_u = 9, int count_v = 7)
{
    NurbsSurface s;
    s.count_u = count_u;
    s.count_v = count_v;
    s.knots_u = uneven_clamped_knots(3, count_u);
    s.knots_v = uneven_clamped_knots(3, count_v);
    s.control.resize(3, count_u * count_v);
    s.weight.setOnes(count_u * count_v);
    for (int j = 0; j < count_v; ++j)
        for (int i = 0; i < count_u; ++i) {
            const double u = i / (count_u - 1.0), v = j / (count_v - 1.0);
            s.control.col(s.index(i, j)) << size * (u + 0.1 * std::sin(3 * v)),
                0.6 * size * (v - 0.07 * u * u) - size / 3, 0.2 * size * std::cos(2 * u) * std::cos(2.5 * v);
            if (rational)
                s.weight[s.index(i, j)] = 1 + 0.3 * std::sin(5 * u + 2 * v);
        }
    return s;
}

/// Half of the patch u in [0, 1] by x, so that two of them meet in a border row of the same
/// doubles.
inline NurbsSurface beside(const NurbsSurface& left)
{
    NurbsSurface right = left;
    const double x = left.control.row(0).maxCoeff();
    for (int j = 0; j < left.count_v; ++j)
        for (int i = 0; i < left.count_u; ++i) {
            right.control.col(right.index(i, j)) = left.control.col(left.index(left.count_u - 1, j));
            right.control(0, right.index(i, j)) += i * 0.1 * x;
            right.weight[right.index(i, j)] = left.weight[left.index(left.count_u - 1, j)];
        }
    return right;
}

} // namespace spia::samples
