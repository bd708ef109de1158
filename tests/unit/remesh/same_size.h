#pragma once
#include "engine/mesh/edge_graph.h"
#include "engine/remesh/size_field.h"

namespace spia::shapes {

/// The same size everywhere, mm.
inline SizeField same_size(const TriMesh& mesh, double size)
{
    const Eigen::Index edges = Eigen::Index(edge_graph(mesh).edge.size());
    return {mesh,
            EdgeSizes{
                Eigen::VectorXd::Constant(mesh.vertices(), size), Eigen::VectorXd::Constant(edges, size), {}, size, 0}};
}

} // namespace spia::shapes
