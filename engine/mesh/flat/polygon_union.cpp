#include "engine/mesh/flat/polygon_union.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <polyclipping/clipper.hpp>
#include <utility>

#include "engine/mesh/vectors.h"

namespace spia {
namespace {

using Key = std::pair<ClipperLib::cInt, ClipperLib::cInt>;

/// The whole numbers that polygons' booleans are exact in.
class Grid {
public:
    explicit Grid(const std::vector<const Eigen::Matrix2Xd*>& polygons)
    {
        Eigen::Array2d low = polygons.front()->rowwise().minCoeff(), high = low;
        for (const Eigen::Matrix2Xd* each : polygons) {
            low = low.min(each->rowwise().minCoeff().array());
            high = high.max(each->rowwise().maxCoeff().array());
        }
        middle_ = (low + high) / 2;
        constexpr double largest = 1 << 29; // products of two fit into 64 bits
        step_ = std::max((high - low).maxCoeff() / 2, 1e-300) / largest;
    }
    double step() const { return step_; } ///< mm

    ClipperLib::IntPoint take(const Eigen::Vector2d& place)
    {
        const Eigen::Vector2d at = (place - middle_) / step_;
        const Key key(std::llround(at.x()), std::llround(at.y()));
        exact_.try_emplace(key, place);
        return {key.first, key.second};
    }
    /// The corner that has been taken there or beside; where triangles cross there is none.
    Eigen::Vector2d place(const ClipperLib::IntPoint& at) const
    {
        for (const auto& [dx, dy] : {Key(0, 0), {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}})
            if (const auto found = exact_.find({at.X + dx, at.Y + dy}); found != exact_.end())
                return found->second;
        return middle_ + step_ * Eigen::Vector2d(double(at.X), double(at.Y));
    }

private:
    Eigen::Vector2d middle_;
    double step_; ///< mm
    std::map<Key, Eigen::Vector2d> exact_;
};

/// Leaves out corners that are straight, or the end of a spike, within rounding.
std::vector<Eigen::Vector2d> without_straight_corners(std::vector<Eigen::Vector2d> ring, double within)
{
    const auto straight = [&](size_t i) {
        const size_t n = ring.size();
        const Eigen::Vector2d &before = ring[(i + n - 1) % n], &at = ring[i], &after = ring[(i + 1) % n];
        const Eigen::Vector2d a = at - before, b = after - at;
        return std::abs(cross(a, b)) <= within * std::max({a.norm(), b.norm(), (after - before).norm()});
    };
    for (size_t i = 0, kept = 0; ring.size() >= 3 && kept < ring.size();)
        if (straight(i % ring.size())) {
            ring.erase(ring.begin() + std::ptrdiff_t(i % ring.size()));
            i = (i + ring.size() - 1) % std::max<size_t>(ring.size(), 1); // the one before may be straight now
            kept = 0;
        } else {
            ++i;
            ++kept;
        }
    return ring;
}

} // namespace

std::vector<Eigen::Matrix2Xd> polygon_union(const std::vector<Eigen::Matrix2Xd>& rows,
                                            const std::vector<Eigen::Matrix2Xd>& without)
{
    if (rows.empty())
        return {};
    std::vector<const Eigen::Matrix2Xd*> all;
    for (const std::vector<Eigen::Matrix2Xd>* each : {&rows, &without})
        for (const Eigen::Matrix2Xd& polygon : *each)
            all.push_back(&polygon);
    Grid grid(all);
    ClipperLib::Clipper clipper;
    for (size_t i = 0; i < all.size(); ++i) {
        ClipperLib::Path corner;
        for (const auto& p : all[i]->colwise())
            corner.push_back(grid.take(p));
        const bool subject = i < rows.size();
        if (!subject && !ClipperLib::Orientation(corner))
            ClipperLib::ReversePath(corner);
        clipper.AddPath(corner, subject ? ClipperLib::ptSubject : ClipperLib::ptClip, true);
    }
    ClipperLib::Paths covered;
    clipper.StrictlySimple(true);
    clipper.Execute(without.empty() ? ClipperLib::ctUnion : ClipperLib::ctDifference, covered, ClipperLib::pftPositive,
                    ClipperLib::pftPositive);
    std::vector<Eigen::Matrix2Xd> rings;
    for (const ClipperLib::Path& path : covered) {
        std::vector<Eigen::Vector2d> ring;
        for (const ClipperLib::IntPoint& p : path)
            if (const Eigen::Vector2d place = grid.place(p); ring.empty() || place != ring.back())
                ring.push_back(place);
        constexpr double rounding = 4; // steps
        ring = without_straight_corners(std::move(ring), rounding * grid.step());
        if (ring.size() < 3)
            continue;
        rings.emplace_back(2, ring.size());
        for (size_t i = 0; i < ring.size(); ++i)
            rings.back().col(Eigen::Index(i)) = ring[i];
    }
    return rings;
}

} // namespace spia
