#include "app/viewer/model/picking/picking.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/viewer/model/picking/sight.h"
#include "engine/core/infinity.h"
#include "engine/core/parallel.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/flat/outline.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

constexpr double edge_on = 1e-4; ///< radians between a face and the line of sight: no pixel shows
                                 ///< it
constexpr double sharp_turn = 20 * std::numbers::pi / 180;

/// A closed polygon of pixels, with its edges sorted into horizontal bands: a lasso has hundreds of
/// them.
class PixelPolygon {
public:
    explicit PixelPolygon(const std::vector<glm::dvec2>& corner) : band_(corner.size() + 1)
    {
        for (const glm::dvec2& p : corner) {
            box_.least = glm::min(box_.least, p);
            box_.greatest = glm::max(box_.greatest, p);
        }
        for (size_t i = 0; i < corner.size(); ++i) {
            const glm::dvec2 a = corner[i], b = corner[(i + 1) % corner.size()];
            for (size_t k = band(std::min(a.y, b.y)); k <= band(std::max(a.y, b.y)); ++k)
                band_[k].push_back({a, b});
        }
    }

    const PixelBox& box() const { return box_; }

    bool holds(glm::dvec2 p) const
    {
        if (!box_.holds(p))
            return false;
        bool inside = false;
        for (const auto& [a, b] : band_[band(p.y)])
            if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
                inside = !inside;
        return inside;
    }

private:
    struct Edge {
        glm::dvec2 a, b;
    };

    size_t band(double y) const
    {
        const double height = box_.greatest.y - box_.least.y;
        return height > 0 ? size_t((y - box_.least.y) / height * double(band_.size() - 1)) : 0;
    }

    PixelBox box_;
    std::vector<std::vector<Edge>> band_;
};

/// Faces whose middle is seen (or, through others, would be) at a pixel for which inside(pixel)
/// holds.
/// @param box of pixels, outside of which there is none
template <class Inside>
FaceSet faces_seen(const Camera& camera, const TriMesh& mesh, const RayPicker& picker, glm::dvec2 size, PixelBox box,
                   bool through, const std::optional<HalfSpace>& kept, const Inside& inside)
{
    const Sight sight(camera, picker.box(), size);
    box.least = glm::max(box.least, glm::dvec2(0)); // what the view does not show is not picked
    box.greatest = glm::min(box.greatest, size);
    if (!(box.least.x <= box.greatest.x && box.least.y <= box.greatest.y))
        return {};
    FaceSet faces = picker.near(sight.half_spaces(box));
    std::vector<char> taken(faces.size(), 0);
    parallel_for(int(faces.size()), [&](int i) {
        const int f = faces[size_t(i)];
        const auto t = mesh.triangle.col(f);
        const Eigen::Vector3d a = mesh.position.col(t[0]), b = mesh.position.col(t[1]), c = mesh.position.col(t[2]);
        const Eigen::Vector3d middle = (a + b + c) / 3;
        const glm::dvec2 pixel = sight.pixel(middle);
        if (!box.holds(pixel) || !inside(pixel) || (kept && kept->height(middle) < 0))
            return;
        if (!through) {
            const Eigen::Vector3d viewer = sight.viewer_of(middle), normal = (b - a).cross(c - a);
            if (std::abs(normal.dot(viewer - middle)) <= edge_on * normal.norm() * (viewer - middle).norm() ||
                picker.hidden(f, middle, kept_eye(kept, viewer, middle)))
                return;
        }
        taken[size_t(i)] = 1;
    });
    size_t count = 0;
    for (size_t i = 0; i < faces.size(); ++i)
        if (taken[i])
            faces[count++] = faces[i];
    faces.resize(count);
    std::sort(faces.begin(), faces.end());
    return faces;
}

} // namespace

RayHit hit_at(const Camera& camera, const RayPicker& picker, glm::dvec2 pixel, glm::dvec2 size,
              const std::optional<HalfSpace>& kept)
{
    const Ray ray = ray_through(camera, picker.box(), pixel, size);
    if (!kept)
        return picker.first(ray.origin, ray.direction);
    const auto seen = kept_of_ray(*kept, ray.origin, ray.direction);
    if (!seen)
        return {};
    RayHit hit = picker.first(ray.origin + seen->from * ray.direction, ray.direction);
    hit.distance += seen->from;
    return hit.distance <= seen->to ? hit : RayHit{};
}

FaceSet faces_at(const PickAt& pick, const Camera& camera, const RayPicker& picker, const RegionSearch& part_regions,
                 const std::optional<HalfSpace>& kept)
{
    const int face = hit_at(camera, picker, pick.pixel, pick.size, kept).face;
    if (face < 0)
        return {};
    if (pick.smooth)
        return part_regions.smooth_region(face);
    if (pick.flood)
        return part_regions.flood(face, *pick.flood * std::numbers::pi / 180);
    return {face};
}

FaceSet faces_in(const PickArea& pick, const Camera& camera, const TriMesh& mesh, const RayPicker& picker,
                 const std::optional<HalfSpace>& kept)
{
    const PixelPolygon polygon(pick.polygon);
    return faces_seen(camera, mesh, picker, pick.size, polygon.box(), pick.through, kept,
                      [&](glm::dvec2 pixel) { return polygon.holds(pixel); });
}

FaceSet faces_under(const PickBrush& pick, const Camera& camera, const TriMesh& mesh, const RayPicker& picker,
                    const std::optional<HalfSpace>& kept)
{
    const PixelBox box{pick.pixel - pick.radius, pick.pixel + pick.radius};
    FaceSet faces = faces_seen(camera, mesh, picker, pick.size, box, pick.through, kept,
                               [&](glm::dvec2 pixel) { return glm::length(pixel - pick.pixel) <= pick.radius; });
    const int under = hit_at(camera, picker, pick.pixel, pick.size, kept).face;
    return under < 0 ? faces : united(faces, {under});
}

FaceSet picked(const FaceSet& selected, const FaceSet& faces, PickMode mode)
{
    switch (mode) {
    case PickMode::replace: return faces;
    case PickMode::add: return united(selected, faces);
    case PickMode::remove: return without(selected, faces);
    }
    return selected;
}

std::optional<Probe> probe_at(const Camera& camera, const TriMesh& mesh, const RayPicker& picker, glm::dvec2 pixel,
                              glm::dvec2 size, double snap, const std::optional<HalfSpace>& kept)
{
    const RayHit hit = hit_at(camera, picker, pixel, size, kept);
    if (hit.face < 0)
        return {};
    Probe probe{hit.face, hit.barycentric};
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d vertex = mesh.position.col(mesh.triangle(k, hit.face));
        const glm::dvec2 corner = pixel_of(camera, vertex, size);
        if (kept && kept->height(vertex) < 0)
            continue;
        if (const double away = glm::length(corner - pixel); away < snap) {
            snap = away;
            probe.barycentric = Eigen::Vector3d::Unit(k);
        }
    }
    return probe;
}

std::vector<int> sharp_turns(const std::vector<double>& turn, const Eigen::MatrixXd& place, double perimeter)
{
    const int n = int(turn.size());
    const double apart = turn_reaches[0] * perimeter;
    std::vector<int> sharp;
    for (int i = 0; i < n; ++i) {
        bool greatest = turn[size_t(i)] >= sharp_turn;
        for (const int step : {1, n - 1}) {
            double way = 0;
            for (int k = (i + step) % n, last = i; greatest && k != i; last = k, k = (k + step) % n) {
                way += (place.col(k) - place.col(last)).norm();
                if (way > apart)
                    break;
                const double other = turn[size_t(k)];
                // of equal ones the first
                greatest = turn[size_t(i)] > other || (turn[size_t(i)] == other && i < k);
            }
        }
        if (greatest)
            sharp.push_back(i);
    }
    return sharp;
}

CornerTrack corner_track(const TriMesh& part, const Blank& blank)
{
    const auto loops = boundary_loops(part);
    CornerTrack track;
    track.vertex = loops[size_t(outer_loop(loops, blank.position))];
    track.place = blank.position(Eigen::all, track.vertex);
    const Outline outline(track.vertex, blank.position);
    const int n = outline.size();
    std::vector<double> turn(track.vertex.size(), 0);
    for (int i = 0; i < n; ++i)
        for (const double reach : turn_reaches)
            turn[size_t(i)] +=
                outline.turning(i, reach * outline.perimeter(), reach * outline.perimeter()) / std::size(turn_reaches);
    for (const int i : sharp_turns(turn, track.place, outline.perimeter()))
        track.sharp.push_back(track.vertex[size_t(i)]);
    return track;
}

int nearest_boundary_vertex(const CornerTrack& track, const Camera& camera, glm::dvec2 pixel, glm::dvec2 size,
                            double snap)
{
    int nearest = track.vertex.front(), sharp = -1;
    double least = infinity, least_sharp = snap;
    for (size_t i = 0; i < track.vertex.size(); ++i) {
        const int v = track.vertex[i];
        const Eigen::Vector3d place(track.place(0, Eigen::Index(i)), track.place(1, Eigen::Index(i)), 0);
        const double away = glm::length(glm::dvec2(pixel_of(camera, place, size)) - pixel);
        if (away < least) {
            least = away;
            nearest = v;
        }
        if (away <= least_sharp && std::find(track.sharp.begin(), track.sharp.end(), v) != track.sharp.end()) {
            least_sharp = away;
            sharp = v;
        }
    }
    return sharp >= 0 ? sharp : nearest;
}

} // namespace spia::viewer
