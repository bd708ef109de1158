#include "engine/nurbs/normal_deviation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/core/sort_in_parts.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {

MeshNormals::MeshNormals(const TriMesh& mesh, int part_faces, double sharp_angle)
    : normal(area_vectors(mesh)), sharp(size_t(mesh.triangles()), 0)
{
    for (auto column : normal.colwise())
        column.stableNormalize();
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    const double least = std::cos(sharp_angle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end != begin + 2)
            return;
        const int a = uses[begin].face, b = uses[begin + 1].face;
        if (a < part_faces && b < part_faces && normal.col(a).dot(normal.col(b)) < least)
            sharp[size_t(a)] = sharp[size_t(b)] = 1;
    });
}

NormalDeviation normal_deviation(const std::vector<NormalSample>& samples, const MeshNormals& mesh,
                                 const std::function<Eigen::Vector3d(int sample)>& position, std::vector<int>& turned,
                                 const Progress& progress)
{
    const auto checkpoint = [&] { progress.checkpoint(1, "comparing the normals"); };
    checkpoint();
    struct Angle {
        double angle, weight;
        int sample;
    };
    std::vector<Angle> angles;
    double same_side = 0;
    for (int i = 0; i < int(samples.size()); ++i) {
        const NormalSample& here = samples[size_t(i)];
        if (here.face < 0 || here.normal.isZero(0) || mesh.normal.col(here.face).isZero(0))
            continue;
        const Eigen::Vector3d face = mesh.normal.col(here.face);
        angles.push_back({std::atan2(here.normal.cross(face).norm(), here.normal.dot(face)), here.weight, i});
        same_side += here.weight * here.normal.dot(face);
    }
    checkpoint();
    NormalDeviation result;
    result.samples = int(angles.size());
    double area = 0, sum = 0;
    int worst = -1;
    for (Angle& here : angles) {
        if (same_side < 0)
            here.angle = M_PI - here.angle;
        area += here.weight;
        sum += here.weight * here.angle;
        if (here.angle > M_PI / 2) {
            turned.push_back(here.sample);
            result.turned += here.weight;
        }
        result.max = std::max(result.max, here.angle);
        if (!mesh.sharp[size_t(samples[size_t(here.sample)].face)] && here.angle > result.max_smooth) {
            result.max_smooth = here.angle;
            worst = here.sample;
        }
    }
    if (worst >= 0)
        result.where = position(worst);
    if (!(area > 0))
        return result;
    result.mean = sum / area;
    result.turned /= area;
    const auto flatter = [](const Angle& a, const Angle& b) {
        return a.angle < b.angle || (a.angle == b.angle && a.sample < b.sample);
    };
    sort_in_parts(angles, flatter, checkpoint);
    double below = 0;
    for (const Angle& here : angles) {
        below += here.weight;
        result.p95 = here.angle;
        if (below >= 0.95 * area)
            break;
    }
    return result;
}

} // namespace spia
