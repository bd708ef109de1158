#include "engine/exchange/cad_gaps.h"

#include <BRepAdaptor_Curve.hxx>
#include <Eigen/Core>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace spia {
namespace {

constexpr int pieces = 32; // of an edge
constexpr int stride = 4;  // every how manieth point of it is asked

using Polyline = std::vector<Eigen::Vector3d>;

Polyline points_of(const TopoDS_Edge& edge)
{
    Polyline points;
    try {
        const BRepAdaptor_Curve curve(edge);
        const double from = curve.FirstParameter(), to = curve.LastParameter();
        for (int k = 0; k <= pieces; ++k) {
            const gp_Pnt p = curve.Value(from + (to - from) * k / pieces);
            points.emplace_back(p.X(), p.Y(), p.Z());
        }
    } catch (const Standard_Failure&) {
        points.clear(); // an edge without a curve
    }
    return points;
}

double distance2(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    const Eigen::Vector3d along = b - a;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0;
    return (a + t * along - p).squaredNorm();
}

/// Boxes of one size in which segments are looked up.
class SegmentGrid {
public:
    explicit SegmentGrid(double size) : size_(size) {}
    void add(int segment, const Eigen::Vector3d& a, const Eigen::Vector3d& b, double reach)
    {
        const auto low = cell(a.cwiseMin(b).array() - reach), high = cell(a.cwiseMax(b).array() + reach);
        for (int x = low[0]; x <= high[0]; ++x)
            for (int y = low[1]; y <= high[1]; ++y)
                for (int z = low[2]; z <= high[2]; ++z)
                    in_[key({x, y, z})].push_back(segment);
    }
    const std::vector<int>& near(const Eigen::Vector3d& p) const
    {
        static const std::vector<int> none;
        const auto found = in_.find(key(cell(p)));
        return found == in_.end() ? none : found->second;
    }

private:
    double size_;
    std::unordered_map<std::uint64_t, std::vector<int>> in_;
    Eigen::Vector3i cell(const Eigen::Vector3d& p) const { return (p / size_).array().floor().cast<int>(); }
    static std::uint64_t key(
        const Eigen::Vector3i& c) // 21 bits each: others in the same box are only looked at in vain
    {
        const auto part = [](int i) { return std::uint64_t(std::uint32_t(i)) & 0x1fffff; };
        return part(c[0]) | part(c[1]) << 21 | part(c[2]) << 42;
    }
};

} // namespace

std::vector<double> gaps_to_others(std::span<const FreeEdge> edges, double most, const Progress& progress)
{
    std::vector<Polyline> line;
    double length = 0;
    int segments = 0;
    for (const FreeEdge& each : edges) {
        line.push_back(points_of(each.edge));
        for (size_t k = 1; k < line.back().size(); ++k, ++segments)
            length += (line.back()[k] - line.back()[k - 1]).norm();
    }
    if (!(length > 0) || !std::isfinite(length))
        return {};
    SegmentGrid grid(std::max(4 * most, 2 * length / segments));
    const auto number = [](size_t edge, size_t k) { return int(edge) * pieces + int(k); };
    for (size_t e = 0; e < line.size(); ++e)
        for (size_t k = 1; k < line[e].size(); ++k)
            grid.add(number(e, k - 1), line[e][k - 1], line[e][k], most);
    std::vector<double> gaps;
    for (size_t e = 0; e < line.size(); ++e) {
        progress.checkpoint(double(e) / double(line.size()), "measuring the gaps");
        double widest = line[e].empty() ? std::numeric_limits<double>::infinity() : 0;
        for (size_t k = stride; k + 1 < line[e].size();
             k += stride) { // without the ends: something always begins there
            double nearest2 = std::numeric_limits<double>::infinity();
            for (const int segment : grid.near(line[e][k])) {
                const auto other = size_t(segment / pieces), at = size_t(segment % pieces);
                if (edges[other].face != edges[e].face)
                    nearest2 = std::min(nearest2, distance2(line[e][k], line[other][at], line[other][at + 1]));
            }
            widest = std::max(widest, std::sqrt(nearest2));
        }
        if (widest <= most)
            gaps.push_back(widest);
    }
    std::sort(gaps.begin(), gaps.end());
    return gaps;
}

double tolerance_for(std::span<const double> gaps, int edges, double least, double most)
{
    constexpr double nearly_all = 0.9, few = 0.0025, hardly_any = 0.05; // of the gaps, of the edges
    if (double(gaps.size()) < hardly_any * edges || gaps.empty())
        return 0;
    const auto up_to = [&](double t) { return std::upper_bound(gaps.begin(), gaps.end(), t) - gaps.begin(); };
    double tolerance = std::max(least, 1.25 * gaps[size_t(nearly_all * double(gaps.size() - 1))]);
    while (tolerance < most && double(up_to(2 * tolerance) - up_to(tolerance)) >= std::max(1.0, few * edges))
        tolerance *= 2;
    return std::min(tolerance, most);
}

} // namespace spia
