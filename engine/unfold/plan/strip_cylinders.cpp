#include "engine/unfold/plan/strip_cylinders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "engine/mesh/disjoint_sets.h"

namespace spia {
namespace {

// A meshers' chords turn by 0.5 rad at most (OpenCASCADE's default; ours 20 degrees), and by more
// than the triangles of one plane do that are rounded to six digits: 1e-4 mm over a width of 0.1
// mm.
constexpr double most_turn = 0.6, least_turn = 1e-3;
constexpr double parallel = 5e-3;  // radians: rounded likewise over a length of 0.02 mm and more
constexpr double on_circle = 2e-3; // of the radius: middle surfaces between skins of different
                                   // chords are off by half a sagitta

/// The straight edge between two plane pieces.
struct Ruling {
    int a, b;                  ///< facets, a < b
    Eigen::Vector3d direction; ///< of both its ends, mm
    double length;             ///< mm
    double turn;               ///< radians, positive where it bulges
};

class Strips {
public:
    Strips(const TriMesh& part, const Eigen::Matrix3Xd& normal, const Eigen::Matrix3Xi& neighbour, bool tangential)
        : part_(part), normal_(normal), neighbour_(neighbour), tangential_(tangential),
          facet_(size_t(part.triangles())), faces_(facet_.size()), beside_(facet_.size()), taken_(facet_.size(), 0)
    {
        join_planes();
        find_rulings();
    }

    std::vector<StripCylinder> cylinders()
    {
        // Chords are narrower than the flats between bends: with them first, a flat is not taken
        // for one.
        std::vector<std::pair<double, std::pair<int, int>>> seeds;
        for (const Ruling& r : ruling_)
            if (is_strip(r.a) && is_strip(r.b))
                seeds.push_back({width(r.a) + width(r.b), {r.a, r.b}});
        std::sort(seeds.begin(), seeds.end());
        std::vector<StripCylinder> result;
        for (const auto& [size, pair] : seeds)
            if (!taken_[size_t(pair.first)] && !taken_[size_t(pair.second)])
                if (auto found = grown(pair.first, pair.second))
                    result.push_back(std::move(*found));
        std::sort(result.begin(), result.end(),
                  [](const StripCylinder& x, const StripCylinder& y) { return x.face.front() < y.face.front(); });
        return result;
    }

private:
    double turn(int f, int g) const
    {
        return std::atan2(normal_.col(f).cross(normal_.col(g)).norm(), normal_.col(f).dot(normal_.col(g)));
    }

    void join_planes()
    {
        DisjointSets planes(facet_.size());
        for (int f = 0; f < part_.triangles(); ++f)
            for (int k = 0; k < 3; ++k)
                if (const int g = neighbour_(k, f); g > f && turn(f, g) < least_turn)
                    planes.join(f, g);
        for (int f = 0; f < part_.triangles(); ++f) {
            facet_[size_t(f)] = planes.root(f);
            faces_[size_t(planes.root(f))].push_back(f);
        }
    }

    /// Of the edges between two facets, in the order of these, that which they are together.
    void find_rulings()
    {
        std::vector<Ruling> edges;
        for (int f = 0; f < part_.triangles(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int g = neighbour_(k, f);
                if (g < 0 || facet_[size_t(f)] >= facet_[size_t(g)])
                    continue; // seen from the first of both, all run the same way
                const Eigen::Vector3d edge =
                    part_.position.col(part_.triangle((k + 1) % 3, f)) - part_.position.col(part_.triangle(k, f));
                const bool bulging = normal_.col(f).cross(normal_.col(g)).dot(edge) > 0;
                edges.push_back(
                    {facet_[size_t(f)], facet_[size_t(g)], edge, edge.norm(), (bulging ? 1 : -1) * turn(f, g)});
            }
        const auto of = [](const Ruling& r) { return std::pair(r.a, r.b); };
        std::stable_sort(edges.begin(), edges.end(), [&](const auto& r, const auto& s) { return of(r) < of(s); });
        for (auto begin = edges.begin(), end = begin; begin != edges.end(); begin = end) {
            Ruling whole{begin->a, begin->b, Eigen::Vector3d::Zero(), 0, 0};
            for (; end != edges.end() && of(*end) == of(*begin); ++end) {
                whole.direction += end->direction;
                whole.length += end->length;
                whole.turn += end->turn * end->length;
            }
            whole.turn /= whole.length;
            const bool straight = whole.direction.norm() > (1 - parallel * parallel) * whole.length;
            if (!straight || std::abs(whole.turn) > most_turn)
                continue;
            beside_[size_t(whole.a)].push_back(int(ruling_.size()));
            beside_[size_t(whole.b)].push_back(int(ruling_.size()));
            ruling_.push_back(whole);
        }
    }

    bool alongside(const Ruling& r, const Ruling& s) const
    {
        return r.turn * s.turn > 0 &&
               r.direction.cross(s.direction).norm() < parallel * r.direction.norm() * s.direction.norm();
    }

    /// Between two rulings that turn it the same way.
    bool is_strip(int facet) const
    {
        const std::vector<int>& beside = beside_[size_t(facet)];
        for (const int r : beside)
            for (const int s : beside)
                if (r < s && alongside(ruling_[size_t(r)], ruling_[size_t(s)]))
                    return true;
        return false;
    }

    /// mm, across its longest ruling
    double width(int facet) const
    {
        const Ruling* longest = nullptr;
        for (const int r : beside_[size_t(facet)])
            if (!longest || ruling_[size_t(r)].length > longest->length)
                longest = &ruling_[size_t(r)];
        const Eigen::Vector3d side = longest->direction.cross(normal_.col(faces_[size_t(facet)].front())).normalized();
        const auto [least, most] = extent(facet, [&](const Eigen::Vector3d& p) { return side.dot(p); });
        return most - least;
    }

    template <class Measure> std::pair<double, double> extent(int facet, const Measure& measure) const
    {
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (const int f : faces_[size_t(facet)])
            for (int k = 0; k < 3; ++k) {
                const double x = measure(part_.position.col(part_.triangle(k, f)));
                least = std::min(least, x);
                most = std::max(most, x);
            }
        return {least, most};
    }

    std::vector<int> faces_of(const std::vector<int>& facets) const
    {
        std::vector<int> faces;
        for (const int facet : facets)
            faces.insert(faces.end(), faces_[size_t(facet)].begin(), faces_[size_t(facet)].end());
        std::sort(faces.begin(), faces.end());
        return faces;
    }

    /// Its corners lie on the cylinder, and it looks straight away from the axis over its middle: a
    /// flat that goes on tangentially is short enough for the first as well, but looks where it
    /// begins.
    bool is_chord_of(const FittedCylinder& cylinder, int facet) const
    {
        const std::vector<int>& faces = faces_[size_t(facet)];
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        for (const int f : faces) {
            if (!lies_on(part_, cylinder, f, on_circle * cylinder.radius) ||
                std::abs(normal_.col(f).normalized().dot(cylinder.axis)) > parallel)
                return false;
            normal += normal_.col(f);
        }
        const Eigen::Matrix<double, 3, 2> frame = across(cylinder.axis);
        const Eigen::Vector2d n = frame.transpose() * normal;
        const Eigen::Vector2d from =
            frame.transpose() * (part_.position.col(part_.triangle(0, faces.front())) - cylinder.point);
        const Eigen::Vector2d away = n.dot(from) > 0 ? n : Eigen::Vector2d(-n);
        const auto [least, most] = extent(facet, [&](const Eigen::Vector3d& p) {
            const Eigen::Vector2d q = frame.transpose() * (p - cylinder.point);
            return std::atan2(away.x() * q.y() - away.y() * q.x(), away.dot(q));
        });
        constexpr double askew = 0.5; // of half its angle; a tangential flat is by all of it
        return std::abs(least + most) / 2 < askew * (most - least) / 2;
    }

    std::optional<StripCylinder> grown(int a, int b)
    {
        std::vector<int> facets{a, b};
        std::set<int> in{a, b};
        auto cylinder = cylinder_of(part_, normal_, neighbour_, faces_of(facets));
        size_t fitted = facets.size();
        for (size_t i = 0; i < facets.size(); ++i) {
            if (!cylinder || cylinder->off > on_circle * cylinder->radius || !is_chord_of(*cylinder, a) ||
                !is_chord_of(*cylinder, b))
                return std::nullopt;
            for (const int r : beside_[size_t(facets[i])]) {
                const int next = ruling_[size_t(r)].a == facets[i] ? ruling_[size_t(r)].b : ruling_[size_t(r)].a;
                if (taken_[size_t(next)] || in.count(next) || !is_chord_of(*cylinder, next))
                    continue;
                facets.push_back(next);
                in.insert(next);
            }
            if (facets.size() >= 2 * fitted ||
                (i + 1 == facets.size() && facets.size() > fitted)) { // the more, the better
                cylinder = cylinder_of(part_, normal_, neighbour_, faces_of(facets));
                fitted = facets.size();
                i = size_t(-1); // and those beside it again
            }
        }
        if (!is_tessellated(facets, in, *cylinder))
            return std::nullopt;
        for (const int facet : facets)
            taken_[size_t(facet)] = 1;
        return StripCylinder{*cylinder, faces_of(facets)};
    }

    /// radians, of the facet around the axis
    double chord(int facet, const FittedCylinder& cylinder) const
    {
        const Eigen::Matrix<double, 3, 2> frame = across(cylinder.axis);
        const Eigen::Vector3d from =
            part_.position.col(part_.triangle(0, faces_[size_t(facet)].front())) - cylinder.point;
        const Eigen::Vector2d start = frame.transpose() * from;
        const auto [least, most] = extent(facet, [&](const Eigen::Vector3d& p) {
            const Eigen::Vector2d q = frame.transpose() * (p - cylinder.point);
            return std::atan2(start.x() * q.y() - start.y() * q.x(), start.dot(q));
        });
        return most - least;
    }

    /// Whether it is a cylinder that was cut into chords, and not a few flats that happen to lie
    /// around a circle.
    bool is_tessellated(const std::vector<int>& facets, const std::set<int>& in, const FittedCylinder& cylinder) const
    {
        constexpr double alike = 0.1; // of the chord; what a mesh has is its cylinder's share, but
                                      // for rounding
        constexpr size_t many = 4;
        double least = std::numeric_limits<double>::infinity(), most = 0;
        for (const int facet : facets) {
            least = std::min(least, chord(facet, cylinder));
            most = std::max(most, chord(facet, cylinder));
        }
        if (most > most_turn)
            return false;
        if (!tangential_ && facets.size() >= many && most - least < alike * most)
            return true;
        bool tangent = false;
        for (const int facet : facets)
            for (const int r : beside_[size_t(facet)]) {
                const Ruling& ruling = ruling_[size_t(r)];
                const int other = ruling.a == facet ? ruling.b : ruling.a;
                if (in.count(other) ||
                    ruling.direction.cross(cylinder.axis).norm() > parallel * ruling.direction.norm())
                    continue;
                const double half = chord(facet, cylinder) / 2;
                if (std::abs(std::abs(ruling.turn) - half) > alike * half + least_turn)
                    return false;
                tangent = true;
            }
        return tangent;
    }

    const TriMesh& part_;
    const Eigen::Matrix3Xd& normal_;
    const Eigen::Matrix3Xi& neighbour_;
    bool tangential_;
    std::vector<int> facet_;              ///< per face, its plane piece: the number of the first
                                          ///< face of that
    std::vector<std::vector<int>> faces_; ///< per facet, ascending
    std::vector<Ruling> ruling_;
    std::vector<std::vector<int>> beside_; ///< per facet: rulings
    std::vector<char> taken_;              ///< per facet
};

} // namespace

std::vector<StripCylinder> strip_cylinders(const TriMesh& part, const Eigen::Matrix3Xd& normal,
                                           const Eigen::Matrix3Xi& neighbour, bool tangential)
{
    return Strips(part, normal, neighbour, tangential).cylinders();
}

} // namespace spia
