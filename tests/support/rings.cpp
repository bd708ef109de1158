#include "tests/support/rings.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace spia::shapes {
namespace {

struct Row {
    const Eigen::Matrix3Xd& points;
    int first; ///< the vertex index of its first point

    int size() const { return int(points.cols()); }
    auto point(int i) const { return points.col(i % size()); }
    int vertex(int i) const { return first + i % size(); }
};

int nearest(const Row& row, const Eigen::Vector3d& x)
{
    int best = 0;
    (row.points.colwise() - x).colwise().squaredNorm().minCoeff(&best);
    return best;
}

/// Walks around both rows at once and always takes the shorter of the two next diagonals.
int stitch(const Row& inner, const Row& outer, Eigen::Matrix3Xi& triangle, int f)
{
    const int inner_steps = inner.size() > 1 ? inner.size() : 0;
    const int j0 = inner_steps > 0 ? nearest(outer, inner.point(0)) : 0;
    int i = 0, j = 0;
    while (i < inner_steps || j < outer.size()) {
        const auto a = inner.point(i), b = outer.point(j0 + j);
        const bool outwards = i == inner_steps || (j < outer.size() && (a - outer.point(j0 + j + 1)).norm() <=
                                                                           (b - inner.point(i + 1)).norm());
        if (outwards) {
            triangle.col(f++) << inner.vertex(i), outer.vertex(j0 + j), outer.vertex(j0 + j + 1);
            ++j;
        } else {
            triangle.col(f++) << inner.vertex(i), outer.vertex(j0 + j), inner.vertex(i + 1);
            ++i;
        }
    }
    return f;
}

} // namespace

std::vector<RingPlan> plan_rings(const std::vector<double>& s, double edge, int fold,
                                 const std::function<Eigen::Vector2d(double s)>& place,
                                 const std::function<double(double distance)>& circumference)
{
    constexpr double steep = 0.985; // sin 80 degrees
    constexpr int fewest = 6;       // around a pole
    std::vector<RingPlan> rings;
    Eigen::Vector2d above(0, 0);
    for (double where : s) {
        const Eigen::Vector2d here = place(where);
        const double length = circumference(here.x());
        if (length < 1e-6 * edge) {
            rings.push_back({where, 1, 0});
        } else {
            const double steps = length / edge / fold;
            RingPlan ring{where, fold * std::max((fewest + fold - 1) / fold, int(std::lround(steps))), 0};
            if (!rings.empty() && rings.back().points > 1) {
                const RingPlan& last = rings.back();
                const bool wall = std::abs(here.y() - above.y()) > steep * (here - above).norm();
                if (wall && std::abs(ring.points - last.points) <= std::max(fold, last.points / 10))
                    ring = {where, last.points, last.phase};
                else
                    ring.phase = 0.5 - last.phase;
            }
            rings.push_back(ring);
        }
        above = here;
    }
    return rings;
}

TriMesh stitch_rings(const std::vector<Eigen::Matrix3Xd>& rings)
{
    assert(rings.size() > 1);
    int vertices = 0, triangles = 0;
    for (size_t k = 0; k < rings.size(); ++k) {
        const int n = int(rings[k].cols()), neighbours = (k > 0) + (k + 1 < rings.size());
        vertices += n;
        triangles += n > 1 ? n * neighbours : 0; // one triangle per step along either ring of a
                                                 // pair
    }
    TriMesh mesh;
    mesh.position.resize(3, vertices);
    mesh.triangle.resize(3, triangles);
    int first = 0, f = 0;
    for (size_t k = 0; k < rings.size(); ++k) {
        const int n = int(rings[k].cols());
        mesh.position.middleCols(first, n) = rings[k];
        if (k > 0)
            f = stitch({rings[k - 1], first - int(rings[k - 1].cols())}, {rings[k], first}, mesh.triangle, f);
        first += n;
    }
    assert(f == triangles);
    return mesh;
}

} // namespace spia::shapes
