#include "engine/mesh/halfedges.h"

#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia {

HalfedgeMesh halfedges(const TriMesh& mesh)
{
    omerr().disable(); // what it would print, the exception says
    HalfedgeMesh result;
    result.reserve(size_t(mesh.vertices()), size_t(mesh.vertices() + mesh.triangles()), size_t(mesh.triangles()));
    for (int v = 0; v < mesh.vertices(); ++v)
        result.add_vertex({mesh.position(0, v), mesh.position(1, v), mesh.position(2, v)});
    for (int f = 0; f < mesh.triangles(); ++f) {
        const auto t = mesh.triangle.col(f);
        const auto face =
            result.add_face(OpenMesh::VertexHandle(t[0]), OpenMesh::VertexHandle(t[1]), OpenMesh::VertexHandle(t[2]));
        if (!face.is_valid())
            throw InputError(fmt::format(
                "face {} (vertices {}, {}, {}) shares an edge with two others or is turned against its neighbours; "
                "run the mesh doctor (`spia info`) and mend the mesh there",
                f, t[0], t[1], t[2]));
    }
    return result;
}

} // namespace spia
