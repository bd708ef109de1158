#include "engine/coons/place_border.h"

#include <array>
#include <cassert>

#include "engine/coons/boundary.h"

namespace spia
{

namespace
{

/// Per vertex of the outline the face whose edge leads from it to the next one.
std::vector<int> faces_along(const FilledMesh& filled)
{
    std::vector<int> next(size_t(filled.mesh.vertices()), -1), face(next.size(), -1);
    for (size_t i = 0; i < filled.outline.size(); ++i)
        next[size_t(filled.outline[i])] = filled.outline[(i + 1) % filled.outline.size()];
    const Eigen::Matrix3Xi& triangle = filled.mesh.triangle;
    for (int f = 0; f < triangle.cols(); ++f)
        for (int k = 0; k < 3; ++k)
            if (next[size_t(triangle(k, f))] == triangle((k + 1) % 3, f))
                face[size_t(triangle(k, f))] = f;
    return face;
}

int corner_of(const Eigen::Matrix3Xi& triangle, int face, int vertex)
{
    for (int k = 0; k < 3; ++k)
        if (triangle(k, face) == vertex)
            return k;
    assert(false && "the face does not have this vertex");
    return 0;
}

} // namespace

void place_border(const FilledMesh& filled, const BlankBoundary& boundary, QuadGrid& grid,
                  std::vector<MeshPoint>& place)
{
    const std::vector<int> face = faces_along(filled);
    for (int k = 0; k < 4; ++k) {
        const std::vector<int>& side = boundary.side[size_t(k)];
        const Eigen::VectorXd chord = chord_parameters(side, filled.plane);
        const int cells = k % 2 == 0 ? grid.columns : grid.rows;
        for (int i = 0; i < cells; ++i) { // the last node of a side is the first one of the next
            const std::array<int, 4> nodes = {grid.node(i, 0), grid.node(grid.columns, i),
                                              grid.node(grid.columns - i, grid.rows),
                                              grid.node(0, grid.rows - i)};
            const int node = nodes[size_t(k)];
            const SidePoint on_side = point_on_side(side, chord, double(i) / cells);
            MeshPoint& here = place[size_t(node)];
            here = {face[size_t(on_side.a)], Eigen::Vector3d::Zero(), 0};
            here.barycentric[corner_of(filled.mesh.triangle, here.face, on_side.a)] = 1 - on_side.weight;
            here.barycentric[corner_of(filled.mesh.triangle, here.face, on_side.b)] = on_side.weight;
            const Eigen::Vector2d position = (1 - on_side.weight) * filled.plane.col(on_side.a) +
                                             on_side.weight * filled.plane.col(on_side.b);
            grid.position.col(node) << position, 0;
        }
    }
}

} // namespace spia
