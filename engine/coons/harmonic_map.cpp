#include "engine/coons/harmonic_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/coons/boundary.h"
#include "engine/core/error.h"
#include "engine/core/small_sparse.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/vectors.h"

namespace spia {

namespace {

// Cotangents of 84 and of 0.6 degrees. The bound below makes the map one-to-one, the one above
// keeps it well conditioned.
constexpr double smallest_weight = 0.1;
constexpr double largest_weight = 100;

/// Bit k is set for a vertex on side k; a corner is on two sides.
std::vector<char> sides_of_vertices(const BlankBoundary& boundary, int vertices)
{
    std::vector<char> sides(size_t(vertices), 0);
    for (int k = 0; k < 4; ++k)
        for (const int v : boundary.side[size_t(k)])
            sides[size_t(v)] = char(sides[size_t(v)] | (1 << k));
    return sides;
}

/// Where each corner of a triangle of the map lies in its parent, and which vertex it is.
struct CutCorner {
    int vertex;
    Eigen::Vector3d place;
};

/// Cuts a triangle whose edges k = 0, 1, 2 have a new vertex middle[k] (or -1) into two, three or
/// four.
void cut(const Eigen::Vector3i& face, const std::array<int, 3>& middle, int parent,
         std::vector<Eigen::Vector3i>& triangles, HarmonicMap& map)
{
    std::vector<CutCorner> ring; // the border of the triangle with its new vertices
    int first = 0;               // begin where the edges that are cut come first
    const int cuts = int(middle[0] >= 0) + int(middle[1] >= 0) + int(middle[2] >= 0);
    for (int k = 0; k < 3; ++k)
        if ((cuts == 1 && middle[size_t(k)] >= 0) || (cuts == 2 && middle[size_t((k + 2) % 3)] < 0))
            first = k;
    for (int step = 0; step < 3; ++step) {
        const int k = (first + step) % 3, l = (k + 1) % 3;
        ring.push_back({face[k], Eigen::Vector3d::Unit(k)});
        if (middle[size_t(k)] >= 0)
            ring.push_back({middle[size_t(k)], 0.5 * (Eigen::Vector3d::Unit(k) + Eigen::Vector3d::Unit(l))});
    }
    const auto add = [&](size_t a, size_t b, size_t c) {
        triangles.emplace_back(ring[a].vertex, ring[b].vertex, ring[c].vertex);
        map.parent.push_back(parent);
        Eigen::Matrix3d corner;
        corner << ring[a].place, ring[b].place, ring[c].place;
        map.corner.push_back(corner);
    };
    if (cuts == 0) {
        add(0, 1, 2);
    } else if (cuts == 1) { // a, ab, b, c
        add(0, 1, 3);
        add(1, 2, 3);
    } else if (cuts == 2) { // a, ab, b, bc, c
        add(1, 2, 3);
        add(0, 1, 3);
        add(0, 3, 4);
    } else { // a, ab, b, bc, c, ca
        add(0, 1, 5);
        add(1, 2, 3);
        add(3, 4, 5);
        add(1, 3, 5);
    }
}

/// The triangles of the map, and the positions of its vertices in the plane of the blank.
Eigen::Matrix2Xd cut_dividing_edges(const FilledMesh& filled, const std::vector<char>& sides, HarmonicMap& map)
{
    const Eigen::Matrix3Xi& face = filled.mesh.triangle;
    std::vector<std::array<int, 3>> middle(size_t(face.cols()), {-1, -1, -1});
    std::vector<Eigen::Vector2d> added;
    const std::vector<EdgeUse> edges = edge_uses(face);
    for (size_t e = 0; e + 1 < edges.size(); ++e) {
        const EdgeUse &one = edges[e], &other = edges[e + 1];
        if (!one.same_edge(other) || !(sides[size_t(one.low)] & sides[size_t(one.high)]))
            continue;
        const int vertex = filled.mesh.vertices() + int(added.size());
        middle[size_t(one.face)][size_t(one.corner)] = vertex;
        middle[size_t(other.face)][size_t(other.corner)] = vertex;
        added.push_back(0.5 * (filled.plane.col(one.low) + filled.plane.col(one.high)));
    }
    std::vector<Eigen::Vector3i> triangles;
    triangles.reserve(size_t(face.cols()));
    for (int f = 0; f < face.cols(); ++f)
        cut(face.col(f), middle[size_t(f)], f, triangles, map);
    map.triangle.resize(3, Eigen::Index(triangles.size()));
    for (size_t t = 0; t < triangles.size(); ++t)
        map.triangle.col(Eigen::Index(t)) = triangles[t];
    Eigen::Matrix2Xd plane(2, filled.plane.cols() + Eigen::Index(added.size()));
    plane.leftCols(filled.plane.cols()) = filled.plane;
    for (size_t i = 0; i < added.size(); ++i)
        plane.col(filled.plane.cols() + Eigen::Index(i)) = added[i];
    return plane;
}

void place_sides(const BlankBoundary& boundary, const Eigen::Matrix2Xd& plane, Eigen::Matrix2Xd& square)
{
    for (size_t k = 0; k < 4; ++k) {
        const Eigen::VectorXd chord = chord_parameters(boundary.side[k], plane);
        for (size_t i = 0; i < boundary.side[k].size(); ++i) {
            const double t = chord[Eigen::Index(i)];
            const std::array<Eigen::Vector2d, 4> place = {Eigen::Vector2d(t, 0), Eigen::Vector2d(1, t),
                                                          Eigen::Vector2d(1 - t, 1), Eigen::Vector2d(0, 1 - t)};
            square.col(boundary.side[k][i]) = place[k];
        }
    }
}

/// The cotangent at corner k of a triangle. A triangle that is turned over or flat gives the one of
/// its mirror image.
double cotangent(const Eigen::Matrix2Xd& plane, const Eigen::Vector3i& t, int k)
{
    const Eigen::Vector2d a = plane.col(t[(k + 1) % 3]) - plane.col(t[k]),
                          b = plane.col(t[(k + 2) % 3]) - plane.col(t[k]);
    const double sine = std::abs(cross(a, b)), cosine = a.dot(b);
    return sine > 0 ? std::clamp(cosine / sine, -largest_weight, largest_weight) : 0;
}

} // namespace

MeshPoint HarmonicMap::in_filled_mesh(const MeshPoint& point) const
{
    return {parent[size_t(point.face)], corner[size_t(point.face)] * point.barycentric, point.distance};
}

HarmonicMap harmonic_map(const FilledMesh& filled, const BlankBoundary& boundary, const Progress& progress)
{
    progress.checkpoint(0, "harmonic map: equations");
    const std::vector<char> sides = sides_of_vertices(boundary, filled.mesh.vertices());
    HarmonicMap map;
    map.plane = cut_dividing_edges(filled, sides, map);
    const Eigen::Matrix2Xd& plane = map.plane;
    map.square = Eigen::Matrix2Xd::Zero(2, plane.cols());
    place_sides(boundary, filled.plane, map.square);

    const std::vector<EdgeUse> edges = edge_uses(map.triangle);
    std::vector<int> unknown(size_t(plane.cols()), -1);
    int unknowns = 0;
    for (const EdgeUse& edge : edges)
        for (const int v : {edge.low, edge.high})
            if (unknown[size_t(v)] < 0 && (v >= filled.mesh.vertices() || !sides[size_t(v)]))
                unknown[size_t(v)] = unknowns++;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(2 * edges.size());
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(unknowns);
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
    for (size_t e = 0; e < edges.size(); ++e) {
        const EdgeUse& edge = edges[e];
        if (e > 0 && edges[e - 1].same_edge(edge))
            continue;
        double weight = 0;
        for (size_t f = e; f < edges.size() && edges[f].same_edge(edge); ++f)
            weight += cotangent(plane, map.triangle.col(edges[f].face), (edges[f].corner + 2) % 3) / 2;
        weight = std::clamp(weight, smallest_weight, largest_weight);
        for (const auto& [v, w] : {std::pair(edge.low, edge.high), std::pair(edge.high, edge.low)}) {
            const int row = unknown[size_t(v)], column = unknown[size_t(w)];
            if (row < 0)
                continue;
            diagonal[row] += weight;
            if (column < 0)
                right.row(row) += weight * map.square.col(w).transpose();
            else if (row > column)
                entries.emplace_back(row, column, -weight);
        }
    }
    if (unknowns == 0)
        return map;
    for (int i = 0; i < unknowns; ++i)
        entries.emplace_back(i, i, diagonal[i]);
    Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    progress.checkpoint(0.2, "harmonic map: solution");
    const SparseLdlt factor(matrix);
    // Positive definite, since the weights are and every vertex hangs on the sides; only rounding
    // can spoil that.
    if (!factor.ok())
        throw SolveError("the harmonic map of the blank could not be factored; remesh the part with better triangles");
    const Eigen::MatrixX2d solution = factor.solve(right);
    for (size_t v = 0; v < unknown.size(); ++v)
        if (unknown[v] >= 0)
            map.square.col(Eigen::Index(v)) = solution.row(unknown[v]).transpose();
    progress.checkpoint(1, "harmonic map: solution");
    return map;
}

} // namespace spia
