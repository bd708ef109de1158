#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// How the sheet that a mesh of elements stands for turns from triangle to triangle.
class SheetTurns {
public:
    /// @param crease  radians; over edges that turn by more the sheet does not go on
    SheetTurns(const TriMesh& mesh, double crease);

    const TriMesh& mesh() const { return mesh_; }
    Eigen::Vector3d normal(int face) const { return normal_.col(face); }
    /// The triangle across the edge from corner k; -1 at the border.
    int neighbour(int face, int k) const { return neighbour_(k, face); }
    /// Whether the edge from corner k is one of the part: it turns by more than the crease, or it
    /// turns while the sheet beside it on both sides does not.
    bool creased(int face, int k) const { return creased_(k, face) != 0; }
    /// Whether a vertex is at the border or at a crease.
    bool at_rim(int vertex) const { return at_rim_[size_t(vertex)] != 0; }
    /// The triangles around a vertex.
    const std::vector<int>& around(int vertex) const { return around_[size_t(vertex)]; }

    /// Radians, by how much triangles that touch one, on its side of creases, are turned against
    /// all of `beside`.
    /// @param about, reach  corners of the triangle beyond that distance from the vertex do not
    ///                      count: long triangles of a plane reach as far as other bends
    double turn_behind(int face, const std::vector<int>& beside, int about = -1, double reach = 0) const;

    static constexpr double level = 0.01;   ///< radians; facets of one plane in files of few decimals
    static constexpr double isolated = 0.2; ///< a turn that is less than that share of another is none

private:
    const TriMesh& mesh_;
    double crease_;
    Eigen::Matrix3Xd normal_;
    Eigen::Matrix3Xi neighbour_, creased_;
    std::vector<std::vector<int>> around_;
    std::vector<char> at_rim_;

    bool turns_alone(int face, int k) const;
};

} // namespace spia
