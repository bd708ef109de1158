#pragma once
#include <Eigen/SparseCore>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "engine/core/small_sparse.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/tri_mesh.h"

/// Real parts, and a stand-in for their blanks.
namespace spia::real_parts {

inline std::filesystem::path folder() { return std::filesystem::path(SPIA_SOURCE_DIR) / "../shared/data/mesh"; }

/// Reads what the files of the folder need of OFF and OBJ, and no more. Polygons become fans.
inline TriMesh read(const std::string& name)
{
    std::ifstream file(folder() / name);
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3i> triangles;
    const auto add = [&](const std::vector<int>& polygon) {
        for (size_t k = 2; k < polygon.size(); ++k)
            triangles.emplace_back(polygon[0], polygon[k - 1], polygon[k]);
    };
    std::string line, word;
    if (name.ends_with(".off")) {
        size_t n = 0, f = 0;
        std::getline(file, line);
        file >> n >> f >> word;
        points.resize(n);
        for (auto& p : points)
            file >> p[0] >> p[1] >> p[2];
        for (size_t i = 0; i < f; ++i) {
            size_t corners = 0;
            file >> corners;
            std::vector<int> polygon(corners);
            for (int& v : polygon)
                file >> v;
            add(polygon);
        }
    } else {
        while (std::getline(file, line)) {
            std::istringstream words(line);
            words >> word;
            if (line.starts_with("v ")) {
                points.emplace_back();
                words >> points.back()[0] >> points.back()[1] >> points.back()[2];
            } else if (line.starts_with("f ")) {
                std::vector<int> polygon;
                while (words >> word)
                    polygon.push_back(std::stoi(word) - 1); // up to the first slash
                add(polygon);
            }
        }
    }
    TriMesh mesh;
    mesh.position.resize(3, Eigen::Index(points.size()));
    for (size_t i = 0; i < points.size(); ++i)
        mesh.position.col(Eigen::Index(i)) = points[i];
    mesh.triangle.resize(3, Eigen::Index(triangles.size()));
    for (size_t i = 0; i < triangles.size(); ++i)
        mesh.triangle.col(Eigen::Index(i)) = triangles[i];
    return mesh;
}

/// Every vertex in the mean of its neighbours (each hole has one more in its middle), the longest
/// loop on a circle: no triangle flips [Tutte 1963], but the sizes differ by many powers of ten.
inline Eigen::Matrix2Xd onto_a_disk(const TriMesh& part, double radius)
{
    const auto loops = boundary_loops(part);
    const int n = part.vertices(), total = n + int(loops.size()) - 1;
    Eigen::Matrix2Xd plane = Eigen::Matrix2Xd::Zero(2, n);
    std::vector<char> fixed(size_t(total), 0);
    for (size_t i = 0; i < loops[0].size(); ++i) {
        const double angle = 2 * std::numbers::pi * double(i) / double(loops[0].size());
        plane.col(loops[0][i]) << radius * std::cos(angle), radius * std::sin(angle);
        fixed[size_t(loops[0][i])] = 1;
    }
    std::vector<std::pair<int, int>> edges;
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            edges.emplace_back(std::minmax(part.triangle(k, f), part.triangle((k + 1) % 3, f)));
    for (size_t l = 1; l < loops.size(); ++l)
        for (const int v : loops[l])
            edges.emplace_back(v, n + int(l) - 1);
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(total, 2);
    for (int v = 0; v < total; ++v)
        entries.emplace_back(v, v, fixed[size_t(v)] ? 1.0 : 1e-300);
    for (const auto& [a, b] : edges)
        for (const auto& [v, w] : {std::pair(a, b), std::pair(b, a)}) {
            if (fixed[size_t(v)])
                continue;
            entries.emplace_back(v, v, 1);
            if (fixed[size_t(w)])
                right.row(v) += plane.col(w).transpose();
            else
                entries.emplace_back(v, w, -1);
        }
    Eigen::SparseMatrix<double> matrix(total, total);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::MatrixX2d solution = SparseLdlt(matrix).solve(right);
    for (int v = 0; v < n; ++v)
        if (!fixed[size_t(v)])
            plane.col(v) = solution.row(v).transpose();
    return plane;
}

} // namespace spia::real_parts
