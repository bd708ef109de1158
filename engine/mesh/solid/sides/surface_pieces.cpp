#include "engine/mesh/solid/sides/surface_pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/face_neighbours.h"

namespace spia {
namespace {

constexpr double radians = 3.14159265358979323846 / 180;

/// From the largest triangle on, all that can be reached over triangles with nearly its normal. A
/// flat is a piece without the first chords of what is bent or rounded at it.
std::vector<int> grown_pieces(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, const Eigen::Matrix3Xi& neighbour)
{
    const double most_turn = std::cos(12 * radians); // a fraction of the angle between a skin and
                                                     // the faces of a rim
    const double flat = std::cos(0.5 * radians);     // rounding of coordinates; chords turn by more
    constexpr double large = 0.01;                   // of the surface
    const Eigen::VectorXd size = normal.colwise().norm();
    std::vector<int> order(size_t(mesh.triangles())), piece(size_t(mesh.triangles()), -1), reached;
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size[a] > size[b]; });
    int count = 0;
    const auto grow = [&](int seed, double turn) {
        const Eigen::Vector3d direction = normal.col(seed).normalized();
        piece[size_t(seed)] = count;
        reached.assign(1, seed);
        for (size_t i = 0; i < reached.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const int next = neighbour(k, reached[i]);
                if (next >= 0 && piece[size_t(next)] < 0 && normal.col(next).dot(direction) >= turn * size[next]) {
                    piece[size_t(next)] = count;
                    reached.push_back(next);
                }
            }
    };
    const double whole = size.sum();
    for (const int seed : order) {
        if (piece[size_t(seed)] >= 0)
            continue;
        grow(seed, flat);
        double area = 0;
        for (const int f : reached)
            area += size[f];
        if (area < large * whole) {
            for (const int f : reached)
                piece[size_t(f)] = -1;
            grow(seed, most_turn);
        }
        ++count;
    }
    return piece;
}

} // namespace

SurfacePieces surface_pieces(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, const std::vector<int>& unit)
{
    const double sharp = std::cos(40 * radians);  // bends of coarse meshes turn by less, rims by 90
                                                  // degrees
    const double level = std::cos(0.5 * radians); // rounding of coordinates; chords turn by more
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    SurfacePieces result;
    if (unit.empty())
        result.piece = grown_pieces(mesh, normal, face_neighbours(mesh.triangles(), uses));
    else {
        std::map<int, int> number;
        for (const int u : unit)
            result.piece.push_back(number.try_emplace(u, int(number.size())).first->second);
    }
    for (int f = 0; f < mesh.triangles(); ++f) {
        const auto p = size_t(result.piece[size_t(f)]);
        if (p >= result.area.size())
            result.area.resize(p + 1, 0);
        result.area[p] += normal.col(f).norm();
    }
    std::map<std::pair<int, int>, PieceContact> contacts;
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end != begin + 2)
            return;
        const EdgeUse &one = uses[begin], &two = uses[begin + 1];
        const int p = result.piece[size_t(one.face)], q = result.piece[size_t(two.face)];
        if (p == q)
            return;
        const auto [a, b] = std::minmax(p, q);
        PieceContact& contact = contacts.try_emplace({a, b}, PieceContact{a, b}).first->second;
        const Eigen::Vector3d m = normal.col(one.face), n = normal.col(two.face);
        const Eigen::Vector3d along = mesh.position.col(one.high) - mesh.position.col(one.low);
        // to the left of the first face: convex
        const double turn = m.cross(n).dot(along) * (one.forward ? 1 : -1);
        double& kind = m.dot(n) >= sharp * m.norm() * n.norm() ? contact.smooth
                       : turn > 0                              ? contact.convex
                                                               : contact.concave;
        kind += along.norm();
        if (m.dot(n) >= level * m.norm() * n.norm())
            contact.level += along.norm();
    });
    for (const auto& [pair, contact] : contacts)
        result.contact.push_back(contact);
    return result;
}

} // namespace spia
