#include "app/viewer/model/section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace spia::viewer {

std::vector<SectionPiece> section(const TriMesh& mesh, const Eigen::VectorXd& value, const SectionLine& line)
{
    const Eigen::Vector3d whole = line.to - line.from, along = whole.normalized();
    const Eigen::Vector3d normal = along.cross(line.depth).normalized();
    const double length = whole.norm();
    struct Cut {
        Eigen::Vector3d place;
        double distance, value;
    };
    std::vector<SectionPiece> pieces;
    for (int f = 0; f < mesh.triangles(); ++f) {
        Eigen::Vector3d height;
        for (int a = 0; a < 3; ++a)
            height[a] = normal.dot(mesh.position.col(mesh.triangle(a, f)) - line.from);
        Cut cut[2];
        int cuts = 0;
        for (int a = 0; a < 3 && cuts < 2; ++a) {
            const int b = (a + 1) % 3, v = mesh.triangle(a, f), w = mesh.triangle(b, f);
            if ((height[a] < 0) == (height[b] < 0))
                continue;
            const double t = height[a] / (height[a] - height[b]);
            const Eigen::Vector3d place = (1 - t) * mesh.position.col(v) + t * mesh.position.col(w);
            cut[cuts++] = {place, along.dot(place - line.from), (1 - t) * value[v] + t * value[w]};
        }
        if (cuts < 2)
            continue;
        if (cut[0].distance > cut[1].distance)
            std::swap(cut[0], cut[1]);
        if (cut[1].distance < 0 || cut[0].distance > length)
            continue;
        const Cut first = cut[0], last = cut[1];
        const auto at = [&](double distance) -> Cut { // on the piece, where the line begins or ends
            const double span = last.distance - first.distance, t = span > 0 ? (distance - first.distance) / span : 0;
            return {first.place + t * (last.place - first.place), distance,
                    first.value + t * (last.value - first.value)};
        };
        if (first.distance < 0)
            cut[0] = at(0);
        if (last.distance > length)
            cut[1] = at(length);
        pieces.push_back({f, cut[0].place, cut[1].place, cut[0].distance, cut[1].distance, cut[0].value, cut[1].value});
    }
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const SectionPiece& a, const SectionPiece& b) { return a.from_distance < b.from_distance; });
    return pieces;
}

} // namespace spia::viewer
