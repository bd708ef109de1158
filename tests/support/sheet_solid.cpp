#include "tests/support/sheet_solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/topology.h"

namespace spia::shapes {

BentSheet bent_sheet(const Profile& profile, double length, double edge)
{
    const std::vector<double> s = even_spacing(profile, edge);
    const int columns = int(s.size()) - 1, rows = std::max(2, int(std::lround(length / edge)));
    BentSheet sheet;
    sheet.mesh.position.resize(3, (columns + 1) * (rows + 1));
    sheet.normal.resize(3, (columns + 1) * (rows + 1));
    sheet.mesh.triangle.resize(3, 2 * columns * rows);
    const auto piece_at = [&](double at) {
        size_t k = 0;
        while (k + 1 < profile.pieces().size() && at > profile.pieces()[k].to)
            ++k;
        return int(k);
    };
    for (int i = 0; i <= columns; ++i) {
        const auto& piece = profile.pieces()[size_t(piece_at(s[size_t(i)]))];
        const double heading = piece.heading + piece.curvature * (s[size_t(i)] - piece.from);
        const Eigen::Vector2d p = profile.at(s[size_t(i)]);
        for (int j = 0; j <= rows; ++j) {
            sheet.mesh.position.col(i * (rows + 1) + j) << p.x(), length * j / rows, p.y();
            sheet.normal.col(i * (rows + 1) + j) << -std::sin(heading), 0, std::cos(heading);
        }
    }
    int f = 0;
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const int a = i * (rows + 1) + j, b = a + rows + 1;
            sheet.mesh.triangle.col(f++) << a, b, b + 1;
            sheet.mesh.triangle.col(f++) << a, b + 1, a + 1;
            sheet.piece.insert(sheet.piece.end(), 2, piece_at((s[size_t(i)] + s[size_t(i) + 1]) / 2));
        }
    return sheet;
}

TriMesh thickened(const TriMesh& outer, const Eigen::Matrix3Xd& inwards)
{
    const int v = outer.vertices(), f = outer.triangles();
    const auto loops = boundary_loops(outer);
    int edges = 0;
    for (const auto& loop : loops)
        edges += int(loop.size());
    TriMesh solid;
    solid.position.resize(3, 2 * v);
    solid.position << outer.position, outer.position + inwards;
    solid.triangle.resize(3, 2 * f + 2 * edges);
    solid.triangle.leftCols(f) = outer.triangle;
    solid.triangle.middleCols(f, f) = outer.triangle.colwise().reverse().array() + v;
    int at = 2 * f;
    for (const auto& loop : loops)
        for (size_t i = 0; i < loop.size(); ++i) {
            const int a = loop[i], b = loop[(i + 1) % loop.size()];
            solid.triangle.col(at++) << b, a, v + a;
            solid.triangle.col(at++) << b, v + a, v + b;
        }
    return solid;
}

std::vector<int> cad_faces(const BentSheet& sheet, const TriMesh& solid)
{
    const int f = sheet.mesh.triangles(), pieces = *std::max_element(sheet.piece.begin(), sheet.piece.end()) + 1;
    std::vector<int> face = sheet.piece;
    for (int i = 0; i < f; ++i)
        face.push_back(pieces + sheet.piece[size_t(i)]);
    int number = 2 * pieces;
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
    const Eigen::Matrix3Xd normal = area_vectors(solid).colwise().normalized();
    for (int i = 2 * f; i < solid.triangles(); ++i) {
        if (normal.col(i).dot(last) < 0.7)
            ++number;
        last = normal.col(i);
        face.push_back(number);
    }
    return face;
}

} // namespace spia::shapes
