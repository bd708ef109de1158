#include "engine/nurbs/tessellate.h"

#include <fmt/core.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"

namespace spia {

std::vector<double> sample_parameters(const std::vector<double>& knots, int degree, int samples_per_span)
{
    if (samples_per_span < 1)
        throw InputError(fmt::format("{} samples per span show nothing; ask for 1 or more", samples_per_span));
    const std::vector<double> border = span_borders(knots, degree);
    std::vector<double> result;
    for (size_t s = 0; s + 1 < border.size(); ++s)
        for (int k = 0; k < samples_per_span; ++k)
            result.push_back(border[s] + (border[s + 1] - border[s]) * k / samples_per_span);
    result.push_back(border.back());
    return result;
}

Tessellation tessellate(const NurbsSurface& surface, int samples_per_span, const Progress& progress)
{
    return tessellate(surface, {samples_per_span, samples_per_span}, progress);
}

Tessellation tessellate(const NurbsSurface& surface, const std::array<int, 2>& samples_per_span,
                        const Progress& progress)
{
    const std::vector<double> u = sample_parameters(surface.knots_u, surface.degree_u, samples_per_span[0]);
    const std::vector<double> v = sample_parameters(surface.knots_v, surface.degree_v, samples_per_span[1]);
    const int columns = int(u.size()) - 1, rows = int(v.size()) - 1;
    if (2.0 * columns * rows > std::numeric_limits<int>::max() / 3)
        throw InputError(fmt::format("{} x {} cells are too many triangles; ask for fewer samples per span than {}",
                                     columns, rows, std::max(samples_per_span[0], samples_per_span[1])));

    Tessellation result;
    const int vertices = (columns + 1) * (rows + 1);
    result.mesh.position.resize(3, vertices);
    result.uv.resize(2, vertices);
    result.normal.resize(3, vertices);
    for_each_in_parts(vertices, progress, "tessellating the surface", [&](int i) {
        const double at_u = u[size_t(i % (columns + 1))], at_v = v[size_t(i / (columns + 1))];
        const SurfacePoint point = evaluate(surface, at_u, at_v);
        result.uv.col(i) << at_u, at_v;
        result.mesh.position.col(i) = point.position;
        result.normal.col(i) = point.normal();
        if (result.normal.col(i).isZero(0)) { // a collapsed side: the normal just inside of it is
                                              // its limit
            const double inside_u = at_u + 1e-4 * (0.5 * (u.front() + u.back()) - at_u);
            const double inside_v = at_v + 1e-4 * (0.5 * (v.front() + v.back()) - at_v);
            result.normal.col(i) = evaluate(surface, inside_u, inside_v).normal();
        }
    });

    result.mesh.triangle.resize(3, 2 * columns * rows);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const int a = i + j * (columns + 1), b = a + 1, c = b + columns + 1, d = c - 1;
            result.mesh.triangle.col(2 * (i + j * columns)) << a, b, c;
            result.mesh.triangle.col(2 * (i + j * columns) + 1) << a, c, d;
        }
    return result;
}

} // namespace spia
