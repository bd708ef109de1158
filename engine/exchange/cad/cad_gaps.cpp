#include "engine/exchange/cad/cad_gaps.h"

#include <Eigen/Geometry>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/exchange/cad/edge_points.h"
#include "engine/mesh/box_tree.h"

namespace spia {
namespace {

constexpr int pieces_of_edge = 32;
constexpr int stride = 4; // every how manieth point of it is asked

using Polyline = std::vector<Eigen::Vector3d>;

/// None of an edge without a curve, or of one that leads beyond all numbers.
Polyline points_of(const TopoDS_Edge& edge)
{
    try {
        Polyline points = points_along(edge, pieces_of_edge);
        const bool finite = std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); });
        return finite ? points : Polyline();
    } catch (const Standard_Failure&) {
        return {};
    }
}

/// The pieces of many edges, to be found by their place. They are kept as triangles of no area:
/// memory goes with their number alone, however long one of them is.
class Segments {
public:
    explicit Segments(const std::vector<Polyline>& lines)
    {
        TriMesh mesh;
        for (size_t e = 0; e < lines.size(); ++e)
            for (size_t k = 1; k < lines[e].size(); ++k)
                edge_.push_back(int(e));
        mesh.position.resize(3, 2 * Eigen::Index(edge_.size()));
        mesh.triangle.resize(3, Eigen::Index(edge_.size()));
        int next = 0;
        for (const Polyline& line : lines)
            for (size_t k = 1; k < line.size(); ++k, ++next) {
                mesh.position.col(2 * next) = line[k - 1];
                mesh.position.col(2 * next + 1) = line[k];
                mesh.triangle.col(next) << 2 * next, 2 * next + 1, 2 * next + 1;
            }
        if (next > 0)
            tree_.emplace(mesh);
    }
    /// Squared distance of the nearest one whose edge is wanted; infinite if none is within reach.
    template <class Wanted> double nearest2(const Eigen::Vector3d& place, double reach, const Wanted& wanted) const
    {
        double best = reach * reach;
        bool found = false;
        std::vector<int> open(tree_ ? 1 : 0, 0);
        while (!open.empty()) {
            const int here = open.back();
            open.pop_back();
            const BoxTree::Node& node = tree_->node[size_t(here)];
            if (node.box.squaredExteriorDistance(place) > best)
                continue;
            for (int i = node.first; i < node.first + node.count; ++i) {
                if (!wanted(edge_[size_t(tree_->face[size_t(i)])]))
                    continue;
                const Eigen::Matrix3d& ends = tree_->triangle[size_t(i)];
                const double away2 = squared_distance(place, ends.col(0), ends.col(1));
                found |= away2 <= best;
                best = std::min(best, away2);
            }
            if (node.count == 0)
                open.insert(open.end(), {node.second, here + 1});
        }
        return found ? best : std::numeric_limits<double>::infinity();
    }

private:
    std::vector<int> edge_; ///< per segment
    std::optional<BoxTree> tree_;
};

} // namespace

std::vector<double> gaps_to_others(std::span<const FreeEdge> edges, double most, const Progress& progress)
{
    std::vector<Polyline> lines;
    for (const FreeEdge& each : edges) {
        progress.checkpoint(0.2 * double(lines.size()) / double(edges.size()), "measuring the gaps");
        lines.push_back(points_of(each.edge));
    }
    const Segments segments(lines);
    std::vector<double> gaps;
    for (size_t e = 0; e < lines.size(); ++e) {
        progress.checkpoint(0.2 + 0.8 * double(e) / double(lines.size()), "measuring the gaps");
        const auto of_others = [&](int edge) { return edges[size_t(edge)].owner != edges[e].owner; };
        double widest2 = lines[e].empty() ? std::numeric_limits<double>::infinity() : 0;
        for (size_t k = stride; k + 1 < lines[e].size() && std::isfinite(widest2);
             k += stride) // without the ends: something always begins there
            widest2 = std::max(widest2, segments.nearest2(lines[e][k], most, of_others));
        if (std::isfinite(widest2))
            gaps.push_back(std::sqrt(widest2));
    }
    std::sort(gaps.begin(), gaps.end());
    return gaps;
}

double tolerance_for(std::span<const double> gaps, double least, double most)
{
    constexpr double nearly_all = 0.9, few = 0.0025; // of the gaps
    if (gaps.empty())
        return 0;
    const auto up_to = [&](double t) { return std::upper_bound(gaps.begin(), gaps.end(), t) - gaps.begin(); };
    double tolerance = std::max(least, 1.25 * gaps[size_t(nearly_all * double(gaps.size() - 1))]);
    while (tolerance < most &&
           double(up_to(2 * tolerance) - up_to(tolerance)) >= std::max(1.0, few * double(gaps.size())))
        tolerance *= 2;
    return std::min(tolerance, most);
}

} // namespace spia
