#include "engine/mesh/cut/front_march.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "engine/core/infinity.h"

namespace spia {
namespace {

using Eigen::Vector3d;

/// When a front that passed a at time t_a and b at t_b arrives at c: as a straight front across the
/// triangle where it comes from between them, else along an edge.
double arrival(const Vector3d& a, const Vector3d& b, const Vector3d& c, double t_a, double t_b)
{
    const double along_edge = std::min(t_a + (c - a).norm(), t_b + (c - b).norm());
    const double base = (b - a).norm();
    if (!std::isfinite(t_b) || !(base > 0))
        return along_edge;
    const Vector3d axis = (b - a) / base;
    const double x = (c - a).dot(axis), y = ((c - a) - x * axis).norm();
    const double slope = (t_b - t_a) / base; // of the time along the base
    if (std::abs(slope) >= 1)
        return along_edge;
    const double rise = std::sqrt(1 - slope * slope), foot = x - y * slope / rise;
    return foot < 0 || foot > base ? along_edge : std::min(along_edge, t_a + slope * x + rise * y);
}

} // namespace

FrontMarch::FrontMarch(const TriMesh& part)
    : part_(&part), first_(size_t(part.vertices()) + 1, 0), face_(3 * size_t(part.triangles())),
      distance_(size_t(part.vertices()), infinity), done_(size_t(part.vertices()), 0)
{
    for (const int v : part.triangle.reshaped())
        ++first_[size_t(v) + 1];
    for (size_t v = 1; v < first_.size(); ++v)
        first_[v] += first_[v - 1];
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            face_[size_t(next[size_t(part.triangle(k, f))]++)] = f;
}

void FrontMarch::run(const std::vector<int>& sources, const std::vector<char>& stop)
{
    for (const int v : reached_) {
        distance_[size_t(v)] = infinity;
        done_[size_t(v)] = 0;
    }
    reached_.clear();
    end_ = 0;
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
    const auto arrive = [&](int v, double time) {
        if (time >= distance_[size_t(v)])
            return;
        if (distance_[size_t(v)] == infinity)
            reached_.push_back(v);
        distance_[size_t(v)] = time;
        open.emplace(time, v);
    };
    for (const int v : sources)
        arrive(v, 0);
    const auto place = [&](int v) -> Vector3d { return part_->position.col(v); };
    while (!open.empty()) {
        const auto [time, v] = open.top();
        open.pop();
        if (std::exchange(done_[size_t(v)], char(1)))
            continue;
        end_ = time;
        if (stop[size_t(v)])
            return;
        for (int i = first_[size_t(v)]; i < first_[size_t(v) + 1]; ++i) {
            const auto t = part_->triangle.col(face_[size_t(i)]);
            const int k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
            const int p = t[(k + 1) % 3], q = t[(k + 2) % 3];
            for (const auto& [to, third] : {std::pair(p, q), std::pair(q, p)})
                if (!done_[size_t(to)])
                    arrive(to, arrival(place(v), place(third), place(to), time,
                                       done_[size_t(third)] ? distance_[size_t(third)] : infinity));
        }
    }
}

std::vector<int> FrontMarch::crossed_faces() const
{
    std::vector<int> faces;
    for (const int v : reached_)
        for (int i = first_[size_t(v)]; i < first_[size_t(v) + 1]; ++i) {
            const auto t = part_->triangle.col(face_[size_t(i)]);
            if (t[0] == v && distance(t[1]) < infinity && distance(t[2]) < infinity)
                faces.push_back(face_[size_t(i)]);
        }
    return faces;
}

} // namespace spia
