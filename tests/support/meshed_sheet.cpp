#include "tests/support/meshed_sheet.h"

#include <algorithm>

#include "engine/mesh/closest_point.h"
#include "engine/nurbs/evaluate.h"

namespace spia::shapes {

MeshedSheet::MeshedSheet(const KnownSheet& sheet, int cells) : mesh(mesh_of(sheet, cells))
{
    source.at = [this, cells](const std::vector<double>& u, const std::vector<double>& v) {
        Eigen::Matrix3Xd points(3, Eigen::Index(u.size() * v.size()));
        for (size_t j = 0; j < v.size(); ++j)
            for (size_t i = 0; i < u.size(); ++i)
                points.col(Eigen::Index(i + j * u.size())) = on_mesh(mesh, cells, u[i], v[j]);
        return points;
    };
}

QuadGrid even_grid(const TriMesh& mesh, int mesh_cells, int cells)
{
    QuadGrid grid;
    grid.columns = grid.rows = cells;
    grid.position.resize(3, grid.nodes());
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i)
            grid.position.col(grid.node(i, j)) = on_mesh(mesh, mesh_cells, double(i) / cells, double(j) / cells);
    return grid;
}

double distance_from_sheet(const NurbsSurface& surface, const KnownSheet& sheet)
{
    double largest = 0;
    const int n = 301; // no multiple of a dyadic number of spans
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            largest = std::max(largest, sheet.distance(evaluate(surface, double(i) / n, double(j) / n).position));
    return largest;
}

double independent_deviation(const NurbsSurface& surface, const KnownSheet& sheet)
{
    const int cells = 400, m = 90; // the triangles' sag is 2e-4 mm on these sheets
    const KnownSheet itself{"", [&](double s, double t) { return evaluate(surface, s, t).position; }, {}, 0};
    const ClosestPointSearch search(mesh_of(itself, cells));
    double largest = distance_from_sheet(surface, sheet);
    for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= m; ++i)
            largest = std::max(largest, search.nearest(sheet.place(double(i) / m, double(j) / m)).distance - 2e-4);
    return largest;
}

} // namespace spia::shapes
