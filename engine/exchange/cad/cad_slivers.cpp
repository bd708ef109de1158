#include "engine/exchange/cad/cad_slivers.h"

#include <BRep_Tool.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/exchange/cad/edge_points.h"

namespace spia {
namespace {

using Polyline = std::vector<Eigen::Vector3d>;

std::vector<Polyline> border_of(const TopoDS_Face& face)
{
    constexpr int parts = 16; // of an edge
    std::vector<Polyline> border;
    for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
        const TopoDS_Edge& edge = TopoDS::Edge(at.Current());
        if (BRep_Tool::Degenerated(edge))
            continue;
        border.push_back(points_along(edge, parts));
    }
    return border;
}

/// From a point of one edge to the other edges.
double to_others(const std::vector<Polyline>& border, size_t edge, const Eigen::Vector3d& p)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t other = 0; other < border.size(); ++other)
        for (size_t k = 1; k < border[other].size() && other != edge; ++k)
            nearest = std::min(nearest, squared_distance(p, border[other][k - 1], border[other][k]));
    return std::sqrt(nearest);
}

} // namespace

std::optional<CadSliver> sliver(const TopoDS_Face& face, double most)
{
    try {
        const std::vector<Polyline> border = border_of(face);
        CadSliver found{0, Eigen::Vector3d::Zero(), -1};
        for (size_t edge = 0; edge < border.size(); ++edge)
            for (const Eigen::Vector3d& p : border[edge]) {
                const double width = to_others(border, edge, p);
                if (!(width <= most))
                    return {};
                if (width >= found.width)
                    found = {width, p, -1};
            }
        if (border.empty())
            return {};
        return found;
    } catch (const Standard_Failure&) {
        return {}; // an edge without a curve
    }
}

} // namespace spia
