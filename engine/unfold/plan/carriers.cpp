#include "engine/unfold/plan/carriers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "engine/mesh/edge_uses.h"
#include "engine/unfold/target/fit_height.h"

namespace spia {
namespace {

constexpr double exact = 1e-4; // of fit_target()
// On a smooth face flanges land straight on from its edge: how well it goes there shows in the
// angle.
constexpr double most_angle = 0.2; // radians

/// Per region from 1, where what it is joined to lies outside of it, to -1, where it lies around
/// that, as the flange around a cup.
std::vector<double> outwards(const TriMesh& part, const BendMap& map)
{
    std::vector<double> out(map.regions.size(), 0), most(map.regions.size(), 0);
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end - begin != 2)
            return;
        for (const auto& [in, beside] : {std::pair(uses[begin], uses[begin + 1]), {uses[begin + 1], uses[begin]}}) {
            const int r = map.label[in.face];
            if (r >= int(map.regions.size()) || map.label[beside.face] == r)
                continue;
            const Eigen::Matrix3d x = part.position(Eigen::all, part.triangle.col(in.face));
            const Eigen::Vector3d a = x.col(in.corner), b = x.col((in.corner + 1) % 3), c = x.col((in.corner + 2) % 3),
                                  along = (b - a).normalized(), up = c - a,
                                  away = -(up - along.dot(up) * along).normalized(),
                                  arm = (a + b) / 2 - map.regions[size_t(r)].place;
            out[size_t(r)] += (b - a).norm() * away.dot(arm);
            most[size_t(r)] += (b - a).norm() * arm.norm();
        }
    });
    for (size_t r = 0; r < out.size(); ++r)
        out[r] = most[r] > 0 ? out[r] / most[r] : 1;
    return out;
}

} // namespace

double diagonal_of(const TriMesh& part, const std::vector<int>& faces)
{
    Eigen::AlignedBox3d box;
    for (const int f : faces)
        for (const int v : part.triangle.col(f))
            box.extend(part.position.col(v));
    return box.diagonal().norm();
}

Carriers::Carriers(const TriMesh& part, const BendMap& map, double distance, std::vector<int> none)
    : part_(part), map_(map), distance_(distance), none_(std::move(none)), found_(map.regions.size())
{
}

Carriers::Found& Carriers::found(int region)
{
    Found& it = found_[size_t(region)];
    if (it.asked)
        return it;
    it.asked = true;
    const FaceSet faces = map_.faces_of(region);
    const double size = diagonal_of(part_, faces);
    it.plain = fit_target(part_, faces, std::max(exact, distance_ / size));
    it.loose = it.plain && it.plain->distance_mm > exact * size;
    return it;
}

const TargetFit* Carriers::plain(int region)
{
    if (std::binary_search(none_.begin(), none_.end(), region))
        return nullptr;
    const Found& it = found(region);
    return it.plain ? &*it.plain : nullptr;
}

const TargetFit* Carriers::of(int region)
{
    if (std::binary_search(none_.begin(), none_.end(), region))
        return nullptr;
    if (const TargetFit* fit = plain(region))
        return fit;
    Found& it = found(region);
    if (!it.asked_smooth)
        it.smooth = fit_height(part_, map_.faces_of(region));
    it.asked_smooth = true;
    return it.smooth && it.smooth->distance_mm <= distance_ && it.smooth->angle <= most_angle ? &*it.smooth : nullptr;
}

std::string Carriers::why_not(int region)
{
    if (std::binary_search(none_.begin(), none_.end(), region))
        return fmt::format("{} was to carry nothing", map_.name(region));
    const Found& it = found(region);
    if (!it.smooth)
        return fmt::format("{} is not a plane, cylinder or cone and turns too far for a smooth face over a plane",
                           map_.name(region));
    return fmt::format(
        "{} is not a plane, cylinder or cone, and the smooth face through it is {:.3g} mm and {:.3g} deg off it",
        map_.name(region), it.smooth->distance_mm, it.smooth->angle * 180 / std::numbers::pi);
}

bool Carriers::loose(int region) { return plain(region) && found(region).loose; }

int chosen_root(const TriMesh& part, const BendMap& map, Carriers& carriers)
{
    constexpr double around =
        0.1; // what the area of a region counts that lies around the others: all would be stretched
             // into it
    const std::vector<double> out = outwards(part, map);
    constexpr double comparable = 0.25; // a face to lay on is worth a smaller region, but not a
                                        // tiny one
    const auto score = [&](int r) {
        return map.regions[size_t(r)].area * std::pow(map.regions[size_t(r)].flatness, 2) *
               (out[size_t(r)] < 0 ? around : 1);
    };
    int best = 0, best_carrier = -1;
    for (int r = 0; r < int(map.regions.size()); ++r) {
        if (score(r) > score(best) * (1 + 1e-9))
            best = r;
        if (carriers.plain(r) && (best_carrier < 0 || score(r) > score(best_carrier) * (1 + 1e-9)))
            best_carrier = r;
    }
    return best_carrier >= 0 && score(best_carrier) > comparable * score(best) ? best_carrier : best;
}

bool wraps(const TargetSurface& face, const TriMesh& part, const std::set<int>& vertices)
{
    constexpr double gap = 0.5; // radians
    const auto around = [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const Eigen::Vector3d& x) {
        const Eigen::Vector3d y = axis.cross(x);
        std::vector<double> angle;
        for (const int v : vertices) {
            const Eigen::Vector3d arm = part.position.col(v) - origin;
            angle.push_back(std::atan2(y.dot(arm), x.dot(arm)));
        }
        std::sort(angle.begin(), angle.end());
        double widest = angle.front() + 2 * std::numbers::pi - angle.back();
        for (size_t k = 1; k < angle.size(); ++k)
            widest = std::max(widest, angle[k] - angle[k - 1]);
        return widest < gap;
    };
    if (const auto* c = std::get_if<CylinderFace>(&face))
        return around(c->origin, c->axis, c->towards);
    if (const auto* c = std::get_if<ConeFace>(&face))
        return around(c->apex, c->axis, c->towards);
    return false;
}

} // namespace spia
