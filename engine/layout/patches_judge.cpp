#include "engine/layout/patches_judge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <numeric>
#include <optional>

#include "engine/core/parallel.h"
#include "engine/layout/plane_lines.h"
#include "engine/mesh/flat/inside_polygon.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/project.h"
#include "engine/nurbs/tessellate.h"

namespace spia {

namespace {

bool in_box(const Eigen::Vector4d& box, const Eigen::Vector2d& p)
{
    return p.x() >= box[0] && p.y() >= box[1] && p.x() <= box[2] && p.y() <= box[3];
}

DeviationStatistics statistics(const std::vector<double>& distance, const std::vector<double>& weight,
                               const Eigen::Matrix3Xd& position, double tolerance)
{
    DeviationStatistics result;
    result.samples = int(distance.size());
    std::vector<int> order(distance.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return distance[size_t(a)] < distance[size_t(b)]; });
    double total = 0, sum = 0, squares = 0, within = 0;
    for (size_t i = 0; i < distance.size(); ++i) {
        total += weight[i];
        sum += weight[i] * distance[i];
        squares += weight[i] * distance[i] * distance[i];
        within += distance[i] <= tolerance ? weight[i] : 0;
    }
    if (order.empty() || !(total > 0))
        return result;
    result.max = distance[size_t(order.back())];
    result.where = position.col(order.back());
    result.mean = sum / total;
    result.rms = std::sqrt(squares / total);
    result.within = result.max <= tolerance ? 1 : within / total;
    double below = 0;
    for (const int i : order) {
        below += weight[size_t(i)];
        result.p95 = distance[size_t(i)];
        if (below >= 0.95 * total)
            break;
    }
    return result;
}

void keep_greater(GreatestDeviation& greatest, double distance, const Eigen::Vector3d& where)
{
    if (distance > greatest.max)
        greatest = {distance, where};
}

/// Half of the way to both neighbours.
std::vector<double> shares(const std::vector<double>& t)
{
    std::vector<double> result(t.size(), 0);
    for (size_t i = 0; i + 1 < t.size(); ++i) {
        result[i] += (t[i + 1] - t[i]) / 2;
        result[i + 1] += (t[i + 1] - t[i]) / 2;
    }
    return result;
}

} // namespace

PatchesJudge::PatchesJudge(const TriMesh& part, const Blank& blank, const Layout& layout, double tolerance,
                           const Progress& progress)
    : tolerance_(tolerance), search_(part, progress), vertex_normal_(vertex_normals(part)),
      samples_(sample_mesh(part, part.triangles()))
{
    TriMesh flat = part;
    flat.position.topRows(2) = blank.position;
    flat.position.row(2).setZero();
    plane_ = sample_mesh(flat, part.triangles()).position.topRows(2);
    std::vector<Eigen::Matrix2Xd> polygon;
    for (const LayoutPatch& patch : layout.patch) {
        polygon.push_back(polygon_of(layout, patch).point);
        const Eigen::Vector2d low = polygon.back().rowwise().minCoeff(), high = polygon.back().rowwise().maxCoeff();
        const Eigen::Vector2d room = Eigen::Vector2d::Constant(1e-3 * (high - low).norm());
        box_.emplace_back();
        box_.back() << low - room, high + room;
    }
    patch_.assign(size_t(plane_.cols()), 0);
    for_each_in_parts(int(plane_.cols()), progress, "finding the patch of every place", [&](int i) {
        const Eigen::Vector2d p = plane_.col(i);
        int boxed = -1;
        for (int k = 0; k < int(polygon.size()); ++k) {
            if (!in_box(box_[size_t(k)], p))
                continue;
            if (boxed < 0)
                boxed = k;
            if (inside_polygon(polygon[size_t(k)], p)) {
                boxed = k;
                break;
            }
        }
        patch_[size_t(i)] = std::max(0, boxed);
    });
}

PatchesJudgement PatchesJudge::judge(const std::vector<NurbsSurface>& patches, const Progress& progress) const
{
    constexpr const char* from_patches = "measuring from the patches to the part";
    PatchesJudgement result;
    result.patch.resize(patches.size());
    result.missing.resize(patches.size());
    std::vector<double> distance, weight;
    std::vector<Eigen::Vector3d> position;
    std::vector<SurfaceProjection> projection;
    for (size_t p = 0; p < patches.size(); ++p) {
        const double all = double(patches.size());
        const Progress here = progress.part(0.5 * double(p) / all, 0.5 * double(p + 1) / all);
        here.checkpoint(0, from_patches);
        const NurbsSurface& patch = patches[p];
        const auto u = sample_parameters(patch.knots_u, patch.degree_u, 4),
                   v = sample_parameters(patch.knots_v, patch.degree_v, 4);
        const auto share_u = shares(u), share_v = shares(v);
        const size_t first = distance.size(), count = u.size() * v.size();
        distance.resize(first + count);
        weight.resize(first + count);
        position.resize(first + count);
        for_each_in_parts(int(count), here, from_patches, [&](int i) {
            const size_t a = size_t(i) % u.size(), b = size_t(i) / u.size();
            const SurfacePoint at = evaluate(patch, u[a], v[b]);
            position[first + size_t(i)] = at.position;
            distance[first + size_t(i)] = search_.nearest(at.position).distance;
            weight[first + size_t(i)] = at.S_u.cross(at.S_v).norm() * share_u[a] * share_v[b];
        });
        for (size_t i = 0; i < count; ++i) {
            keep_greater(result.patch[p], distance[first + i], position[first + i]);
            if (distance[first + i] > tolerance_)
                result.missing[p].push_back({u[i % u.size()], v[i / u.size()], distance[first + i]});
        }
        projection.emplace_back(patch, 4, here.part(1, 1));
    }
    Eigen::Matrix3Xd places(3, Eigen::Index(position.size()));
    for (size_t i = 0; i < position.size(); ++i)
        places.col(Eigen::Index(i)) = position[i];
    result.surface_to_mesh = statistics(distance, weight, places, tolerance_);

    const int count = int(plane_.cols());
    std::vector<double> back(static_cast<size_t>(count));
    result.at_vertex.resize(vertex_normal_.cols());
    std::vector<SurfaceFoot> foot(static_cast<size_t>(count));
    std::vector<int> nearest = patch_; // a place on a line between patches may be another one's
    for_each_in_parts(count, progress.part(0.5, 1), "measuring from the part to the patches", [&](int i) {
        const Eigen::Vector3d point = samples_.position.col(i);
        const SurfaceFoot own = projection[size_t(patch_[size_t(i)])].nearest(point);
        foot[size_t(i)] = own;
        for (size_t p = 0; p < patches.size() && foot[size_t(i)].distance > tolerance_; ++p)
            if (int(p) != patch_[size_t(i)] && in_box(box_[p], plane_.col(i)))
                if (const SurfaceFoot other = projection[p].nearest(point); other.distance < foot[size_t(i)].distance) {
                    foot[size_t(i)] = other;
                    nearest[size_t(i)] = int(p);
                }
        back[size_t(i)] = foot[size_t(i)].distance;
        if (i < int(vertex_normal_.cols())) {
            const bool outside = (own.position - point).dot(vertex_normal_.col(i)) >= 0;
            result.at_vertex[i] = outside ? back[size_t(i)] : -back[size_t(i)];
        }
    });
    for (int i = 0; i < count; ++i) {
        const size_t p = size_t(nearest[size_t(i)]);
        keep_greater(result.patch[p], back[size_t(i)], samples_.position.col(i));
        if (back[size_t(i)] > tolerance_)
            result.missing[p].push_back({foot[size_t(i)].u, foot[size_t(i)].v, back[size_t(i)]});
    }
    result.mesh_to_surface = statistics(back, samples_.weight, samples_.position, tolerance_);
    return result;
}

} // namespace spia
