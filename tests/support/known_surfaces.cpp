#include "tests/support/known_surfaces.h"

#include <cmath>
#include <numbers>

namespace spia::surfaces {

QuadGrid grid(int columns, int rows, const std::function<Eigen::Vector3d(double s, double t)>& place)
{
    QuadGrid grid;
    grid.columns = columns;
    grid.rows = rows;
    grid.position.resize(3, grid.nodes());
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            grid.position.col(grid.node(i, j)) = place(double(i) / columns, double(j) / rows);
    return grid;
}

NurbsSurface cylinder(double radius, double height, double from, double to)
{
    NurbsSurface s = one_span(2, 1);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 3; ++i) {
            const double angle = from + (to - from) * i / 2, cosine = i == 1 ? std::cos((to - from) / 2) : 1;
            s.control.col(s.index(i, j)) << radius / cosine * std::cos(angle), radius / cosine * std::sin(angle),
                height * j;
            s.weight[s.index(i, j)] = cosine;
        }
    return s;
}

NurbsSurface quarter_cylinder(double radius, double length)
{
    NurbsSurface s = cylinder(radius, length, 0, std::numbers::pi / 2);
    for (int j = 0; j < 2; ++j) { // about y, and without the slips of sines
        s.control.col(s.index(0, j)) << 0, j * length, radius;
        s.control.col(s.index(1, j)) << radius, j * length, radius;
        s.control.col(s.index(2, j)) << radius, j * length, 0;
        s.weight[s.index(1, j)] = std::sqrt(0.5);
    }
    return s;
}

NurbsSurface one_span(int degree_u, int degree_v)
{
    const auto knots = [](int degree) {
        std::vector<double> result(size_t(degree) + 1, 0);
        result.resize(2 * result.size(), 1);
        return result;
    };
    NurbsSurface s;
    s.degree_u = degree_u;
    s.degree_v = degree_v;
    s.count_u = degree_u + 1;
    s.count_v = degree_v + 1;
    s.knots_u = knots(degree_u);
    s.knots_v = knots(degree_v);
    s.control.setZero(3, s.count_u * s.count_v);
    s.weight.setOnes(s.control.cols());
    return s;
}

NurbsSurface bilinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& d)
{
    NurbsSurface s = one_span(1, 1);
    s.control.col(s.index(0, 0)) = a;
    s.control.col(s.index(1, 0)) = b;
    s.control.col(s.index(0, 1)) = c;
    s.control.col(s.index(1, 1)) = d;
    return s;
}

NurbsSurface sphere_patch(double radius)
{
    // A quarter of the unit circle about the first axis, and its weights.
    const double c = std::sqrt(0.5);
    const double along[3] = {c, 1 / c, c}, across[3] = {-c, 0, c}, weight[3] = {1, c, 1};
    NurbsSurface s = one_span(2, 2);
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) { // the meridian's point j runs around the z axis
            s.control.col(s.index(i, j)) << radius * along[j] * along[i], radius * along[j] * across[i],
                radius * across[j];
            s.weight[s.index(i, j)] = weight[i] * weight[j];
        }
    return s;
}

NurbsSurface crooked()
{
    NurbsSurface s;
    s.degree_u = 3;
    s.degree_v = 2;
    s.knots_u = {0, 0, 0, 0, 0.2, 0.55, 0.55, 1, 1, 1, 1};
    s.knots_v = {0, 0, 0, 0.3, 0.4, 1, 1, 1};
    s.count_u = 7;
    s.count_v = 5;
    s.control.resize(3, 35);
    s.weight.resize(35);
    for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 7; ++i) {
            const int c = s.index(i, j);
            s.control.col(c) << 10 * i + 2 * std::sin(3. * c), 12 * j + 2 * std::cos(5. * c), 8 * std::sin(2. * i + j);
            s.weight[c] = 1 + 0.5 * std::sin(7. * c);
        }
    return s;
}

} // namespace spia::surfaces
