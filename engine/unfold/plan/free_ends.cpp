#include "engine/unfold/plan/free_ends.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "engine/core/infinity.h"
#include "engine/core/small_dense.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/segment_distance.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr int samples = 16; ///< lines along a strip on which its ends are looked at

using Edge = std::pair<int, int>;

Edge edge_of(const TriMesh& part, int face, int k)
{
    return std::minmax({part.triangle(k, face), part.triangle((k + 1) % 3, face)});
}

double distance(const Eigen::Vector3d& place, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
    const Eigen::Vector3d way = to - from;
    const double share = way.squaredNorm() > 0 ? (place - from).dot(way) / way.squaredNorm() : 0;
    return (from + std::clamp(share, 0., 1.) * way - place).norm();
}

/// The direction that the normals of some faces are square to, along which the lines of a bend run,
/// and how far they are off that.
struct Turning {
    Eigen::Vector3d axis; ///< unit
    double off;           ///< the sine of an angle, within which nine tenths of the area are
};

Turning turning(const Eigen::Matrix3Xd& normal, const std::vector<int>& faces)
{
    constexpr double most = 0.9;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double whole = 0, area = 0;
    for (const int f : faces) {
        whole += normal.col(f).norm();
        sum += normal.col(f) * normal.col(f).transpose() / normal.col(f).norm();
    }
    Turning result{eigen_pairs(sum).vector.col(0), 0};
    std::vector<std::pair<double, double>> off; // and the area
    for (const int f : faces)
        off.emplace_back(std::abs(result.axis.dot(normal.col(f).normalized())), normal.col(f).norm());
    std::sort(off.begin(), off.end());
    for (size_t i = 0; i < off.size() && area < most * whole; ++i) {
        area += off[i].second;
        result.off = off[i].first;
    }
    return result;
}

} // namespace

/// The end of a strip on a line along it.
struct FreeEnds::End {
    double along; ///< mm; infinite: the strip is not there
    bool rim = false;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

FreeEnds::FreeEnds(const TriMesh& part) : part_(part), normal_(area_vectors(part)), use_(edge_uses(part.triangle))
{
    for_each_edge(use_, [&](size_t begin, size_t end) {
        if (end != begin + 1)
            return;
        rim_.emplace(use_[begin].low, use_[begin].high);
        on_rim_.insert({use_[begin].low, use_[begin].high});
    });
}

/// Both ends on each of the lines.
std::array<std::vector<FreeEnds::End>, 2> FreeEnds::ends(const Strip& strip) const
{
    std::map<Edge, int> times;
    for (const int f : strip.face)
        for (int k = 0; k < 3; ++k)
            ++times[edge_of(part_, f, k)];
    std::array<std::vector<End>, 2> result{std::vector<End>(samples, End{infinity}),
                                           std::vector<End>(samples, End{-infinity})};
    for (size_t i = 0; i < strip.face.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            const Edge edge = edge_of(part_, strip.face[i], k);
            if (times[edge] > 1)
                continue; // inside
            const double from = strip.across[i][k], to = strip.across[i][next];
            for (int s = 0; s < samples; ++s) {
                const double at = (s + 0.5) / samples;
                if ((from < at) == (to < at))
                    continue;
                const double share = (at - from) / (to - from);
                const double along = (1 - share) * strip.along[i][k] + share * strip.along[i][next];
                const Eigen::Vector3d place = (1 - share) * part_.position.col(part_.triangle(k, strip.face[i])) +
                                              share * part_.position.col(part_.triangle(next, strip.face[i]));
                for (const int side : {0, 1})
                    if (End& end = result[size_t(side)][size_t(s)]; side == 0 ? along < end.along : along > end.along)
                        end = {along, rim_.count(edge) > 0, place};
            }
        }
    return result;
}

bool FreeEnds::free(const Strip& strip) const
{
    constexpr double share = 0.25; // of the breadth, and of the length; the sheet beside the end of
                                   // a drawn radius is broader
    constexpr double most = 0.5;   // of the lines
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Eigen::Vector3d& along : strip.along) {
        low = std::min(low, along.minCoeff());
        high = std::max(high, along.maxCoeff());
    }
    const double near = share * std::min(strip.breadth, high - low);
    const auto is_free = [&](const End& end) {
        return end.rim || std::any_of(rim_.begin(), rim_.end(), [&](const Edge& edge) {
                   return distance(end.place, part_.position.col(edge.first), part_.position.col(edge.second)) <= near;
               });
    };
    for (const std::vector<End>& side : ends(strip)) {
        const auto reached =
            std::count_if(side.begin(), side.end(), [](const End& e) { return std::isfinite(e.along); });
        const auto free_ones =
            std::count_if(side.begin(), side.end(), [&](const End& e) { return std::isfinite(e.along) && is_free(e); });
        if (double(free_ones) <= most * double(reached))
            return false;
    }
    return true;
}

/// A fold without faces: its edges lie on one line, and it ends at the edge of the part.
bool FreeEnds::of_fold(const BendMap& map, const Bend& bend) const
{
    constexpr double straight =
        0.01; // of the length: vertices of meshes are rounded, and some of a rim lie a little off
    std::set<int> on;
    for_each_edge(use_, [&](size_t begin, size_t end) {
        if (end == begin + 2 &&
            Edge(std::minmax({map.label[use_[begin].face], map.label[use_[begin + 1].face]})) == Edge(bend.a, bend.b))
            on.insert({use_[begin].low, use_[begin].high});
    });
    if (on.size() < 2)
        return false;
    const std::vector<int> vertex(on.begin(), on.end());
    const Eigen::Matrix3Xd place = part_.position(Eigen::all, vertex);
    const Eigen::Matrix3Xd arm = place.colwise() - place.rowwise().mean();
    const Eigen::Vector3d way = eigen_pairs(arm * arm.transpose()).vector.col(2);
    const Eigen::RowVectorXd along = way.transpose() * arm;
    Eigen::Index first = 0, last = 0;
    const double length = along.maxCoeff(&last) - along.minCoeff(&first);
    return (arm - way * along).colwise().norm().maxCoeff() <= straight * length &&
           on_rim_.count(vertex[size_t(first)]) && on_rim_.count(vertex[size_t(last)]);
}

bool FreeEnds::of(const BendZone& zone) const
{
    Strip strip{zone.face, {}, {}, zone.radius * (zone.to - zone.from)};
    for (size_t i = 0; i < zone.face.size(); ++i) {
        strip.across.push_back((zone.turn[i].array() - zone.from) / (zone.to - zone.from));
        const Eigen::Matrix3d corner = part_.position(Eigen::all, part_.triangle.col(zone.face[i]));
        strip.along.push_back((corner.colwise() - zone.point).transpose() * zone.axis);
    }
    return free(strip);
}

FreeEnds::Strip FreeEnds::band(const BendMap& map, size_t bend, const Eigen::Vector3d& axis,
                               const Eigen::Matrix2Xd& flat) const
{
    const int label = map.label_of_bend(bend);
    std::vector<std::array<int, 2>> from, to;
    for_each_edge(use_, [&](size_t begin, size_t end) {
        if (end != begin + 2)
            return;
        const Edge labels = std::minmax({map.label[use_[begin].face], map.label[use_[begin + 1].face]});
        if (labels.second == label && labels.first == map.bends[bend].a)
            from.push_back({use_[begin].low, use_[begin].high});
        else if (labels.second == label && labels.first == map.bends[bend].b)
            to.push_back({use_[begin].low, use_[begin].high});
    });
    const SegmentDistance to_from(flat, from), to_to(flat, to);
    Strip strip;
    strip.face = map.faces_of(label);
    for (const int f : strip.face) {
        Eigen::Vector3d across, along;
        for (int k = 0; k < 3; ++k) {
            const int v = part_.triangle(k, f);
            const double a = to_from(flat.col(v)), b = to_to(flat.col(v));
            across[k] = a + b > 0 ? a / (a + b) : 0.5;
            along[k] = axis.dot(part_.position.col(v));
            strip.breadth += (a + b) / 3 / double(strip.face.size());
        }
        strip.across.push_back(across);
        strip.along.push_back(along);
    }
    return strip;
}

bool FreeEnds::of(const BendMap& map, size_t bend, const Eigen::Matrix2Xd& flat) const
{
    constexpr double parallel = 15 * std::numbers::pi / 180; // triangles that lie askew over a bend
                                                             // are tilted
    const Bend& of = map.bends[bend];
    if (of.b < 0)
        return false;
    if (of.faces == 0)
        return of_fold(map, of);
    const Turning turned = turning(normal_, map.faces_of(map.label_of_bend(bend)));
    return turned.off <= std::sin(parallel) && free(band(map, bend, turned.axis, flat));
}

} // namespace spia
