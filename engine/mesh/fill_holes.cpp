#include "engine/mesh/fill_holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "engine/core/error.h"
#include "engine/core/small_sparse.h"
#include "engine/mesh/mesh_polygon.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"

namespace spia {

namespace {

constexpr double largest_cotangent = 1e3; // of a sliver: keeps one bad triangle from ruling the
                                          // equations

double loop_area(const std::vector<int>& loop, const Eigen::Matrix2Xd& plane)
{
    const Eigen::Vector2d origin = plane.col(loop[0]); // keeps the digits of a blank far from the
                                                       // origin
    double doubled = 0;
    for (size_t i = 0; i < loop.size(); ++i)
        doubled += cross(plane.col(loop[i]) - origin, plane.col(loop[(i + 1) % loop.size()]) - origin);
    return doubled / 2;
}

void require_disk(const FilledMesh& filled)
{
    // Euler: vertices - edges + faces is 2 - 2 handles - loops per component; one loop is left.
    const TriMesh& mesh = filled.mesh;
    std::vector<int> root(size_t(mesh.vertices()));
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int v) {
        while (root[v] != v)
            v = root[v] = root[root[v]];
        return v;
    };
    std::vector<char> used(size_t(mesh.vertices()), 0);
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            used[mesh.triangle(k, f)] = 1;
            root[find(mesh.triangle(k, f))] = find(mesh.triangle((k + 1) % 3, f));
        }
    int vertices = 0, components = 0;
    for (int v = 0; v < mesh.vertices(); ++v)
        if (used[v]) {
            ++vertices;
            components += find(v) == v;
        }
    if (components != 1)
        throw InputError(fmt::format("the part has {} disconnected pieces; weld them or keep one of them", components));
    const int boundary_edges = int(filled.outline.size());
    const int edges = (3 * mesh.triangles() + boundary_edges) / 2;
    const int euler = vertices - edges + mesh.triangles();
    if (euler != 1)
        throw InputError(fmt::format("the part has handles (Euler number {} instead of 1 once its holes are filled); "
                                     "cut it open before it is flattened",
                                     euler));
}

/// New vertices of one hole, and its faces, appended to the filled mesh.
struct Additions {
    std::vector<Eigen::Vector2d> plane;
    std::vector<Eigen::Vector3d> position; ///< exact for the centre of a fan, else to be solved for
    std::vector<std::array<int, 3>> triangle;
};

void close_by_mesh(const PlanarMesh& fill, const std::vector<int>& edge, int first_new, Additions& additions)
{
    const int n = int(edge.size());
    for (int i = n; i < fill.position.cols(); ++i) {
        additions.plane.push_back(fill.position.col(i));
        additions.position.push_back(Eigen::Vector3d::Zero());
    }
    const auto vertex = [&](int i) { return i < n ? edge[size_t(i)] : first_new + i - n; };
    for (int t = 0; t < fill.triangle.cols(); ++t)
        additions.triangle.push_back(
            {vertex(fill.triangle(0, t)), vertex(fill.triangle(1, t)), vertex(fill.triangle(2, t))});
}

void close_by_fan(const std::vector<int>& edge, int centre, const FilledMesh& filled, Additions& additions)
{
    Eigen::Vector2d plane = Eigen::Vector2d::Zero();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < edge.size(); ++i) {
        plane += filled.plane.col(edge[i]) / double(edge.size());
        position += filled.mesh.position.col(edge[i]) / double(edge.size());
        additions.triangle.push_back({edge[i], edge[(i + 1) % edge.size()], centre});
    }
    additions.plane.push_back(plane);
    additions.position.push_back(position);
}

void append(FilledMesh& filled, const Additions& additions)
{
    const Eigen::Index v = filled.plane.cols(), added = Eigen::Index(additions.plane.size());
    filled.plane.conservativeResize(2, v + added);
    filled.mesh.position.conservativeResize(3, v + added);
    for (Eigen::Index i = 0; i < added; ++i) {
        filled.plane.col(v + i) = additions.plane[size_t(i)];
        filled.mesh.position.col(v + i) = additions.position[size_t(i)];
    }
    const Eigen::Index f = filled.mesh.triangle.cols();
    filled.mesh.triangle.conservativeResize(3, f + Eigen::Index(additions.triangle.size()));
    for (size_t t = 0; t < additions.triangle.size(); ++t)
        filled.mesh.triangle.col(f + Eigen::Index(t)) << additions.triangle[t][0], additions.triangle[t][1],
            additions.triangle[t][2];
}

/// cot of the angle between two sides is beyond what is counted. There linear functions of the
/// plane no longer make the Laplacian zero.
bool is_sliver(const Eigen::Vector2d& ca, const Eigen::Vector2d& cb)
{
    return std::abs(ca.dot(cb)) > largest_cotangent * std::abs(cross(ca, cb));
}

/// The same rows without those of the part that have a sliver. A sheet of few, long triangles has
/// slivers from hole to hole: their rows outweigh all others, and place the fill far off the sheet.
std::vector<char> without_slivers(std::vector<char> row, const FilledMesh& filled)
{
    for (int f = 0; f < filled.mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto corner = [&](int i) { return filled.mesh.triangle((k + i) % 3, f); };
            const Eigen::Vector2d c = filled.plane.col(corner(0));
            if (is_sliver(filled.plane.col(corner(1)) - c, filled.plane.col(corner(2)) - c))
                for (const int v : {corner(1), corner(2)})
                    if (v < filled.part_vertices)
                        row[size_t(v)] = 0;
        }
    return row;
}

/// Places the vertices marked in `free`: least squares of the Laplacian over the plane at the
/// vertices marked in `row`, weighted with the area around them. Linear functions of the plane make
/// it zero, whatever the triangles.
void place_in_space(FilledMesh& filled, const std::vector<char>& free, const std::vector<char>& row)
{
    TriMesh& mesh = filled.mesh;
    std::vector<int> unknown(free.size(), -1), equation(row.size(), -1);
    int unknowns = 0, equations = 0;
    for (size_t v = 0; v < free.size(); ++v) {
        if (free[v])
            unknown[v] = unknowns++;
        if (row[v])
            equation[v] = equations++;
    }
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(equations, 3);
    Eigen::VectorXd around = Eigen::VectorXd::Zero(equations); // area
    const auto add = [&](int v, int w, double weight) {
        if (unknown[w] >= 0)
            entries.emplace_back(equation[v], unknown[w], weight);
        else
            right.row(equation[v]) -= weight * mesh.position.col(w).transpose();
    };
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) { // the corner k, and the edge against it
            const int a = mesh.triangle((k + 1) % 3, f), b = mesh.triangle((k + 2) % 3, f);
            const int c = mesh.triangle(k, f);
            if (!row[a] && !row[b] && !row[c])
                continue;
            const Eigen::Vector2d ca = filled.plane.col(a) - filled.plane.col(c);
            const Eigen::Vector2d cb = filled.plane.col(b) - filled.plane.col(c);
            const double sine = std::abs(cross(ca, cb));
            const double floor = std::abs(ca.dot(cb)) / largest_cotangent;
            const double weight = sine > 0 ? ca.dot(cb) / std::max(sine, floor) / 2 : 0;
            for (const auto& [v, w] : {std::pair(a, b), std::pair(b, a)})
                if (row[v]) {
                    add(v, v, weight);
                    add(v, w, -weight);
                }
            if (row[c])
                around[equation[c]] += sine / 6;
        }
    const double least_area = 1e-6 * around.sum() / std::max(equations, 1);
    const Eigen::VectorXd scale = around.cwiseMax(least_area).cwiseSqrt().cwiseInverse();
    Eigen::SparseMatrix<double> laplacian(equations, unknowns);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    laplacian = scale.asDiagonal() * laplacian;
    right = scale.asDiagonal() * right;
    const Eigen::SparseMatrix<double> normal = laplacian.transpose() * laplacian;
    const SparseLdlt factor(normal);
    if (!factor.ok())
        throw InputError("the holes of the part could not be filled smoothly: their edges have no extent in the "
                         "blank; close the slits of the part first");
    Eigen::MatrixX3d solution = factor.solve(laplacian.transpose() * right);
    // The normal equations square the condition; one correction with the residual gives the lost
    // digits back.
    const Eigen::MatrixX3d residual = right - laplacian * solution;
    solution += factor.solve(laplacian.transpose() * residual);
    for (size_t v = 0; v < free.size(); ++v)
        if (free[v])
            mesh.position.col(Eigen::Index(v)) = solution.row(unknown[v]).transpose();
}

} // namespace

int outer_loop(const std::vector<std::vector<int>>& loops, const Eigen::Matrix2Xd& plane)
{
    int outer = -1;
    double largest = 0;
    for (size_t i = 0; i < loops.size(); ++i) {
        const double area = loop_area(loops[i], plane);
        if (area > largest) {
            largest = area;
            outer = int(i);
        }
    }
    if (loops.empty())
        throw InputError("the part is closed and has no boundary; cut it open, or take one side of the sheet");
    if (outer < 0)
        throw InputError(
            "no boundary loop of the blank runs counter-clockwise; the blank is upside down: mirror it, or "
            "turn the faces of the part");
    return outer;
}

FilledMesh fill_holes(const TriMesh& part, const Eigen::Matrix2Xd& plane, const Progress& progress)
{
    FilledMesh filled;
    filled.mesh = part;
    filled.plane = plane;
    filled.part_vertices = part.vertices();
    filled.part_triangles = part.triangles();
    std::vector<std::vector<int>> loops = boundary_loops(part);
    const int outer = outer_loop(loops, plane);
    filled.outline = loops[size_t(outer)];

    std::vector<char> row(size_t(part.vertices()), 0), free(size_t(part.vertices()), 0);
    for (size_t i = 0; i < loops.size(); ++i) {
        progress.checkpoint(double(i) / double(loops.size()), "filling holes");
        if (int(i) == outer)
            continue;
        std::vector<int>& edge = loops[i];
        std::reverse(edge.begin(), edge.end()); // the fill lies on the other side of the edge
        Eigen::Matrix2Xd outline(2, edge.size());
        for (size_t k = 0; k < edge.size(); ++k)
            outline.col(Eigen::Index(k)) = plane.col(edge[k]);
        const PlanarMesh fill = mesh_polygon(outline);
        Additions additions;
        const int first_new = filled.mesh.vertices();
        const bool fan = fill.triangle.cols() == 0;
        if (fan)
            close_by_fan(edge, first_new, filled, additions);
        else
            close_by_mesh(fill, edge, first_new, additions);
        append(filled, additions);
        ++filled.holes;
        filled.fanned_holes += fan;
        free.resize(size_t(filled.mesh.vertices()), char(!fan));
        row.resize(size_t(filled.mesh.vertices()), char(!fan));
        if (!fan)
            for (const int v : edge)
                row[size_t(v)] = 1;
    }
    require_disk(filled);
    for (const int v : filled.outline)
        row[size_t(v)] = 0; // the Laplacian needs faces all around
    if (std::count(free.begin(), free.end(), char(1)) > 0)
        place_in_space(filled, free, without_slivers(std::move(row), filled));
    return filled;
}

} // namespace spia
