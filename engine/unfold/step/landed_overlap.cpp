#include "engine/unfold/step/landed_overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/flat/overlap.h"
#include "engine/mesh/locate.h"
#include "engine/mesh/orient2d.h"
#include "engine/unfold/target/turn_target.h"

namespace spia {
namespace {

/// The faces on a target, developed.
struct Landed {
    TriMesh mesh;            ///< with vertices of its own
    std::vector<int> source; ///< #V, of the part
    std::vector<int> piece;  ///< #V, the first face of the sheet that hangs together
    Eigen::Matrix2Xd flat;   ///< 2 by #V, mm
    std::vector<int> face;   ///< #F, of the part
};

std::vector<int> faces_on(const TriMesh& now, const TargetSurface& target, double within_mm)
{
    constexpr double along = 0.9; // cosine between the normals: a face that only crosses the target
                                  // is not on it
    std::vector<char> near(size_t(now.vertices()));
    for (int v = 0; v < now.vertices(); ++v) {
        const Eigen::Vector3d x = now.position.col(v);
        near[size_t(v)] = (x - placed(target, developed(target, x))).norm() <= within_mm;
    }
    std::vector<int> faces;
    for (int f = 0; f < now.triangles(); ++f) {
        const auto t = now.triangle.col(f);
        if (!near[size_t(t[0])] || !near[size_t(t[1])] || !near[size_t(t[2])])
            continue;
        const Eigen::Vector3d a = now.position.col(t[0]), b = now.position.col(t[1]), c = now.position.col(t[2]);
        if ((b - a).cross(c - a).normalized().dot(outer_normal(target, (a + b + c) / 3)) > along)
            faces.push_back(f);
    }
    return faces;
}

/// Turned so that its development is cut where no face is, if there is such a place.
TargetSurface best_cut(const TriMesh& now, const TargetSurface& target, const std::vector<int>& faces)
{
    std::vector<std::array<int, 2>> edges;
    Eigen::Matrix3Xd corner(3, Eigen::Index(3 * faces.size()));
    for (size_t k = 0; k < faces.size(); ++k)
        for (int a = 0; a < 3; ++a) {
            corner.col(Eigen::Index(3 * k) + a) = now.position.col(now.triangle(a, faces[k]));
            edges.push_back({int(3 * k) + a, int(3 * k) + (a + 1) % 3});
        }
    return turned_towards(target, corner, edges).value_or(target);
}

/// Faces that share an edge share its vertices; fans that touch in a vertex only have each their
/// own.
Landed developed_faces(const TriMesh& now, const TargetSurface& target, const std::vector<int>& faces)
{
    const auto place = [&](int v) { return developed(target, now.position.col(v)); };
    std::vector<int> whole; // the others have corners on both sides of the cut
    for (const int f : faces) {
        const auto t = now.triangle.col(f);
        if (orient2d(place(t[0]), place(t[1]), place(t[2])) > 0)
            whole.push_back(f);
    }
    const Eigen::Matrix3Xi triangle = now.triangle(Eigen::all, whole);
    DisjointSets fan(3 * whole.size()), sheet(whole.size());
    const std::vector<EdgeUse> uses = edge_uses(triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin != 2)
            return;
        const int f = uses[begin].face, g = uses[begin + 1].face;
        sheet.join(f, g);
        for (const int v : {uses[begin].low, uses[begin].high}) {
            const auto corner = [&](int face) {
                return 3 * face + (triangle(0, face) == v ? 0 : triangle(1, face) == v ? 1 : 2);
            };
            fan.join(corner(f), corner(g));
        }
    });
    Landed landed;
    std::vector<int> number(3 * whole.size(), -1);
    landed.mesh.triangle.resize(3, Eigen::Index(whole.size()));
    for (size_t c = 0; c < number.size(); ++c) {
        const auto root = size_t(fan.root(int(c)));
        if (number[root] < 0) {
            number[root] = int(landed.source.size());
            landed.source.push_back(triangle.reshaped()[Eigen::Index(c)]);
            landed.piece.push_back(sheet.root(int(c / 3)));
        }
        landed.mesh.triangle.reshaped()[Eigen::Index(c)] = number[root];
    }
    landed.face = whole;
    landed.mesh.position = now.position(Eigen::all, landed.source);
    landed.flat.resize(2, landed.mesh.vertices());
    for (int v = 0; v < landed.mesh.vertices(); ++v)
        landed.flat.col(v) = place(landed.source[size_t(v)]);
    return landed;
}

/// Which of the landed sheet a step has moved.
struct Moved {
    std::vector<char> face, vertex;        ///< #F; #V: a face around it
    std::set<int> piece;                   ///< with such a face
    std::set<std::pair<int, int>> outline; ///< edges of such faces, low vertex first

    Moved(const Landed& landed, int faces_of_part, const std::vector<int>& moved)
        : face(landed.face.size(), 0), vertex(landed.source.size(), 0)
    {
        std::vector<char> of_part(size_t(faces_of_part), 0);
        for (const int f : moved)
            of_part[size_t(f)] = 1;
        for (size_t f = 0; f < face.size(); ++f) {
            face[f] = of_part[size_t(landed.face[f])];
            if (face[f])
                for (const int v : landed.mesh.triangle.col(Eigen::Index(f))) {
                    vertex[size_t(v)] = 1;
                    piece.insert(landed.piece[size_t(v)]);
                }
        }
        const std::vector<EdgeUse> uses = edge_uses(landed.mesh.triangle);
        for_each_edge(uses, [&](size_t begin, size_t end) {
            if (end - begin == 1 && face[size_t(uses[begin].face)])
                outline.insert({uses[begin].low, uses[begin].high});
        });
    }
    bool edge(const std::array<int, 2>& e) const { return outline.count(std::minmax(e[0], e[1])) > 0; }
};

/// A vertex of every piece that lies within another one, though no outline of it meets another's,
/// and the face it lies on.
std::vector<std::pair<int, int>> nested(const Landed& landed, const std::set<int>& crossing)
{
    std::vector<std::pair<int, int>> found;
    std::set<int> seen = crossing;
    const PlanarLocator locator(landed.flat, landed.mesh.triangle);
    std::map<int, int> fans;
    for (const int v : landed.source)
        ++fans[v];
    for (int v = 0; v < landed.mesh.vertices(); ++v) {
        if (fans[landed.source[size_t(v)]] > 1) // where pieces touch anyway
            continue;
        if (!seen.insert(landed.piece[size_t(v)]).second)
            continue;
        const Eigen::Vector2d x = landed.flat.col(v);
        for (const MeshPoint& place : locator.covering(x)) {
            const auto t = landed.mesh.triangle.col(place.face);
            const Eigen::Vector2d a = landed.flat.col(t[0]), b = landed.flat.col(t[1]), c = landed.flat.col(t[2]);
            if (landed.piece[size_t(t[0])] != landed.piece[size_t(v)] && orient2d(a, b, x) >= 0 &&
                orient2d(b, c, x) >= 0 && orient2d(c, a, x) >= 0) {
                found.emplace_back(v, place.face);
                break;
            }
        }
    }
    return found;
}

} // namespace

LandedOverlap landed_overlap(const TriMesh& now, const TargetSurface& target, double within_mm,
                             const std::vector<int>& moved)
{
    LandedOverlap result;
    const std::vector<int> faces = faces_on(now, target, within_mm);
    if (faces.empty())
        return result;
    const Landed landed = developed_faces(now, best_cut(now, target, faces), faces);
    if (landed.mesh.triangles() == 0)
        return result;
    const Overlap over = overlap(landed.mesh, landed.flat);
    const Moved by_step(landed, now.triangles(), moved);
    const auto take = [&](const Eigen::Vector3d& place, bool of_moved) {
        if (result.places++ == 0)
            result.first = place;
        result.landed += of_moved;
    };
    std::set<int> crossing;
    for (const OutlineCrossing& pair : over.crossings) {
        const auto touch = [&](int v, int w) { // fans of one vertex: there they may meet
            return v != w && landed.source[size_t(v)] == landed.source[size_t(w)];
        };
        const auto [a, b] = pair.edge;
        const auto [c, d] = pair.other;
        if (touch(a, c) || touch(a, d) || touch(b, c) || touch(b, d))
            continue;
        if (landed.piece[size_t(a)] != landed.piece[size_t(c)])
            crossing.insert({landed.piece[size_t(a)], landed.piece[size_t(c)]});
        take((landed.mesh.position.col(a) + landed.mesh.position.col(b)) / 2,
             by_step.edge({a, b}) || by_step.edge({c, d}));
    }
    for (const int v : over.wound)
        take(landed.mesh.position.col(v), by_step.vertex[size_t(v)]);
    for (const auto& [v, face] : nested(landed, crossing))
        take(landed.mesh.position.col(v),
             by_step.piece.count(landed.piece[size_t(v)]) > 0 || by_step.face[size_t(face)]);
    return result;
}

} // namespace spia
