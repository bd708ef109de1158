#include "engine/mesh/smooth/creases.h"

#include <algorithm>
#include <numbers>

#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"

namespace spia {

SheetTurns::SheetTurns(const TriMesh& mesh, double crease)
    : mesh_(mesh), crease_(crease), normal_(area_vectors(mesh)),
      neighbour_(face_neighbours(mesh.triangles(), edge_uses(mesh.triangle))),
      creased_(Eigen::Matrix3Xi::Zero(3, mesh.triangles())), around_(size_t(mesh.vertices())),
      at_rim_(size_t(mesh.vertices()), 0)
{
    normal_.colwise().normalize();
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            around_[size_t(mesh.triangle(k, f))].push_back(f);
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int g = neighbour_(k, f);
            if (g > f && turns_alone(f, k))
                for (int l = 0; l < 3; ++l)
                    if (neighbour_(l, g) == f)
                        creased_(k, f) = creased_(l, g) = 1;
        }
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            if (neighbour_(k, f) < 0 || creased_(k, f))
                at_rim_[size_t(mesh.triangle(k, f))] = at_rim_[size_t(mesh.triangle((k + 1) % 3, f))] = 1;
}

bool SheetTurns::turns_alone(int f, int k) const
{
    const int g = neighbour_(k, f);
    const double turn = angle_between(normal_.col(f), normal_.col(g));
    constexpr double least = 3 * level;
    if (turn > crease_ || turn <= least)
        return turn > crease_;
    const std::vector<int> both = {f, g};
    const double most = std::max(level, isolated * turn);
    return turn_behind(f, both) < most && turn_behind(g, both) < most;
}

double SheetTurns::turn_behind(int f, const std::vector<int>& beside, int about, double reach) const
{
    double result = 0;
    for (int k = 0; k < 3; ++k) {
        const int v = mesh_.triangle(k, f);
        if (about >= 0 && (mesh_.position.col(v) - mesh_.position.col(about)).norm() > reach)
            continue;
        for (const int h : around_[size_t(v)]) {
            if (angle_between(normal_.col(h), normal_.col(f)) > crease_)
                continue;
            double least = std::numbers::pi;
            for (const int g : beside)
                least = std::min(least, angle_between(normal_.col(h), normal_.col(g)));
            result = std::max(result, least);
        }
    }
    return result;
}

} // namespace spia
