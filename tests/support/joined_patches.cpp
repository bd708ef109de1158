#include "tests/support/joined_patches.h"

#include <algorithm>
#include <cmath>

#include "engine/nurbs/certificate.h"

namespace spia::patches {
namespace {

std::vector<double> uneven_knots(int degree, int count, double power)
{
    std::vector<double> knots(size_t(degree) + 1, 0.0);
    for (int i = 1; i < count - degree; ++i)
        knots.push_back(std::pow(i / double(count - degree), power)); // no short decimal fractions
    knots.insert(knots.end(), size_t(degree) + 1, 1.0);
    return knots;
}

/// Bicubic patches around the origin, one per sector, whose height is one function of the plane.
MultiPatch around_a_corner(int sectors, bool rational)
{
    constexpr int n = 5;
    std::vector<NurbsSurface> all;
    // The control points of the spokes are made once: both neighbours take the same doubles.
    const auto at = [&](double x, double y) {
        return Eigen::Vector4d(x, y, 9 * std::sin(x / 50) * std::cos(y / 40),
                               rational ? 1 + 0.2 * std::sin(x / 30 + y / 20) : 1);
    };
    const auto spoke = [&](int k) {
        const double angle = 6.283185307179586 * (k % sectors) / sectors;
        return Eigen::Vector2d(std::cos(angle), std::sin(angle));
    };
    for (int k = 0; k < sectors; ++k) {
        NurbsSurface s;
        s.count_u = s.count_v = n;
        s.knots_u = s.knots_v = uneven_knots(3, n, 1);
        s.control.resize(3, n * n);
        s.weight.resize(n * n);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const double u = 100. * i / (n - 1), v = 100. * j / (n - 1);
                const Eigen::Vector2d along = u * spoke(k), up = v * spoke(k + 1);
                const Eigen::Vector2d xy = j == 0 ? along : i == 0 ? up : Eigen::Vector2d(along + up);
                const Eigen::Vector4d here = at(xy.x(), xy.y());
                s.control.col(s.index(i, j)) = here.head<3>();
                s.weight[s.index(i, j)] = here[3];
            }
        all.push_back(s);
    }
    MultiPatch result{all, {}};
    for (int k = 0; k < sectors; ++k)
        result.interfaces.push_back({{k, Side::u0}, {(k + 1) % sectors, Side::v0}, false});
    return result;
}

} // namespace

NurbsSurface mirrored_u(const NurbsSurface& surface)
{
    NurbsSurface result = surface;
    std::transform(surface.knots_u.rbegin(), surface.knots_u.rend(), result.knots_u.begin(),
                   [](double knot) { return 1 - knot; });
    for (int j = 0; j < surface.count_v; ++j)
        for (int i = 0; i < surface.count_u; ++i) {
            const int from = surface.index(surface.count_u - 1 - i, j), to = surface.index(i, j);
            result.control.col(to) = surface.control.col(from);
            result.weight[to] = surface.weight[from];
        }
    return result;
}

NurbsSurface exchanged(const NurbsSurface& surface)
{
    NurbsSurface result = surface;
    std::swap(result.degree_u, result.degree_v);
    std::swap(result.count_u, result.count_v);
    std::swap(result.knots_u, result.knots_v);
    for (int j = 0; j < surface.count_v; ++j)
        for (int i = 0; i < surface.count_u; ++i) {
            result.control.col(result.index(j, i)) = surface.control.col(surface.index(i, j));
            result.weight[result.index(j, i)] = surface.weight[surface.index(i, j)];
        }
    return result;
}

NurbsSurface curved(double size, bool rational)
{
    NurbsSurface s;
    s.degree_v = 2;
    s.count_u = 7;
    s.count_v = 6;
    s.knots_u = uneven_knots(3, s.count_u, 1.3);
    s.knots_v = uneven_knots(2, s.count_v, 1.2);
    s.control.resize(3, s.count_u * s.count_v);
    s.weight.setOnes(s.count_u * s.count_v);
    for (int j = 0; j < s.count_v; ++j)
        for (int i = 0; i < s.count_u; ++i) {
            const double u = i / (s.count_u - 1.0), v = j / (s.count_v - 1.0);
            s.control.col(s.index(i, j)) << size * (u + 0.1 * std::sin(3 * v)),
                0.6 * size * (v - 0.07 * u * u) - size / 3, 0.2 * size * std::cos(2 * u) * std::cos(2.5 * v);
            if (rational)
                s.weight[s.index(i, j)] = 1 + 0.3 * std::sin(5 * u + 2 * v);
        }
    return s;
}

NurbsSurface beyond(const NurbsSurface& first)
{
    NurbsSurface second = first;
    const double width = first.control.row(0).maxCoeff() - first.control.row(0).minCoeff();
    for (int j = 0; j < first.count_v; ++j)
        for (int i = 0; i < first.count_u; ++i) {
            const int border = first.index(first.count_u - 1, j), here = first.index(i, j);
            second.control.col(here) = first.control.col(border);
            second.control.col(here) += Eigen::Vector3d(0.13, 0.01 * i, 0.02 * i) * i * width;
            second.weight[here] = first.weight[border];
        }
    for (int j = 0; j < first.count_v; ++j) // the border stays what it is, to the last bit
        second.control.col(first.index(0, j)) = first.control.col(first.index(first.count_u - 1, j));
    return second;
}

std::vector<Sample> samples()
{
    std::vector<Sample> result;
    for (const bool rational : {false, true}) {
        const std::string kind = rational ? "rational" : "polynomial";
        const NurbsSurface left = curved(400, rational), right = beyond(left);
        const auto add = [&](const std::string& name, std::vector<NurbsSurface> all,
                             std::vector<PatchInterface> joints) {
            result.push_back({kind + " " + name, {std::move(all), std::move(joints)}});
        };
        add("one", {left}, {});
        add("two", {left, right}, {{{0, Side::u1}, {1, Side::u0}, false}});
        // mirrored along v: the shared sides run against each other
        const NurbsSurface against = exchanged(mirrored_u(exchanged(right)));
        add("two reversed", {left, against}, {{{0, Side::u1}, {1, Side::u0}, true}});
        add("two u along v", {left, exchanged(right)}, {{{0, Side::u1}, {1, Side::v0}, false}});
        add("two u against v", {left, mirrored_u(exchanged(right))}, {{{0, Side::u1}, {1, Side::v0}, true}});
        add("two end to end", {mirrored_u(left), mirrored_u(exchanged(right))}, {{{1, Side::v0}, {0, Side::u0}, true}});
        result.push_back({kind + " five around a corner", around_a_corner(5, rational)});
    }
    // A polynomial patch beside one that is rational further inside.
    NurbsSurface left = curved(400, false), right = beyond(left);
    for (int j = 1; j + 1 < right.count_v; ++j)
        right.weight[right.index(3, j)] = 0.7 + 0.01 * j;
    result.push_back({"mixed two", {{left, right}, {{{0, Side::u1}, {1, Side::u0}, false}}}});
    return result;
}

double greatest_angle(const MultiPatch& patches)
{
    double greatest = 0;
    for (const InterfaceCertificate& joint : certify(patches).interfaces)
        greatest = std::max(greatest, joint.greatest_angle);
    return greatest;
}

} // namespace spia::patches
