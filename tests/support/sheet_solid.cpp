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

TriMesh stepped(const TriMesh& solid, int skin_faces, const std::vector<char>& chosen, const Eigen::Matrix3Xd& way)
{
    const int before = solid.vertices(), rim_from = 2 * skin_faces;
    const auto is_chosen = [&](int f) { return f < rim_from && chosen[size_t(f)] != 0; };
    std::map<std::pair<int, int>, int> face_of; // per directed edge
    for (int f = 0; f < solid.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            face_of[{solid.triangle(k, f), solid.triangle((k + 1) % 3, f)}] = f;
    std::vector<char> follows(size_t(solid.triangles()), 0), stays(size_t(before), 0), moves(size_t(before), 0);
    for (int f = 0; f < rim_from; ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = solid.triangle(k, f), b = solid.triangle((k + 1) % 3, f), on = face_of.at({b, a});
            (is_chosen(f) ? moves : stays)[size_t(a)] = 1;
            if (is_chosen(f) && on >= rim_from) { // its faces come in pairs, one for each edge of
                                                  // the outer skin
                const int first = rim_from + (on - rim_from) / 2 * 2;
                follows[size_t(first)] = follows[size_t(first + 1)] = 1;
            }
        }
    std::vector<int> copy(size_t(before), -1);
    std::vector<Eigen::Vector3d> position;
    for (int v = 0; v < before; ++v)
        position.push_back(solid.position.col(v) +
                           (moves[size_t(v)] && !stays[size_t(v)] ? way.col(v).eval() : Eigen::Vector3d::Zero()));
    for (int v = 0; v < before; ++v)
        if (moves[size_t(v)] && stays[size_t(v)]) {
            copy[size_t(v)] = int(position.size());
            position.push_back(solid.position.col(v) + way.col(v));
        }
    const auto lower = [&](int v) { return copy[size_t(v)] >= 0 ? copy[size_t(v)] : v; };
    std::vector<Eigen::Vector3i> triangle, added;
    for (int f = 0; f < solid.triangles(); ++f) {
        Eigen::Vector3i t = solid.triangle.col(f);
        for (int k = 0; k < 3; ++k) {
            const int a = solid.triangle(k, f), b = solid.triangle((k + 1) % 3, f), on = face_of.at({b, a});
            if (is_chosen(f) && on < rim_from && !is_chosen(on)) {
                added.emplace_back(a, b, lower(b));
                added.emplace_back(a, lower(b), lower(a));
            }
            // Between two pairs of the rim one of which has its corner moved.
            if (follows[size_t(f)] && on >= rim_from && !follows[size_t(on)]) {
                if (copy[size_t(a)] >= 0)
                    added.emplace_back(lower(a), a, b);
                else if (copy[size_t(b)] >= 0)
                    added.emplace_back(a, b, lower(b));
            }
        }
        if (is_chosen(f) || follows[size_t(f)])
            for (int k = 0; k < 3; ++k)
                t[k] = lower(t[k]);
        triangle.push_back(t);
    }
    triangle.insert(triangle.end(), added.begin(), added.end());
    TriMesh result;
    result.position.resize(3, Eigen::Index(position.size()));
    for (size_t v = 0; v < position.size(); ++v)
        result.position.col(Eigen::Index(v)) = position[v];
    result.triangle.resize(3, Eigen::Index(triangle.size()));
    for (size_t f = 0; f < triangle.size(); ++f)
        result.triangle.col(Eigen::Index(f)) = triangle[f];
    return result;
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
